"""The supervisor's live table."""

from __future__ import annotations

from rich.table import Table

from protocol.messages import Heartbeat
from protocol.names import role
from services.commands.up.child import Child


def status_table(children: list[Child], beats: dict[str, Heartbeat]) -> Table:
    """A row a process: state, process id, restarts, rate, late ticks, memory, drops."""
    table = Table(title="retouch up: Ctrl-C stops everything")
    for heading in ("process", "state"):
        table.add_column(heading)
    for heading in ("pid", "restarts", "Hz", "period p99", "late", "MB", "drops"):
        table.add_column(heading, justify="right")
    for child in children:
        name = child.job.name
        if not child.job.restart and child.exit_code == 0:
            continue
        state = "[green]runs[/]" if child.alive else "[red]down[/]"
        row = [name, state, str(child.pid or "-"), str(child.restarts)]
        beat = next((b for b in beats.values() if b.pid == child.pid and role(b.process) == name), None)
        if beat is not None:
            late = f"{100 * beat.late_ticks / max(1, beat.ticks):.1f} %"
            drops = str(sum(t.drops for t in beat.topics))
            row += [f"{beat.rate_hz:g}", f"{1e3 * beat.period_p99:.1f} ms", late, f"{beat.memory / 1e6:.0f}", drops]
        table.add_row(*row)
    return table
