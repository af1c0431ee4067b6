"""A page at which people log in, served for real, and browsers without a window that come to it."""

import contextlib
import http.client
import socket
import ssl
import time
from dataclasses import dataclass
from http.cookies import SimpleCookie
from urllib.parse import urlencode, urlsplit

import msgspec
from websockets.sync.client import connect

from protocol.messages import Role
from services.accounts.account import Account, Accounts
from services.accounts.file import AccountsFile, save
from services.process.clock import SystemClock
from services.process.config import StationSection
from services.station.live_view.description import described
from services.station.page.login.judge import Judge
from services.station.page.page import Page
from services.station.page.said import Held, Hello, Pressed
from sim.tasks.scene import Eye
from tests.ports import free_port

DIGEST = f"$argon2id$v=19$m=65536,t=3,p=1${{}}${'A' * 43}"
SALTS = {"Anna": "A" * 22, "Carl": "B" * 22, "Eve": "C" * 22}
ROLES = {"Anna": Role.OPERATOR, "Carl": Role.OBSERVER, "Eve": Role.SUPERVISOR}
ANNA, CARL, EVE = (Account(name, role, DIGEST.format(SALTS[name])) for name, role in ROLES.items())
EVERYBODY = Accounts((ANNA, CARL, EVE))
PASSWORD = "correct horse"
TIMEOUT_S = 20.0
TEXT, CLOSE = 1, 8


def is_right(password, account):
    """What stands in for argon2, which has tests of its own: at once, and the same password for everybody."""
    return account is not None and password == PASSWORD


@contextlib.contextmanager
def house(folder, *, judged=is_right, **section):
    """A page at which everybody of `EVERYBODY` has an account.

    Args:
        folder: for their file.
        judged: see `IsRight`.
        section: of the station's configuration.
    """
    path = folder / "accounts.json"
    save(EVERYBODY, path)
    nothing = described((), {}, Eye(), None)
    station = StationSection(**{"port": free_port()} | section)
    page = Page(station, "robot1", SystemClock(), nothing, judge=Judge(AccountsFile(path), judged))
    page.start()
    try:
        yield House(page, path)
    finally:
        page.close()


@dataclass
class House:
    """The page, and the file of accounts."""

    page: Page
    accounts: object

    def change(self, accounts):
        """Let the accounts be others."""
        save(accounts, self.accounts)


class Browser:
    """Asks as a browser does, and keeps the cookie that it is given.

    Args:
        page: that it is at.
        root: of the authority that it trusts; None over plain HTTP.
        host: under which it opens the page; the one that this listens on, where it says nothing else.
    """

    def __init__(self, page, root=None, host=""):
        self.page = page
        url = urlsplit(page.url)
        self._url = url._replace(netloc=f"{host or url.hostname}:{url.port}")
        self._context = ssl.create_default_context(cafile=root) if root is not None else None
        self.origin = self._url.geturl()
        self.cookies = {}

    def ask(self, method, path, fields=None, **headers):
        """The answer; its text is read already."""
        if self._context is not None:
            link = http.client.HTTPSConnection(self._url.netloc, timeout=TIMEOUT_S, context=self._context)
        else:
            link = http.client.HTTPConnection(self._url.netloc, timeout=TIMEOUT_S)
        body = urlencode(fields) if isinstance(fields, dict) else fields
        own = {"Cookie": self.cookie} if self.cookies else {}
        if method == "POST":
            own |= {"Origin": self.origin, "Content-Type": "application/x-www-form-urlencoded"}
        with contextlib.closing(link):
            said = {name.replace("_", "-"): value for name, value in headers.items()}
            link.request(method, path, body, own | said)
            answer = link.getresponse()
            answer.text = answer.read().decode(errors="replace")
        for said in answer.headers.get_all("Set-Cookie", ()):
            for name, morsel in SimpleCookie(said).items():
                self.cookies[name] = morsel.value
                answer.morsel = morsel
        return answer

    @property
    def cookie(self):
        return "; ".join(f"{name}={value}" for name, value in self.cookies.items())

    def log_in(self, name="Anna", password=PASSWORD, path="/login"):
        return self.ask("POST", path, {"name": name, "password": password})

    def log_out(self):
        return self.ask("POST", "/logout", "")

    def first_frame(self):
        """The kind of the first frame that comes over the link, of one of HTTPS, too (RFC 6455, section 5.2).

        By hand: no two threads may use one connection over TLS, as the client of `link` does.
        """
        host, port = self._url.hostname, self._url.port
        head = {
            **{"Host": self._url.netloc, "Origin": self.origin, "Cookie": self.cookie},
            **{"Connection": "Upgrade", "Upgrade": "websocket"},
            **{"Sec-WebSocket-Version": "13", "Sec-WebSocket-Key": "dGhlIHNhbXBsZSBub25jZQ=="},
        }
        lines = ["GET /link HTTP/1.1", *(f"{name}: {said}" for name, said in head.items()), "", ""]
        with (
            socket.create_connection((host, port), timeout=TIMEOUT_S) as plain,
            self._context.wrap_socket(plain, server_hostname=host) as secured,
        ):
            secured.sendall("\r\n".join(lines).encode())
            received = b""
            while not (frames := received.partition(b"\r\n\r\n")[2]):
                received += secured.recv(65_536)
        return frames[0] & 0x0F

    def link(self):
        """The page's link over plain HTTP, as a script opens it."""
        address = f"{self.origin.replace('http', 'ws', 1)}/link"
        headers = {"Cookie": self.cookie} if self.cookies else {}
        return connect(address, origin=self.origin, additional_headers=headers, open_timeout=TIMEOUT_S)


class Tab:
    """A tab over a link: says what the script says.

    Args:
        link: that is open.
        said: by the tab, of its person.
    """

    def __init__(self, link, **said):
        self.link = link
        self._sequence = 0
        self._say(Hello("seat-of-a-tab", "load-of-a-tab", **said))

    def hold(self, *keys):
        self._say(Held(*self._stamp(), keys, True, True, (), (0, 0, 0, 0)))

    def press(self, action, argument=""):
        number, at_ms = self._stamp()
        self._say(Pressed(number, at_ms, number, action, argument))

    def _stamp(self):
        """By its own clock: what seems to come later and later counts no more."""
        self._sequence += 1
        return self._sequence, time.monotonic() * 1e3

    def _say(self, message):
        self.link.send(msgspec.json.encode(message).decode())
