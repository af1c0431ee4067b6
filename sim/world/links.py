"""Where a robot's links are, as its joints stand: of what is fixed to them, a real camera for one."""

from collections.abc import Iterable, Mapping

import mujoco

from sim.exceptions import CameraUnfit
from sim.pose import Pose
from sim.robots.description import RobotDescription
from sim.tasks import AnyScene
from sim.tasks.reaching import ReachingScene
from sim.world.assembly import assemble


class Links:
    """Forward kinematics of a robot where it stands in a scene; used by one thread.

    Args:
        scene: That it stands in.
        description: Of the robot.
    """

    def __init__(self, scene: AnyScene, description: RobotDescription) -> None:
        self._model = assemble(scene, description)
        self._data = mujoco.MjData(self._model)
        self._names = frozenset(self._model.joint(number).name for number in range(self._model.njnt))
        if isinstance(scene, ReachingScene):
            self._put(zip(scene.manipulator.held_names, scene.stance.held, strict=True))

    def check(self, camera: str, link: str) -> None:
        """Let pass a link that is there.

        Args:
            camera: That is fixed to it.
            link: Its name.

        Raises:
            CameraUnfit: It is not.
        """
        if mujoco.mj_name2id(self._model, mujoco.mjtObj.mjOBJ_BODY, link) < 0:
            raise CameraUnfit(camera, link)

    def carries(self, joint: str, link: str) -> bool:
        """Say whether a link moves where a joint does.

        Args:
            joint: Of the robot, by name.
            link: Its name.
        """
        mover = self._model.joint(joint).bodyid[0]
        body = self._model.body(link).id
        while body not in (0, mover):
            body = self._model.body_parentid[body]
        return bool(body == mover)

    def hand(self, joint: str) -> str:
        """Return the name of the link that a joint moves.

        Args:
            joint: Of the robot, by name.
        """
        return str(self._model.body(self._model.joint(joint).bodyid[0]).name)

    def pose(self, link: str, joints: Mapping[str, float]) -> Pose:
        """Return where a link's frame is in the base frame.

        Args:
            link: Its name.
            joints: Positions of the robot's joints, by name [rad, m]; those of names that it does not have say nothing.
        """
        self._put(joints.items())
        mujoco.mj_kinematics(self._model, self._data)
        body = self._data.body(link)
        return Pose(body.xpos.copy(), body.xquat.copy())

    def _put(self, positions: Iterable[tuple[str, float]]) -> None:
        for name, position in positions:
            if name in self._names:
                self._data.qpos[self._model.joint(name).qposadr[0]] = position
