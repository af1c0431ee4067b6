"""What a recording holds of the way from hand to eye."""

import msgspec
import pytest

from protocol.messages import (
    AuthorityState,
    MasterState,
    Mode,
    OperatorInput,
    Phase,
    Pose,
    RobotState,
)
from protocol.topics import AUTHORITY_STATE, MASTER_STATE, OPERATOR_INPUT, ROBOT_STATE

pytestmark = pytest.mark.sim

HERE = Pose((0.5, 0.0, 0.5), (1.0, 0.0, 0.0, 0.0))
ANNA = AuthorityState(operator="anna", holder="station-anna", epoch=3, expires_in=1.0)
ROBOT = RobotState(measured=HERE, reference=HERE, phase=Phase.EXECUTE, mode=Mode.REFINE, episode=2)


def test_how_long_each_stage_from_hand_to_eye_takes_is_recorded_as_far_as_it_is_known(record):
    state = msgspec.structs.replace(ROBOT, applied_latency=0.024, applied_way=0.018, following_lag=0.02)
    read = record(
        [(AUTHORITY_STATE, ANNA), (ROBOT_STATE, ROBOT), (MASTER_STATE, MasterState(holder="station-anna"))],
        [
            (ROBOT_STATE, state),
            (MASTER_STATE, MasterState(holder="station-anna", capture=0.012)),
            (OPERATOR_INPUT, OperatorInput(holder="station-anna", present=True, drawn=0.031)),
        ],
    )
    path = "/series/latency/stages"
    told = {name: read.values(f"{path}/{name}") for name in ("capture", "way", "apply", "motion", "picture")}
    assert told == {
        name: [[pytest.approx(value)]]
        for name, value in {"capture": 12.0, "way": 18.0, "apply": 6.0, "motion": 20.0, "picture": 31.0}.items()
    }
