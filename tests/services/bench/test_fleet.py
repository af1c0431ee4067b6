"""The benchmark of many robots: what it reckons, and that robots, operators and traffic are there."""

import json
from pathlib import Path

import pytest

from protocol import topics
from protocol.rights import subject
from tests.bench import fleet
from tests.bench.many import presence, rules
from tests.bench.many.fleet import Fleet, late_share, rates
from tests.heartbeats import heartbeat


@pytest.mark.parametrize(("processor", "borne"), [(0.05, (1, 4, 16)), (0.4, (1, 4)), (0.5, (1,)), (2.5, ())])
def test_only_so_many_robots_run_as_the_machine_bears(processor, borne):
    assert fleet.bearable(fleet.COUNTS, processor, 2) == borne


def test_a_rate_is_what_was_counted_meanwhile():
    before, after = {"a": (10, 1_000), "b": (5, 5)}, {"a": (30, 5_000), "b": (5, 5), "c": (2, 8)}
    assert rates(before, after, 2.0) == {"a": (10.0, 2_000.0), "c": (1.0, 4.0)}


def beat(ticks, late):
    return heartbeat(ticks=ticks, late_ticks=late)


def test_late_ticks_are_those_of_the_interval_and_of_all_robots():
    assert late_share([[beat(1000, 500), beat(1100, 501)], [beat(0, 0), beat(100, 3)], []]) == pytest.approx(0.02)


def test_a_hundred_sites_have_a_thousand_robots_and_three_hundred_operators():
    kinds = [subject(name).kind.name for name in rules.names(100)]
    assert {kind: kinds.count(kind) for kind in ("router", "robot", "operator")} == {
        "router": 100,
        "robot": 1000,
        "operator": 300,
    }


def test_access_rules_grow_no_faster_than_the_certificates():
    few, many = (len(json.dumps(rules.generated(sites))) for sites in (1, 10))
    assert 9.0 * few < many < 10.5 * few


@pytest.mark.system
def test_a_robot_moves_under_its_operator_and_is_seen_to_go(tmp_path):
    with Fleet(Path(tmp_path), "particle") as one:
        one.grow(1)
        one.join()
        with one.operated() as traffic:
            cost = one.cost(traffic, 1.0)
        assert (cost.robots, cost.routers) == (1, 2)
        assert {topics.MASTER_STATE.name, topics.AUTHORITY_RENEWAL.name, topics.ROBOT_STATE.name} <= set(cost.traffic)
        assert cost.latency_p50_ms > 0.0
        assert all(result.value > 0.0 for result in presence.measure(one, 1))
