"""What success means in a task, as data."""

from dataclasses import dataclass

from sim.region import Region
from sim.tasks.scene import Vector


@dataclass(frozen=True)
class Success:
    """What has to be so when a motion has ended, and what must not have happened until then.

    Attributes:
        reached: Half axes of the ellipsoid around the grasping frame, along its axes, that the object's centre must lie
            in (thesis, Fig. E.2) [m].
        kicked_over: Displacement along each axis of the base frame beyond which the object counts as kicked over
            (thesis, Appendix E) [m]; of an object that is to be lifted or placed only while no finger holds it.
        tilt: Of the object beyond which it does too [rad]; as far as it can be tilted and fall back where it is None.
        may_touch: Boxes and meshes that the robot may touch, by name.
        force: Of a touch of these, beyond which it counts as a collision all the same [N]; no limit where it is None.
        time: Within which it has to be done [s]; no limit where it is None.
        grasped: The gripper holds the object at the end.
        lifted: By at least so much, from where it stood [m]; None where it need not be.
        placed: In which region its centre is at the end, let go of; None where it need not be [m].
    """

    reached: Vector
    kicked_over: Vector
    tilt: float | None = None
    may_touch: tuple[str, ...] = ()
    force: float | None = None
    time: float | None = None
    grasped: bool = False
    lifted: float | None = None
    placed: Region | None = None

    def allows(self, thing: str, force: float) -> bool:
        """Say whether the robot may touch a thing so hard [N]."""
        return thing in self.may_touch and (self.force is None or force <= self.force)

    @property
    def gripper(self) -> bool:
        """The gripper takes part."""
        return self.grasped or self.lifted is not None or self.placed is not None
