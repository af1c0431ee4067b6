"""A request that the robot understood and will not carry out."""

from services.process.exceptions import ServiceError


class Refusal(ServiceError):
    """Why not, in one line for whoever asked."""

    def __init__(self, reason: str) -> None:
        self.reason = reason
        super().__init__(reason)
