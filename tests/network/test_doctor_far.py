"""What the command prints between two machines: over a good link, a poor one, a thin one, and one that is cut."""

import re

import pytest

from services.process.exit_codes import Exit
from tests.network.standing import Standing
from tests.system.harness import Command

pytestmark = [pytest.mark.system, pytest.mark.zenoh, pytest.mark.alone]

ENDED_S = 60.0


@pytest.fixture
def doctor(link, router, tmp_path):
    """A function that runs the doctor on the far machine; its exit code, and its lines by what they are about."""

    def run(*arguments, endpoint=router):
        with Command("doctor", endpoint, "--insecure", *arguments, folder=tmp_path, there=link.there) as command:
            code = command.ended(ENDED_S)
            assert "Traceback" not in command.err
            verdicts = {}
            for line in command.out.splitlines():
                verdict, _, told = line.partition("  ")
                check, _, said = told.strip().partition(": ")
                verdicts.setdefault(check, []).append((verdict, said))
            return code, verdicts

    return run


@pytest.fixture
def robot(router):
    with Standing(router, "robot1"):
        yield


@pytest.mark.usefixtures("robot")
def test_over_a_good_link_all_is_well(link, doctor):
    link.shape(delay_s=0.01)
    code, told = doctor()
    assert code == Exit.DONE
    well = {"ok"} if "computer" not in told else {"ok", "look at this"}  # a computer that is too busy is a poor way
    assert {told[check][0][0] for check in ("way", "pictures", "clock")} <= well
    assert "after they were stamped" not in told["clock"][0][1], "another machine's clock"
    assert "this machine's time of day is 0.0 s" in told["clock"][1][1]
    assert told["certificate"][0][0] == "look at this", "whoever reaches this network can command"


@pytest.mark.usefixtures("robot")
def test_over_a_thin_link_pictures_are_to_be_looked_at(link, doctor):
    link.shape(delay_s=0.02, rate=1.2e6)
    _, told = doctor()
    ((verdict, said),) = told["pictures"]
    assert verdict != "ok"
    assert float(re.search(r"([\d.]+) Mbit/s", said)[1]) <= 1.3, "no more than the link carries"


@pytest.mark.usefixtures("robot")
def test_over_a_link_that_loses_packets_the_loss_is_told(link, doctor):
    link.shape(delay_s=0.02, loss=0.1)
    _, told = doctor()
    ((verdict, said),) = told["way"]
    assert verdict != "ok"
    assert " of 200 lost" in said


def test_a_machine_that_is_off_does_not_answer(link, doctor):
    link.cut()
    code, told = doctor()
    assert code == Exit.CRASHED
    ((verdict, said),) = told["port"]
    assert verdict == "wrong"
    assert "no answer" in said
    assert told.keys() - {"computer"} == {
        "name",
        "port",
        "certificate",
        "router, entry, processes, version, clock, way, pictures, rights",
    }


def test_what_can_be_no_endpoint_is_wrong_input(doctor):
    assert doctor(endpoint="tcp/nowhere")[0] == Exit.BAD_INPUT
