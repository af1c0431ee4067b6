"""The configuration: defaults that work, and one line for what is wrong, with its place."""

import os

import pytest

from services.cli import parser
from services.commands.settings import configuration
from services.process.config import Configuration, load, save
from services.process.exceptions import ConfigurationError
from services.process.master_devices import Keyboard, Page, Scripted
from services.process.written import LARGEST
from sim.exceptions import UnknownVariant
from sim.tasks import SCENES


@pytest.fixture
def write(tmp_path):
    def write_(text, name="retouch.toml"):
        path = tmp_path / name
        path.write_text(text)
        return path

    return write_


def test_an_empty_file_is_the_default(write):
    assert load(write("")) == Configuration()


def test_what_is_saved_is_what_is_loaded(tmp_path):
    configuration_ = Configuration(name="kitchen", seed=7)
    save(configuration_, tmp_path / "c.json")
    assert load(tmp_path / "c.json") == configuration_


@pytest.mark.parametrize(
    ("text", "said"),
    [
        ("naem = 'x'", "retouch.toml: unknown key naem; did you mean name?"),
        ("[robot]\nscnee = 'table'", "[robot]: unknown key scnee; did you mean scene?"),
        ("[viewer]\nqqq = 1", "[viewer]: unknown key qqq; one of "),
        ("[master.device]\nkind = 'keyboard'\ngrwoth = 1", "[master.device]: unknown key grwoth; did you mean growth?"),
        (
            "[master.device]\ngrowth = 1.0",
            "[master] device: the key is missing: `kind`; one of page, keyboard, gamepad, pointer, spacemouse,",
        ),
        ("[model]\nkind = 'magic'", "[model] kind: expected a text; one of adaptive, promp"),
        ("[station]\nadapt = 'x'", "[station] adapt: invalid value 'x'; one of next, current"),
        ("robot = 3", "robot: expected a section, got a whole number"),
        ("seed = 'one'", "seed: "),
        ("seed = -1", "seed: "),
        ("[station]\nport = 70000", "[station] port: "),
        (
            "[master.device]\nkind = 'mouse'",
            "[master.device] kind: invalid value 'mouse'; one of page, keyboard, gamepad, pointer, spacemouse,",
        ),
        ("[robot]\nvelocity_scale = 2.0", "[robot] velocity_scale: "),
        ("[robot]\nhold_after_s = 0.26", "[robot] hold_after_s: "),
        ("[robot]\npresence_after_s = 0.26", "[robot] presence_after_s: "),
        ("[robot]\nlease_s = 3.01", "[robot] lease_s: "),
        ("[robot]\nlease_s = nan", "[robot] lease_s: "),
        ("[robot]\nmaster_gain = 11.0", "[robot] master_gain: "),
        ("seed = ", "nvalid"),
    ],
)
def test_what_is_wrong_is_named_with_its_place_in_one_line(write, text, said):
    path = write(text)
    with pytest.raises(ConfigurationError, match=r"retouch\.toml") as caught:
        load(path)
    assert said in str(caught.value)
    assert "\n" not in str(caught.value)


@pytest.mark.parametrize("encoding", ["utf-8-sig", "utf-16", "utf-16-le", "utf-16-be"])
@pytest.mark.parametrize("ending", ["\n", "\r\n", "\r"])
@pytest.mark.parametrize(("name", "text"), [("c.toml", "# größer\nname = 'k'\n"), ("c.json", '{\n"name": "k"}\n')])
def test_a_file_is_read_whatever_editor_wrote_it(tmp_path, name, text, ending, encoding):
    mark = "\ufeff" if encoding in ("utf-16-le", "utf-16-be") else ""
    (tmp_path / name).write_bytes((mark + text.replace("\n", ending)).encode(encoding))
    assert load(tmp_path / name).name == "k"


def test_a_byte_that_is_no_utf8_is_named_with_its_line(tmp_path):
    (tmp_path / "c.toml").write_bytes("name = 'k'\n# größer\n".encode("latin-1"))
    with pytest.raises(ConfigurationError, match=r"line 2.*0xf6.*UTF-8"):
        load(tmp_path / "c.toml")


def test_a_mistake_in_json_is_named_with_its_line(tmp_path):
    (tmp_path / "c.json").write_text('{\n"name": "k",\n}')
    with pytest.raises(ConfigurationError, match="line 3"):
        load(tmp_path / "c.json")


@pytest.mark.parametrize(("name", "text"), [("c.toml", "a = " + "[" * 5000), ("c.json", '{"a": ' + "[" * 5000)])
def test_what_is_nested_without_end_is_one_line(tmp_path, name, text):
    (tmp_path / name).write_text(text)
    with pytest.raises(ConfigurationError) as caught:
        load(tmp_path / name)
    assert "\n" not in str(caught.value)


def test_what_is_no_file_is_not_waited_for(tmp_path):
    os.mkfifo(tmp_path / "pipe")
    for path, word in ((tmp_path, "folder"), (tmp_path / "pipe", "pipe")):
        with pytest.raises(ConfigurationError, match=word):
            load(path)


def test_what_is_too_large_is_not_read(tmp_path):
    with (tmp_path / "c.toml").open("wb") as file:
        file.truncate(LARGEST + 1)
    with pytest.raises(ConfigurationError, match="larger"):
        load(tmp_path / "c.toml")


def test_a_file_that_is_not_there_is_named(tmp_path):
    with pytest.raises(ConfigurationError, match=r"absent\.toml"):
        load(tmp_path / "absent.toml")


def parsed(*argv):
    return configuration(parser().parse_args(argv))


def test_flags_go_before_the_file(write):
    path = write("name = 'kitchen'\nseed = 3\n[robot]\nscene = 'dishwasher'")
    result = parsed("up", "--config", str(path), "--seed", "5", "--scene", "table")
    assert (result.name, result.seed, result.robot.scene) == ("kitchen", 5, "table")


def test_a_person_has_what_the_page_reads_and_a_headless_run_the_script():
    assert isinstance(parsed("up").master.device, Page)
    headless = parsed("up", "--headless", "--once")
    assert isinstance(headless.master.device, Scripted)
    assert headless.station.scripted
    assert headless.station.once


def test_who_listens_everywhere_connects_to_itself():
    result = parsed("up", "--listen", "tls/0.0.0.0:7999")
    assert (result.listen, result.connect) == ("tls/0.0.0.0:7999", "tls/127.0.0.1:7999")


def test_the_documented_example_is_valid(write):
    example = "name = 'kitchen'\n[model]\nkind = 'promp'\n[master.device]\nkind = 'keyboard'\ngrowth = 0.08\n"
    assert load(write(example)).master.device == Keyboard(growth=0.08)


def test_the_variant_that_is_taught_is_one_of_the_scenes():
    assert parsed("up").station.variant == ""
    assert parsed("up", "--scene", "particle", "--variant", "free").station.variant == "free"
    with pytest.raises(UnknownVariant, match="b1, b2"):
        parsed("up", "--variant", "free")


def test_the_help_names_every_scene(capsys):
    with pytest.raises(SystemExit):
        parser().parse_args(["up", "--help"])
    said = capsys.readouterr().out
    assert all(name in said for name in SCENES)
