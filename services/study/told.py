"""What a study's protocol and journal tell its report, beside the figures."""

from __future__ import annotations

from collections.abc import Mapping, Sequence

from services.study.analysis.reporting import Reporting
from services.study.events import Consented, Deviated, Entry
from services.study.freezing import digest
from services.study.instruments.instrument import Instrument
from services.study.preregistration import FILE
from services.study.protocol.protocol import FILE as PROTOCOL
from services.study.study import Study


def reporting_of(study: Study, entries: Sequence[Entry], instruments: Mapping[str, Instrument]) -> Reporting:
    """What only the study knows.

    Args:
        study: its folder.
        entries: of its journal.
        instruments: that its protocol names.
    """
    protocol, frozen = study.protocol, study.frozen()
    events = [entry.event for entry in entries]
    consented = sum(isinstance(event, Consented) for event in events)
    days = sorted({entry.at[:10] for entry in entries})
    return Reporting(
        title=protocol.title,
        recruitment=f"{protocol.recruitment.how}; {protocol.recruitment.inclusion}",
        compensation=protocol.recruitment.compensation,
        consent=f"text of version {protocol.consent.version}, agreed to by {consented}",
        ethics=protocol.recruitment.ethics,
        dates=f"{days[0]} to {days[-1]}" if days else "",
        sample_size=f"{protocol.order.participants} were aimed at",
        preregistration=f"{FILE}, frozen at {frozen.at}, protocol {frozen.files[PROTOCOL][:16]}" if frozen else "",
        deviations=tuple(
            f"{', '.join(event.changed)}: {event.reason}" for event in events if isinstance(event, Deviated)
        ),
        instruments=tuple(
            f"{name} (version {one.version}, in {', '.join(protocol.languages)})" for name, one in instruments.items()
        ),
        system=f"simulated robot, scene {protocol.task.scene}; "
        + ", ".join(f"{name} {version}" for name, version in study.now().software.items()),
    )


def source_of(study: Study) -> str:
    """What the report says that its data are from."""
    return f"{study.protocol.name}, version {study.protocol.version} ({digest(study.folder / PROTOCOL)[:8]})"
