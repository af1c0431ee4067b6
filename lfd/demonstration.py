"""A demonstration: a trajectory that reached an object, and where the object was."""

from dataclasses import dataclass, replace

from lfd.arrays import Array, checked, frozen
from lfd.trajectory import Trajectory


@dataclass(frozen=True, eq=False)
class Demonstration:
    """One reaching motion and the object that it reached, both in the robot's base frame.

    Attributes:
        trajectory: The motion of the end effector in the base frame.
        object_position: Position of the object in the base frame, shape (3,) [m].

    Raises:
        WrongShape: The object position is not of shape (3,).
        NotFinite: It contains NaN or infinity.
    """

    trajectory: Trajectory
    object_position: Array

    def __post_init__(self) -> None:
        object.__setattr__(self, "object_position", checked("object_position", self.object_position, (3,)))

    @property
    def condition(self) -> Array:
        """The condition s: the object relative to the end effector at t = 0, base axes, shape (3,) [m].

        The thesis multiplies it by 10. That is no property of the condition: it only divides the conditioning noise
        of equation (10) by 100, so it stands with that noise (`lfd.promp`) and not here.
        """
        return frozen(self.object_position - self.trajectory.positions[0])


def relative_to_object(trajectory: Trajectory, object_position: Array) -> Trajectory:
    """The trajectory relative to the object, base axes: equation (23), whose rotation is the identity.

    Args:
        trajectory: In the base frame.
        object_position: In the base frame, shape (3,) [m].
    """
    return replace(trajectory, positions=trajectory.positions - object_position)


def to_base(trajectory: Trajectory, object_position: Array) -> Trajectory:
    """The inverse of `relative_to_object`, for an object at `object_position` (3,) [m] in the base frame."""
    return replace(trajectory, positions=trajectory.positions + object_position)
