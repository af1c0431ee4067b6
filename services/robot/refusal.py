"""A request that the robot understood and will not carry out."""

from services.process.exceptions import ServiceError


class Refusal(ServiceError):
    """Why not, in one line for whoever asked.

    Args:
        reason: of it.
        lasting: asking again does not help; what was asked for has to be another.
    """

    def __init__(self, reason: str, *, lasting: bool = False) -> None:
        self.reason = reason
        self.lasting = lasting
        super().__init__(reason)
