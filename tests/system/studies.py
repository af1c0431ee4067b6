"""A study's folder for tests on the live robot."""

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
name = "Online"
teaching = "prediction"
device = "{device}"
[[methods]]
name = "Offline"
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
table = [["Online", "Offline"]]
participants = 1
[instruments]
before = []
after_method = []
"""

TRAINING, MODEL = "Online/training", "Online/1"


def study_in(folder, **task):
    """Make one: see `PROTOCOL` for what can be different."""
    folder.mkdir()
    (folder / "protocol.toml").write_text(PROTOCOL.format(**task))
    return folder


def written(folder, part):
    """The configuration's file of a part of participant 1."""
    return folder / "recordings" / "P01" / part.replace("/", "-") / "configuration.json"
