"""A flood by whoever reaches a robot's network is refused or harmless: its control, its authority, its stop go on."""

import contextlib

import pytest

from services.bus.zenoh import open_router
from tests.network.flooding import RATES
from tests.network.floods import HOLDER, Comparison, Flood, Robot
from tests.ports import free_port
from tests.system.harness import START_S

pytestmark = [pytest.mark.system, pytest.mark.zenoh, pytest.mark.sim, pytest.mark.alone]

MOST = 0.01
"""More of the control periods may be missed with a flood than without."""

STOPPED_S = 2.0

LEAST_COUNTED = 100

COUNTED = {
    "messages": ("without_authority", "messages a second come without authority"),
    "pictures": ("oversized", "has 1000000 bytes, at most"),
    "queries": ("refused", "refused: "),
}
"""By kind of flood, what is counted of it where it comes through, and what the log says."""


@pytest.fixture(scope="module")
def secured(identities, tmp_path_factory):
    """A robot on a network of certificates."""
    endpoint = f"tls/127.0.0.1:{free_port()}"
    with Robot(endpoint, tmp_path_factory.mktemp("secured"), f'tls = "{identities.folder}"', identities) as robot:
        yield robot


@pytest.fixture(scope="module")
def unsecured(tmp_path_factory):
    """A robot on a network of one machine."""
    with Robot(f"tcp/127.0.0.1:{free_port()}", tmp_path_factory.mktemp("unsecured"), "") as robot:
        yield robot


@pytest.fixture(scope="module")
def elsewhere(identities):
    """Routers where nobody listens: with certificates, and without."""
    endpoints = f"tls/127.0.0.1:{free_port()}", f"tcp/127.0.0.1:{free_port()}"
    routers = open_router(endpoints[0], None, identities.of("router.garage")), open_router(endpoints[1])
    yield endpoints
    for router in routers:
        router.close()


def check_harmless(robot, flood, kind, capsys):
    """Nothing of the robot's changes by a flood, and its control periods begin in time."""
    before = robot.beat()
    compared = Comparison(robot, flood, MOST)
    with capsys.disabled():
        print(f"\n{kind}, {compared}")
    if compared.sent < RATES[kind] / 2:
        pytest.skip(f"this machine is too busy for a flood: {compared}")
    assert compared.more - compared.error <= MOST, str(compared)
    assert robot.beat().pid == before.pid
    authority = robot.authority()
    assert (authority.holder, authority.epoch) == (HOLDER, robot.epoch)


def check_counted(robot, kind, before):
    """What came of it to the robot is counted since that heartbeat, and told."""
    what, line = COUNTED[kind]
    assert counts(robot.beat())[what] - counts(before)[what] > LEAST_COUNTED
    robot.up.until(lambda: line in robot.up.out + robot.up.err, START_S, f"it is told: {line}")


def counts(beat):
    """The robot's figures, and how much it dropped by cause."""
    drops = {cause: sum(getattr(topic, cause) for topic in beat.topics) for cause in ("oversized", "crowded")}
    return drops | {figure.name: figure.value for figure in beat.figures}


@pytest.fixture
def flood(secured, identities, elsewhere):
    """A function that begins to flood the robot's network under a certificate."""
    with contextlib.ExitStack() as stack:
        yield lambda kind, whose: stack.enter_context(
            Flood(kind, secured.endpoint, elsewhere[0], identities.folder, whose)
        )


@pytest.mark.parametrize(
    ("whose", "kind"),
    [pytest.param(whose, kind, marks=pytest.mark.long) for whose in ("observer.carl", "robot.garage") for kind in RATES]
    + [pytest.param("operator.bob", "pictures", marks=pytest.mark.long)],
)
def test_a_flood_under_a_certificate_is_harmless(secured, flood, whose, kind, capsys):
    check_harmless(secured, flood(kind, whose), kind, capsys)


@pytest.mark.parametrize("kind", ["messages", pytest.param("queries", marks=pytest.mark.long)])
def test_a_flood_by_whoever_has_no_authority_is_harmless_counted_and_told(secured, flood, kind, capsys):
    before = secured.beat()
    check_harmless(secured, flood(kind, "operator.bob"), kind, capsys)
    check_counted(secured, kind, before)


@pytest.mark.parametrize("kind", ["messages", "queries", pytest.param("pictures", marks=pytest.mark.long)])
def test_a_flood_by_anybody_on_the_machine_is_harmless_counted_and_told(unsecured, elsewhere, kind, capsys):
    before = unsecured.beat()
    with Flood(kind, unsecured.endpoint, elsewhere[1]) as flood:
        check_harmless(unsecured, flood, kind, capsys)
    check_counted(unsecured, kind, before)


# Last: it leaves the robot latched.
def test_a_stop_is_heard_in_a_flood(secured, flood):
    flood("messages", "operator.bob").towards("here")
    secured.stopped_within(STOPPED_S)
