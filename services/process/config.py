"""Configuration: TOML into frozen structs; what nobody set has a default that works on one machine."""

from __future__ import annotations

from pathlib import Path
from typing import Annotated

import msgspec

from protocol.messages import Coding, Method
from protocol.queries import Adapt
from services.process import endpoint
from services.process.backend import BackendSection
from services.process.cameras import MOST_CAMERAS, CameraName, CameraSource
from services.process.exceptions import BadEndpoint, ConfigurationError
from services.process.files import write_whole
from services.process.master_devices import MasterDevice, Page
from services.process.processes import NOBODY_IN_PARTICULAR
from services.process.section import Positive, Section
from services.process.written import read

Port = Annotated[int, msgspec.Meta(ge=1, le=65535)]

LONGEST_SILENCE_S = 0.25
"""After this long without the operator or the master no file can let a robot move on [s]."""

LONGEST_LEASE_S = 3.0
"""No file can let the authority last longer than this without renewal [s]."""

Silence = Annotated[float, msgspec.Meta(gt=0.0, le=LONGEST_SILENCE_S)]


ROBOT_SUFFIX = ".toml"
"""Of a robot file: what ends so is no robot's name; of a task file just so."""


class RobotSection(Section, frozen=True):
    """The robot process.

    Attributes:
        scene: which simulated scene it stands in: the name of one that ships, or the path of a task file.
        model: which robot stands in it: the name of one that ships, or the path of a robot file; empty for the one that
            the scene was made for.
        variant: the scene's arrangement to start in; empty for the one that the model was trained in.
        hold_after_s: age of the master's newest sample at which a refinement holds, at most `LONGEST_SILENCE_S` [s].
        presence_after_s: age of the authority's newest renewal at which every motion holds, at most the same [s].
        lease_s: how long the authority lasts without renewal, at most `LONGEST_LEASE_S` [s].
        velocity_scale: share of the joints' velocity limits that the robot may use.
        self_distance_stop: distance between its own parts at which it stops [m].
        master_gain: of the master's displacement on the reference; its rotation counts as it is.
        backend: what moves it.
    """

    scene: str = "dishwasher"
    model: str = ""
    variant: str = ""
    hold_after_s: Silence = 0.1
    presence_after_s: Silence = 0.2
    lease_s: Annotated[float, msgspec.Meta(gt=0.0, le=LONGEST_LEASE_S)] = 1.0
    velocity_scale: Annotated[float, msgspec.Meta(gt=0.0, le=1.0)] = 0.5
    self_distance_stop: Annotated[float, msgspec.Meta(ge=0.0)] = 0.005
    master_gain: Annotated[float, msgspec.Meta(gt=0.0, le=10.0)] = 1.0
    backend: BackendSection = BackendSection()

    @property
    def model_file(self) -> Path | None:
        """The robot file that is meant; None where the robot is meant by its name."""
        return _path(self.model)

    @property
    def task_file(self) -> Path | None:
        """The task file that is meant; None where the scene is meant by its name."""
        return _path(self.scene)


def _path(text: str) -> Path | None:
    return Path(text) if "/" in text or text.endswith(ROBOT_SUFFIX) else None


class CameraSection(Section, frozen=True):
    """The camera process: pictures a second, their size [pixel] and quality, as of JPEG, and how they are coded.

    Attributes:
        cameras: beside the robot's own, or in the place of one of the same name.
        cloud: the camera whose depth is sent as a point cloud.
    """

    rate_hz: Positive = 15.0
    width: Annotated[int, msgspec.Meta(ge=64, le=1920)] = 320
    height: Annotated[int, msgspec.Meta(ge=48, le=1080)] = 240
    quality: Annotated[int, msgspec.Meta(ge=10, le=100)] = 80
    codec: Coding = Coding.JPEG
    cameras: Annotated[tuple[CameraSource, ...], msgspec.Meta(max_length=MOST_CAMERAS)] = ()
    cloud: CameraName = "head"

    def __post_init__(self) -> None:
        """Judge the names; raises ValueError, which the reader of a file turns into its line."""
        names = [camera.name for camera in self.cameras]
        twice = next((name for name in names if names.count(name) > 1), None)
        if twice is not None:
            raise ValueError(f"two of [[camera.cameras]] are called {twice}: give each a name of its own")


class PerceptionSection(Section, frozen=True):
    """The perception process: by which camera it sees, and over how many pictures the pose is filtered."""

    camera: CameraName = "head"
    window: Annotated[int, msgspec.Meta(ge=1, le=100)] = 9


class MasterSection(Section, frozen=True):
    """The master process: which device it owns; by default whichever is used in the page."""

    device: MasterDevice = msgspec.field(default_factory=Page)


class ModelSection(Section, frozen=True):
    """The model process.

    Attributes:
        kind: "adaptive", or "promp" for the thesis' own model.
        database: file of a skill, other skills beside it; empty for the robot's own in the user's data folder.
        skill: which one is in use to begin with, by its name; empty for the one that was last, or the task's own.
        run: of `retouch up`: a process that comes back in it goes on with the skill that was chosen since.
    """

    kind: Annotated[str, msgspec.Meta(pattern="^(adaptive|promp)$")] = "adaptive"
    database: str = ""
    skill: str = ""
    run: str = ""


class StationSection(Section, frozen=True):
    """The station process.

    Attributes:
        host: address that the page listens on.
        port: of the page.
        certificate: file of the page's TLS certificate, PEM, with those that vouch for it; empty for plain HTTP, and
            where others reach the page for one of this machine's certificates.
        key: file of the certificate's private key, PEM; empty where it stands in the certificate's file.
        login: when the page asks who is there: "auto" where others than this machine reach it, "always", or "never".
        language: in which the page speaks: the name of one of its tables of words.
        framed_by: origin of the one page that may show this one in a frame, "http://127.0.0.1:8090"; empty for none.
        refinements_allowed: attempts at one update.
        updates_allowed: updates of one run.
        autonomous_s: duration of an autonomous execution [s].
        refine_s: duration of an execution under correction [s].
        variant: arrangement of the scene that is taught; empty for the one that has been changed.
        place: of the target, the same in every episode: of an object's centre, base frame [m], or as many numbers as
            the scene has; empty for places drawn at random.
        method: the only one by which is taught, "refine", "waypoints" or "demonstrate"; empty where the operator
            chooses.
        basis: the only one that corrections start from, "model", or "refinement" for what the previous one came to;
            empty where the operator chooses.
        fixed: the operator changes neither a motion's pace nor the part of it that counts nor the confidence, and takes
            nothing back that was learnt; stopping and letting it go on is theirs always.
        adapt: which way-point a correction moves: "next" (eq. 15-17), or "current" (eq. B.7) for comparison.
        alpha: how far the model believes a refinement (eq. 18), from 0 to 1; 1 is all the way.
        demonstration_points: that a motion led by hand is learnt with.
        demonstration_tempo: it is learnt in the tempo in which it was led; else evenly along its way, so that where it
            lingered makes it jump nowhere.
        scripted: the workflow's buttons are pressed by a script; there is no page.
        untaught: a script shows an empty skill its first motion; else it waits for whoever does.
        once: finish when the loop has closed, instead of going on with another object position.
        executions: a script executes so often, each time at another place, and teaches nothing; 0 where it teaches.
    """

    host: str = "127.0.0.1"
    port: Port = 8080
    certificate: str = ""
    key: str = ""
    login: Annotated[str, msgspec.Meta(pattern="^(auto|always|never)$")] = "auto"
    language: str = "en"
    framed_by: Annotated[str, msgspec.Meta(pattern=r"^(https?://[A-Za-z0-9.:\[\]-]+)?$")] = ""
    refinements_allowed: Annotated[int, msgspec.Meta(ge=1)] = 10
    updates_allowed: Annotated[int, msgspec.Meta(ge=1)] = 8
    autonomous_s: Positive = 10.0
    refine_s: Positive = 20.0
    variant: str = ""
    place: tuple[float, ...] = ()
    method: Method = Method.UNKNOWN
    basis: Annotated[str, msgspec.Meta(pattern="^(model|refinement)?$")] = ""
    fixed: bool = False
    adapt: Adapt = Adapt.NEXT
    alpha: Annotated[float, msgspec.Meta(ge=0.0, le=1.0)] = 1.0
    demonstration_points: Annotated[int, msgspec.Meta(ge=75, le=500)] = 75
    demonstration_tempo: bool = False
    scripted: bool = False
    untaught: bool = False
    once: bool = False
    executions: Annotated[int, msgspec.Meta(ge=0, le=10_000)] = 0

    @property
    def scheme(self) -> str:
        """Under which the page is served."""
        return "https" if self.certificate else "http"


FOLDER_SETTING = "[viewer] folder"
"""Where the folders of runs are to be, as an error names it."""


class ViewerSection(Section, frozen=True):
    """The viewer process: where it serves its page, and the folder for recordings."""

    host: str = "127.0.0.1"
    web_port: Port = 9090
    stream_port: Port = 9876
    folder: str = "runs"


class SiteSection(Section, frozen=True):
    """A robot's site, as `deploy/site` starts it: robot, camera, perception, model.

    Attributes:
        listen: where desks reach its router; empty where it joins another one instead of having one.
        join: another router that its own joins, one that both sides can dial, say; empty for none.
    """

    listen: str = "tls/0.0.0.0:7447"
    join: str = ""


class DeskSection(Section, frozen=True):
    """An operator's desk, as `deploy/desk` starts it: master, viewer, station.

    Attributes:
        connect: where the site's router is reached, or the one that both sides dial.
        router: it has a router of its own, so that nothing crosses a thin link twice.
    """

    connect: str = ""
    router: bool = False


class Configuration(Section, frozen=True):
    """Everything that can be set.

    Attributes:
        name: the robot's name, the first chunk of all its keys.
        operator: who is at this station; stands in everything that a hand or a press causes.
        connect: the router's Zenoh endpoint.
        listen: where `retouch up` and `retouch router` listen.
        tls: the folder of this machine's certificates; empty for the one in the user's folder of settings.
        insecure: endpoints without certificates may be open to others, who then can listen in and command.
        seed: of everything random.
    """

    name: str = "robot1"
    operator: str = NOBODY_IN_PARTICULAR
    connect: str = "tcp/127.0.0.1:7447"
    listen: str = "tcp/127.0.0.1:7447"
    tls: str = ""
    insecure: bool = False
    seed: Annotated[int, msgspec.Meta(ge=0)] = 0
    site: SiteSection = SiteSection()
    desk: DeskSection = DeskSection()
    robot: RobotSection = RobotSection()
    camera: CameraSection = CameraSection()
    perception: PerceptionSection = PerceptionSection()
    master: MasterSection = MasterSection()
    model: ModelSection = ModelSection()
    station: StationSection = StationSection()
    viewer: ViewerSection = ViewerSection()

    def __post_init__(self) -> None:
        """Judge the endpoints before anybody waits for them; raises BadEndpoint."""
        for text in (self.connect, self.listen, self.site.listen, self.site.join, self.desk.connect):
            if text:
                endpoint.parse(text)


def load(path: Path) -> Configuration:
    """Read a configuration file: TOML, or JSON where its name ends so.

    Raises:
        ConfigurationError: it is not there, cannot be parsed, or has a wrong key, type or value; says which.
    """
    try:
        return read(path, Configuration, "configuration")
    except BadEndpoint as error:
        raise ConfigurationError(path, str(error)) from None


def save(configuration: Configuration, path: Path) -> None:
    """Write the configuration as JSON, as `load` reads it.

    Raises:
        OSError: it cannot be written.
    """
    write_whole(path, msgspec.json.format(msgspec.json.encode(configuration)))
