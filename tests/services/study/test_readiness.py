"""What cannot be run is told before anybody takes part, in one line."""

import pytest

from services.study.exceptions import ProtocolUnfit
from services.study.instruments.library import load
from services.study.protocols import SHIPPED
from services.study.readiness import ready
from services.study.records import SCORES
from services.study.study import new_study, open_study
from sim.exceptions import OutOfReach, SimError, UnknownScene, UnknownVariant


@pytest.fixture
def changed(tmp_path):
    """A function that makes a study whose protocol has a text put in another's place."""

    def make(old, new):
        folder = new_study(tmp_path / "study", SHIPPED["thesis"]).folder
        text = (folder / "protocol.toml").read_text(encoding="utf-8")
        assert old in text
        (folder / "protocol.toml").write_text(text.replace(old, new), encoding="utf-8")
        return open_study(folder)

    return make


@pytest.mark.parametrize(
    ("old", "new", "raised"),
    [
        ('scene = "dishwasher"', 'scene = "dishwaher"', UnknownScene),
        ('variant = "b2"', 'variant = "b7"', UnknownVariant),
        ('variant = "b2"', 'variant = "b2"\nobject_position = [9.0, 0.0, 0.5]', OutOfReach),
        ('variant = "b2"', 'variant = "b2"\nobject_position = [0.5, 0.0]', OutOfReach),
    ],
)
def test_a_task_that_cannot_be_is_refused(changed, old, new, raised):
    assert issubclass(raised, SimError)
    with pytest.raises(raised):
        ready(changed(old, new))


@pytest.mark.parametrize("measure", ["sus", "trust"])
def test_a_hypothesis_about_what_is_not_asked_is_refused(changed, measure):
    study = changed('measure = "workload"', f'measure = "{measure}"')
    with pytest.raises(ProtocolUnfit, match=r"Workload: online against offline: .*after_method \(nasa_tlx\)"):
        ready(study)


@pytest.mark.parametrize("measure", ["sus", "trust"])
def test_one_about_what_is_asked_passes(changed, measure):
    study = changed('measure = "workload"', f'measure = "{measure}"')
    text = (study.folder / "protocol.toml").read_text(encoding="utf-8")
    asked = text.replace('after_method = ["nasa_tlx"]', f'after_method = ["{measure}"]')
    (study.folder / "protocol.toml").write_text(asked, encoding="utf-8")
    ready(open_study(study.folder))


def test_every_rated_measure_is_a_score_of_a_questionnaire_that_comes_with_retouch():
    scores = {score.name for name in ("nasa_tlx", "sus", "trust") for score in load(None, name).scores}
    assert set(SCORES.values()) <= scores
