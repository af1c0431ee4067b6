"""The small parts that the page is made of. An element is sent to the browser only where something changed."""

from __future__ import annotations

from nicegui import ui
from nicegui.element import Element


def block(classes: str, tag: str = "div") -> Element:
    """A plain HTML element."""
    return ui.element(tag).classes(classes)


def text(content: str, classes: str) -> ui.label:
    """A line of text."""
    return ui.label(content).classes(classes)


def icon(name: str, classes: str = "") -> None:
    """A symbol out of assets/symbols.svg, in the colour of the text around it."""
    # The names are this package's own constants, so there is nothing to sanitize.
    ui.html(
        f'<svg viewBox="0 0 24 24" aria-hidden="true"><use href="/assets/symbols.svg#{name}"/></svg>', sanitize=False
    ).classes(f"icon icon-{name} {classes}")


def mark(element: Element, name: str, value: str) -> None:
    """Set an attribute by which the style sheet tells how the element looks."""
    if element.props.get(name) != value:
        element.props[name] = value


def enable(button: Element, enabled: bool) -> None:
    """Let the button be pressed, or not."""
    if enabled == ("disabled" in button.props):
        button.props.set_bool("disabled", not enabled)


class Chip:
    """A figure in the header: what it is, and how much.

    Args:
        name: of the figure; a test finds it by this.
        title: what a person reads.
    """

    def __init__(self, name: str, title: str) -> None:
        with block("chip").props(f"data-chip={name}") as self._box:
            text(title, "chip-title")
            self._value = text("none", "chip-value")
        mark(self._box, "data-tone", "none")

    def show(self, value: str, tone: str = "none") -> None:
        """Show a value, in the colour of its tone: good, bad, warn or none."""
        self._value.set_text(value)
        mark(self._box, "data-tone", tone)
