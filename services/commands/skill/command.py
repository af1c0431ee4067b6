"""`retouch skill`: what a robot has learnt, by name; its words, and what each of them does."""

from __future__ import annotations

from argparse import ArgumentParser, Namespace, _SubParsersAction
from pathlib import Path

from services.commands.arguments import add_network, add_scene, whole
from services.commands.settings import configuration
from services.commands.skill import changing, files, showing
from services.model.skills import shelf_of
from services.process.exit_codes import Exit

_ABOUT = """\
A skill is what was learnt for a task: demonstrations, corrections, and the versions of
the model that they make. A robot has as many as you like, a file each in
~/.local/share/retouch/ROBOT on the machine that its model process runs on; these words
work on the files there. A skill is for one task and one kind of robot, and is used for
no other.
"""

_EXAMPLES = """\
examples:
  retouch skill list                          all skills of a robot
  retouch skill new cups --task table --notes "the blue ones"
                                              an empty one, to be taught by hand
  retouch up --task table --skill cups        with this one in use
  retouch skill use plates                    another one, while the model process runs
  retouch skill show cups                     what it has learnt, entry by entry
  retouch skill undo cups                     takes back what it learnt last
  retouch skill drop cups --yes               away with it; 'retouch skill undo cups' brings it back
  retouch skill export cups                   one file, cups.retouch-skill, to send or to keep
  retouch skill import cups.retouch-skill --name cups-of-anna

Names have 1 to 64 letters, digits, '-', '_' and '.', and begin with a letter or digit.
What a model process has open can be read, copied, exported and undone; it is renamed
and dropped when nobody has it open.
"""


def add_arguments(parser: ArgumentParser) -> None:
    """See `Action`."""
    parser.description, parser.epilog = _ABOUT, _EXAMPLES
    words = parser.add_subparsers(dest="word", required=True, metavar="WORD")
    _word(words, "list", "all skills of a robot, and which of them is used for which task")
    _word(words, "show", "what a skill has learnt, entry by entry", "name")
    new = _word(words, "new", "make an empty skill", "name")
    add_scene(new)
    new.add_argument("--notes", default="", metavar="TEXT", help="for people")
    _word(words, "use", "have the running model process use a skill from now on", "name")
    note = _word(words, "note", "write the notes of a skill anew", "name")
    note.add_argument("notes", metavar="TEXT", help="for people")
    _word(words, "rename", "give a skill another name", "name", "other")
    _word(words, "copy", "make another skill that has learnt the same", "name", "other")
    undo = _word(words, "undo", "take back what a skill learnt last, or bring back one that was dropped", "name")
    undo.add_argument("--entry", type=whole(1), metavar="N", help="this one, whatever came after it; see 'show'")
    drop = _word(words, "drop", "take a skill away; its file is kept", "name")
    drop.add_argument("--yes", action="store_true", help="do it; without this nothing is done")
    export = _word(words, "export", "write a skill into one file that can be sent", "name")
    export.add_argument("file", nargs="?", type=Path, metavar="FILE", help="(default: NAME.retouch-skill)")
    bring = _word(words, "import", "make a skill of an exported file")
    bring.add_argument("file", type=Path, metavar="FILE", help="that 'retouch skill export' wrote")
    bring.add_argument("--name", metavar="NAME", help="of the new skill (default: the one that it was exported by)")


def _word(words: _SubParsersAction[ArgumentParser], name: str, about: str, *skills: str) -> ArgumentParser:
    word = words.add_parser(name, help=about, description=f"{about[0].upper()}{about[1:]}.")
    for skill in skills:
        word.add_argument(skill, metavar="NAME" if skill == "name" else "NEW-NAME", help="of the skill")
    add_network(word)
    return word


def run(arguments: Namespace) -> int:
    """See `Action`.

    Raises:
        SkillError: there is no such skill, there is one already, or it is open.
        StorageError: a skill's file cannot be used.
        CommandFailed: something else has to be said, or is not there.
        BusError: the model process has to be asked, and is not reached.
    """
    settings = configuration(arguments)
    shelf = shelf_of(settings.model, settings.name)
    match arguments.word:
        case "list":
            showing.list_all(shelf)
        case "show":
            showing.show(shelf, arguments.name)
        case "new":
            changing.new(shelf, settings, arguments.name, arguments.notes)
        case "use":
            changing.use(settings, arguments.name)
        case "note":
            changing.note(shelf, arguments.name, arguments.notes)
        case "rename":
            changing.rename(shelf, arguments.name, arguments.other)
        case "copy":
            changing.copy(shelf, arguments.name, arguments.other)
        case "undo":
            changing.undo(shelf, settings, arguments.name, arguments.entry)
        case "drop":
            changing.drop(shelf, arguments.name, sure=arguments.yes)
        case "export":
            files.export(shelf, arguments.name, arguments.file)
        case _:
            files.bring_in(shelf, arguments.file, arguments.name)
    return Exit.DONE
