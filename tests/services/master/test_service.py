import subprocess
import sys

import msgspec
import pytest

from protocol.messages import AuthorityState, Mode, OperatorInput, Phase, Pose, RobotState, Trouble
from protocol.topics import AUTHORITY_STATE, MASTER_STATE, OPERATOR_INPUT, ROBOT_STATE
from services.bus.memory import MemoryNetwork
from services.master.service import build
from services.process.clock import ManualClock
from services.process.config import Configuration

POSE = Pose((0.5, 0.0, 0.5), (1.0, 0.0, 0.0, 0.0))
REFINING = RobotState(measured=POSE, reference=POSE, phase=Phase.EXECUTE, mode=Mode.REFINE, episode=1)
PERIOD = 0.01


GRANTED = AuthorityState(operator="ann", holder="station-a", epoch=7, expires_in=1.0)


class Desk:
    """A master with a keyboard that belongs to Ann, and whoever talks to it."""

    def __init__(self, silent_s=0.3):
        self.clock = ManualClock()
        self.network = network = MemoryNetwork(self.clock)
        self.others = network.bus()
        self.station = network.bus("station-ann")
        self.states = network.bus().subscribe(MASTER_STATE)
        self.service = build(network.bus(), self.clock, Configuration(operator="ann"))
        self.listen(silent_s)

    def listen(self, seconds):
        """The time in which a new process says nothing."""
        for _ in range(round(seconds / PERIOD)):
            self.service.step(self.clock.now_ns())
            assert self.states.latest() is None
            self.clock.advance(PERIOD)

    def run(self, seconds, keys=("KeyQ",), page=True, robot=REFINING, authority=GRANTED, **said):
        """Let time pass; `said` is what else stands in the page's input."""
        named = {"focused": True, "operator": "ann", "holder": "station-a", "epoch": 7} | said
        for _ in range(round(seconds / PERIOD)):
            self.clock.advance(PERIOD)
            if page:
                self.station.publish(OPERATOR_INPUT, OperatorInput(keys=keys, **named))
            if robot is not None:
                self.others.publish(ROBOT_STATE, robot)
            if authority is not None:
                self.others.publish(AUTHORITY_STATE, authority)
            self.service.step(self.clock.now_ns())
        said = self.states.latest()
        return said.message if said is not None else None


def test_it_publishes_at_the_topics_rate_though_nobody_is_there():
    desk = Desk()
    assert desk.service.rate_hz == MASTER_STATE.rate_hz
    state = desk.run(0.1, authority=None, page=False)
    assert (state.sequence, state.engaged, state.epoch, state.device) == (10, False, 0, "keyboard")
    assert state.contact_energy < 0.0  # keys render no contact


def test_a_held_key_moves_the_device_in_the_name_of_who_holds_it():
    desk = Desk()
    desk.run(0.1, keys=())
    state = desk.run(1.0, keys=("KeyQ", "KeyG"))
    assert state.displacement == pytest.approx((0.12, 0.0, 0.0), abs=0.002)
    assert state.rotation == pytest.approx((0.0, -0.4, 0.0), abs=0.006)
    assert state.engaged
    assert (state.operator, state.holder, state.epoch) == ("ann", "station-a", 7)


def test_a_key_that_is_pressed_or_let_go_acts_between_ticks_and_nothing_else_does():
    desk = Desk()
    desk.run(0.1, keys=())
    before = desk.states.latest().message.sequence
    named = {"focused": True, "operator": "ann", "holder": "station-a", "epoch": 7}
    for keys, told in (((), 0), (("KeyE",), 1), (("KeyE",), 1), ((), 2)):
        desk.clock.advance(0.002)
        desk.station.publish(OPERATOR_INPUT, OperatorInput(keys=keys, **named))
        assert desk.service.call.is_set()
        desk.service.step_early(desk.clock.now_ns())
        assert desk.states.latest().message.sequence == before + told


@pytest.mark.parametrize(
    "authority",
    [
        None,
        AuthorityState(holder="", epoch=7, expires_in=0.0),
        AuthorityState(holder="station-b", epoch=7, expires_in=1.0),
        AuthorityState(holder="station-a", epoch=8, expires_in=1.0),
        AuthorityState(holder="station-a", epoch=6, expires_in=1.0),
    ],
    ids=["unheard", "nobody", "another station", "a later epoch", "an earlier epoch"],
)
def test_under_an_epoch_that_the_robot_does_not_confirm_nobody_is_at_the_device(authority):
    state = Desk().run(0.5, authority=authority)
    assert (state.engaged, state.operator, state.holder, state.epoch) == (False, "", "", 0)
    assert state.displacement == (0.0, 0.0, 0.0)


def test_a_station_without_a_name_is_not_confirmed_by_a_robot_that_nobody_holds():
    state = Desk().run(0.5, holder="", epoch=3, authority=AuthorityState(holder="", epoch=3, expires_in=0.0))
    assert (state.engaged, state.epoch) == (False, 0)


def test_the_authority_lost_in_the_middle_disengages_at_once():
    desk = Desk()
    desk.run(0.1, keys=())
    assert desk.run(0.5).engaged
    state = desk.run(0.01, authority=AuthorityState(holder="station-b", epoch=8, expires_in=1.0))
    assert (state.engaged, state.epoch) == (False, 0)


def test_it_follows_its_own_station_whatever_other_stations_say():
    desk = Desk()
    desk.run(0.1, keys=())
    for _ in range(20):
        desk.run(0.01)
        stranger = OperatorInput(keys=("KeyS",), focused=True, operator="ann", holder="station-a", epoch=7)
        desk.others.publish(OPERATOR_INPUT, stranger)
    state = desk.run(0.5)
    assert state.displacement[0] > 0.05
    assert state.displacement[1] == 0.0


def test_whoever_sits_at_its_station_is_followed_and_named():
    desk = Desk()
    desk.run(0.1, keys=(), operator="bob")
    state = desk.run(0.5, operator="bob")
    assert (state.engaged, state.operator) == (True, "bob")


def test_of_a_station_and_the_one_before_it_it_follows_the_one_that_holds_the_authority():
    desk = Desk()
    desk.run(0.1, keys=())
    before = desk.network.bus("station-ann")
    for _ in range(50):
        desk.run(0.01)
        idle = OperatorInput(keys=(), focused=False, operator="ann", holder="station-z", epoch=0)
        before.publish(OPERATOR_INPUT, idle)
    state = desk.run(0.01)
    assert (state.engaged, state.holder) == (True, "station-a")


def test_a_station_that_is_silent_for_its_stale_time_is_forgotten():
    desk = Desk()
    desk.run(0.5)
    desk.run(OPERATOR_INPUT.stale_after_ns / 1e9 + 0.02, page=False)
    assert not desk.run(0.01, page=False).engaged


def test_the_page_gone_means_zero_within_the_stale_time_and_a_moment():
    desk = Desk()
    desk.run(0.1, keys=())
    desk.run(1.0)
    stale = OPERATOR_INPUT.stale_after_ns / 1e9
    assert desk.run(stale, page=False).engaged
    assert not desk.run(0.02, page=False).engaged
    state = desk.run(0.2, page=False)
    assert state.displacement == (0.0, 0.0, 0.0)


def test_without_hearing_the_robot_it_is_silent_so_that_the_robot_holds():
    desk = Desk()
    desk.run(0.5)
    desk.run(0.3, robot=None)
    silent_from = desk.states.latest()
    desk.run(0.3, robot=None)
    assert desk.states.latest() is silent_from
    held = msgspec.structs.replace(REFINING, offset=(0.06, 0.0, 0.0))
    assert desk.run(0.01, keys=(), robot=held).displacement == pytest.approx((0.06, 0.0, 0.0), abs=1e-3)


def test_a_process_that_has_just_come_up_listens_for_three_tenths_of_a_second_before_it_speaks():
    desk = Desk(silent_s=0.0)
    assert desk.run(0.3) is None
    assert desk.run(PERIOD) is not None


@pytest.mark.parametrize("lost", [{"focused": False}, {"robot": msgspec.structs.replace(REFINING, phase=Phase.IDLE)}])
def test_who_commands_without_a_hand_on_the_device_is_told_with_nobody_at_it(lost):
    state = Desk().run(0.5, **lost)
    assert (state.engaged, state.operator, state.epoch) == (False, "ann", 7)


def test_the_device_is_let_go_of_with_the_process():
    desk = Desk()
    closed = []
    desk.service._device.close = lambda: closed.append("keyboard")
    desk.service.close()
    assert closed == ["keyboard"]


def test_a_process_that_stood_still_does_not_make_up_for_it():
    desk = Desk()
    desk.run(0.1, keys=())
    before = desk.run(0.5).displacement[0]
    desk.clock.advance(5.0)
    assert desk.run(0.01).displacement[0] - before <= 0.12 * 0.1 + 1e-9


@pytest.mark.parametrize(
    ("module", "unneeded"),
    [("services.master.service", ("sim", "scipy")), ("services.master.devices.scripted", ("mujoco", "scipy"))],
)
def test_a_device_needs_no_room_but_its_own(module, unneeded):
    code = f"import sys, {module}; print(*sorted({{m.split('.')[0] for m in sys.modules}} & set({unneeded})))"
    result = subprocess.run([sys.executable, "-c", code], capture_output=True, text=True, check=True, timeout=30)
    assert result.stdout.strip() == ""


def test_by_pictures_that_are_too_old_no_hand_corrects_and_the_page_is_told_why():
    desk = Desk()
    desk.run(0.1, keys=())
    assert desk.run(0.2).engaged
    state = desk.run(0.1, blind=True)
    assert not state.engaged
    assert state.trouble is Trouble.BLIND
    assert desk.run(0.2).engaged


def test_every_state_says_which_of_the_robot_s_had_come_and_how_long_before():
    desk = Desk()
    robot = desk.network.bus().subscribe(ROBOT_STATE)
    state = desk.run(0.1)
    assert state.echoed_ns == robot.latest().message.stamp_ns
    held_ns = state.echo_held_ns
    state = desk.run(0.02, robot=None)
    assert state.echo_held_ns - held_ns == pytest.approx(2e7)


def test_it_tells_how_long_a_key_took_from_the_page_to_its_sample():
    desk = Desk()
    desk.run(0.1, keys=())
    assert desk.run(0.1, captured_ns=desk.clock.now_ns()).capture == pytest.approx(PERIOD)
    assert desk.run(0.1, keys=("KeyW",)).capture == -1.0, "a page that does not say when"
    assert any(figure.name == "stage_capture" for figure in desk.service.figures())
