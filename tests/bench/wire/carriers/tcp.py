"""A pair of TCP sockets, with TLS where there are certificates; nothing is between them."""

import contextlib
import socket
import ssl
import struct
import threading

HEAD = struct.Struct("<BI")
KINDS = ("command", "picture")


@contextlib.contextmanager
def sending(settings, kind):
    """Sends messages of a kind."""
    with socket.create_connection(("127.0.0.1", settings["ports"][0])) as plain:
        plain.setsockopt(socket.IPPROTO_TCP, socket.TCP_NODELAY, 1)
        link = _client(settings["certificates"], plain)
        number = KINDS.index(kind)
        yield lambda payload: link.sendall(HEAD.pack(number, len(payload)) + payload)


@contextlib.contextmanager
def receiving(settings, notes):
    """Hands what comes to the notes."""
    server = socket.create_server(("127.0.0.1", settings["ports"][0]))
    threading.Thread(target=_accept, args=(server, settings["certificates"], notes), daemon=True).start()
    yield


def _accept(server, certificates, notes):
    while True:
        plain, _ = server.accept()
        threading.Thread(target=_read, args=(plain, certificates, notes), daemon=True).start()


def _read(plain, certificates, notes):
    with _server(certificates, plain) as link, link.makefile("rb") as stream:
        hear = (notes.hear, notes.see)
        while head := stream.read(HEAD.size):
            number, length = HEAD.unpack(head)
            hear[number](stream.read(length))


def _client(certificates, plain):
    if certificates is None:
        return plain
    context = ssl.create_default_context(cafile=f"{certificates}/ca.pem")
    context.load_cert_chain(f"{certificates}/operator.anna.pem")
    return context.wrap_socket(plain, server_hostname="127.0.0.1")


def _server(certificates, plain):
    if certificates is None:
        return plain
    context = ssl.create_default_context(ssl.Purpose.CLIENT_AUTH, cafile=f"{certificates}/ca.pem")
    context.verify_mode = ssl.CERT_REQUIRED
    context.load_cert_chain(f"{certificates}/router.kitchen.pem")
    return context.wrap_socket(plain, server_side=True)
