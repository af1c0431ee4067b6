"""What a tab says of its seat: that it looks on, that it is asked for its seat, that its keys do not count yet."""

from __future__ import annotations

import math

from services.station.page.standing import Standing
from services.station.page.values import Values


def seating(standing: Standing) -> Values:
    """The banners' and the keys' words."""
    return {
        "view-only@data-asking": standing.asking_s > 0.0,
        "view-only-text": _looking_on(standing),
        "asked@data-open": standing.asked_s > 0.0,
        "asked-text": f"Another tab asks for the input and gets it in {math.ceil(standing.asked_s)} s.",
        "let-go": _not_counting(standing),
    }


def _looking_on(standing: Standing) -> str:
    if standing.asking_s > 0.0:
        return f"Asking for the input: without an answer it is here in {math.ceil(standing.asking_s)} s."
    if standing.kept:
        return "Whoever has the input keeps it; here you can only stop."
    return "The input is not here: you can only stop."


def _not_counting(standing: Standing) -> str:
    if not standing.armed or not standing.let_go:
        return ""
    if not standing.heard:
        return "Your keys come too late: computer or link is busy."
    if not standing.focused:
        return "Click into the page: keys count only there."
    return "Let go of all keys: then they count again."
