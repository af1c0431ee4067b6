"""MQTT, at most once: paho's clients at a broker of amqtt's."""

import asyncio
import contextlib
import logging
import socket
import threading

from amqtt.broker import Broker
from paho.mqtt.client import CallbackAPIVersion, Client

STARTS_S = 20.0


@contextlib.contextmanager
def routing(settings):
    """Passes on what comes."""
    logging.disable(logging.WARNING)
    started = threading.Event()
    threading.Thread(target=lambda: asyncio.run(_broke(settings, started)), daemon=True).start()
    if not started.wait(STARTS_S):
        raise SystemExit("the broker does not start")
    yield


async def _broke(settings, started):
    certificates, port = settings["certificates"], settings["ports"][0]
    listener = {"type": "tcp", "bind": f"127.0.0.1:{port}"}
    if certificates is not None:
        file = f"{certificates}/router.kitchen.pem"
        listener |= {"ssl": True, "cafile": f"{certificates}/ca.pem", "certfile": file, "keyfile": file}
    plugins = {"amqtt.plugins.authentication.AnonymousAuthPlugin": {"allow_anonymous": True}}
    broker = Broker({"listeners": {"default": listener}, "plugins": plugins})
    await broker.start()
    started.set()
    await asyncio.Event().wait()


@contextlib.contextmanager
def sending(settings, kind):
    """Sends messages of a kind."""
    client = _client(settings)
    yield lambda payload: client.publish(kind, payload)


@contextlib.contextmanager
def receiving(settings, notes):
    """Hands what comes to the notes."""
    client = _client(settings)
    hear = {"command": notes.hear, "picture": notes.see}
    client.on_message = lambda client, _, message: hear[message.topic](message.payload)
    client.subscribe([(kind, 0) for kind in hear])
    yield


def _client(settings):
    client, linked = Client(CallbackAPIVersion.VERSION2), threading.Event()
    client.on_socket_open = lambda *of: of[-1].setsockopt(socket.IPPROTO_TCP, socket.TCP_NODELAY, 1)
    client.on_connect = lambda *_: linked.set()
    if (certificates := settings["certificates"]) is not None:
        file = f"{certificates}/operator.anna.pem"
        client.tls_set(f"{certificates}/ca.pem", file, file)
    client.connect("127.0.0.1", settings["ports"][0])
    client.loop_start()
    if not linked.wait(STARTS_S):
        raise SystemExit("the broker does not answer")
    return client
