"""A session of a study on the live robot: a training and a model, told whole, whatever is killed in its middle."""

import contextlib
import itertools

import psutil
import pytest

from protocol.messages import Mode, Phase
from services.offline.people.ways import Teaching
from services.process.config import load
from services.study.events import Attempted, Began, BrokenOff, Ended, GoneOn
from services.study.journal import read
from tests.ports import free_port
from tests.system.harness import START_S, Command, Witness, eventually
from tests.system.participant import Participant
from tests.system.somebody import Somebody
from tests.system.studies import MODEL, TRAINING, study_in, written

pytestmark = [pytest.mark.system, pytest.mark.zenoh, pytest.mark.sim, pytest.mark.alone, pytest.mark.long]

PART_S = 300.0
GONE_S = 10.0
SAID_AGAIN = 300
"""Of the robot's messages, after which it is let go on again if it has not."""


@pytest.fixture
def folder(tmp_path):
    """Of a study."""
    return study_in(tmp_path / "study", device="stylus", scene="particle", place=[0.0, 0.0], successes=2)


@pytest.fixture
def serve(folder, tmp_path):
    """A function that serves the study at a port: a rehearsal, whose stylus a simulated hand leads."""
    with contextlib.ExitStack() as stack:

        def served(port):
            command = ("study", "run", folder, "--synthetic", "1", "--no-browser", "--port", port)
            return stack.enter_context(Command(*command, folder=tmp_path))

        yield served


@contextlib.contextmanager
def at_the_robot(folder, part):
    """Whoever does what the robot's page recommends, and lets a motion go on after a hold, and a witness of the robot.

    Yields:
        The witness, and a function that presses what is to be pressed now, each thing once.
    """
    made = load(written(folder, part))
    with Witness(made.connect, made.name) as witness, Somebody(made.station.host, made.station.port) as somebody:
        pressed = []

        def press():
            teaching, robot = witness.teaching, witness.robot
            if teaching is None or robot is None:
                return
            holds = "go_on" in teaching.actions  # a busy machine made it
            wanted = "go_on" if holds else teaching.recommended if teaching.phase == "deciding" else ""
            again = robot.sequence // SAID_AGAIN if holds else 0
            asked = (teaching.publisher, len(teaching.attempts), teaching.updates, wanted, again)
            if wanted and asked not in pressed:
                pressed.append(asked)
                somebody.press(wanted)

        yield witness, press


def attempts(folder, part):
    return [event for event in events(folder, Attempted) if event.part == part]


def events(folder, kind):
    return [entry.event for entry in read(folder / "raw") if isinstance(entry.event, kind)]


def do(folder, person, part, *steps):
    """Press what is recommended until something is seen, and do something then; step after step."""
    with at_the_robot(folder, part) as (witness, press):
        for until, then in steps:

            def seen(until=until):
                press()
                return until(witness)

            eventually(seen, PART_S, lambda: f"{part}; {witness.teaching}; {person.stage}; {person.refused}")
            then()


def refines(witness):
    robot = witness.robot
    return robot and robot.phase is Phase.EXECUTE and robot.mode is Mode.REFINE and 0.1 < robot.progress < 0.7


def second(folder, part):
    """Whether a correction is under way that is not the first attempt."""
    return lambda witness: attempts(folder, part) and refines(witness)


def nothing():
    pass


def kill_all(study):
    """kill -9 everything that a study has started, and not itself."""
    for process in study.left():
        if process.pid != study.process.pid:
            with contextlib.suppress(psutil.NoSuchProcess):
                process.kill()


def test_a_training_and_a_model_are_told_whole_whatever_is_killed(folder, serve):
    port = free_port()
    study = serve(port)
    with Participant(port, 1) as person:
        person.sees("consent", START_S, "the pages are there")
        person.does("consent", version="1", language="en")
        begin(person, TRAINING)

        # The study's own process dies in the middle of the second attempt: nothing is left of it, and it goes on.
        do(
            folder,
            person,
            TRAINING,
            (second(folder, TRAINING), study.process.kill),
        )
        study.process.wait()
        eventually(lambda: not study.left(), GONE_S, lambda: f"all processes end: {study.left()}")
        told = attempts(folder, TRAINING)
        study = serve(port)
        begin(person, TRAINING, resumed=True)
        do(folder, person, TRAINING, (lambda _: person.part == MODEL, nothing))
        assert attempts(folder, TRAINING)[: len(told)] == told

        # All of the robot's processes die in the middle of a correction, and the part goes on when they want it to.
        begin(person, MODEL)
        do(
            folder,
            person,
            MODEL,
            (second(folder, MODEL), lambda: kill_all(study)),
        )
        begin(person, MODEL, resumed=True)

        # One of them dies in the middle of the next one: it is started again, and the part goes on.
        over = (lambda _: person.part not in ("", MODEL), nothing)
        do(folder, person, MODEL, (refines, lambda: study.kill("station")), over)

        assert study.stop() == 0
        assert not study.left()

    practised, adapted = attempts(folder, TRAINING), attempts(folder, MODEL)
    for told in (practised, adapted):
        assert [one.number for one in told] == list(range(1, len(told) + 1))
        assert all((folder / one.recording).is_file() for one in told)
        assert all(one.ended > one.began for one in told)
        assert all(one.began >= before.ended for before, one in itertools.pairwise(told))
    led = [one for one in practised if one.teaching is not None]
    assert {one.teaching for one in led} == {Teaching.PREDICTION}
    assert sum(one.success for one in led[-4:]) >= 2
    assert all(one.updates == 0 for one in practised), "a training's model keeps nothing"
    assert all(one.active > 0.0 for one in led)
    assert adapted[-1].success
    assert adapted[-1].teaching is None
    assert adapted[-1].updates >= 1
    assert [(one.part, one.passed) for one in events(folder, Ended)] == [(TRAINING, True), (MODEL, True)]
    assert [one.part for one in events(folder, Began)] == [TRAINING, MODEL, "break/First"]
    assert [one.part for one in events(folder, GoneOn)] == [TRAINING, MODEL]
    (broken,) = events(folder, BrokenOff)
    assert (broken.part, broken.why) == (MODEL, "killed by signal 9")
    assert broken.raw["acting"] > 0.0


def begin(person, part, *, resumed=False):
    """Begin a part, and wait until the robot's page is shown."""
    ready = person.sees("ready", START_S, part)
    assert ready["resumed"] is resumed
    assert person.part == part
    person.does("begin", part=part, language="en")
    person.sees("wait", 5.0, "the robot is being made ready")
    person.sees("trial", START_S, part)
