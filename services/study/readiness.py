"""Whether a study can be run as its files say, asked before anybody takes part."""

from __future__ import annotations

from collections.abc import Iterator
from typing import NamedTuple

from services.offline.result import Arrangement
from services.study.arrangement import arrangement
from services.study.exceptions import ProtocolUnfit
from services.study.instruments.instrument import Instrument
from services.study.instruments.library import of_protocol
from services.study.protocol.protocol import FILE, Protocol
from services.study.records import SCORES
from services.study.study import Study
from sim.tasks import AnyScene
from sim.tasks import scene as scene_named


class Ready(NamedTuple):
    """What a study that can be run is run with.

    Attributes:
        instruments: questionnaires that its protocol names.
        scene: of its task.
        arrangement: that the robot finds there.
    """

    instruments: dict[str, Instrument]
    scene: AnyScene
    arrangement: Arrangement


def ready(study: Study) -> Ready:
    """Let pass what can be run.

    Raises:
        ConfigurationError: a questionnaire cannot be read, or has a wrong key, type or value.
        ProtocolUnfit: one is not there, or contradicts itself or the protocol, or none measures what is compared.
        SimError: there is no such scene, variant of it, or target in it.
    """
    instruments = of_protocol(study.protocol, study.folder)
    for place, reason in _unmeasured(study.protocol, instruments):
        raise ProtocolUnfit(study.folder / FILE, place, reason)
    scene = scene_named(study.protocol.task.scene)
    return Ready(instruments, scene, arrangement(study.protocol, scene))


def _unmeasured(protocol: Protocol, instruments: dict[str, Instrument]) -> Iterator[tuple[str, str]]:
    """Hypotheses about what no questionnaire asks after each method, and what is wrong with them."""
    asked = protocol.instruments.after_method
    known = {score.name for name in asked for score in instruments[name].scores}
    for one in protocol.analysis.hypotheses:
        if one.measure.rated and SCORES[one.measure] not in known:
            reason = (
                f"no questionnaire of [instruments] after_method ({', '.join(asked) or 'there is none'}) gives"
                f" {one.measure.value}, its score {SCORES[one.measure]}"
            )
            yield f"[[analysis.hypotheses]] {one.name}", reason
