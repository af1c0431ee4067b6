"""The registry as Markdown, for the README and for `retouch topics`."""

from protocol.queries import QUERIES
from protocol.topics import TOPICS


def topic_table() -> str:
    """One row a topic: name, message, rate, quality of service, publisher, readers at the robot, what it is."""
    rows = [
        f"| `{t.name}` | {t.type.__name__} | {t.rate_hz:g} | {t.qos.value} | {t.publisher} | {', '.join(t.readers)}"
        f" | {t.about} |"
        for t in TOPICS
    ]
    head = ["| topic | message | Hz | QoS | publisher | read by | what it is |", "|---|---|---|---|---|---|---|"]
    return "\n".join([*head, *rows])


def query_table() -> str:
    """One row a query: name, request, reply, who asks, who answers, what it does."""
    rows = [
        f"| `{q.name}` | {q.request.__name__} | {q.reply.__name__} | {', '.join(q.askers)} | {q.server} | {q.about} |"
        for q in QUERIES
    ]
    head = ["| query | request | reply | asked by | answered by | what it does |", "|---|---|---|---|---|---|"]
    return "\n".join([*head, *rows])
