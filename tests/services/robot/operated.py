"""A robot process that an operator asks, and a clock that is moved by hand."""

from protocol import messages, queries, topics
from protocol.queries import AuthorityGranted
from services.bus.memory import MemoryNetwork
from services.process.clock import ManualClock


class Operated:
    """See the module.

    Args:
        build: the robot process, of a bus and a clock.
    """

    def __init__(self, build):
        self.clock = ManualClock()
        self.network = MemoryNetwork(self.clock)
        self.operator = self.network.bus()
        self.service = build(self.network.bus(), self.clock)
        self.epoch = 0
        self.holder = "ann"

    def run(self, seconds, *, renew=True, master=None, **said):
        """Let time pass: with the operator present or not, with a displacement of the master or without a master."""
        for _ in range(round(seconds * 100)):
            self.clock.advance(0.01)
            if renew:
                renewal = messages.AuthorityRenewal(holder=self.holder, epoch=self.epoch)
                self.operator.publish(topics.AUTHORITY_RENEWAL, renewal)
            if master is not None:
                self.say(master, **said)
            self.service.step(self.clock.now_ns())

    def say(
        self, displacement, *, rotation=(0.0, 0.0, 0.0), engaged=True, epoch=None, contact_energy=-1.0, opening=None
    ):
        """One sample of the master."""
        state = messages.MasterState(
            displacement=displacement,
            rotation=rotation,
            engaged=engaged,
            holder=self.holder,
            epoch=self.epoch if epoch is None else epoch,
            contact_energy=contact_energy,
            opening=opening,
        )
        self.operator.publish(topics.MASTER_STATE, state)

    def ask(self, query, request):
        pending = self.operator.ask(query, request)
        self.run(0.01)
        return pending.poll()

    def acquire(self, holder="ann", *, take_over=False):
        request = queries.AcquireAuthority(holder, take_over=take_over, reason="it burns" if take_over else "")
        reply = self.ask(queries.ACQUIRE, request)
        assert isinstance(reply, AuthorityGranted)
        self.epoch, self.holder = reply.epoch, holder
        return reply.epoch
