"""A station and the model's own process on the memory bus: a robot stands in that does what it is told."""

import numpy as np
import pytest

from lfd.store.database import DemonstrationStore
from protocol import queries, topics
from protocol.messages import (
    AuthorityState,
    Cut,
    EpisodeResult,
    ModelState,
    ObjectPose,
    Phase,
    Pose,
    Purpose,
    RobotState,
    SceneState,
    Verdict,
)
from protocol.queries import AddDemonstration
from services.bus.arrays import motion_from_wire, motion_to_wire
from services.bus.memory import MemoryNetwork
from services.model.service import build
from services.process.clock import ManualClock
from services.process.config import Configuration, ModelSection, RobotSection
from services.station.service import StationService
from tests.services.station.site import BY_HAND, REGION, Tab

START = Pose((0.5, 0.0, 0.4), (1.0, 0.0, 0.0, 0.0))
KNOWN, UNKNOWN = (0.85, 0.05, 0.55), (0.85, -0.4, 0.55)


class Site:
    """One step of a fiftieth of a second for all of them."""

    def __init__(self, database):
        self.clock = ManualClock()
        network = MemoryNetwork(self.clock)
        self.robot = network.bus()
        self.answers = {query: self.robot.serve(query) for query in (queries.ACQUIRE, queries.RESET, queries.EXECUTE)}
        configuration = Configuration(
            robot=RobotSection(scene="dishwasher"), model=ModelSection(database=str(database))
        )
        self.model = build(network.bus(), self.clock, configuration)
        self.page = Tab()
        self.station = StationService(network.bus(), BY_HAND, self.page, seed=3)
        self.at = KNOWN
        self.authority = AuthorityState(holder="", epoch=40, expires_in=0.0)
        self.executed = []
        self.phase = Phase.IDLE
        for place in (KNOWN, (0.85, 0.1, 0.55)):
            self.teach(place)

    def teach(self, place):
        t = np.linspace(0.0, 1.0, 40)[:, None]
        path = np.array(START.position) + t * (np.array(place) - START.position)
        motion = motion_to_wire(path, np.tile(START.orientation, (40, 1)), 10.0)
        pending = self.robot.ask(
            queries.ADD_DEMONSTRATION, AddDemonstration(Purpose.INITIAL, motion, place, "dishwasher")
        )
        self.model.step(self.clock.now_ns())
        assert isinstance(pending.poll(), queries.Learnt)

    def run(self, seconds):
        for _ in range(round(50 * seconds)):
            self.clock.advance(0.02)
            self._publish()
            for query, server in self.answers.items():
                for call in server.take():
                    call.reply(self._answer(query, call.request))
            self.model.step(self.clock.now_ns())
            self.station.step(self.clock.now_ns())

    def press(self, action):
        self.page.pressed = [action]
        self.run(3.0)

    def _publish(self):
        state = RobotState(measured=START, reference=START, phase=self.phase, episode=len(self.executed), publisher=1)
        self.robot.publish(topics.ROBOT_STATE, state)
        self.robot.publish(topics.AUTHORITY_STATE, self.authority)
        self.robot.publish(topics.OBJECT_POSE, ObjectPose(pose=Pose(self.at, START.orientation), tag=1, pictures=9))
        scene = SceneState(
            name="dishwasher",
            variant="b1",
            boxes=(),
            object_size=(0.05, 0.05, 0.1),
            ellipsoid_radii=(0.05, 0.05, 0.05),
            kicked_over_thresholds=(0.1, 0.1, 0.1),
            start=START,
            object_region=REGION,
            variants=("b1",),
        )
        self.robot.publish(topics.SCENE_STATE, scene)

    def _answer(self, query, request):
        if query is queries.ACQUIRE:
            self.authority = AuthorityState(holder=request.holder, epoch=41, expires_in=1.0)
            return queries.AuthorityGranted(41, 1.0)
        if query is queries.EXECUTE:
            self.executed.append(request)
            self.phase = Phase.EXECUTE
            return queries.EpisodeStarted(len(self.executed))
        return queries.Accepted()

    def end(self, motion, **changes):
        """The robot ends its episode by a collision at 60 % of the motion."""
        order = self.executed[-1]
        self.phase = Phase.IDLE
        result = EpisodeResult(
            episode=len(self.executed),
            request=order.request,
            mode=order.mode,
            prediction=order.prediction,
            refined=motion,
            commanded=motion,
            measured=motion,
            verdict=Verdict(reached=False, kicked_over=False, collision=True),
            operator_input=True,
            clamped=0,
            held=0.0,
            duration=20.0,
            clear_until=0.6,
            **{"completed": True, "reason": "", **changes},
        )
        self.robot.publish(topics.EPISODE_RESULT, result)
        self.run(1.0)


@pytest.fixture
def database(tmp_path):
    return tmp_path / "model.sqlite"


@pytest.fixture
def site(database):
    site = Site(database)
    site.run(3.0)
    yield site
    site.model.close()


def test_where_motions_were_shown_the_prediction_is_executed_and_known(site):
    site.press("execute")
    assert len(site.executed) == 1
    assert site.page.shown.prediction.known == 1.0


def test_far_from_what_was_shown_the_operator_is_asked_before_anything_is_executed(site):
    site.at = UNKNOWN
    site.press("execute")
    assert site.executed == []
    assert site.page.shown.prediction.known < 0.5
    assert "I don't know this place" in site.page.shown.teaching.text
    assert site.page.shown.teaching.recommended == "refine"
    site.press("execute")
    assert len(site.executed) == 1


@pytest.mark.parametrize("changes", [{}, {"completed": False, "reason": "stopped", "cut": Cut.STOPPED}])
def test_the_part_of_a_refinement_before_it_failed_is_learnt_upon_a_press_and_the_rest_stays(site, database, changes):
    site.press("execute")
    site.end(site.page.shown.prediction.motion)
    before = motion_from_wire(site.page.shown.prediction.motion)[0]
    site.press("refine")
    phases = np.linspace(0.0, 1.0, len(before))
    raised = before + 0.1 * np.sin(np.pi * phases)[:, None] * [0.0, 0.0, 1.0]
    site.end(motion_to_wire(raised, np.tile(START.orientation, (len(raised), 1)), 20.0), **changes)
    assert "teach" in site.page.shown.teaching.actions
    site.press("teach")
    site.press("execute")
    after = motion_from_wire(site.page.shown.prediction.motion)[0]
    early, late = phases <= 0.5, phases >= 0.72
    np.testing.assert_allclose(after[early], raised[early], atol=2e-3)
    np.testing.assert_allclose(after[late], before[late], atol=2e-3)
    with DemonstrationStore(database) as store:
        assert store.active()[-1].demonstration.part == (0.0, pytest.approx(0.55))


def test_a_prediction_of_a_model_that_has_learnt_since_is_not_shown_any_more(site):
    site.press("execute")
    assert site.page.shown.prediction is not None
    site.end(site.page.shown.prediction.motion)
    site.teach((0.85, 0.0, 0.55))
    site.run(1.5)
    assert isinstance(site.page.shown.model, ModelState)
    assert site.page.shown.prediction is None
