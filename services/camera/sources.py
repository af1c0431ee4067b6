"""All cameras of a robot, simulated and real, as they are configured."""

from __future__ import annotations

from collections.abc import Mapping

from protocol.messages import Pose
from protocol.topics import ROBOT_STATE
from services.bus.bus import Bus
from services.camera.calibrated import Calibrated, calibrated
from services.camera.device import DeviceCamera
from services.camera.places import Carried, Mounting, Place, Standing, mounting
from services.camera.seen import Source
from services.camera.simulated import DrawnWorld, SimulatedCamera
from services.process.cameras import Simulated
from services.process.clock import Clock
from services.process.config import Configuration
from services.process.robots import camera_names, scene_of
from sim.tasks import described
from sim.world.links import Links


class Sources:
    """Opens them, and closes them at the end.

    Args:
        bus: to the robot.
        clock: for the times at which pictures come.
        configuration: of the whole system.

    Attributes:
        cameras: by name, in their order.

    Raises:
        DrawingLibraryMissing: a camera is simulated, and nothing on this machine can draw without a display.
        DescriptionMissing: the robot's meshes are not installed.
        UnknownScene: the configuration names a scene that is not there.
        CameraUnfit: a camera is fixed to a link that is not there.
        ConfigurationError: what was measured of a camera cannot be used.
    """

    def __init__(self, bus: Bus, clock: Clock, configuration: Configuration) -> None:
        self._bus, self._clock, self._configuration = bus, clock, configuration
        section = configuration.camera
        names = camera_names(configuration)
        real = {one.name: one for one in section.cameras if not isinstance(one, Simulated)}
        known = {name: calibrated(configuration.name, name) for name in names}
        places = self._places({name: known[name].mounting or mounting(one) for name, one in real.items()})
        self._drawn = DrawnWorld(bus, configuration.robot, section) if set(names) - set(real) else None
        drawn = self._simulated({name: known[name] for name in names if name not in real})
        size = section.width, section.height
        self._devices = {
            name: DeviceCamera(one, places[name], clock, size=size, optics=known[name].optics)
            for name, one in real.items()
        }
        self.cameras: Mapping[str, Source] = {name: self._devices.get(name) or drawn[name] for name in names}

    @property
    def unusable(self) -> int:
        """States of the simulated world that could not be drawn so far."""
        return self._drawn.unusable if self._drawn is not None else 0

    def close(self) -> None:
        """Give devices and the drawing library's resources back."""
        for device in self._devices.values():
            device.close()
        if self._drawn is not None:
            self._drawn.close()

    def _simulated(self, known: Mapping[str, Calibrated]) -> dict[str, Source]:
        cameras: dict[str, Source] = {}
        if self._drawn is not None:
            for name, one in known.items():
                if one.mounting is not None:
                    self._drawn.check(name, one.mounting)
                cameras[name] = SimulatedCamera(self._drawn, name, one)
        return cameras

    def _places(self, fixed: Mapping[str, Mounting]) -> dict[str, Place]:
        places: dict[str, Place] = {
            name: Standing(Pose(one.position, one.orientation)) for name, one in fixed.items() if not one.link
        }
        carried = {name: one for name, one in fixed.items() if one.link}
        if carried:
            scene = scene_of(self._configuration.robot)
            links, robot = Links(scene, described(scene)), self._bus.subscribe(ROBOT_STATE)
            for name, one in carried.items():
                links.check(name, one.link)
                places[name] = Carried(one, links, robot)
        return places
