"""The commands, as data."""

from services.commands.command import Command
from services.process.processes import PROCESSES

_MODULES = {"robot": "services.commands.robot.command", "camera": "services.commands.camera.command"}
"""Of the processes that are more than one process."""

COMMANDS: tuple[Command, ...] = (
    Command("up", "services.commands.up.command", "start everything and watch over it", needs="process"),
    *(Command(p.name, _MODULES.get(p.name, "services.commands.process"), p.about) for p in PROCESSES),
    Command("router", "services.commands.router", "where the processes of a site meet", needs="process"),
    Command("task", "services.commands.task.command", "tasks: list, make, check and draw them", needs="robot"),
    Command("teach", "services.commands.teach", "give a model its first demonstrations, or a motion", needs="robot"),
    Command("history", "services.commands.history", "what a model has learnt; undo and redo of any", needs="station"),
    Command("skill", "services.commands.skill.command", "what a robot has learnt, by name", needs="station"),
    Command("run", "services.commands.run", "execute a skill, and see how often it succeeds", needs="station"),
    Command("prepare", "services.commands.prepare", "make and keep what every simulated run needs", needs="robot"),
    Command("echo", "services.commands.echo", "print what passes on a key expression", needs="process"),
    Command("device", "services.commands.device.command", "input devices: there, live, calibrated", needs="master"),
    Command("top", "services.commands.top", "the live processes of a network", needs="process"),
    Command("doctor", "services.commands.doctor.command", "what is wrong between two machines", needs="process"),
    Command("stop", "services.commands.stop", "emergency stop of a robot, or its release", needs="process"),
    Command("log", "services.commands.log", "what a robot has written down; is it as it was?", needs="process"),
    Command("replay", "services.commands.replay", "open a recording in Rerun", needs="viewer"),
    Command("certs", "services.commands.certs", "certificates: who may join a network, and what for", needs="process"),
    Command("accounts", "services.commands.accounts", "who may log in at the page, as what", needs="station"),
    Command("topics", "services.commands.topics", "print the table of topics and queries", needs="process"),
    Command("reproduce", "services.commands.reproduce", "the thesis' analyses made again: one report", needs="study"),
    Command(
        "study", "services.commands.study.command", "a study with people: its statistics and report", needs="study"
    ),
    Command("map", "services.commands.map", "where a model succeeds, before and after a correction", needs="study"),
)
