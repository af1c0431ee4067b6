"""A study's folder for tests on the live robot."""

from services.offline.people.ways import Teaching

PROTOCOL = """
format = 1
name = "live"
version = "1"
title = "Two ways"
languages = ["en"]
[recruitment]
how = "not at all"
inclusion = "nobody"
compensation = "none"
ethics = "none: it is a test"
contact = "nobody"
[consent]
version = "1"
[consent.text]
en = "You agree."
[[methods]]
name = "First"
teaching = "{teaching}"
device = "{device}"
[[methods]]
name = "Second"
teaching = "demonstration"
device = "{device}"
[task]
scene = "{scene}"
object_position = {place}
models = 1
[training]
successes = {successes}
of_last = 4
[order]
design = "table"
table = [["First", "Second"]]
participants = 1
[instruments]
before = []
after_method = []
"""

TRAINING, MODEL = "First/training", "First/1"


def study_in(folder, teaching=Teaching.PREDICTION, **task):
    """Make one: see `PROTOCOL` for what can be different."""
    folder.mkdir()
    (folder / "protocol.toml").write_text(PROTOCOL.format(teaching=teaching.value, **task))
    return folder


def written(folder, part):
    """The configuration's file of a part of participant 1."""
    return folder / "recordings" / "P01" / part.replace("/", "-") / "configuration.json"
