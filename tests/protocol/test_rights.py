"""Every kind of certificate may do on every key what the tables say, and nothing else."""

import itertools

import pytest

from protocol.commander import EVERYBODY, commander_key
from protocol.exceptions import InvalidName
from protocol.queries import QUERIES, REVOKE
from protocol.rights import KINDS, Act, rights, subject
from protocol.topic import VERSION
from protocol.topics import TOPICS
from tests.protocol.includes import includes

ROBOTS = ("kitchen", "garage")
PEOPLE = ("anna", "bob")
PROCESSES = [
    *("robot", "camera", "perception", "model"),
    *(f"{role}-{name}" for role in ("master", "station", "viewer", "cli", "teach", "history") for name in PEOPLE),
]
SUBJECTS = [f"{kind.name}.{'anna' if kind.person else 'kitchen'}" for kind in KINDS if not kind.routes]


def may(one, act, key):
    """Whether the rights of a certificate include the act on a key."""
    return any(right.act is act and includes(right.key, key) for right in rights(one))


def own(one, process):
    """Whether a process is one of the certificate's."""
    return process in {one.process(role) for role in one.kind.roles}


def reaches(one, robot):
    return one.kind.person or robot == one.name


@pytest.mark.parametrize("name", SUBJECTS)
def test_a_topic_is_published_by_those_whom_the_table_names_under_their_own_name_to_their_own_robot(name):
    one = subject(name)
    for topic, robot, process in itertools.product(TOPICS, ROBOTS, PROCESSES):
        commanding = topic.name.startswith(("cmd/", "authority/"))
        expected = (
            own(one, process)
            and topic.published_by(process)
            and reaches(one, robot)
            and (one.kind.commands or not one.kind.person or not commanding)
        )
        assert may(one, Act.PUBLISH, topic.key(robot, process)) == expected, (name, topic.name, robot, process)


@pytest.mark.parametrize("name", SUBJECTS)
def test_people_read_everything_and_a_robots_processes_what_they_use_of_it(name):
    one = subject(name)
    for topic, robot in itertools.product(TOPICS, ROBOTS):
        expected = one.kind.person or (reaches(one, robot) and one.kind.name in topic.readers)
        assert may(one, Act.READ, topic.key(robot, "*")) == expected, (name, topic.name, robot)


@pytest.mark.parametrize("name", SUBJECTS)
def test_a_query_is_asked_by_those_who_may_under_their_own_name_and_answered_by_its_server_alone(name):
    one = subject(name)
    for query, robot, process in itertools.product(QUERIES, ROBOTS, PROCESSES):
        allowed = {
            "operator": query is not REVOKE,
            "supervisor": query is REVOKE or query.looks,
            "observer": query.looks,
        }.get(one.kind.name, False)
        expected = allowed and own(one, process) and process.partition("-")[0] in query.askers
        assert may(one, Act.ASK, query.key(robot, process)) == expected, (name, query.name, process)
        answers = one.kind.name == query.server and robot == one.name
        assert may(one, Act.ANSWER, query.key(robot)) == answers, (name, query.name, robot)


@pytest.mark.parametrize("name", SUBJECTS)
def test_nobody_announces_another_process(name):
    one = subject(name)
    for robot, process in itertools.product(ROBOTS, PROCESSES):
        expected = own(one, process) and reaches(one, robot)
        assert may(one, Act.BE_THERE, f"retouch/{VERSION}/{robot}/alive/{process}") == expected


@pytest.mark.parametrize("name", SUBJECTS)
def test_a_robot_s_own_process_says_who_commands_it_and_people_see_that_of_all(name):
    one = subject(name)
    assert may(one, Act.SEE, EVERYBODY) == one.kind.person
    for robot, operator in itertools.product(ROBOTS, ("", "anna")):
        expected = one.kind.name == "robot" and robot == one.name
        assert may(one, Act.BE_THERE, commander_key(robot, operator)) == expected


@pytest.mark.parametrize("name", SUBJECTS)
def test_nobody_reaches_the_transports_own_administration_or_another_version(name):
    one = subject(name)
    for act, key in itertools.product(
        Act, ("@/*/router", "@/1234/router/config/**", "retouch/@v2/kitchen/cmd/pace/a", "x")
    ):
        assert not may(one, act, key)


def test_everybody_may_stop_a_robot_that_they_reach():
    for name in SUBJECTS:
        one = subject(name)
        for role in one.kind.roles:
            assert may(one, Act.PUBLISH, f"retouch/{VERSION}/kitchen/safety/emergency_stop/{one.process(role)}")


@pytest.mark.parametrize("text", ["anna", "operator.", "king.anna", "operator.an/na", "operator.anna.x", ".anna", ""])
def test_what_is_no_name_of_a_certificate_is_an_error(text):
    with pytest.raises(InvalidName):
        subject(text)
