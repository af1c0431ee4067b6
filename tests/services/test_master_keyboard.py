import msgspec
import pytest
from hypothesis import given
from hypothesis import strategies as st

from protocol.messages import Mode, OperatorInput, Phase, Pose, RobotState
from services.config import Keyboard
from services.master.device import Moment
from services.master.keyboard import KEYS, LET_GO_S, KeyboardMaster, directions, pushed

LAW = Keyboard(growth=0.12, decay=0.05, reach=0.25)
POSE = Pose((0.5, 0.0, 0.5), (1.0, 0.0, 0.0, 0.0))
REFINING = RobotState(measured=POSE, reference=POSE, phase=Phase.EXECUTE, mode=Mode.REFINE, episode=1)

Displacement = st.floats(-LAW.reach, LAW.reach)
Step = st.floats(0.0, 0.1)
Keys = st.sets(st.sampled_from([*KEYS, "KeyZ", "Space"]))


def moment(*keys, dt=0.01, focused=True, robot=REFINING, armed=True):
    return Moment(0, dt, OperatorInput(keys=keys, focused=focused), robot, armed)


def hold(master, seconds, *keys, **others):
    sample = None
    for _ in range(round(seconds / 0.01)):
        sample = master.step(moment(*keys, **others))
    return sample


@pytest.mark.parametrize(
    ("keys", "expected"),
    [
        ((), (0, 0, 0)),
        (("KeyQ",), (1, 0, 0)),
        (("KeyA",), (-1, 0, 0)),
        (("KeyW", "KeyE"), (0, 1, 1)),
        (("KeyS", "KeyD", "KeyQ"), (1, -1, -1)),
        (("KeyQ", "KeyA"), (0, 0, 0)),
        (("KeyQ", "KeyQ", "Space"), (1, 0, 0)),
    ],
)
def test_keys_push_along_their_axes_and_cancel_out(keys, expected):
    assert directions(keys) == expected


@given(displacement=Displacement, direction=st.sampled_from([-1, 1]), dt=Step)
def test_a_held_key_grows_the_displacement_up_to_the_reach(displacement, direction, dt):
    after = pushed(displacement, direction, dt, LAW)
    assert abs(after) <= LAW.reach
    assert after * direction >= displacement * direction
    assert abs(after - displacement) <= LAW.growth * dt + 1e-12


@given(displacement=Displacement, dt=Step)
def test_without_a_key_it_decays_and_never_passes_zero(displacement, dt):
    after = pushed(displacement, 0, dt, LAW)
    assert after * displacement >= 0.0
    assert abs(after) == pytest.approx(max(0.0, abs(displacement) - LAW.decay * dt))


@given(displacement=Displacement, keys=Keys, first=Step, second=Step)
def test_the_speed_does_not_depend_on_how_often_it_is_asked(displacement, keys, first, second):
    for way in directions(keys):
        twice = pushed(pushed(displacement, way, first, LAW), way, second, LAW)
        assert twice == pytest.approx(pushed(displacement, way, first + second, LAW), abs=1e-12)


def test_diagonals_move_both_axes_at_full_growth():
    sample = hold(KeyboardMaster(LAW), 0.5, "KeyQ", "KeyD")
    assert sample.displacement == pytest.approx((0.06, 0.0, -0.06))
    assert sample.velocity == pytest.approx((0.12, 0.0, -0.12))
    assert sample.engaged


@pytest.mark.parametrize(
    "loss",
    [
        {"focused": False},
        {"robot": None},
        {"robot": msgspec.structs.replace(REFINING, mode=Mode.AUTONOMOUS)},
        {"robot": msgspec.structs.replace(REFINING, phase=Phase.STOPPED)},
        {"armed": False},
    ],
)
def test_whatever_is_lost_disengages_at_once_and_returns_to_zero_although_keys_are_held(loss):
    master = KeyboardMaster(LAW)
    before = hold(master, 3.0, "KeyQ", "KeyS").displacement
    assert before == pytest.approx((0.25, -0.25, 0.0))
    first = master.step(moment("KeyQ", "KeyS", **loss))
    assert not first.engaged
    assert abs(first.displacement[0]) < abs(before[0])
    assert hold(master, LET_GO_S, "KeyQ", "KeyS", **loss).displacement == (0.0, 0.0, 0.0)


def test_a_page_that_went_silent_holds_no_key():
    master = KeyboardMaster(LAW)
    hold(master, 1.0, "KeyQ")
    assert not master.step(Moment(0, 0.01, None, REFINING, armed=True)).engaged


def test_whoever_engages_takes_over_the_correction_that_the_robot_applies():
    robot = msgspec.structs.replace(REFINING, offset=(0.1, -0.4, 0.0))
    sample = KeyboardMaster(LAW).step(moment(robot=robot))
    assert sample.displacement == pytest.approx((0.1, -LAW.reach, 0.0), abs=LAW.decay * 0.01 + 1e-9)
    assert max(map(abs, sample.velocity)) <= LAW.decay + 1e-9
