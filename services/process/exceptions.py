"""The services' failures; each becomes one line for the person who started the command.

ServiceError
├── ConfigurationError   a wrong key, type or value in a configuration file
├── WaypointFileError    waypoints in a file that make no motion
├── BusError             the network cannot be opened or used
│   ├── EndpointInUse    another program listens there
│   └── NameTaken        a process of this name is on the network already
├── PortInUse            another program listens where a page should be served
├── RoomMissing          a role whose packages are not installed
├── FolderUnusable       a folder of the user's that cannot be made or written
└── CommandFailed        a command ended without what it was started for
"""

from pathlib import Path


class ServiceError(Exception):
    """Base of everything that the services raise for a person to read."""


class ConfigurationError(ServiceError):
    """A configuration file that cannot be used."""

    def __init__(self, path: Path, reason: str) -> None:
        self.path = path
        self.reason = reason
        super().__init__(f"configuration {path}: {reason}")


class WaypointFileError(ServiceError):
    """A file of waypoints that cannot be used."""

    def __init__(self, path: Path, reason: str) -> None:
        self.path = path
        self.reason = reason
        super().__init__(f"waypoints {path}: {reason}")


class BusError(ServiceError):
    """The network cannot be opened or used."""


class EndpointInUse(BusError):
    """Nothing can listen at the endpoint."""

    def __init__(self, endpoint: str) -> None:
        self.endpoint = endpoint
        super().__init__(
            f"cannot listen on {endpoint}: the address is in use or not this machine's;"
            " give another one with --listen, or join the network that is there with --connect"
        )


class NameTaken(BusError):
    """Two processes of one robot may not have the same name."""

    def __init__(self, robot: str, process: str) -> None:
        self.robot = robot
        self.process = process
        super().__init__(
            f"a process {process!r} of robot {robot!r} is on this network already: choose another name with --robot"
        )


class PortInUse(ServiceError):
    """Nothing can be served there."""

    def __init__(self, what: str, host: str, port: int, setting: str, reason: str) -> None:
        self.host = host
        self.port = port
        self.setting = setting
        super().__init__(
            f"cannot serve {what} on {host}:{port}: {reason.lower() or 'the address cannot be used'};"
            f" set another one with {setting} in the configuration"
        )


class RoomMissing(ServiceError):
    """A role was started whose packages are not installed."""

    def __init__(self, role: str, module: str) -> None:
        self.role = role
        self.module = module
        super().__init__(f"the {role} needs the package {module!r}: install retouch[{role}]")


class FolderUnusable(ServiceError):
    """A folder where the user's files belong cannot be made or written."""

    def __init__(self, folder: Path, variable: str, reason: str) -> None:
        self.folder = folder
        self.variable = variable
        self.reason = reason
        super().__init__(f"cannot use the folder {folder}: {reason.lower()}; set {variable} to one that can be written")


class CommandFailed(ServiceError):
    """A command ended without what it was started for."""
