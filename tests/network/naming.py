"""Messages whose content says, in a word of its own, on whose topic they were published."""

from protocol import topics
from protocol.messages import EmergencyStop, OperatorInput, SafetyState

TOPICS = (topics.SAFETY_STATE, topics.EMERGENCY_STOP, topics.OPERATOR_INPUT)
"""From the robot, from anybody, from the station: other priorities, the same robots."""


def named(robot, topic):
    """A message that says whose it is."""
    name = f"{robot} {topic.name}"
    match topic:
        case topics.SAFETY_STATE:
            return SafetyState(emergency_stop=False, by=name)
        case topics.EMERGENCY_STOP:
            return EmergencyStop(pressed=False, by=name)
        case topics.OPERATOR_INPUT:
            return OperatorInput(operator=name)


def written(message):
    """Whose the message says that it is."""
    return message.operator if isinstance(message, OperatorInput) else message.by
