"""The colours, 0xRRGGBBAA, the operator's page's: Okabe and Ito's, which everybody can tell apart."""

import numpy as np
from numpy.typing import NDArray

Colours = NDArray[np.uint32]

PREDICTED = 0xE69F00FF
UNCERTAINTY = 0xE69F0038
REFINED = 0x56B4E9FF
GO = 0x2EC27EFF
STOP = 0xE5484DFF
OBJECT = 0x3584E4FF
TRUTH = 0xC0C8D2FF
FORCE = 0xCC79A7FF
QUIET = 0x4A5260FF
BACKGROUND = 0x0E1116FF

AXES = np.array([STOP, GO, OBJECT], dtype=np.uint32)
"""x, y, z."""
AXES_PALE = np.array([0xF2A2A5FF, 0x96E0BDFF, 0x9AC2F2FF], dtype=np.uint32)
"""The same, paler."""
MANY = np.array(
    [TRUTH, PREDICTED, REFINED, 0x009E73FF, 0xF0E442FF, OBJECT, 0xD55E00FF, FORCE],
    dtype=np.uint32,
)
