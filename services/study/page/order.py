"""In which order a participant is asked the questions of a form: the same one however often it is loaded."""

from __future__ import annotations

import numpy as np

from services.study.instruments.instrument import Instrument, shown_order


def form_order(instrument: Instrument, seed: int, number: int, part: str) -> tuple[str, ...]:
    """Names of its answers.

    Args:
        instrument: that is shown.
        seed: of the protocol's allocation.
        number: of the participant.
        part: of the session.
    """
    return shown_order(instrument, np.random.default_rng((seed, number, *part.encode())))
