"""What a person has in mind before a motion: the way that they mean, and the correction that leads a robot along it."""

from dataclasses import dataclass, replace

import numpy as np
from numpy.typing import NDArray

from sim.person.imagination import chosen, imagined
from sim.person.intention import Intention, plan, plan_at_equal_progress
from sim.pose import Pose
from sim.tasks import AnyScene
from sim.tasks.scene import Corridor

Array = NDArray[np.float64]


@dataclass(frozen=True, eq=False)
class Outlook:
    """What a person sees before a motion.

    Attributes:
        scene: That the robot stands in.
        variant: Of it.
        place: Of the target, shape (d,) [m].
        start: Of the motion.
    """

    scene: AnyScene
    variant: str
    place: Array
    start: Pose

    def way(self, motion: Array | None, scatter: float, rng: np.random.Generator) -> Corridor:
        """The way that they mean, as they have it in mind this time.

        Args:
            motion: What the robot would do, shape (n, 3) [m]; None where nothing is known of that.
            scatter: Of the person, see `deviation` [m].
            rng: Of the choice and of this time's deviation.
        """
        ways = self.scene.corridors(self.variant, self.place, self.start)
        foreseen = ways[0].positions if motion is None else motion
        scatter *= self.scene.unsteadiness
        return imagined(chosen(ways, foreseen, rng), foreseen, scatter, rng, self.scene.freedom)

    def correction(
        self,
        positions: Array,
        orientations: Array,
        scatter: float,
        rng: np.random.Generator,
        exaggeration: float = 1.0,
        *,
        opening: Array | None = None,
    ) -> Intention:
        """The correction that leads a prediction along the way that they mean.

        Args:
            positions: Of the predicted grasping frame at equal steps of progress, shape (n, 3) [m].
            orientations: The same, shape (n, 4); neighbours in one hemisphere.
            scatter: Of the person, see `deviation` [m].
            rng: Of the choice and of this time's deviation.
            exaggeration: Of the correction; 1 is natural.
            opening: Of the predicted gripper, shape (n,) [m]; None where it takes no part.
        """
        meant = self.way(positions, scatter, rng)
        if not self.scene.freedom.tempo:
            return plan_at_equal_progress(positions, orientations, meant, exaggeration)
        known = [
            way for variant in self.scene.variants for way in self.scene.corridors(variant, self.place, self.start)
        ]
        planned = plan(positions, orientations, meant, known, exaggeration, opening=opening)
        slack = self.scene.turn_slack
        return replace(planned, rotations=_beyond(planned.rotations, slack)) if slack > 0.0 else planned


def _beyond(rotations: Array, slack: float) -> Array:
    """What is left of rotations, shape (n, 3), of a robot of which nobody asks for a turn that it may leave anyway."""
    angles = np.linalg.norm(rotations, axis=1, keepdims=True)
    return np.asarray(rotations * np.maximum(0.0, 1.0 - slack / np.maximum(angles, slack)), dtype=np.float64)
