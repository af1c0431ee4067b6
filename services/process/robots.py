"""Which robot a configuration means, and the scene with that robot in it."""

from __future__ import annotations

from services.process.config import Configuration, RobotSection
from services.process.exceptions import UnusableSetting
from services.process.robot_file import load_robot
from sim.exceptions import UnknownScene
from sim.robots import faults
from sim.robots.catalogue import robot
from sim.robots.description import source_of
from sim.robots.robot import USUAL_CAMERAS, Manipulator
from sim.tasks import SCENES, AnyScene, is_path, scene
from sim.tasks.reaching import ReachingScene


def manipulator(section: RobotSection) -> Manipulator | None:
    """The robot that a configuration means; None for whichever a scene was made for.

    Raises:
        UnknownRobot: none that ships has the name.
        ConfigurationError: the robot file cannot be used.
        SimError: what it names is not there.
    """
    if section.model_file is not None:
        found = load_robot(section.model_file)
        source = source_of(found)
        faults.check(faults.parsed(source), found, source)
        return found
    return robot(section.model) if section.model else None


def scene_of(section: RobotSection, name: str = "") -> AnyScene:
    """The scene of a configuration, with its robot in it.

    Args:
        section: of the configuration.
        name: of another scene, as a robot tells it; the section's own by default.

    Raises:
        UnknownScene: there is none of that name.
        TaskUnfit: the task file cannot be used.
        UnknownRobot: see `manipulator`.
        RobotOfItsOwn: no other robot stands in that scene.
        ConfigurationError: see `manipulator`.
    """
    if is_path(name):  # whatever is told, no file is opened for it
        raise UnknownScene(name, SCENES)
    arm = manipulator(section)
    if section.task_file is not None and name:
        own = scene(section.scene, arm)
        return own if own.name == name else scene(name, arm)
    return scene(name or section.scene, arm)


def known_scene(section: RobotSection) -> AnyScene | None:
    """The scene of a configuration; None where it is not known here.

    Raises:
        TaskUnfit: the task file cannot be used.
        UnknownRobot: see `manipulator`.
        RobotOfItsOwn: no other robot stands in that scene.
        ConfigurationError: see `manipulator`.
    """
    try:
        return scene_of(section)
    except UnknownScene:
        return None


def camera_names(configuration: Configuration) -> tuple[str, ...]:
    """The names of all cameras: the robot's own, then what the configuration adds.

    A robot in a scene that is not known here has those that robots usually have.

    Raises:
        TaskUnfit: the task file cannot be used.
        UnknownRobot: see `manipulator`.
        RobotOfItsOwn: no other robot stands in that scene.
        ConfigurationError: see `manipulator`.
    """
    known = known_scene(configuration.robot)
    own: tuple[str, ...] = USUAL_CAMERAS
    if isinstance(known, ReachingScene):
        own = tuple(camera.name for camera in known.manipulator.cameras)
    return tuple(dict.fromkeys((*own, *(camera.name for camera in configuration.camera.cameras))))


def check_camera(setting: str, name: str, configuration: Configuration) -> None:
    """Let a camera pass that is there.

    Args:
        setting: that names it, as an error does.
        name: of the camera.
        configuration: of the whole system.

    Raises:
        UnusableSetting: it is not.
    """
    known = camera_names(configuration)
    if name not in known:
        raise UnusableSetting(setting, f"there is no camera {name}: name one of {', '.join(known)}")
