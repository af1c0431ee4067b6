"""Zenoh by itself: a router, and clients that put bytes on the keys of ours with its manners. No codec, no rules.

What arrives is bytes that nobody can use yet: the floor of `raw_zenoh`, as sockets are of everything.
"""

import contextlib
import json

import zenoh

KEYS = {
    "command": "retouch/@v1/kitchen/cmd/master_state/master-anna",
    "picture": "retouch/@v1/kitchen/cam/image/head/camera",
}
PRIORITIES = {"command": zenoh.Priority.INTERACTIVE_HIGH, "picture": zenoh.Priority.DATA_LOW}


@contextlib.contextmanager
def routing(settings):
    """Passes on what comes."""
    with _opened(settings, "router", "router.kitchen"):
        yield


@contextlib.contextmanager
def sending(settings, kind):
    """Sends messages of a kind."""
    with _opened(settings, "client", "operator.anna" if kind == "command" else "camera.kitchen") as session:
        publisher = session.declare_publisher(
            KEYS[kind],
            priority=PRIORITIES[kind],
            congestion_control=zenoh.CongestionControl.DROP,
            express=kind == "command",
        )
        yield publisher.put


@contextlib.contextmanager
def receiving(settings, notes):
    """Hands what comes to the notes."""
    with subscribed(settings, lambda sample: notes.hear(sample.payload.to_bytes()), notes):
        yield


@contextlib.contextmanager
def subscribed(settings, hear, notes):
    """A client that calls `hear` with each command."""
    with _opened(settings, "client", "operator.bob") as session:
        session.declare_subscriber(KEYS["command"], hear)
        session.declare_subscriber(KEYS["picture"], lambda sample: notes.see(sample.payload.to_bytes()))
        yield


def _opened(settings, mode, name):
    certificates, port = settings["certificates"], settings["ports"][0]
    endpoint = f"{'tcp' if certificates is None else 'tls'}/127.0.0.1:{port}"
    made = {
        "mode": mode,
        "scouting": {"multicast": {"enabled": False}},
        ("listen" if mode == "router" else "connect"): {"endpoints": [endpoint]},
    }
    if certificates is not None:
        file = f"{certificates}/{name}.pem"
        made["transport"] = {
            "link": {
                "tls": {
                    "root_ca_certificate": f"{certificates}/ca.pem",
                    "enable_mtls": True,
                    "listen_private_key": file,
                    "listen_certificate": file,
                    "connect_private_key": file,
                    "connect_certificate": file,
                }
            }
        }
    return zenoh.open(zenoh.Config.from_json5(json.dumps(made)))
