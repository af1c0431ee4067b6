"""What came out of a rehearsal, as plain values that cross to another process."""

from __future__ import annotations

import math
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from lfd.motion.trajectory import Trajectory
from protocol.messages import Condition, EpisodeResult, Mode, Motion, Pose, Vector3, Verdict
from protocol.queries import Reset
from services.bus.arrays import motion_from_wire, vector3


@dataclass(frozen=True)
class Arrangement:
    """What the robot finds: the condition of the thesis, and what else a reset puts in place.

    Attributes:
        variant: of the scene.
        object_position: of the object's centre, base frame [m]; None where a scene has no object.
        start: of the grasping frame; the scene's own, or as it was put last, where there is none.
        condition: the external state of a scene that has another than the object's position.
    """

    variant: str
    object_position: Vector3 | None = None
    start: Pose | None = None
    condition: Condition | None = None

    @classmethod
    def of(cls, variant: str, place: tuple[float, ...], *, has_object: bool) -> Arrangement:
        """Of a target at a place, as the scene counts it.

        Args:
            variant: of the scene.
            place: of the target, shape (d,) [m].
            has_object: the scene has an object there; else it is a condition.
        """
        return cls(variant, vector3(np.array(place))) if has_object else cls(variant, condition=place)

    @property
    def place(self) -> NDArray[np.float64]:
        """Of the target: the object's position, or the condition, shape (d,) [m]."""
        return np.array(self.condition if self.object_position is None else self.object_position, dtype=np.float64)

    def reset(self) -> Reset:
        """The request that arranges it; the epoch is for the asker to fill in."""
        return Reset(0, self.variant, self.object_position, self.condition, self.start)


@dataclass(frozen=True, eq=False)
class Attempt:
    """One episode.

    Attributes:
        mode: autonomous, or refined by the scripted operator.
        model_version: that predicted.
        verdict: with its evidence.
        reason: why it did not run to its end, empty where it did.
        prediction: of the model.
        refined: the reference, the operator's correction included.
        commanded: what the joints were told; the model learns of it, oriented as the reference.
        measured: what the arm did.
        miss: how much nearer it should have come to reach the target; 0 where it did [m].
    """

    mode: Mode
    model_version: int
    verdict: Verdict
    reason: str
    prediction: Trajectory
    refined: Trajectory
    commanded: Trajectory
    measured: Trajectory
    miss: float

    @classmethod
    def of(cls, result: EpisodeResult, predicted: Motion, model_version: int, miss: float) -> Attempt:
        """From the robot's message, and what it does not say."""
        return cls(
            mode=result.mode,
            model_version=model_version,
            verdict=result.verdict,
            reason=result.reason,
            prediction=_trajectory(predicted),
            refined=_trajectory(result.refined),
            commanded=_trajectory(result.commanded),
            measured=_trajectory(result.measured),
            miss=miss,
        )

    @property
    def success(self) -> bool:
        """All three criteria are met."""
        verdict = self.verdict
        return verdict.reached and not verdict.kicked_over and not verdict.collision

    @property
    def failure(self) -> str:
        """What went wrong and by how much, in a few words; empty for a success."""
        verdict, said = self.verdict, []
        if verdict.collision:
            link, thing = verdict.collision_between or ("robot", "something")
            force = f" with {verdict.collision_force:.0f} N" if verdict.collision_force else ""
            said.append(f"{_words(link)} hit {_words(thing)}{force}")
        if verdict.kicked_over:
            moved = 1e3 * float(np.max(np.abs(verdict.object_displacement)))
            said.append(f"kicked over by {moved:.0f} mm and {math.degrees(verdict.object_tilt):.0f} degrees")
        if not verdict.reached:
            said.append(f"missed by {1e3 * self.miss:.0f} mm")
        return ", ".join(said)


@dataclass(frozen=True, eq=False)
class Course:
    """Algorithm 1 under one arrangement.

    Attributes:
        arrangement: that it ran under.
        attempts: every episode in order.
        updates: of the model.
    """

    arrangement: Arrangement
    attempts: tuple[Attempt, ...]
    updates: int

    @property
    def success(self) -> bool:
        """The last prediction succeeded by itself."""
        return bool(self.attempts) and self.attempts[-1].mode is Mode.AUTONOMOUS and self.attempts[-1].success

    @property
    def refinements(self) -> int:
        """Attempts at correcting."""
        return sum(attempt.mode is Mode.REFINE for attempt in self.attempts)

    @property
    def needed_refinement(self) -> bool:
        """The first prediction failed."""
        return bool(self.attempts) and not self.attempts[0].success


def _words(name: str) -> str:
    """A part's name as a person would say it."""
    return name.removesuffix("_link").replace("_", " ")


def _trajectory(motion: Motion) -> Trajectory:
    return Trajectory(*motion_from_wire(motion))
