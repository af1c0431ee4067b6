"""A router's rules in Zenoh's words, from the tables: who may do what, how large, how often."""

from __future__ import annotations

from collections.abc import Iterable, Iterator, Sequence
from typing import Any

from protocol.queries import QUERIES
from protocol.rights import Act, Right, Subject, rights
from protocol.topic import VERSION, QoS
from protocol.topics import TOPICS

EVERYTHING = ("**", f"retouch/{VERSION}/**")
"""No wildcard reaches behind a version unless it names it."""

_WORDS: dict[Act, dict[str, tuple[str, ...]]] = {
    Act.PUBLISH: {"ingress": ("put",)},
    Act.READ: {"ingress": ("declare_subscriber",), "egress": ("put",)},
    Act.ASK: {"ingress": ("query",), "egress": ("reply",)},
    Act.ANSWER: {"ingress": ("declare_queryable", "reply"), "egress": ("query",)},
    Act.BE_THERE: {"ingress": ("liveliness_token", "liveliness_query"), "egress": ("liveliness_token",)},
    Act.SEE: {"ingress": ("declare_liveliness_subscriber", "liveliness_query"), "egress": ("liveliness_token",)},
}
"""Seen from the router: what comes in from whom the rule is about, and what goes out to them."""

_ALL = (
    "put",
    "delete",
    "declare_subscriber",
    "query",
    "declare_queryable",
    "reply",
    "liveliness_token",
    "declare_liveliness_subscriber",
    "liveliness_query",
)

SURPLUS = 10
"""So many times as often as its topic says may something be published: what waited for a moment comes at once."""

ASKED_HZ = 200.0
"""So often may a person's process ask the same thing."""

SLACK = 4096
"""What the transport may add to a message [byte]."""


def access_control(subjects: Sequence[tuple[str, Subject]]) -> dict[str, Any]:
    """The section `access_control`: what is not allowed is denied.

    Args:
        subjects: each one's common name, as it stands in the certificate, and whom it is for.
    """
    rules: list[dict[str, Any]] = [_rule("everything", flow, _ALL, EVERYTHING) for flow in ("ingress", "egress")]
    # Who listens and who answers may be known to everybody: a client sends nothing where it knows nobody.
    rules.append(_rule("told", "egress", ("declare_subscriber", "declare_queryable"), EVERYTHING))
    policies: list[dict[str, Any]] = []
    for common_name, one in subjects:
        if one.kind.routes:
            policies.append(_policy(common_name, ("everything-ingress", "everything-egress")))
            continue
        own = [
            _rule(f"{common_name}-{act.name}", flow, messages, keys)
            for act in Act
            if (keys := tuple(right.key for right in rights(one) if right.act is act))
            for flow, messages in _WORDS[act].items()
        ]
        rules += own
        policies.append(_policy(common_name, ("told-egress", *(rule["id"] for rule in own))))
    return {
        "enabled": True,
        "default_permission": "deny",
        "rules": rules,
        "subjects": [{"id": name, "cert_common_names": [name]} for name, _ in subjects],
        "policies": policies,
    }


def quotas(subjects: Sequence[tuple[str, Subject]]) -> dict[str, Any]:
    """The sections `low_pass_filter` and `downsampling`: nothing is larger, nor comes oftener, than the tables say.

    Zenoh counts by rule, not by key. So rates are limited where a robot's own clock could suffer, and person by person:
    what people's processes say to robots, and ask of them.
    """
    sizes = [
        *(_size(topic.name, topic.max_bytes, ("put",), f"{topic.name}/*") for topic in TOPICS),
        *(_size(q.name, q.max_bytes, ("query", "reply"), f"{q.name}/{q.server}/*") for q in QUERIES),
    ]
    people = [one for _, one in subjects if one.kind.person]
    said = {topic.name: topic.rate_hz for topic in TOPICS if topic.readers and topic.qos in (QoS.REALTIME, QoS.STATE)}
    rules = [
        *(_rate(right.key, SURPLUS * said[name]) for right, name in _of(people, Act.PUBLISH) if name in said),
        *(_rate(right.key, ASKED_HZ) for right, _ in _of(people, Act.ASK)),
    ]
    rates = {"id": "rates", "messages": ["put", "query"], "flows": ["ingress"], "rules": rules}
    return {"low_pass_filter": sizes, "downsampling": [rates] if rules else []}


def _of(people: Iterable[Subject], act: Act) -> Iterator[tuple[Right, str]]:
    """Their rights to do something, with the topic's or query's name."""
    for one in people:
        for right in rights(one):
            if right.act is act:
                yield right, "/".join(right.key.split("/")[3:5])


def _rate(key: str, most_hz: float) -> dict[str, Any]:
    return {"key_expr": key, "freq": most_hz}


def _rule(name: str, flow: str, messages: Iterable[str], keys: Iterable[str]) -> dict[str, Any]:
    return {
        "id": f"{name}-{flow}",
        "permission": "allow",
        "flows": [flow],
        "messages": list(messages),
        "key_exprs": list(keys),
    }


def _policy(common_name: str, rules: Iterable[str]) -> dict[str, Any]:
    return {"id": common_name, "subjects": [common_name], "rules": list(rules)}


def _size(name: str, most: int, messages: Iterable[str], place: str) -> dict[str, Any]:
    return {
        "id": f"size-{name}",
        "flows": ["ingress"],
        "messages": list(messages),
        "key_exprs": [f"retouch/{VERSION}/*/{place}"],
        "size_limit": most + SLACK,
    }
