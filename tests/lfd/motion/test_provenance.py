import math

import pytest

from lfd.exceptions import OutOfRange
from lfd.motion.provenance import Provenance


@pytest.mark.parametrize(
    ("given", "named"),
    [
        ({"confidence": c}, r"Provenance\.confidence .* at least 0 and at most 1")
        for c in (-0.01, 1.01, math.nan, None, True)
    ]
    + [({"at_s": t}, r"Provenance\.at_s .* a finite number") for t in (math.nan, math.inf, "noon")],
)
def test_what_cannot_be_meant_is_refused_by_name(given, named):
    with pytest.raises(OutOfRange, match=named):
        Provenance("anna", **given)
