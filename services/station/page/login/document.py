"""The log-in as the browser loads it: one form, without a script."""

from __future__ import annotations

from html import escape
from pathlib import Path
from string import Template

from services.station.page.asset_files import ICON_ADDRESS, LOGIN_STYLE_ADDRESS, SYMBOLS_ADDRESS
from services.station.page.login.form import LONGEST_NAME
from services.station.words.table import say, speech

_HTML = Template((Path(__file__).parent / "form.html").read_text(encoding="utf-8"))

_FOCUS = ("focus_name", "focus_password")


def document(robot: str, address: str, name: str, notice: str) -> str:
    """The HTML, in the language that the process speaks.

    Args:
        robot: its name.
        address: that the form is sent to.
        name: that stands in it already.
        notice: one line about what happened last; empty where nothing did.
    """
    made = {
        "language": speech.language,
        "title": say("log_in.title", robot=robot),
        "heading": say("log_in.heading"),
        "product": say("document.name"),
        "robot": robot,
        "icon": ICON_ADDRESS,
        "symbols": SYMBOLS_ADDRESS,
        "style": LOGIN_STYLE_ADDRESS,
        "address": address,
        "name_label": say("log_in.name"),
        "password_label": say("log_in.password"),
        "enter": say("log_in.enter"),
        "longest": str(LONGEST_NAME),
        "name": name,
        "notice": notice,
    }
    first = "focus_password" if name else "focus_name"
    filled = {key: escape(value) for key, value in made.items()}
    return _HTML.substitute(filled, **{focus: "autofocus" if focus == first else "" for focus in _FOCUS})
