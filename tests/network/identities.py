"""An authority with all kinds of certificates, and what forgers have instead of one."""

import shutil
from datetime import timedelta

from protocol.rights import subject
from services.bus.zenoh import open_session
from services.certificates import register
from services.certificates.authority import make_authority
from services.certificates.credentials import Credentials
from tests.system.harness import START_S

SITE = ("router", "robot", "camera", "perception", "model")
NAMES = (
    *(f"{kind}.kitchen" for kind in SITE),
    "page.desk",
    *("router.garage", "robot.garage", "operator.anna", "operator.bob", "observer.carl", "supervisor.sue"),
)


class Identities:
    """An authority, and a foreign one, in folders.

    Args:
        folder: for them.
    """

    def __init__(self, folder):
        self.folder = folder / "own"
        self.authority = make_authority(self.folder)
        for name in NAMES:
            self.authority.issue(name, hosts=("127.0.0.1",))
        self._foreign = folder / "foreign"
        foreign = make_authority(self._foreign)
        for name in ("robot.kitchen", "router.kitchen", "operator.anna"):
            foreign.issue(name)
        self._mixed = folder / "mixed"
        self._mixed.mkdir()
        shutil.copy(self.folder / "ca.pem", self._mixed)
        shutil.copy(self._foreign / "operator.anna.pem", self._mixed)

    def of(self, name):
        """A certificate of the authority's."""
        return Credentials(self.folder, subject(name))

    def foreign(self, name):
        """One of the foreign authority, with everything that it trusts."""
        return Credentials(self._foreign, subject(name))

    def forged(self):
        """A foreign authority's certificate for a name that is let in, with the true authority's own."""
        return Credentials(self._mixed, subject("operator.anna"))

    def expired(self, monkeypatch):
        """One that the authority issued, and that has ended."""
        true = register.now()
        monkeypatch.setattr(register, "now", lambda: true - timedelta(days=15))
        self.authority.issue("operator.old", days=14)
        monkeypatch.undo()
        return self.of("operator.old")

    def session(self, endpoint, name):
        """A session that shows a certificate."""
        return open_session(endpoint, START_S, credentials=self.of(name))
