"""Two cameras on a link that carries less than they could send: whoever shares it waits for no queue of theirs."""

import numpy as np
import pytest

from services.camera.pacing import LEAST, LEAST_QUALITY
from tests.services.camera.narrow_link import OTHERS_BITS, NarrowLink, size

RARELY_S, NEVER_S = 0.1, 0.15
"""What a hand or a state waits in the queue of a link, once in a hundred times and at most."""


@pytest.mark.parametrize("rate", [2e6, 2.5e6, 3e6, 3.5e6, 4e6, 6e6])
def test_neither_while_it_is_found_out_what_the_link_carries_nor_later_does_anything_wait_for_long(rate):
    link = NarrowLink(rate)
    link.run(40.0)
    assert np.quantile(link.waits, 0.99) <= RARELY_S
    assert max(link.waits) <= NEVER_S
    assert link.pictures_hz(5.0) >= 15.0


def test_on_a_wide_link_all_is_soon_sent():
    link = NarrowLink(50e6)
    link.run(3.0)
    assert link.pacing.share == 1.0


def test_on_a_link_of_their_own_the_cameras_take_turns():
    link = NarrowLink(3e6)
    link.run(0.3)
    link.waits.clear()
    link.run(0.5)
    assert link.pacing.quality == LEAST_QUALITY
    one_picture_s = size(LEAST_QUALITY) * 8 / (3e6 - OTHERS_BITS)
    assert max(link.waits) <= 1.05 * one_picture_s


def test_what_made_a_queue_is_not_sent_again_at_once():
    link = NarrowLink(20e6)
    link.run(5.0)
    link.narrow(2e6)
    link.run(4.0)
    assert link.pacing.share < 2.0 * LEAST
    link.waits.clear()
    link.run(4.0)
    assert max(link.waits) <= RARELY_S
