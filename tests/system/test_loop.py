"""The whole product: one command closes the loop, and says so to people and to programs; see test_sides for two."""

import json

import pytest

from tests.system.closed import check_closed
from tests.system.harness import EVERYBODY, Command, configured, free_endpoint

pytestmark = [pytest.mark.system, pytest.mark.zenoh, pytest.mark.sim, pytest.mark.alone, pytest.mark.long]

WITHIN_S = 240.0


@pytest.mark.parametrize("scene", ["dishwasher", "particle", "table", "post"])
def test_a_prediction_fails_is_refined_and_the_next_one_succeeds_by_itself(tmp_path, scene):
    configuration = configured(tmp_path, free_endpoint())
    arguments = ("--fresh", "--headless", "--once", "--scene", scene, "--json", "out.json", "--config", configuration)
    with Command("up", *arguments, folder=tmp_path) as up:
        assert up.ended(WITHIN_S) == 0, up.tail()
        assert up.left() == []
    report = json.loads((tmp_path / "out.json").read_text())
    assert set(report["processes"]) == EVERYBODY
    assert len(set(report["processes"].values())) == len(EVERYBODY)
    check_closed(report, scene)
