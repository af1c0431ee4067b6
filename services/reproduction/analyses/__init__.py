"""All analyses, in the order of the report; each group has a file of its own.

A new one is a pure function `Context -> Finding` in a file here, an `Analysis` beside it, and its name in this tuple.
"""

from services.reproduction.analyses.dishwasher import DISHWASHER_BASKET
from services.reproduction.analyses.dmp import DYNAMIC_MOVEMENT_PRIMITIVES
from services.reproduction.analyses.factor_ten import FACTOR_TEN
from services.reproduction.analyses.incremental import WELFORD
from services.reproduction.analyses.initial_poses import INITIAL_POSES
from services.reproduction.analyses.linear import LINEAR, LINEAR_3D_CONTEXT, LINEAR_3D_OUTPUT
from services.reproduction.analyses.next_waypoint import NEXT_WAYPOINT
from services.reproduction.analyses.particle import OBSTACLE_2D, VIA_POINTS
from services.reproduction.analyses.planes import PLANES
from services.reproduction.analyses.shifted_start import SHIFTED_START
from services.reproduction.analyses.sine import SINE
from services.reproduction.analyses.slow_adaptation import SLOW_ADAPTATION
from services.reproduction.analyses.table import TABLE_OBJECTS
from services.reproduction.analyses.time_warping import TIME_WARPING
from services.reproduction.analysis import Analysis

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
