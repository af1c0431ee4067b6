"""The registry as Markdown, for the README and for `retouch topics`."""

from protocol.queries import QUERIES
from protocol.topics import TOPICS


def topic_table() -> str:
    """One row a topic: name, message, rate, quality of service, publisher, what it is."""
    rows = [
        f"| `{t.name}` | {t.type.__name__} | {t.rate_hz:g} | {t.qos.value} | {t.publisher} | {t.about} |"
        for t in TOPICS
    ]
    return "\n".join(["| topic | message | Hz | QoS | publisher | what it is |", "|---|---|---|---|---|---|", *rows])


def query_table() -> str:
    """One row a query: name, request, reply, who answers, what it does."""
    rows = [f"| `{q.name}` | {q.request.__name__} | {q.reply.__name__} | {q.server} | {q.about} |" for q in QUERIES]
    return "\n".join(["| query | request | reply | answered by | what it does |", "|---|---|---|---|---|", *rows])
