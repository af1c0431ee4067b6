"""All analyses, in the order of the report; each group has a file of its own.

A new one is a pure function `Context -> Finding` in a file here, an `Analysis` beside it, and its name in this tuple.
"""

from services.study.analyses.dishwasher import DISHWASHER_BASKET
from services.study.analyses.dmp import DYNAMIC_MOVEMENT_PRIMITIVES
from services.study.analyses.factor_ten import FACTOR_TEN
from services.study.analyses.incremental import WELFORD
from services.study.analyses.initial_poses import INITIAL_POSES
from services.study.analyses.linear import LINEAR, LINEAR_3D_CONTEXT, LINEAR_3D_OUTPUT
from services.study.analyses.next_waypoint import NEXT_WAYPOINT
from services.study.analyses.particle import OBSTACLE_2D, VIA_POINTS
from services.study.analyses.planes import PLANES
from services.study.analyses.shifted_start import SHIFTED_START
from services.study.analyses.sine import SINE
from services.study.analyses.slow_adaptation import SLOW_ADAPTATION
from services.study.analyses.table import TABLE_OBJECTS
from services.study.analyses.time_warping import TIME_WARPING
from services.study.analysis import Analysis

ANALYSES: tuple[Analysis, ...] = (
    LINEAR,
    LINEAR_3D_CONTEXT,
    LINEAR_3D_OUTPUT,
    SINE,
    PLANES,
    VIA_POINTS,
    OBSTACLE_2D,
    TABLE_OBJECTS,
    DISHWASHER_BASKET,
    INITIAL_POSES,
    SLOW_ADAPTATION,
    WELFORD,
    NEXT_WAYPOINT,
    SHIFTED_START,
    DYNAMIC_MOVEMENT_PRIMITIVES,
    TIME_WARPING,
    FACTOR_TEN,
)
