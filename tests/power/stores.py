"""What the product keeps for good: how it comes to be, step by step, and how it is found again.

Each of these has `steps`, which stores something for good before each yield, and `found`, which reads what is there
with the product's own code, by parts.
"""

import contextlib
import time
from concurrent.futures import ThreadPoolExecutor
from datetime import UTC, datetime

import numpy as np
from cryptography import x509
from cryptography.hazmat.primitives import serialization

from lfd.models.promp import ConditionedProMP
from lfd.motion.demonstration import Demonstration
from lfd.motion.trajectory import Trajectory
from lfd.store import model_file
from lfd.store.stored import Binding, Purpose
from protocol.messages import Role
from services.accounts import file as accounts_file
from services.accounts.account import Account, Accounts
from services.certificates import credentials, register
from services.certificates.authority import Authority, make_authority
from services.certificates.exceptions import NoAuthority
from services.evidence.events import StopChanged
from services.evidence.ledger import LedgerFile, path_of
from services.evidence.reading import Reader, verify
from services.model.shelf import Shelf
from services.process.files import data_folder
from services.robot.latch import Latch
from services.robot.memory import safety_file

ROBOT = "kitchen"
BINDING = Binding("dishwasher", "tiago")
PATIENCE_S = 10.0


def until(seen):
    """Wait for what another thread does."""
    deadline = time.monotonic() + PATIENCE_S
    while not seen():
        assert time.monotonic() < deadline
        time.sleep(1e-3)


def demonstrated(y, points=20):
    """A straight reach."""
    way = np.linspace(0.0, 1.0, points)[:, None]
    positions = (0.5, 0.0, 0.5) + way * (0.4, y, 0.1)
    return Demonstration.reaching(Trajectory(positions, np.tile((1.0, 0.0, 0.0, 0.0), (points, 1)), 5.0), positions[-1])


def certificate_in(path):
    """The certificate in a file."""
    return x509.load_pem_x509_certificate(path.read_bytes())


class Learnt:
    """Demonstrations, in several lives of the model's process."""

    def steps(self):
        for life in (0, 1):
            store = Shelf(data_folder() / ROBOT, ROBOT).take(BINDING.scene, BINDING, 0.0)
            first = store.add(demonstrated(0.1), Purpose.INITIAL, BINDING, request=10 * life + 1)
            yield
            store.add(demonstrated(0.2, points=300), Purpose.UPDATE, BINDING)
            yield
            store.undo(first, request=10 * life + 2)
            yield
            store.redo(first)
            yield
            store.close()

    def found(self):
        with Shelf(data_folder() / ROBOT, ROBOT).take(BINDING.scene, BINDING, 0.0) as store:
            kept = [(one.version, one.turn.version, one.in_use) for one in store.history()]
            return {"all": (kept, store.version, [store.made_by(request) for request in (1, 2, 11, 12)])}


class Safety:
    """The robot's stop, and its epochs."""

    def steps(self):
        memory = safety_file(ROBOT)
        memory.recall("now")
        latch, epoch = Latch(), 0
        for number in range(6):
            latch = (
                latch.pressed("anna", "x" * 40 * number, "then") if number % 2 == 0 else latch.released("bob", "now")
            )
            epoch += 700
            memory.keep(latch, epoch)
            until(lambda: memory.settled)
            assert not memory.fault
            yield
        memory.close()

    def found(self):
        memory = safety_file(ROBOT)
        record = memory.recall("now")
        memory.close()
        return {"stop": record.latch, "epochs": record.epoch_bound}


class Evidence:
    """The robot's log."""

    def steps(self):
        for life in (0, 1):
            ledger = self._ledger()
            for step in range(3):
                for number in range(4 * step + 1):
                    ledger.add(self._event(f"{life}.{step}.{number}"))
                until(lambda ledger=ledger: not ledger.unwritten)
                yield
            ledger.close()

    def found(self):
        path = path_of(ROBOT)
        before = self._reasons(path)
        ledger = self._ledger()
        ledger.add(self._event("since"))
        ledger.close()
        assert verify(path).whole, verify(path).faults
        assert self._reasons(path) == [*before, "since"]
        return {"log": before}

    def _ledger(self):
        return LedgerFile(path_of(ROBOT), ThreadPoolExecutor(1), lambda: datetime(2026, 3, 1, tzinfo=UTC))

    def _event(self, reason):
        return StopChanged(latched=True, by="anna", reason=f"{reason} {'x' * 700}", released_by="")

    def _reasons(self, path):
        if not path.exists():
            return []
        events = [found.entry.event for found in Reader(path)]
        return [event.reason.split()[0] for event in events if isinstance(event, StopChanged)]


class People:
    """The accounts of a station."""

    def steps(self):
        path, accounts = accounts_file.accounts_path(), Accounts()
        digest = "$argon2id$v=19$m=65536,t=3,p=4$c2FsdHNhbHQ$aGFzaGhhc2g"
        for name in ("anna", "bob", "carl"):
            accounts = accounts.with_new(Account(name, Role.OPERATOR, digest))
            accounts_file.save(accounts, path)
            yield
        accounts_file.save(accounts.without("bob"), path)
        yield

    def found(self):
        return {"names": [one.name for one in accounts_file.load(accounts_file.accounts_path()).accounts]}


class Certificates:
    """An authority, and what it has issued: one to another machine's folder."""

    def steps(self):
        authority = make_authority(self._folder())
        yield
        authority.issue("robot.kitchen")
        yield
        authority.issue("operator.anna", to=self._machine())
        yield
        authority.renew("robot.kitchen")
        yield
        authority.revoke("robot.kitchen")
        yield
        authority.issue("robot.kitchen")
        yield

    def found(self):
        folder, machine = self._folder(), self._machine()
        try:
            authority = Authority(folder)
        except NoAuthority:
            authority = make_authority(folder)
            assert authority.register.issued == ()
            return {"own": None, "machine": ()}
        own = {one.name: (one.generation, one.serial, one.revoked) for one in authority.register.issued}
        for name in own:
            self._check(authority, (machine if name == "operator.anna" else folder) / f"{name}.pem")
        given = register.load(machine)
        if given.issued:  # written last
            assert certificate_in(machine / credentials.ROOT) == certificate_in(folder / credentials.ROOT)
        return {"own": own, "machine": given.issued}

    def _check(self, authority, path):
        """What is in the register has its file, with a certificate of this authority's and its key."""
        content = path.read_bytes()
        certificate = x509.load_pem_x509_certificate(content)
        key = serialization.load_pem_private_key(content, None)
        assert certificate.public_key() == key.public_key()
        certificate.verify_directly_issued_by(certificate_in(authority.folder / credentials.ROOT))

    def _folder(self):
        return credentials.folder("")

    def _machine(self):
        return self._folder() / "machine"


class Exported:
    """A model, in a file that a person named."""

    def steps(self):
        for y in (0.1, 0.2):
            model_file.save(ConditionedProMP.fit([demonstrated(0.3), demonstrated(y)]), data_folder() / "model.npz")
            yield

    def found(self):
        path = data_folder() / "model.npz"
        with contextlib.suppress(FileNotFoundError):
            path.stat()
            return {"model": model_file.load(path).joint.mean.tobytes()}
        return {"model": None}


STORES = {one.__name__.lower(): one() for one in (Learnt, Safety, Evidence, People, Certificates, Exported)}
