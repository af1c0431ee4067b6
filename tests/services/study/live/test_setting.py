"""What a part is run with: the protocol's method, place and limits, and nothing that a participant could change."""

from pathlib import Path

import pytest

from protocol.messages import Method as Way
from services.offline.people.ways import Device, Teaching
from services.process.config import load as load_configuration
from services.process.config import save
from services.process.master_devices import Gamepad, Keyboard, Page, Phantom, Pointer, Scripted
from services.study.arrangement import arrangement
from services.study.live.setting import Ports, Run, Setting
from services.study.protocol.protocol import Method, load
from services.study.protocols import SHIPPED
from services.study.session.course import Adapt, Train
from sim.tasks import DISHWASHER

PROTOCOL = load(SHIPPED["thesis"])
PORTS = Ports(router=7001, station=7002, web=7003, stream=7004)


def configuration(part, *, language="de", rehearsal=False):
    setting = Setting(PROTOCOL, arrangement(PROTOCOL, DISHWASHER), "http://127.0.0.1:8090", rehearsal)
    return setting.configuration(Run(part, "P07", language, Path("/there"), Path("/there/model-1.sqlite")), PORTS)


def test_a_model_has_the_protocols_limits_and_the_page_only_the_methods_way():
    made = configuration(Adapt("OffKey", 2))
    station = made.station
    assert (station.updates_allowed, station.refinements_allowed) == (8, 10)
    assert (station.method, station.variant, station.framed_by) == (Way.WAYPOINTS, "b2", "http://127.0.0.1:8090")
    assert len(station.place) == 3
    assert made.master.device == Keyboard()
    assert (made.operator, made.model.database, made.viewer.folder) == ("P07", "/there/model-1.sqlite", "/there")


def test_a_trainings_attempts_are_limited_by_the_study_alone():
    station = configuration(Train("OnKey")).station
    assert station.updates_allowed == station.refinements_allowed == PROTOCOL.training.attempts
    assert (station.method, station.basis) == (Way.REFINE, "model")


def test_every_part_finds_the_same(tmp_path):
    first, second = configuration(Train("OnKey")), configuration(Adapt("OffStyl", 3))
    assert first.station.place == second.station.place
    assert (first.robot, first.seed, first.model.kind) == (second.robot, second.seed, second.model.kind)


def test_people_hold_the_real_stylus_and_a_simulated_hand_only_in_a_rehearsal():
    assert configuration(Train("OnStyl")).master.device == Phantom()
    assert configuration(Train("OnStyl"), rehearsal=True).master.device == Scripted()


@pytest.mark.parametrize(
    ("device", "led"),
    [
        (Device.KEYBOARD, Keyboard()),
        (Device.GAMEPAD, Gamepad()),
        (Device.POINTER, Pointer()),
        (Device.SPACE_MOUSE, Page()),
    ],
)
def test_only_the_methods_device_leads(device, led):
    setting = Setting(PROTOCOL, arrangement(PROTOCOL, DISHWASHER), "")
    assert setting.device(Method("A", Teaching.PREDICTION, device)) == led


def test_a_language_that_the_robots_page_does_not_speak_is_english_there():
    assert configuration(Train("OnKey")).station.language == "de"
    assert configuration(Train("OnKey"), language="nl").station.language == "en"


def test_it_is_what_retouch_up_reads(tmp_path):
    made = configuration(Train("OnKey"))
    save(made, tmp_path / "configuration.json")
    assert load_configuration(tmp_path / "configuration.json") == made
