"""Who may command, what is held at that person's page, and what the hand does with the master."""

from __future__ import annotations

from protocol.messages import Controller, MasterState, OperatorInput, Trouble, Vector3
from protocol.topics import AUTHORITY_STATE, MASTER_STATE, OPERATOR_INPUT
from services.bus.bus import Bus
from services.bus.stages import stages
from services.viewer import entities, scene, series
from services.viewer.journal import Journal, who_commands
from services.viewer.news import News, NewsOfHolder
from services.viewer.run import Run
from services.viewer.words import Words

_KINDS = ("gamepad", "spacemouse", "pointer")

# A button that is pressed by half counts as held here.
_HELD = 0.5


class Teleoperation:
    """Draws the operator's side of a run; of several operators, the one who may command.

    Args:
        bus: to them.
        run: where it is drawn.
        words: of the run.
        journal: that words are written from.
    """

    def __init__(self, bus: Bus, run: Run, words: Words, journal: Journal) -> None:
        self._run, self._words, self._journal = run, words, journal
        self._authority = News(bus.subscribe(AUTHORITY_STATE))
        self._input = NewsOfHolder(bus.subscribe(OPERATOR_INPUT))
        self._master = NewsOfHolder(bus.subscribe(MASTER_STATE))
        self._axes: dict[str, int] = {}
        scene.log_force_style(run)

    def draw(self, at: Vector3 | None, now_ns: int) -> None:
        """Draw what is new.

        Args:
            at: where the hand is felt, the grasping frame's position [m]; None where it is not known.
            now_ns: the time [ns].
        """
        authority = self._authority.take(now_ns)
        if authority is not None:
            self._words.state(entities.AUTHORITY, who_commands(authority), now_ns)
            self._words.write(*self._journal.authority(authority, now_ns))
        holder = self._authority.known.holder if self._authority.known is not None else ""
        held = self._input.take(holder)
        if held is not None:
            self._words.state(entities.KEYS, keys_held(held), now_ns)
            self._words.state(entities.PAGE, who_is_there(held), now_ns)
            self._draw_axes(held.controllers)
            series.log_stages(self._run, stages(operator=held))
        master = self._master.take(holder)
        if master is None:
            return
        self._words.state(entities.ENGAGED, hand(master), now_ns)
        series.log_master(self._run, master)
        series.log_stages(self._run, stages(master=master))
        if at is not None:
            scene.log_force(self._run, at, master.force)

    def _draw_axes(self, controllers: tuple[Controller, ...]) -> None:
        for controller in controllers:
            name, count = named(controller), len(controller.axes)
            if self._axes.get(name, 0) < count:
                self._axes[name] = count
                series.log_axes_legend(self._run, name, count)
            series.log_axes(self._run, name, controller.axes)


def named(controller: Controller) -> str:
    """A controller by its kind and number; one of a kind that is not known here is another one."""
    return f"{controller.kind if controller.kind in _KINDS else 'other'}{controller.number}"


def keys_held(held: OperatorInput) -> str:
    """The keys and buttons that are held down, by their places; empty where none is."""
    keys = [key.removeprefix("Key") for key in held.keys]
    buttons = [
        f"{named(controller)} {number}"
        for controller in held.controllers
        for number, pressed in enumerate(controller.buttons)
        if pressed > _HELD
    ]
    return " + ".join(keys + buttons)


def hand(master: MasterState) -> str:
    """The device that a hand is on, and what is wrong with one; empty where neither is."""
    device = (master.device or "engaged") if master.engaged else ""
    if master.trouble is Trouble.NONE:
        return device
    trouble = f"{master.trouble.value.replace('_', ' ')}: {master.trouble_with}"
    return f"{device}, {trouble}" if device else trouble


def who_is_there(held: OperatorInput) -> str:
    """Who is at the page, and whether keys count there; empty where nobody is."""
    if not held.present:
        return ""
    return held.operator if held.focused else f"{held.operator}, the keys elsewhere"
