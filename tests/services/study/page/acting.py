"""What people do at the pages, without browsers, and what these show them then."""

from services.study.page import acts
from services.study.page.console import console_view
from services.study.page.participant import participant_view


def answers(study, number=1):
    """Complete ones to the form that a participant is at, the middle of everything."""
    part = study.desk.conductor.now(number)
    instrument = study.desk.instruments[part.instrument]
    found = {}
    for question in instrument.questions:
        kind = type(question).__name__
        for name in question.answers:
            found[name] = {
                "Scale": lambda q=question: q.ticks[len(q.ticks) // 2],
                "Choice": lambda q=question: q.options[0].name,
                "Text": lambda: "something",
                "Pairs": lambda n=name: n.split("/")[0],
            }[kind]()
    return found


def fill(study, number=1, **change):
    part = study.desk.conductor.now(number)
    version = study.desk.instruments[part.instrument].version
    said = {"part": part.name, "version": version, "language": "de", "answers": answers(study, number), **change}
    study.desk.participant_does(number, acts.Fill(**said))


def agree(study, number=1, version="2"):
    study.desk.participant_does(number, acts.Consent(version=version, language="de"))


def begin(study, number=1, language="de"):
    part = study.desk.conductor.now(number).name
    study.desk.participant_does(number, acts.Begin(part=part, language=language))


def stage(study, number=1):
    return participant_view(study.desk, number, "v").stage


def row(study, number=1):
    return next(row for row in console_view(study.desk, None, "v").rows if row.number == number)
