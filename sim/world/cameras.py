"""The robot's cameras and those that stand in the scene, drawn from a published state.

They hold a model of their own, so that drawing can never disturb control.
"""

import mujoco
import numpy as np
from numpy.typing import NDArray

from sim.pose import Pose
from sim.robots.description import RobotDescription
from sim.robots.robot import Camera
from sim.tasks import AnyScene
from sim.world.assembly import assemble
from sim.world.drawing import Canvas, Depth, Image
from sim.world.staging import select

Array = NDArray[np.float64]

_OPTICAL = np.diag([1.0, -1.0, -1.0])  # MuJoCo's camera axes to optical ones: half a turn about x


class Cameras:
    """All cameras in a scene; used by one thread, and closed at the end.

    Args:
        scene: What stands around the robot.
        description: Of the arm; a particle needs none.
        width: Of the pictures [px].
        height: Of the pictures [px].
        more: Cameras beside the robot's own, or in the place of one of the same name.

    Attributes:
        names: Of the cameras.

    Raises:
        DrawingLibraryMissing: Neither EGL nor OSMesa can be used.
        CameraUnfit: A camera is fixed to a link that is not there.
    """

    def __init__(
        self,
        scene: AnyScene,
        description: RobotDescription,
        width: int = 320,
        height: int = 240,
        more: tuple[Camera, ...] = (),
    ) -> None:
        self.scene = scene
        self.width, self.height = width, height
        self._model = assemble(scene, description, more)
        self.names = frozenset(self._model.camera(number).name for number in range(self._model.ncam))
        self._data = mujoco.MjData(self._model)
        self.show(scene.variants[0])
        self._canvas = Canvas(self._model, width, height)

    def show(self, variant: str) -> None:
        """Draw this variant of the scene from now on.

        Raises:
            UnknownVariant: The scene has no such variant.
        """
        select(self._model, self.scene, variant)

    def render(self, name: str, qpos: Array) -> Image:
        """Draw what a camera sees.

        Args:
            name: One of `names`.
            qpos: State of the world, as `World.state` gives it.

        Returns:
            The picture in RGB, shape (height, width, 3), its first row at the top.
        """
        self._place(qpos)
        camera = mujoco.MjvCamera()
        camera.type = mujoco.mjtCamera.mjCAMERA_FIXED
        camera.fixedcamid = self._model.camera(name).id
        return self._canvas.draw(self._data, camera)

    def depth(self) -> Depth:
        """Return how far along the view is what was rendered last, shape (height, width) [m]; see `Canvas.depth`."""
        return self._canvas.depth()

    def intrinsics(self, name: str) -> Array:
        """Return a camera's matrix, shape (3, 3) [px], for pixel centres at whole numbers.

        Args:
            name: One of `names`.
        """
        fovy = np.radians(float(self._model.camera(name).fovy[0]))
        focal = self.height / 2 / np.tan(fovy / 2)
        return np.array([[focal, 0.0, (self.width - 1) / 2], [0.0, focal, (self.height - 1) / 2], [0.0, 0.0, 1.0]])

    def pose(self, name: str, qpos: Array) -> Pose:
        """Return where a camera is in the base frame, with optical axes: x right, y down, z forward.

        Args:
            name: One of `names`.
            qpos: State of the world, as `World.state` gives it.
        """
        self._place(qpos)
        seen = self._data.camera(name)
        orientation = np.zeros(4)
        mujoco.mju_mat2Quat(orientation, (seen.xmat.reshape(3, 3) @ _OPTICAL).ravel())
        return Pose(seen.xpos.copy(), orientation)

    def link(self, name: str) -> Pose:
        """Return where a link was in the base frame when a camera was looked through last.

        Args:
            name: Of the link; empty for the base frame itself.

        Raises:
            KeyError: There is none.
        """
        body = self._data.body(name or "world")
        return Pose(body.xpos.copy(), body.xquat.copy())

    def close(self) -> None:
        """Give the drawing library's resources back."""
        self._canvas.close()

    def _place(self, qpos: Array) -> None:
        self._data.qpos[:] = qpos
        mujoco.mj_kinematics(self._model, self._data)
        mujoco.mj_comPos(self._model, self._data)
        mujoco.mj_camlight(self._model, self._data)
