"""The page's regions that tell: header, traffic light, counters, verdict, cameras, live view."""

from __future__ import annotations

from nicegui import ui
from nicegui.element import Element

from protocol.messages import Recording
from services.station.page.elements import Chip, block, icon, mark, text
from services.station.page.readout import (
    LIGHT_WORDS,
    criteria,
    is_stale,
    length,
    outcome,
    span,
    tone,
    viewer_address,
)
from services.station.page.view import Shown


class Header:
    """Name, figures, and who has the authority.

    Args:
        robot: its name.
    """

    def __init__(self, robot: str) -> None:
        with block("header", "header"):
            icon("retouch", "brand")
            text("Retouch", "brand-name")
            text(robot, "robot-name")
            block("spring")
            self._phase = Chip("phase", "Robot")
            self._age = Chip("age", "Data age")
            self._latency = Chip("latency", "Hand to robot")
            self._object = Chip("object", "Object error")
            self._model = Chip("model", "Model")
            self._authority = Chip("authority", "Authority")

    def update(self, shown: Shown) -> None:
        """Show the view's figures."""
        view, robot = shown.view, shown.view.robot
        self._age.show(span(shown.robot_age_s), "bad" if is_stale(shown) else "good")
        self._phase.show("unknown" if robot is None else robot.phase.value)
        self._latency.show(" / ".join(span(figure.value) for figure in view.latencies) or "none")
        self._object.show("not seen" if view.object_pose is None else length(view.object_pose.error))
        model = view.model
        self._model.show("none" if model is None else f"v{model.version}, {model.updates} learnt")
        holder = view.authority.holder if view.authority is not None else ""
        if view.authority_is_mine:
            self._authority.show("yours", "good")
        else:
            self._authority.show(holder or "nobody", "warn")


class TrafficLight:
    """May the operator act? Said by colour, shape and word; below it what to do."""

    def __init__(self) -> None:
        with block("panel light") as self._box:
            with block("lamps"):
                icon("red", "lamp")
                icon("amber", "lamp")
                icon("green", "lamp")
            with block("light-words"):
                self._word = text("", "light-word")
                self._text = text("", "light-text")
                self._notice = text("", "notice")

    def update(self, shown: Shown) -> None:
        """Follow the teaching state."""
        teaching = shown.view.teaching
        mark(self._box, "data-light", "off" if teaching is None else teaching.light.value)
        self._word.set_text("Starting" if teaching is None else LIGHT_WORDS[teaching.light])
        waiting = "Waiting for the teaching workflow."
        self._text.set_text(waiting if teaching is None else teaching.text or teaching.reason)
        self._notice.set_text(shown.view.notice)


class Counters:
    """How many refinements and updates are used."""

    def __init__(self) -> None:
        with block("panel counters"):
            self._refinements = _Counter("Refinements", "refinements")
            self._updates = _Counter("Updates", "updates")

    def update(self, shown: Shown) -> None:
        """Follow the teaching state."""
        teaching = shown.view.teaching
        if teaching is not None:
            self._refinements.show(teaching.refinements, teaching.refinements_allowed)
            self._updates.show(teaching.updates, teaching.updates_allowed)


class _Counter:
    def __init__(self, title: str, name: str) -> None:
        with block("counter").props(f"data-counter={name}"):
            text(title, "counter-title")
            self._value = text("none", "counter-value")
            self._bar = block("counter-bar")

    def show(self, used: int, allowed: int) -> None:
        self._value.set_text(f"{used} / {allowed}")
        self._bar.style(f"--used: {used}; --allowed: {max(allowed, 1)}")


class VerdictPanel:
    """The success criteria, each with a check or a cross and its evidence."""

    _TITLES = ("Target reached", "Not kicked over", "No collision")

    def __init__(self) -> None:
        with block("panel verdict") as self._box:
            self._outcome = text("", "outcome")
            self._rows = [self._row(title) for title in self._TITLES]

    @staticmethod
    def _row(title: str) -> tuple[Element, ui.label]:
        with block("criterion") as row:
            for symbol in ("check", "cross", "dash"):
                icon(symbol)
            text(title, "criterion-title")
            evidence = text("", "criterion-evidence")
        return row, evidence

    def update(self, shown: Shown) -> None:
        """Show the verdict as it is now."""
        good, word = outcome(shown)
        mark(self._box, "data-tone", tone(good))
        self._outcome.set_text(word)
        for (row, evidence), (met, reason) in zip(self._rows, criteria(shown), strict=True):
            mark(row, "data-tone", tone(met))
            evidence.set_text(reason)


def cameras() -> None:
    """Head above wrist; the page's script draws the pictures and writes their age."""
    with block("cameras"):
        for camera, title in (("head", "Head camera"), ("wrist", "Wrist camera")):
            with block("panel camera").props(f"data-camera={camera} data-state=waiting"):
                block("picture", "canvas")
                text("No picture yet", "camera-empty")
                with block("caption"):
                    text(title, "caption-title")
                    text("", "camera-age")


class Scene:
    """The viewer's live view, or why there is none.

    Args:
        page_host: the name under which the browser opened the page.
    """

    def __init__(self, page_host: str) -> None:
        self._page_host = page_host
        self._loaded = ("", "")
        with block("panel scene") as self._box:
            self._frame = block("frame")
            with block("scene-empty"):
                icon("view")
                text("No live view", "scene-empty-title")
                text("The viewer process is not there yet; the page needs none to be used.", "scene-empty-text")
            self._stale = text("", "scene-stale")
            with block("legend"):
                text("prediction", "legend-predicted")
                text("refinement", "legend-refined")

    def update(self, shown: Shown) -> None:
        """Load the live view, anew where it is another recording, and say where its data is old."""
        self._load(shown.view.recording)
        stale = is_stale(shown)
        mark(self._box, "data-stale", "yes" if stale else "no")
        if stale:
            self._stale.set_text(f"Robot data {_age(shown)}")

    def _load(self, recording: Recording | None) -> None:
        url = viewer_address(recording.viewer_url, self._page_host) if recording is not None else ""
        wanted = (url, recording.recording_id if recording is not None and url else "")
        mark(self._box, "data-view", "live" if url else "none")
        if wanted == self._loaded:
            return
        self._loaded = wanted
        self._frame.clear()
        if url:
            with self._frame:
                frame = ui.element("iframe").classes("viewer")
                frame.props["src"] = url
                frame.props["title"] = "Live view"
                frame.props["data-recording"] = wanted[1]


def _age(shown: Shown) -> str:
    return "has not come yet" if shown.view.robot is None else f"is {span(shown.robot_age_s)} old"
