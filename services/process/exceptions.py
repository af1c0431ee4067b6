"""The services' failures; each becomes one line for the person who started the command.

ServiceError
├── ConfigurationError       a wrong key, type or value in a configuration file
├── UnusableSetting          a value of it that cannot be used: a certificate, a language
├── CommandFailed            a command ended without what it was started for
│   └── ProcessDied          a process of the pool that was killed or crashed (services.offline.pool)
├── EnvironmentFault         the machine or the network, not what a person wrote; exit code 3
│   ├── RouterUnreachable    no router answers (a BusError too)
│   ├── EndpointInUse        another program listens there (a BusError too)
│   ├── NameTaken            a process of this name is on the network already (a BusError too)
│   ├── PortInUse            another program listens where a page should be served
│   ├── RoomMissing          a role whose packages are not installed
│   ├── DeviceMissing        an input device that is configured, and not there
│   ├── RobotNotAnswering    no robot answers where one is configured (services.robot.backends.backend)
│   ├── FolderUnusable       a folder of the user's that cannot be made or written
│   ├── CannotWrite          a file that cannot be written: a full disk, no rights
│   ├── LimitReached         no more memory, open files or processes, of the machine's or of this user's
│   ├── NotConfirmed         a robot did not confirm its stop, or the stop's release
│   ├── NoAnswer             a process that was asked and did not answer
│   └── KeepsFailing         a process that ends again and again, for a reason that does not go away
├── BusError                 the network cannot be opened or used
│   └── BadEndpoint          no endpoint, or one of a host that nobody knows
├── NotFinite                an array from the wire that holds NaN or infinity (services.bus.arrays)
├── Refusal                  a request that the robot will not carry out (services.robot.refusal)
├── StartImpossible          a place where no motion can start (services.robot.starts)
├── InverseFailed            the inverse kinematics found no step (services.robot.mechanism)
├── JointsInOtherOrder       a robot's joints that are not named from base to gripper (services.robot.mechanism)
├── Unreachable              a pose that the robot does not reach (services.robot.mechanism)
├── NotReady                 an arm that follows no commands now (services.robot.backends.backend)
├── Jump                     a first command that does not begin where the arm is (services.robot.backends.backend)
├── WayBlocked               the arm would touch something on its way to the start (services.robot.homing)
├── Blocked                  something stands where the arm is to be put (services.robot.backends.backend)
├── NoSuchEntry              nothing of that number in a skill's history (services.model.history)
├── SkillError               (services.model.exceptions)
│   ├── NoSuchSkill          a robot has no skill of this name
│   ├── SkillThere           it has one already
│   ├── SkillNameBad         a text that no skill can be called by
│   ├── SkillMisfit          a skill of another task or robot
│   ├── SkillOpen            one that a model process has open (an EnvironmentFault too)
│   ├── ChoiceLost           a file that does not say which one is in use
│   └── ExportUnusable       a file that is no export of a skill, or not as it was written
│       └── NoSkillIn        one that is as it was written, and makes no skill
├── CameraUnusable           a camera's device that is not there (services.camera.exceptions)
├── CalibrationImpossible    pictures that no camera can be calibrated by (services.camera.exceptions)
├── OpeningUnfit             a motion that says too much or too little of the gripper (services.model.skill)
├── NothingPlanned           way-points or a refinement that make no motion (services.model.planning)
├── ViewerError              (services.viewer.exceptions)
│   ├── WebFilesMissing      the Rerun SDK did not give its web viewer's files (an EnvironmentFault too)
│   └── CannotReplay         a recording that cannot be opened
├── CertificateError         (services.certificates.exceptions)
│   ├── NoAuthority          a folder that holds no certificate authority
│   ├── AuthorityThere       one that holds one already
│   ├── CannotIssue          a certificate that is not issued, renewed or revoked
│   ├── Unreadable           a file of the folder that holds something else
│   ├── CertificateMissing   a process without a certificate
│   └── Unsecured            an endpoint that is open to others
├── NoLog                    an evidence log that is not there (services.evidence.exceptions)
├── AccountError             (services.accounts.exceptions)
│   ├── AccountsUnreadable   a file of accounts that holds something else
│   ├── NameUnusable         a text that is no person's name
│   ├── AccountThere         somebody of the name has an account already
│   ├── NoSuchAccount        nobody of the name has one
│   ├── PasswordUnusable     one that is too short or too long, or differs from the one before
│   └── LoginImpossible      a page at which nobody can log in, or nobody has to where others reach it
├── ReproductionError        (services.reproduction.exceptions)
│   ├── UnknownAnalysis      a name that no analysis has
│   ├── CannotKeep           a folder that results cannot be kept in (an EnvironmentFault too)
│   └── NothingToMap         a model that cannot be mapped
├── AnalysisError            (services.study.analysis.exceptions)
│   ├── NothingToAnalyse     observations that hold too little for any analysis
│   ├── UnknownMethod        a hypothesis about a method that nobody used
│   └── BadRenaming          a flag that renames what is not there, or twice
└── StudyError               (services.study.exceptions)
    ├── ProtocolUnfit        a protocol or questionnaire that contradicts itself
    ├── NoStudy              a folder that holds none
    ├── StudyThere           one that holds one already
    ├── DataSetThere         one that holds something, where a data set is to be
    ├── StudyInUse           another console or run has the study open (an EnvironmentFault too)
    ├── StudyFrozen          what was frozen has changed since, and nobody has said why
    ├── NotFrozen            a study that has to be frozen before people take part
    ├── FrozenAlready        one that was frozen before, and has begun
    ├── Mixed                people and simulated participants in one study
    ├── JournalBroken        a journal that is not as it was written, or of another version
    ├── ParticipantUnknown   no participant has this number
    ├── ParticipantThere     one has it already
    ├── AnswerRefused        an answer that is missing, or outside what its question allows
    └── NotNow               something that cannot be done at this point of a session
"""

from __future__ import annotations

from pathlib import Path


class ServiceError(Exception):
    """Base of everything that the services raise for a person to read."""


class ConfigurationError(ServiceError):
    """A configuration file, or another that a person writes, that cannot be used."""

    def __init__(self, path: Path, reason: str, what: str = "configuration") -> None:
        self.path = path
        self.reason = reason
        super().__init__(f"{what} {path}: {reason}")


class UnusableSetting(ServiceError):
    """A value of the configuration that is of the right kind, and cannot be used all the same."""

    def __init__(self, setting: str, reason: str) -> None:
        self.setting = setting
        self.reason = reason
        super().__init__(f"{setting}: {reason}")


class EnvironmentFault(ServiceError):
    """The machine or the network does not give what is needed.

    Attributes:
        passes: whether it may be gone when the command is started again, without anybody doing anything.
    """

    passes = False


class BusError(ServiceError):
    """The network cannot be opened or used."""


class BadEndpoint(BusError):
    """A text that is no endpoint, or one whose host does not exist."""

    def __init__(self, endpoint: str, reason: str, right: str) -> None:
        self.endpoint = endpoint
        self.reason = reason
        self.right = right
        super().__init__(f"{endpoint!r} is no endpoint: {reason}; {right} would be one")


class RouterUnreachable(BusError, EnvironmentFault):
    """No router answered."""

    passes = True

    def __init__(self, endpoint: str, within_s: float, reason: str) -> None:
        self.endpoint = endpoint
        self.reason = reason
        super().__init__(
            f"no router answers at {endpoint} after {within_s:g} s: {reason};"
            " start one there, or give another with --connect"
        )


class EndpointInUse(BusError, EnvironmentFault):
    """Nothing can listen at the endpoint."""

    passes = True

    def __init__(self, endpoint: str) -> None:
        self.endpoint = endpoint
        super().__init__(
            f"cannot listen on {endpoint}: the address is in use or not this machine's;"
            " give another one with --listen, or join the network that is there with --connect"
        )


class NameTaken(BusError, EnvironmentFault):
    """Two processes of one robot may not have the same name."""

    passes = True

    def __init__(self, robot: str, process: str) -> None:
        self.robot = robot
        self.process = process
        super().__init__(
            f"a process {process!r} of robot {robot!r} is on this network already: say who is here with --operator, or"
            " choose another robot's name with --robot"
        )


class PortInUse(EnvironmentFault):
    """Nothing can be served there."""

    passes = True

    def __init__(self, what: str, host: str, port: int, setting: str, reason: str) -> None:
        self.host = host
        self.port = port
        self.setting = setting
        where = "" if setting.startswith("--") else " in the configuration"
        super().__init__(
            f"cannot serve {what} on {host}:{port}: {reason.lower() or 'the address cannot be used'};"
            f" set another one with {setting}{where}"
        )


class RoomMissing(EnvironmentFault):
    """A role was started whose packages are not installed."""

    def __init__(self, role: str, module: str) -> None:
        self.role = role
        self.module = module
        super().__init__(f"the {role} needs the package {module!r}: install retouch[{role}]")


class DeviceMissing(EnvironmentFault):
    """An input device that is configured is not there, or cannot be opened."""

    def __init__(self, device: str, remedy: str) -> None:
        self.device = device
        super().__init__(f"there is no {device} at this computer, or it cannot be opened: {remedy}")


class FolderUnusable(EnvironmentFault):
    """A folder where the user's files belong cannot be made or written."""

    def __init__(self, folder: Path, variable: str, reason: str) -> None:
        self.folder = folder
        self.variable = variable
        self.reason = reason
        super().__init__(f"cannot use the folder {folder}: {reason.lower()}; set {variable} to one that can be written")


class CannotWrite(EnvironmentFault):
    """A file that cannot be read or written, for a reason that lies in the machine."""

    def __init__(self, path: Path | str, reason: str) -> None:
        self.path = path
        self.reason = reason
        super().__init__(f"cannot use {path}: {reason.lower()}; make room or rights there, or name another place")


class LimitReached(EnvironmentFault):
    """The machine, or a limit of this user's, gives no more of something."""

    def __init__(self, what: str, remedy: str) -> None:
        self.what = what
        super().__init__(f"this machine gives no more {what}: {remedy}")


class NotConfirmed(EnvironmentFault):
    """A robot did not confirm its stop, or the stop's release."""

    def __init__(self, what: str, whom: str, within_s: float, reason: str, remedy: str) -> None:
        self.what = what
        self.whom = whom
        self.reason = reason
        super().__init__(f"{whom} did not confirm the {what} in {within_s:g} s: {reason}; {remedy}")


class NoAnswer(EnvironmentFault):
    """A process was asked again and again, and did not answer."""

    passes = True

    def __init__(self, process: str, robot: str, within_s: float, reason: str) -> None:
        self.process = process
        self.robot = robot
        self.reason = reason
        super().__init__(f"the {process} of robot {robot!r} did not answer in {within_s:g} s: {reason}")


class KeepsFailing(EnvironmentFault):
    """A process was started again and again, and ended each time."""

    def __init__(self, process: str, times: int, reason: str) -> None:
        self.process = process
        self.times = times
        self.reason = reason
        super().__init__(f"{process} ended {times} times in a row: {reason}; the whole log is in the run's folder")


class CommandFailed(ServiceError):
    """A command ended without what it was started for."""
