"""Who is there, who is missing, and who speaks another version."""

import pytest

from protocol import messages, topics
from protocol.codec import encode
from protocol.topic import VERSION
from services.bus.zenoh import Passing
from services.commands.doctor.finding import Verdict
from services.commands.doctor.hearing import Beat, Foreign, Hearing
from services.commands.doctor.processes import AT_THE_ROBOT, present, versions
from tests.heartbeats import heartbeat


def beat(process, **changed):
    return heartbeat(process, robot="kitchen", topic=topics.HEARTBEAT.name, **{"software": "0.1.0"} | changed)


def there(*names, robot="kitchen"):
    return {robot: {name: Beat(robot, beat(name), 0) for name in names}}


def verdicts(findings):
    return [finding.verdict for finding in findings]


def test_a_whole_robot_and_its_operator():
    (found,) = present(there(*AT_THE_ROBOT, "station-anna"), "kitchen")
    assert found.verdict is Verdict.OK
    assert "robot, camera, perception, model, station-anna on site" in found.found


def test_nobody_at_all():
    (found,) = present({}, "kitchen")
    assert found.verdict is Verdict.WRONG
    assert "no process of any robot" in found.found
    assert "retouch up --robot kitchen" in found.remedy


def test_another_robot_is_there_and_this_one_is_not():
    other, found = present(there(*AT_THE_ROBOT, robot="garage"), "kitchen")
    assert other.verdict is Verdict.OK
    assert found.verdict is Verdict.WRONG
    assert "robot kitchen is not there" in found.found
    assert "--robot garage" in found.remedy


def test_a_robot_of_which_only_the_operators_side_is_there():
    (found,) = present(there("station-anna", "master-anna"), "kitchen")
    assert found.verdict is Verdict.WRONG
    assert "only station-anna, master-anna" in found.found
    assert "--robot" not in found.remedy.replace("--robot kitchen", "")


def test_a_robot_without_eyes():
    (found,) = present(there("robot", "model"), "kitchen")
    assert found.verdict is Verdict.LOOK
    assert "not there: camera, perception" in found.found


def heard(*passing):
    hearing = Hearing()
    for one in passing:
        hearing.beat(one)
    return hearing


def passing(message, schema=topics.HEARTBEAT.schema, version=VERSION):
    key = topics.HEARTBEAT.key("kitchen", message.process).replace(VERSION, version)
    return Passing(key, encode(topics.HEARTBEAT, message), schema)


def test_everybody_speaks_the_same():
    hearing = heard(passing(beat("robot")))
    (found,) = versions(hearing, "0.1.0", sealed=False)
    assert found.verdict is Verdict.OK
    assert hearing.robots["kitchen"]["robot"].message.host == "site"


@pytest.mark.parametrize(("schema", "version", "speaks"), [("Heartbeat/2", "@v1", "Heartbeat/2"), ("", "@v2", "@v2")])
def test_another_schema_and_another_version_are_told_as_such(schema, version, speaks):
    hearing = heard(passing(beat("camera"), schema, version))
    assert hearing.foreign == {Foreign("kitchen", "camera", speaks)}
    assert hearing.robots == {}
    (found,) = versions(hearing, "0.1.0", sealed=False)
    assert found.verdict is Verdict.WRONG
    assert f"camera of kitchen speaks {speaks}" in found.found
    assert "same release" in found.remedy


def test_another_release_is_to_be_looked_at():
    (found,) = versions(heard(passing(beat("robot", software="0.2.0"))), "0.1.0", sealed=False)
    assert found.verdict is Verdict.LOOK
    assert "runs release 0.2.0, here it is 0.1.0" in found.found


def test_who_dropped_messages_of_another_version_says_so():
    figures = (messages.TopicFigures("cmd/master_state", 0.0, -1.0, -1.0, wrong_version=7),)
    (found,) = versions(heard(passing(beat("robot", topics=figures))), "0.1.0", sealed=False)
    assert found.verdict is Verdict.LOOK
    assert "7 on cmd/master_state" in found.found


def test_nobody_speaks_no_version():
    assert verdicts(versions(Hearing(), "0.1.0", sealed=True)) == [Verdict.NOT_MADE]


def test_what_is_no_heartbeat_is_passed_over():
    hearing = heard(Passing(topics.HEARTBEAT.key("kitchen", "robot"), b"\xc1", topics.HEARTBEAT.schema))
    assert (hearing.robots, hearing.foreign) == ({}, set())


def test_a_name_from_the_network_does_nothing_at_a_terminal():
    one = Beat("kitchen", beat("robot", host="\x1b[2Jsite\n"), 0)
    (found,) = present({"kitchen": {"robot": one}}, "kitchen")
    assert "\x1b" not in found.line
    assert "\n" not in found.line
