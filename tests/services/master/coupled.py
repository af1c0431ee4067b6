"""A hand on the simulated stylus, a network, a robot at a wall, on one clock: the real force loop and both ports."""

import heapq
from types import SimpleNamespace

import numpy as np

from protocol.messages import MasterState, Phase, Pose, RobotState
from services.master.devices.simulated_stylus import SimulatedStylus
from services.master.feedback import Feedback
from services.master.haptics import HapticLoop
from services.robot.contact import LARGEST, ContactPort
from services.robot.correction import UNCORRECTED, Correction
from services.robot.safety import REFERENCE_SPEED, clamp_length
from sim.person.hand import DAMPING, STIFFNESS
from sim.person.stylus import Stylus

MS = 1_000_000
PERIOD_MS = 10
LONGEST_STEP = REFERENCE_SPEED * PERIOD_MS / 1e3
"""Of the robot in a control period [m]."""
POSE = Pose((0.5, 0.0, 0.5), (1.0, 0.0, 0.0, 0.0))


class PassiveHand:
    """An arm that is held in mind at a place, and yields: the impedance of the scripted operator's hand."""

    rotation = None

    def __init__(self):
        self.target = (0.0, 0.0, 0.0)

    def force(self, stylus):
        moved = zip(self.target, stylus.position, stylus.velocity, strict=True)
        return tuple(STIFFNESS * (t - x) - DAMPING * v for t, x, v in moved)


class Channel:
    """One way through a network: everything late, some of it later, lost, or twice; what is overtaken is dropped.

    Args:
        rng: of chance.
        delay_ms: of all.
        jitter_ms: that is added to it at most.
        loss: share that never comes; of what comes as much comes twice.
    """

    def __init__(self, rng, delay_ms, jitter_ms=0.0, loss=0.0):
        self._rng, self._delay, self._jitter, self._loss = rng, delay_ms, jitter_ms, loss
        self._under_way = []
        self._newest = 0

    def send(self, now_ms, message):
        for _ in range(int(self._rng.random() >= self._loss) + int(self._rng.random() < self._loss)):
            due = now_ms + self._delay + self._jitter * self._rng.random()
            heapq.heappush(self._under_way, (due, message.sequence, id(message), message))

    def take(self, now_ms):
        """The newest that has come by now, None where nothing newer has."""
        newest = None
        while self._under_way and self._under_way[0][0] <= now_ms:
            _, sequence, _, message = heapq.heappop(self._under_way)
            if sequence > self._newest:
                self._newest, newest = sequence, message
        return newest


class Coupled:
    """See the module. The robot's correction is what its port lets through; the wall pushes it back along x.

    Args:
        there: the channel to the robot.
        back: the channel from it.
        wall_at: where the wall begins [m].
        stiffness: of the wall [N/m].
        damping: of the wall, against being pressed in [N s/m].
        limit: of the force that is rendered [N].
        local: stiffness of eq. 14 [N/m].
    """

    def __init__(self, there, back, *, wall_at=0.02, stiffness=2000.0, damping=0.0, limit=20.0, local=0.0):
        self.there, self.back = there, back
        self.wall_at, self.stiffness, self.damping = wall_at, stiffness, damping
        self.hand = PassiveHand()
        self.feedback = Feedback(local, 0.0, limit)
        self.loop = HapticLoop(SimulatedStylus(Stylus(), self.hand), self.feedback, 0)
        self.port = ContactPort(PERIOD_MS / 1e3)
        self.episode = SimpleNamespace(execution=SimpleNamespace(correction=UNCORRECTED))
        self.master = self.robot = None
        self.heard = True
        self.now_ms = self._sent = 0
        self.energy_in = self.energy_out = self.on_hand = self.by_contact = 0.0
        self.touches, self._pushed = 0, False
        self.forces, self.positions, self.offsets = [], [], []

    def run(self, seconds, target=None):
        """Let time pass, the hand's mind at a place along x [m]."""
        for _ in range(round(seconds * 1e3)):
            if target is not None:
                self.hand.target = (target, 0.0, 0.0)
            self.now_ms += 1
            before = self.loop.newest.stylus.position
            rendered = self.loop.advance_to(self.now_ms * MS)
            force = rendered.feedback
            moved = [b - a for a, b in zip(before, rendered.stylus.position, strict=True)]
            work = sum(f * s for f, s in zip(force, moved, strict=True))
            self._count(work)
            self.on_hand += work
            self.forces.append(force)
            self.positions.append(rendered.stylus.position[0])
            if self.now_ms % PERIOD_MS == 0:
                self._exchange(rendered)

    def swing(self, seconds):
        """How far the stylus went to and fro lately [m]."""
        lately = self.positions[-round(seconds * 1e3) :]
        return max(lately) - min(lately)

    def _count(self, out):
        self.energy_out += max(0.0, out)
        self.energy_in += max(0.0, -out)

    def _exchange(self, rendered):
        self._sent += 1
        contact = self.feedback.contact
        said = MasterState(
            publisher=1,
            sequence=self._sent,
            displacement=rendered.stylus.position,
            engaged=True,
            contact_energy=contact.energy_in,
        )
        self.there.send(self.now_ms, said)
        self.master = self.there.take(self.now_ms) or self.master
        self._press()
        told = RobotState(
            publisher=2,
            sequence=self._sent,
            measured=POSE,
            reference=POSE,
            phase=Phase.EXECUTE,
            contact_force=tuple(self.port.force.tolist()),
            contact_energy=self.port.energy_in,
        )
        self.back.send(self.now_ms, told)
        robot = self.back.take(self.now_ms) if self.heard else None
        if robot is not None:
            contact.hear(robot)
            self.loop.hear(self.now_ms * MS)

    def _press(self):
        """One control period of the robot."""
        execution, before = self.episode.execution, self.episode.execution.correction.offset
        if self.master is not None:
            asked = Correction(np.array(self.master.displacement), np.zeros(3))
            execution.correction = self.port.limited(asked, self.master, self.episode)
            step, _ = clamp_length(execution.correction.offset - before, LONGEST_STEP)
            execution.correction = Correction(before + step, np.zeros(3))
        offset = execution.correction.offset
        depth, speed = offset[0] - self.wall_at, (offset[0] - before[0]) / (PERIOD_MS / 1e3)
        push = max(0.0, self.stiffness * depth + self.damping * speed) if depth > 0.0 else 0.0
        self.touches += push > 0.0 and not self._pushed
        self._pushed = push > 0.0
        force = np.array([-min(push, LARGEST), 0.0, 0.0])
        self.port.observe(force)
        self._count(-float(force @ (offset - before)))
        self.by_contact += max(0.0, float(force @ (offset - before)))
        self.offsets.append(offset[0])
