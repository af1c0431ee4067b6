"""Where questionnaires are found: in a study's folder, or among those that come with Retouch."""

from __future__ import annotations

from collections.abc import Sequence
from pathlib import Path

import msgspec

from services.process.suggestion import right
from services.process.written import read
from services.study.exceptions import ProtocolUnfit
from services.study.instruments import SHIPPED
from services.study.instruments.contradictions import contradictions
from services.study.instruments.instrument import Instrument
from services.study.instruments.questions import Choice, Option
from services.study.protocol.protocol import Method, Protocol

FOLDER = "instruments"
"""Of a study's own questionnaires, in its folder."""


def load(folder: Path | None, name: str, languages: Sequence[str] = (), methods: Sequence[Method] = ()) -> Instrument:
    """A questionnaire that agrees with itself: the study's own of that name, or else the one that comes with Retouch.

    Args:
        folder: of the study; None for none.
        name: of the questionnaire.
        languages: that it has to speak.
        methods: of the protocol, for questions among them.

    Raises:
        ConfigurationError: it cannot be read, or has a wrong key, type or value.
        ProtocolUnfit: there is none of that name, or two of its parts contradict each other.
    """
    path = file(folder, name)
    instrument = read(path, Instrument, "questionnaire")
    for place, reason in contradictions(instrument, path.stem, languages, among=bool(methods)):
        raise ProtocolUnfit(path, place, reason)
    return _among(instrument, methods)


def file(folder: Path | None, name: str) -> Path:
    """Where a questionnaire is: the study's own of that name, or else the one that comes with Retouch.

    Raises:
        ProtocolUnfit: there is none.
    """
    own = folder / FOLDER / f"{name}.toml" if folder is not None else None
    path = own if own is not None and own.exists() else SHIPPED.get(name)
    if path is None:
        where = own if own is not None else Path(f"{name}.toml")
        raise ProtocolUnfit(where, "instruments", f"there is no such file; {right(name, list(SHIPPED))}")
    return path


def of_protocol(protocol: Protocol, folder: Path | None) -> dict[str, Instrument]:
    """All questionnaires that a protocol names.

    Args:
        protocol: of the study.
        folder: of the study.

    Raises:
        ConfigurationError: one cannot be read, or has a wrong key, type or value.
        ProtocolUnfit: one is not there, or contradicts itself or the protocol.
    """
    asked = protocol.instruments
    names = dict.fromkeys((*asked.before, *asked.after_method, *asked.after))
    return {name: load(folder, name, protocol.languages, protocol.methods) for name in names}


def _among(instrument: Instrument, methods: Sequence[Method]) -> Instrument:
    """With the protocol's methods as options, where a question is among them."""
    options = tuple(Option(method.name, {tag: _label(method, tag) for tag in instrument.title}) for method in methods)
    questions = tuple(
        msgspec.structs.replace(question, options=options)
        if isinstance(question, Choice) and question.among
        else question
        for question in instrument.questions
    )
    return msgspec.structs.replace(instrument, questions=questions)


def _label(method: Method, language: str) -> str:
    about = method.about.get(language, "")
    return f"{method.name}: {about}" if about else method.name
