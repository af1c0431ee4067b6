"""A script shows an empty skill its first motions."""

from dataclasses import replace

import msgspec
import pytest

from protocol import queries
from protocol.messages import Method, Mode, Purpose
from services.station.workflow.action import Action
from services.station.workflow.state import Phase
from tests.services.station.workflow.guided import METHODS, TRAINING
from tests.services.station.workflow.person import EMPTY, FINISHED, shown_way
from tests.services.station.workflow.site import MISSED, REACHED, SCRIPTED, Site


@pytest.mark.parametrize("method", METHODS)
def test_a_script_goes_through_both_places(method):
    site = Site(replace(SCRIPTED, untaught=True, method=method))
    site.sees(model=EMPTY, scene=msgspec.structs.replace(site.view.scene, training_places=TRAINING))
    for _ in range(400):
        site.step()
        if site.state.phase is Phase.EXECUTING and site.state.mode is Mode.TEACH:
            _by_hand(site)
        elif site.state.phase is Phase.EXECUTING:
            site.end(REACHED)
        if site.state.phase is Phase.FINISHED:
            break
    assert [one.purpose for one in site.requests(queries.ADD_DEMONSTRATION)] == [Purpose.INITIAL] * 2
    assert site.state.closure.closed, site.state.reason


def _by_hand(site):
    """As a hand does that shows it all: three waypoints, or the way."""
    site.step()
    for _ in range(3 * (site.state.approach.method is Method.WAYPOINTS)):
        site.step(Action.STORE)
    site.step(Action.FINISH)
    site.step()
    site.end(REACHED, operator_input=True, commanded=shown_way(), **FINISHED)


def test_a_script_that_never_gets_there_tries_every_place_and_says_so():
    site = Site(replace(SCRIPTED, untaught=True))
    site.sees(model=EMPTY, scene=msgspec.structs.replace(site.view.scene, training_places=TRAINING))
    for _ in range(2000):
        site.step()
        if site.state.phase is Phase.EXECUTING and site.state.episode.number:
            site.end(MISSED)
        if site.state.phase is Phase.FINISHED:
            break
    assert site.state.reason == "no first motion could be shown at any place"
    assert {one.object_position for one in site.requests(queries.RESET)} == {*TRAINING}
