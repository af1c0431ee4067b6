"""A protocol says what it means, or what is wrong with it in one line."""

import pytest

from services.offline.people.ways import Device, Teaching
from services.process.exceptions import ConfigurationError
from services.study.exceptions import ProtocolUnfit
from services.study.protocol.protocol import load
from services.study.protocols import SHIPPED


@pytest.fixture
def changed(tmp_path):
    """A function that loads the thesis' protocol with a text put in another's place."""

    def load_changed(old, new):
        text = SHIPPED["thesis"].read_text(encoding="utf-8")
        assert old in text
        path = tmp_path / "protocol.toml"
        path.write_text(text.replace(old, new), encoding="utf-8")
        return load(path)

    return load_changed


def test_the_thesis_protocol_is_the_thesis():
    protocol = load(SHIPPED["thesis"])
    how = {method.name: (method.teaching, method.device) for method in protocol.methods}
    assert how == {
        "OnStyl": (Teaching.PREDICTION, Device.STYLUS),
        "OnKey": (Teaching.PREDICTION, Device.KEYBOARD),
        "OffStyl": (Teaching.DEMONSTRATION, Device.STYLUS),
        "OffKey": (Teaching.WAYPOINTS, Device.KEYBOARD),
    }
    assert (protocol.task.models, protocol.task.updates, protocol.task.refinements) == (3, 8, 10)
    assert (protocol.training.successes, protocol.training.of_last, protocol.training.minutes) == (2, 4, 30.0)
    assert len(protocol.analysis.hypotheses) == 4


@pytest.mark.parametrize(
    ("old", "new", "said"),
    [
        ("format = 1", "format = 2", "format: this version reads format 1, the file says 2"),
        ('name = "OnKey"', 'name = "OnStyl"', "methods: OnStyl stands there twice"),
        (
            '["OnStyl", "OnKey", "OffKey", "OffStyl"]',
            '["OnStyl", "OnKey"]',
            "order.table, row 1: it has to",
        ),
        ('languages = ["en", "de", "nl"]', 'languages = ["en", "fr"]', "consent.text: there is none in fr"),
        ('first = ["OnStyl", "OnKey"]', 'first = ["OnStil"]', "no method is called OnStil"),
        ('second = ["OnKey", "OffKey"]', 'second = ["OnStyl", "OffKey"]', "it wants methods on both sides"),
        ("successes = 2", "successes = 5", "training: 5 of the last 4 cannot be"),
        ('design = "table"', 'design = "williams"', 'order.table: it is for design = "table"'),
    ],
)
def test_what_contradicts_itself_is_told_with_its_place(changed, old, new, said):
    with pytest.raises(ProtocolUnfit, match=r"protocol\.toml: ") as caught:
        changed(old, new)
    assert said in str(caught.value)


@pytest.mark.parametrize(
    ("old", "new", "said"),
    [
        ("models = 3", "models = 0", "models"),
        ("compensation", "compensaton", "did you mean compensation"),
        (
            'device = "keyboard"',
            'device = "keybord"',
            r"\[\[methods\]\] number 2, device: invalid value .keybord.; one of stylus, keyboard",
        ),
    ],
)
def test_what_does_not_fit_is_told_as_its_writer_would(changed, old, new, said):
    with pytest.raises(ConfigurationError, match=said):
        changed(old, new)
