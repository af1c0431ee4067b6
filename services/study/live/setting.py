"""What a part of a session is run with: the configuration of the robot's and the operator's processes."""

from __future__ import annotations

from dataclasses import dataclass
from pathlib import Path

from protocol.messages import Method as Way
from protocol.messages import Origin
from services.offline.people.ways import Device, Teaching
from services.offline.result import Arrangement
from services.process.config import (
    Configuration,
    MasterSection,
    ModelSection,
    RobotSection,
    StationSection,
    ViewerSection,
)
from services.process.master_devices import Gamepad, Keyboard, MasterDevice, Page, Phantom, Pointer, Scripted
from services.station.words.table import ENGLISH, languages
from services.study.protocol.protocol import Method, Protocol
from services.study.session.course import Adapt, Train

ROBOT = "study"
"""Its name on the network."""

_WAYS = {
    Teaching.PREDICTION: (Way.REFINE, Origin.MODEL.value),
    Teaching.REFINEMENT: (Way.REFINE, Origin.REFINEMENT.value),
    Teaching.WAYPOINTS: (Way.WAYPOINTS, ""),
    Teaching.DEMONSTRATION: (Way.DEMONSTRATE, ""),
}
"""The station's method, and what its refinements start from."""


@dataclass(frozen=True)
class Ports:
    """Where a part's processes listen, on loopback.

    Attributes:
        router: of the network.
        station: of the operator's page.
        web: of the viewer's page.
        stream: of its live stream.
    """

    router: int
    station: int
    web: int
    stream: int


@dataclass(frozen=True)
class Run:
    """A part of somebody's session.

    Attributes:
        part: which.
        operator: who takes part, by their code.
        language: of their page.
        folder: of what is recorded, absolute.
        database: of the model, absolute.
    """

    part: Train | Adapt
    operator: str
    language: str
    folder: Path
    database: Path


@dataclass(frozen=True)
class Setting:
    """What is the same in every part of a study.

    Attributes:
        protocol: of the study.
        arrangement: that the robot finds.
        framed_by: origin of the study's page.
        rehearsal: nobody takes part: a simulated hand holds the stylus.
    """

    protocol: Protocol
    arrangement: Arrangement
    framed_by: str
    rehearsal: bool = False

    def configuration(self, run: Run, ports: Ports) -> Configuration:
        """Of one part."""
        task, rule = self.protocol.task, self.protocol.training
        method = self.protocol.method(run.part.method)
        way, basis = _WAYS[method.teaching]
        practises = isinstance(run.part, Train)
        endpoint = f"tcp/127.0.0.1:{ports.router}"
        return Configuration(
            name=ROBOT,
            operator=run.operator,
            connect=endpoint,
            listen=endpoint,
            seed=self.protocol.order.seed,
            robot=RobotSection(scene=task.scene),
            master=MasterSection(device=self.device(method)),
            model=ModelSection(database=str(run.database)),
            station=StationSection(
                port=ports.station,
                language=run.language if run.language in languages() else ENGLISH,
                framed_by=self.framed_by,
                # In a training nothing is kept of what is learnt: its attempts are limited by the study alone.
                refinements_allowed=rule.attempts if practises else task.refinements,
                updates_allowed=rule.attempts if practises else task.updates,
                variant=self.arrangement.variant,
                place=tuple(self.arrangement.place.tolist()),
                method=way,
                basis=basis,
                fixed=True,
            ),
            viewer=ViewerSection(web_port=ports.web, stream_port=ports.stream, folder=str(run.folder)),
        )

    def device(self, method: Method) -> MasterDevice:
        """By which a method's operator leads, and nothing else; a 3-D mouse is read by the page as a gamepad is."""
        match method.device:
            case Device.STYLUS:
                return Scripted() if self.rehearsal else Phantom()
            case Device.KEYBOARD:
                return Keyboard()
            case Device.GAMEPAD:
                return Gamepad()
            case Device.POINTER:
                return Pointer()
            case Device.SPACE_MOUSE:
                return Page()
