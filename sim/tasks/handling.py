"""What a person does with an object that they have reached: close on it, lift it, carry it to its place, let go."""

import numpy as np

from sim.tasks.scene import Array, Corridor
from sim.tasks.success import Success

_BEYOND = 0.03  # [m] that an object is lifted higher than it has to be
_CARRIED = 0.10  # [m] above where it stood an object is carried to its place
_ABOVE = 0.002  # [m] over what it is put on, an object is let go


def handled(reach: Corridor, place: Array, success: Success, wide: float) -> Corridor:
    """Return the way to an object, and on from there as success asks for it.

    Args:
        reach: To where it is grasped.
        place: Of the object's centre, shape (3,) [m].
        success: In the task.
        wide: Opening of the gripper as it comes [m].
    """
    grasp = reach.positions[-1]
    there, openings = [*reach.positions], [*([wide] * (len(reach.positions) - 1)), 0.0]
    raised = 0.0 if success.lifted is None else success.lifted
    if success.placed is not None:
        raised = max(raised, _CARRIED)
    if raised > 0.0:
        up = np.array([0.0, 0.0, raised + _BEYOND])
        there.append(grasp + up)
        openings.append(0.0)
        if success.placed is not None:
            middle = (np.array(success.placed.lower) + np.array(success.placed.upper)) / 2
            standing = np.array([middle[0], middle[1], success.placed.lower[2]]) - place
            standing[2] = max(standing[2], 0.0) + _ABOVE
            there += [grasp + standing + up, grasp + standing]
            openings += [0.0, wide]
    turns = np.vstack([reach.orientations, np.tile(reach.orientations[-1], (len(there) - len(reach.positions), 1))])
    return Corridor(np.array(there), turns, np.array(openings))
