"""A study with synthetic participants: the same from the same seed, and whole whenever and however it was ended."""

from pathlib import Path

import msgspec
import numpy as np
import pytest

from services.study.events import Attempted, Opened
from services.study.instruments.library import of_protocol
from services.study.journal import FILE, Journal
from services.study.protocols import SHIPPED
from services.study.records import observed
from services.study.session.conductor import Conductor
from services.study.study import new_study
from services.study.synthetic.character import Nature
from services.study.synthetic.filling import Experience, filled
from services.study.synthetic.lesson import Done
from services.study.synthetic.rehearsal import Rehearsal
from services.study.synthetic.run import StudyClock, SyntheticRun

pytestmark = pytest.mark.usefixtures("unsynchronised")

PEOPLE = 3


def told(lesson):
    """Stands in for the simulator: what came of a lesson, from the participant's seed alone."""
    rng = np.random.default_rng((lesson.nature.seed, lesson.place))
    names = [f"{lesson.method.name}/training", *(f"{lesson.method.name}/{m + 1}" for m in range(lesson.task.models))]
    done = []
    for name in names:
        count = int(rng.integers(1, 4))
        attempts = tuple(
            Attempted(
                participant=lesson.participant, part=name, number=number, teaching=lesson.method.teaching, updates=0,
                success=number == count, reached=True, kicked_over=False, collision=False, active=20.0,
                began=30.0 * (number - 1), ended=30.0 * number,
            )
            for number in range(1, count + 1)
        )  # fmt: skip
        done.append(Done(name, attempts, rng.random() < 0.9, 20.0 * count, 30.0 * count + 5.0))
        if not done[-1].passed and name.endswith("training"):
            break
    return tuple(done)


def backwards(lessons, jobs):
    """What was begun last is ready first."""
    return (((one.participant, one.method.name), told(one)) for one in reversed(lessons))


def in_order(lessons, jobs):
    return (((one.participant, one.method.name), told(one)) for one in lessons)


@pytest.fixture
def study(tmp_path):
    return new_study(tmp_path / "study", SHIPPED["thesis"])


def run(study, lessons, raw=None):
    """Run it, or go on with it; the entries."""
    clock = StudyClock()
    with Journal(raw or study.raw, clock) as journal:
        if journal.entries:
            clock.now = clock.now.fromisoformat(journal.entries[-1].at)
        instruments = of_protocol(study.protocol, study.folder)
        conductor = Conductor(study.protocol, journal, instruments)
        SyntheticRun(study.protocol, instruments, conductor, clock, Rehearsal(PEOPLE), lessons=lessons).go(1)
        assert all(one.finished for one in conductor.participants().values())
        return [entry for entry in journal.entries if not isinstance(entry.event, Opened)]


def test_what_is_ready_first_is_no_matter(study, tmp_path):
    assert run(study, in_order) == run(study, backwards, tmp_path / "other")
    assert (study.raw / FILE).read_bytes() == (tmp_path / "other" / FILE).read_bytes()


def test_ended_after_any_entry_it_goes_on_to_the_same_data(study, tmp_path):
    whole = run(study, in_order)
    lines = (study.raw / FILE).read_bytes().splitlines(keepends=True)
    for cut in range(0, len(lines), 7):
        raw = tmp_path / f"cut-{cut}"
        raw.mkdir()
        (raw / FILE).write_bytes(b"".join(lines[:cut]))
        assert [entry.event for entry in run(study, backwards, raw)] == [entry.event for entry in whole]


def test_attempts_are_numbered_without_gaps_and_none_comes_twice(study):
    numbers = {}
    for entry in run(study, backwards):
        if isinstance(entry.event, Attempted):
            numbers.setdefault((entry.event.participant, entry.event.part), []).append(entry.event.number)
    assert all(found == list(range(1, len(found) + 1)) for found in numbers.values())


def test_what_is_analysed_is_what_the_journal_says_and_marked(study):
    entries = run(study, in_order)
    observations = observed(study.protocol, entries, of_protocol(study.protocol, study.folder), "here")
    assert observations.synthetic
    assert observations.participants == ["P01", "P02", "P03"]
    assert {one.method for one in observations.ratings} == {method.name for method in study.protocol.methods}
    assert all(0.0 <= one.workload <= 100.0 for one in observations.ratings)
    for outcome in observations.outcomes:
        assert (outcome.seconds is not None) == outcome.adapted


@pytest.mark.parametrize("name", ["nasa_tlx", "sus", "trust", "participant", "preference"])
@pytest.mark.parametrize("seed", range(5))
def test_forms_are_filled_in_as_their_file_wants_them(study, name, seed):
    asked = msgspec.structs.replace(study.protocol.instruments, before=(name,), after_method=(), after=())
    instrument = of_protocol(msgspec.structs.replace(study.protocol, instruments=asked), None)[name]
    shown, answers = filled(instrument, Nature.drawn(seed), 1, None)
    instrument.check(answers)
    assert len(shown) == len(set(shown))


def test_who_works_longer_and_fails_more_says_that_it_was_more_work(study):
    instrument = of_protocol(study.protocol, None)["nasa_tlx"]
    easy, hard = Experience(20.0, 0.0), Experience(600.0, 0.8)

    def workload(experience):
        scores = [instrument.scored(filled(instrument, Nature.drawn(k), 1, experience)[1]) for k in range(30)]
        return np.mean([score["workload"] for score in scores])

    assert workload(hard) > workload(easy) + 20.0


def test_a_person_is_their_seed():
    assert Nature.drawn(7) == Nature.drawn(7)
    assert len({Nature.drawn(seed) for seed in range(50)}) == 50


def test_shipped_protocols_are_files():
    assert all(Path(path).is_file() for path in SHIPPED.values())
