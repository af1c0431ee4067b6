"""A network that hands out no more energy than was put into it, whatever it does to what it carries.

Between hand and robot the network is a two-port: a velocity goes one way, a contact force comes back. Delay alone lets
such a network give out energy of its own, and a coupling with a stiff wall then grows. The time-domain passivity
approach (Hannaford and Ryu, 2002: observe the energy at a port in real time, and dissipate what would be too much; Ryu,
Artigas and Preusche, 2010: with a delay that nobody knows) splits each port's energy into what went in and what came
out, and tells the other side what went in. For every port, at every time,

    E_out(t) <= E_in of the other port, as far as it is known here:  at most E_in(t - T),

so that the sum over both ports is passive for any T, constant or not. An E_in only ever grows: the newest that came is
all that counts, and what was lost, came twice or came late takes nothing away.

What came out beyond that is a debt: what goes in repays it first, and only the rest is told to the other side. Both
controllers dissipate before a sample acts, so that the debt stays within what one sample can do beyond a stated bound.
Plain floats, since one of the ports is passed a thousand times a second.
"""

from __future__ import annotations

import math

Vector = tuple[float, float, float]

MOST_KEPT = 0.5
"""Of the energy that went in on the other side and has not come out here, so much is kept [J]; the rest is dissipated.

A network that had gathered much, as friction lets it, could give it back all at once.
"""

DEBT = 0.01
"""With a debt of so much a port that renders a force renders none that does work [J]; with a smaller one, the less."""

MOST_DAMPING = 10.0
"""Of the controller [N s/m]: a tenth of what a device of a tenth of a kilogram bears at a thousand samples a second."""


class Port:
    """One side of the network.

    Args:
        credit: that may come out before anything is known to have gone in, and that is repaid before all else [J].

    Attributes:
        energy_in: that went in here and is the other side's to give out, since the beginning [J]; it never falls.
        available: that may come out here [J]; negative, a debt.
    """

    def __init__(self, credit: float = 0.0) -> None:
        self.energy_in = 0.0
        self.available = self._credit = credit
        self._source: int | None = None
        self._heard = 0.0

    def hear(self, source: int, energy_in: float) -> None:
        """Take note of what went in on the other side.

        Args:
            source: who says so; another one begins its count anew, and what went in before is nobody's.
            energy_in: its count [J]; one that is no larger than the largest heard changes nothing.
        """
        if source != self._source:
            self._source, self._heard = source, energy_in
        gained = energy_in - self._heard
        if gained > 0.0:
            self._heard = energy_in
            self.available = min(self.available + gained, max(self.available, MOST_KEPT))

    def observe(self, out: float) -> None:
        """Count one sample.

        Args:
            out: the work that the network did here on what is outside [J]; negative, that was done on it.
        """
        if out > 0.0:
            self.available -= out
            return
        repaid = min(-out, max(0.0, self._credit - self.available))
        self.available += repaid
        self.energy_in += -out - repaid

    def force(self, wanted: Vector, velocity: Vector) -> Vector:
        """The force to render in this sample, where a force comes out and a velocity goes in (impedance type).

        Of the force f and the velocity v along it there is rendered, with the share s that falls from 1 without a debt
        to 0 at the whole of it, and a damping alpha = (1 - s) `MOST_DAMPING`,

            s f - alpha v,    no less than 0 and no more than f:

        without a debt the force itself; with the whole debt only what resists, and repays. It is continuous in all that
        it depends on, because a force that is either there or not there buzzes at the rate of the samples.

        Args:
            wanted: that came through the network [N].
            velocity: of the device [m/s].
        """
        if self.available >= 0.0:
            return wanted
        share = max(0.0, 1.0 + self.available / DEBT)
        size = math.hypot(*wanted)
        if size == 0.0:
            return wanted
        x, y, z = wanted[0] / size, wanted[1] / size, wanted[2] / size
        along = x * velocity[0] + y * velocity[1] + z * velocity[2]
        rendered = max(0.0, min(size, share * size - (1.0 - share) * MOST_DAMPING * along))
        return (rendered * x, rendered * y, rendered * z)

    def step(self, wanted: Vector, force: Vector) -> Vector:
        """The step to take in this sample, where a velocity comes out and a force goes in (admittance type).

        A conductance takes away what would come out beyond what is available: s + beta f, no more than the step's own
        part against the force. The result is never longer than what is wanted, and without a force it is the same.

        Args:
            wanted: that came through the network [m].
            force: from outside, against which the step works, or with it [N].
        """
        x, y, z = force
        return _bounded(wanted, (-x, -y, -z), max(0.0, self.available))


def _bounded(one: Vector, other: Vector, most: float) -> Vector:
    """The first of two conjugate vectors, less so much of its part along the other that their product is at most so."""
    size = math.hypot(*other)
    if size == 0.0:
        return one
    (x, y, z), (ux, uy, uz) = one, (other[0] / size, other[1] / size, other[2] / size)
    excess = x * ux + y * uy + z * uz - most / size
    return one if excess <= 0.0 else (x - excess * ux, y - excess * uy, z - excess * uz)
