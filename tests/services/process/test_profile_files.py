"""A person's profiles: read strictly, written as they are read."""

import os

import pytest

from services.process.default_profiles import STANDARD_GAMEPAD
from services.process.exceptions import ConfigurationError
from services.process.profile import Buttons, Way
from services.process.profile_files import load_profile, load_profiles, profiles_folder, save_profile


@pytest.fixture(autouse=True)
def folder(tmp_path, monkeypatch):
    """Where this test's profiles are."""
    monkeypatch.setenv("XDG_CONFIG_HOME", str(tmp_path))
    return tmp_path / "retouch" / "devices"


def write(folder, name, text):
    folder.mkdir(parents=True, exist_ok=True)
    (folder / f"{name}.toml").write_text(text)
    return folder / f"{name}.toml"


def test_without_a_folder_there_are_none_and_none_is_made(folder):
    assert load_profiles() == ()
    assert profiles_folder() == folder
    assert not folder.exists()


def test_what_a_file_says_goes_over_a_default(folder):
    text = """
        kind = "gamepad"
        device = "Xbox"
        left_hand = true
        dead_zone = 0.2
        [ways.z]
        axis = 5
        rest = -1.0
        [buttons]
        finish = 3
        """
    (own,) = load_profiles(write(folder, "xbox", text).stem)
    assert (own.name, own.profile.device) == ("xbox", "Xbox")
    profile = own.over(STANDARD_GAMEPAD)
    assert (profile.left_hand, profile.dead_zone, profile.expo) == (True, 0.2, STANDARD_GAMEPAD.expo)
    assert profile.ways.z == Way(axis=5, rest=-1.0)
    assert profile.ways.x == STANDARD_GAMEPAD.ways.x
    assert profile.buttons == Buttons(finish=3)


@pytest.mark.parametrize(
    ("text", "said"),
    [
        ("", "the key is missing: `kind`"),
        ("kind = 'mouse'", "kind: invalid value 'mouse'; one of gamepad, phantom, pointer, spacemouse"),
        ("kind = 'gamepad'\ndeadzone = 0.1", "unknown key deadzone; did you mean dead_zone?"),
        ("kind = 'gamepad'\ndead_zone = 2", "dead_zone: expected a number <= 0.9"),
        ("kind = 'gamepad'\n[ways.x]\nsign = 0", "[ways.x] sign: invalid value 0; one of -1, 1"),
        ("kind = 'gamepad'\n[ways.forward]", "[ways]: unknown key forward; one of x, y, z, roll, pitch, yaw"),
        ("kind = 'gamepad'\n[ways.x]\nrest = 0.5\nhigh = 0.2", "[ways] x: rest 0.5 does not lie between low -1"),
        ("kind = 'gamepad'\n[buttons]\nfinish = 'A'", "[buttons] finish: expected a whole number"),
        ("kind = ", "nvalid"),
    ],
)
def test_what_is_wrong_is_named_with_its_place_in_one_line(folder, text, said):
    path = write(folder, "bad", text)
    with pytest.raises(ConfigurationError) as caught:
        load_profiles()
    assert f"profile {path}: " in str(caught.value)
    assert said in str(caught.value)
    assert "\n" not in str(caught.value)


def test_one_that_is_named_and_not_there_is_named():
    with pytest.raises(ConfigurationError, match=r"profile .*mine\.toml: No such file"):
        load_profiles("mine")


def test_what_is_written_is_read_again(folder):
    said = {
        "kind": "gamepad",
        "device": 'A "pad" \\ with é',
        "left_hand": False,
        "ways": {
            "x": {"axis": 1, "sign": -1, "rest": 0.0125, "low": -1.0, "high": 0.75},
            "roll": {"plus": 5, "minus": 4},
        },
        "buttons": {"finish": 0, "clutch": None},
    }
    save_profile(folder / "pad.toml", said, ["Measured.", "By hand."])
    own = load_profile(folder / "pad.toml")
    assert own.profile.device == said["device"]
    assert own.profile.ways.x == Way(axis=1, sign=-1, rest=0.0125, low=-1.0, high=0.75)
    assert own.profile.ways.roll == Way(plus=5, minus=4)
    assert own.profile.buttons == Buttons(finish=0)
    assert (folder / "pad.toml").read_text().startswith("# Measured.\n# By hand.\nkind = ")


def test_a_folder_that_cannot_be_written_is_said_when_it_has_to_be(folder, tmp_path):
    if os.geteuid() == 0:
        (tmp_path / "retouch").write_text("in the way")
    else:
        tmp_path.chmod(0o500)
    with pytest.raises(OSError, match=r"."):
        save_profile(folder / "pad.toml", {"kind": "gamepad"}, [])
