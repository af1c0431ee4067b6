"""What came under a key, a query or a name that is not its own does not pass."""

import pytest

from protocol import messages, queries, topics
from protocol.exceptions import Misplaced
from protocol.placement import announcement, check_announced, check_message

PLACE = {"robot": "robot1", "topic": "state/robot", "process": "robot"}


def message(**changed):
    here = messages.Pose((0.0, 0.0, 0.0), (1.0, 0.0, 0.0, 0.0))
    return messages.RobotState(measured=here, reference=here, phase=messages.Phase.IDLE, **(PLACE | changed))


def test_a_message_passes_where_it_belongs():
    check_message(topics.ROBOT_STATE, "robot1", message())
    check_message(topics.ROBOT_STATE, "robot1", message(), topics.ROBOT_STATE.key("robot1", "robot"))


@pytest.mark.parametrize(
    ("changed", "said"),
    [
        ({"robot": "robot2"}, "belongs to 'state/robot' of robot 'robot2'"),
        ({"topic": "state/world"}, "belongs to 'state/world' of robot 'robot1'"),
        ({"process": "station-ann"}, "comes from 'station-ann': only the robot publishes it"),
        ({"process": "robotic"}, "only the robot publishes it"),
        ({"process": "robot/x"}, "only the robot publishes it"),
        ({"process": "robot-2"}, "under the key retouch/@v1/robot1/state/robot/robot"),
    ],
)
def test_a_message_that_belongs_elsewhere_does_not(changed, said):
    with pytest.raises(Misplaced, match=said) as caught:
        check_message(topics.ROBOT_STATE, "robot1", message(**changed), topics.ROBOT_STATE.key("robot1", "robot"))
    assert caught.value.subject == "state/robot"


def test_only_the_role_that_the_table_names_publishes_a_topic():
    for topic in topics.TOPICS:
        others = {t.publisher for t in topics.TOPICS} - {topic.publisher}
        if topic.publisher == "any":
            assert topic.published_by("cli-1")
            continue
        assert topic.published_by(topic.publisher)
        assert topic.published_by(f"{topic.publisher}-ann-2")
        assert not any(topic.published_by(other) for other in others)
    assert not any(topic.published_by(name) for topic in topics.TOPICS for name in ("", "*", "a/b", "-master"))


def test_a_request_says_where_it_belongs_and_a_foreign_one_need_not():
    for query in queries.QUERIES:
        assert check_announced(query, "robot1", announcement(query, "robot1", query.request)) == query.schema
    assert check_announced(queries.UNDO, "robot1", "Undo/1") == "Undo/1"
    assert check_announced(queries.UNDO, "robot1", "") == ""


@pytest.mark.parametrize(("query", "robot"), [(queries.UNDO, "robot2"), (queries.DESCRIBE, "robot1")])
def test_a_request_or_reply_of_another_query_or_robot_does_not_pass(query, robot):
    with pytest.raises(Misplaced, match=f"'{query.name}' of robot '{robot}'"):
        check_announced(queries.UNDO, "robot1", announcement(query, robot, query.reply))
