"""A page that nobody watches: what of a station's page most tests do not look at."""

from protocol.messages import Attendance


class QuietPage:
    """Shows nothing and lists nobody; see `Frontend`. Who takes it says what is held and pressed."""

    jpeg_only = False

    def attendance(self):
        return Attendance(holder="")

    def show(self, view):
        pass

    def figures(self):
        return ()

    def close(self):
        pass
