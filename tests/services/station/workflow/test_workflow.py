"""The teaching workflow: Algorithm 1, and the way back from every loss."""

from dataclasses import replace

import msgspec
import pytest

from protocol import messages, queries
from protocol.messages import Attempt, EpisodeResult, Mode, Outcome, Verdict
from services.bus.arrays import motion_to_wire, to_wire
from services.bus.bus import Failed
from services.station.workflow.state import Action, Phase, Place, Settings, View, Workflow
from services.station.workflow.workflow import EPISODE_GRACE_S, advance, learnable, loop_has_closed

POSE = messages.Pose((0.5, 0.0, 0.5), (1.0, 0.0, 0.0, 0.0))
MOTION = motion_to_wire([[0.5, 0.0, 0.5], [0.8, 0.0, 0.6]], [[1.0, 0.0, 0.0, 0.0]] * 2, 7.0)
REACHED = Outcome(reached=True, kicked_over=False, collision=False)
COLLIDED = Outcome(reached=False, kicked_over=False, collision=True)
MISSED = Outcome(reached=False, kicked_over=False, collision=False)


def robot_state(phase):
    return messages.RobotState(measured=POSE, reference=POSE, phase=phase)


class Site:
    """Everything around the station, answering as a healthy system does; a run is a list of verdicts."""

    def __init__(self, settings, verdicts=()):
        self.settings = settings
        self.verdicts = list(verdicts)
        self.state = Workflow()
        self.now_s = 100.0
        self.epoch = 7
        self.version = 2
        self.asked = []
        self.view = View(
            now_s=0.0,
            robot=robot_state(messages.Phase.IDLE),
            authority=messages.AuthorityState(holder="", epoch=self.epoch, expires_in=0.0),
            safety=messages.SafetyState(emergency_stop=False),
            scene=messages.SceneState(
                name="dishwasher",
                variant="b2",
                boxes=(),
                object_size=(0.05, 0.05, 0.1),
                ellipsoid_radii=(0.05, 0.05, 0.05),
                kicked_over_thresholds=(0.1, 0.1, 0.1),
                start=POSE,
                object_region=((0.8, 0.0, 0.5), (0.9, 0.1, 0.5)),
                variants=("b1", "b2"),
            ),
            model=messages.ModelState(kind="adaptive", version=2, demonstrations=2, updates=0, scene="dishwasher"),
            seen=messages.ObjectPose(pose=messages.Pose((0.85, 0.05, 0.5), (1.0, 0.0, 0.0, 0.0)), tag=1, pictures=9),
            drawn=Place((0.85, 0.05, 0.5)),
        )

    def step(self, **seen):
        """Advance by a second; a question is answered in the next step."""
        self.now_s += 1.0
        before = self.state.phase
        now = {"now_s": self.now_s, "seen_s": self.now_s, "scene_s": self.now_s}
        step = advance(self.state, replace(self.view, **(now | seen)), self.settings)
        self.state = step.state
        self.view = replace(self.view, outcome=None, result=None)
        if step.ask is not None:
            self.asked.append(step.ask)
            outcome = self.answer(step.ask)
            self.view = replace(self.view, outcome=outcome)
        elif self.state.phase is Phase.EXECUTING and before is Phase.EXECUTING and self.verdicts:
            result = self.result(self.verdicts.pop(0))
            self.view = replace(self.view, result=result, robot=robot_state(messages.Phase.IDLE))
        return step

    def answer(self, ask):
        match ask.query:
            case queries.ACQUIRE:
                self.epoch += 1
                holder = messages.AuthorityState(holder=ask.request.holder, epoch=self.epoch, expires_in=1.0)
                self.view = replace(self.view, authority=holder)
                return queries.AuthorityGranted(self.epoch, 1.0)
            case queries.PREDICT:
                return queries.Predicted(
                    messages.Prediction(
                        id=len(self.asked),
                        motion=MOTION,
                        deviations=to_wire([[0.0] * 3] * 2),
                        model_version=self.version,
                        object_position=ask.request.object_position,
                    )
                )
            case queries.ADD_DEMONSTRATION | queries.UNDO:
                self.version += 1
                return queries.Learnt(replace_version(self.view.model, self.version))
            case queries.EXECUTE:
                self.view = replace(self.view, robot=robot_state(messages.Phase.EXECUTE))
                return queries.EpisodeStarted(1)
            case queries.FINISH:
                self.view = replace(self.view, robot=robot_state(messages.Phase.IDLE))
                return queries.Accepted()
            case _:
                return queries.Accepted()

    def result(self, outcome):
        return EpisodeResult(
            episode=1,
            request=self.state.request,
            mode=self.state.mode,
            completed=True,
            reason="",
            prediction=self.state.prediction.id,
            refined=MOTION,
            commanded=MOTION,
            measured=MOTION,
            verdict=Verdict(reached=outcome.reached, kicked_over=outcome.kicked_over, collision=outcome.collision),
            operator_input=self.state.mode is Mode.REFINE,
            clamped=0,
            held=0.0,
            duration=10.0,
        )

    def run_to(self, phase, limit=400, **seen):
        for _ in range(limit):
            if self.state.phase is phase:
                return
            self.step(**seen)
        pytest.fail(f"never came to {phase}; is in {self.state.phase}: {self.state.notice}")

    def names(self):
        return [ask.query.name for ask in self.asked]


def replace_version(model, version):
    return messages.ModelState(
        kind=model.kind, version=version, demonstrations=2, updates=version - 2, scene=model.scene
    )


SCRIPTED = Settings(holder="station", scripted=True, once=True, refinements_allowed=3, updates_allowed=2)
BY_HAND = Settings(holder="station")


def test_the_loop_closes_by_one_correction():
    site = Site(SCRIPTED, [COLLIDED, REACHED, REACHED])
    site.run_to(Phase.FINISHED)
    assert site.state.loop_closed
    assert [a.mode for a in site.state.attempts] == [Mode.AUTONOMOUS, Mode.REFINE, Mode.AUTONOMOUS]
    assert site.names().count("model/add_demonstration") == 1


def test_a_refinement_that_fails_is_not_learnt():
    site = Site(SCRIPTED, [COLLIDED, MISSED, REACHED, REACHED])
    site.run_to(Phase.FINISHED)
    assert site.state.loop_closed
    assert site.names().count("model/add_demonstration") == 1
    assert len(site.state.attempts) == 4


def test_every_episode_begins_with_a_reset_and_a_look():
    site = Site(SCRIPTED, [COLLIDED, REACHED, REACHED])
    site.run_to(Phase.FINISHED)
    assert [n for n in site.names() if n in ("cmd/reset", "model/predict", "cmd/execute")] == [
        "cmd/reset",
        "model/predict",
        "cmd/execute",
    ] * 3


def test_the_run_is_about_the_changed_variant_and_one_object_position():
    site = Site(SCRIPTED, [COLLIDED, REACHED, REACHED])
    site.run_to(Phase.FINISHED)
    resets = {(ask.request.variant, ask.request.object_position) for ask in site.asked if ask.query is queries.RESET}
    assert resets == {("b2", (0.85, 0.05, 0.5))}


def test_an_arrangement_is_what_every_reset_asks_for():
    arrangement = queries.Reset(0, "b1", (0.9, 0.1, 0.5), start=POSE)
    site = Site(replace(SCRIPTED, arrangement=arrangement), [COLLIDED, REACHED, REACHED])
    site.run_to(Phase.FINISHED)
    resets = [ask.request for ask in site.asked if ask.query is queries.RESET]
    assert resets == [queries.Reset(site.epoch, "b1", (0.9, 0.1, 0.5), start=POSE)] * 3


def test_a_run_without_refinements_executes_once():
    site = Site(replace(SCRIPTED, refinements_allowed=0), [COLLIDED])
    site.run_to(Phase.FINISHED)
    assert [attempt.mode for attempt in site.state.attempts] == [Mode.AUTONOMOUS]


def test_refinements_run_slower_than_predictions_and_are_learnt_in_a_predictions_tempo():
    site = Site(SCRIPTED, [COLLIDED, REACHED, REACHED])
    site.run_to(Phase.FINISHED)
    durations = [ask.request.duration for ask in site.asked if ask.query is queries.EXECUTE]
    learnt = [ask.request.motion.duration for ask in site.asked if ask.query is queries.ADD_DEMONSTRATION]
    assert (durations, learnt) == ([10.0, 20.0, 10.0], [10.0])


def test_a_refinement_is_learnt_with_the_prediction_that_it_refines_as_far_as_it_is_believed():
    site = Site(replace(SCRIPTED, alpha=0.5), [COLLIDED, REACHED, REACHED])
    site.run_to(Phase.FINISHED)
    (learnt,) = [ask.request for ask in site.asked if ask.query is queries.ADD_DEMONSTRATION]
    assert learnt.alpha == 0.5
    assert learnt.prediction == learnable(MOTION, SCRIPTED.autonomous_s)


def test_a_refinement_that_is_believed_wholly_is_learnt_without_the_prediction():
    site = Site(SCRIPTED, [COLLIDED, REACHED, REACHED])
    site.run_to(Phase.FINISHED)
    (learnt,) = [ask.request for ask in site.asked if ask.query is queries.ADD_DEMONSTRATION]
    assert learnt.prediction is None


def test_a_robot_that_does_not_know_the_prediction_is_given_another_one():
    site = Site(BY_HAND)
    site.run_to(Phase.STARTING)
    site.step()
    site.step(outcome=queries.Refused("no prediction 7 was heard from the model: predict again"))
    assert site.state.phase is Phase.PREDICTING
    assert "no prediction 7 was heard" in site.state.notice
    site.run_to(Phase.EXECUTING)
    executed = [ask.request.prediction for ask in site.asked if ask.query is queries.EXECUTE]
    assert len(set(executed)) == len(executed) == 2


def test_too_many_refinements_end_the_run_with_the_reason():
    site = Site(SCRIPTED, [COLLIDED, *[MISSED] * 3])
    site.run_to(Phase.FINISHED)
    assert not site.state.loop_closed
    assert site.state.reason == "3 refinements did not succeed"


def test_too_many_updates_end_the_run_with_the_reason():
    site = Site(SCRIPTED, [COLLIDED, REACHED, COLLIDED, REACHED, COLLIDED])
    site.run_to(Phase.FINISHED)
    assert site.state.reason == "2 updates did not teach the model"


def test_without_a_script_a_person_decides_after_each_episode():
    site = Site(BY_HAND, [COLLIDED, REACHED])
    site.run_to(Phase.DECIDING)
    for _ in range(5):
        site.step()
    assert site.state.phase is Phase.DECIDING
    assert Action.REFINE in site.state.offered
    site.step(actions=frozenset({Action.REFINE}))
    site.run_to(Phase.EXECUTING)
    assert site.state.mode is Mode.REFINE


def test_what_is_not_offered_is_not_done():
    site = Site(BY_HAND, [COLLIDED])
    site.run_to(Phase.DECIDING)
    site.step(actions=frozenset({Action.UNDO, Action.TAKE_OVER}))
    assert site.state.phase is Phase.DECIDING


def test_undo_takes_the_update_back_and_tries_again():
    site = Site(BY_HAND, [COLLIDED, REACHED, MISSED])
    site.run_to(Phase.DECIDING)
    site.step(actions=frozenset({Action.REFINE}))
    site.run_to(Phase.LEARNING)
    site.run_to(Phase.DECIDING)
    site.step(actions=frozenset({Action.UNDO}))
    site.run_to(Phase.EXECUTING)
    assert "model/undo" in site.names()
    assert site.state.updates == 0


@pytest.mark.parametrize("lost", ["robot", "model"])
def test_it_waits_for_who_is_missing_and_says_so(lost):
    site = Site(SCRIPTED)
    for _ in range(5):
        site.step(**{lost: None})
    assert site.state.phase is Phase.WAITING
    assert lost in site.state.notice


def test_it_looks_until_the_object_is_seen():
    site = Site(SCRIPTED)
    site.run_to(Phase.LOOKING, seen=None)
    for _ in range(5):
        site.step(seen=None)
    assert site.state.phase is Phase.LOOKING


def test_a_failed_question_is_shown_and_asked_again():
    site = Site(SCRIPTED)
    site.run_to(Phase.PREDICTING)
    site.step()
    site.view = replace(site.view, outcome=Failed("nobody answers"))
    site.step()
    assert "nobody answers" in site.state.notice
    site.run_to(Phase.EXECUTING)


def test_where_the_object_was_before_the_reset_does_not_count():
    site = Site(SCRIPTED)
    site.run_to(Phase.LOOKING)
    before = site.now_s
    for _ in range(5):
        site.step(seen_s=before)
    assert site.state.phase is Phase.LOOKING
    site.run_to(Phase.PREDICTING)


CONDITION = (0.05, -0.1)


class ConditionSite(Site):
    """As `Site`, in a scene that has a condition of its own and no object to look at."""

    def __init__(self, settings, verdicts=()):
        super().__init__(settings, verdicts)
        scene = msgspec.structs.replace(
            self.view.scene, name="particle", variant="obstacle", variants=("free", "obstacle"), condition=CONDITION
        )
        self.view = replace(self.view, scene=scene, seen=None, drawn=Place(condition=CONDITION))

    def requests(self, query):
        return [ask.request for ask in self.asked if ask.query is query]


def test_a_condition_of_the_scenes_own_is_set_predicted_from_and_learnt():
    site = ConditionSite(SCRIPTED, [MISSED, REACHED, REACHED])
    site.run_to(Phase.FINISHED)
    assert site.state.loop_closed
    resets = {(r.variant, r.object_position, r.condition) for r in site.requests(queries.RESET)}
    assert resets == {("obstacle", None, CONDITION)}
    for query in (queries.PREDICT, queries.ADD_DEMONSTRATION):
        assert {(r.object_position, r.condition) for r in site.requests(query)} == {((0.0, 0.0, 0.0), CONDITION)}
    assert {a.condition for a in site.state.attempts} == {CONDITION}


def test_what_the_robot_said_of_its_condition_before_the_reset_does_not_count():
    site = ConditionSite(SCRIPTED)
    site.run_to(Phase.LOOKING)
    before = site.now_s
    for _ in range(5):
        site.step(scene_s=before)
    assert site.state.phase is Phase.LOOKING
    site.step()
    assert site.state.phase is Phase.PREDICTING


def test_the_run_is_about_the_variant_that_is_configured():
    site = ConditionSite(replace(SCRIPTED, variant="free"), [MISSED, REACHED, REACHED])
    site.run_to(Phase.FINISHED)
    assert {r.variant for r in site.requests(queries.RESET)} == {"free"}


def lose_authority(site):
    site.epoch += 50
    site.view = replace(site.view, authority=messages.AuthorityState(holder="", epoch=site.epoch, expires_in=0.0))
    site.step()
    assert site.state.phase is Phase.WAITING


def test_a_lost_authority_is_asked_for_again_and_the_episode_goes_on():
    site = Site(SCRIPTED)
    site.run_to(Phase.EXECUTING)
    request = site.state.request
    lose_authority(site)
    site.run_to(Phase.EXECUTING)
    assert site.state.epoch == site.epoch
    assert site.state.request == request


def test_a_robot_that_was_restarted_is_given_the_episode_again():
    site = Site(SCRIPTED)
    site.run_to(Phase.EXECUTING)
    request = site.state.request
    lose_authority(site)
    site.run_to(Phase.RESETTING, robot=robot_state(messages.Phase.IDLE))
    site.run_to(Phase.EXECUTING)
    assert site.state.request == request + 1


def test_an_operator_who_was_deciding_decides_once_the_authority_is_back():
    site = Site(BY_HAND, [COLLIDED])
    site.run_to(Phase.DECIDING)
    asked = len(site.asked)
    lose_authority(site)
    site.run_to(Phase.DECIDING)
    assert site.names()[asked:] == ["authority/acquire"]


def test_an_episode_that_never_ends_is_repeated():
    site = Site(SCRIPTED)
    site.run_to(Phase.EXECUTING)
    site.now_s += SCRIPTED.autonomous_s + EPISODE_GRACE_S
    site.step()
    assert site.state.phase is Phase.WAITING
    asked = len(site.asked)
    site.run_to(Phase.EXECUTING)
    assert site.names()[asked:] == [
        "authority/acquire",
        "cmd/finish",
        "cmd/reset",
        "model/predict",
        "cmd/execute",
    ]


def test_a_person_may_let_the_robot_hold_for_as_long_as_they_like():
    site = Site(BY_HAND)
    site.run_to(Phase.EXECUTING)
    site.now_s += 3600.0
    site.step()
    assert site.state.phase is Phase.EXECUTING


def test_the_emergency_stop_offers_nothing_but_its_release():
    site = Site(SCRIPTED)
    site.run_to(Phase.EXECUTING)
    stopped = messages.SafetyState(emergency_stop=True, by="someone")
    site.step(safety=stopped)
    assert site.state.offered == {Action.RELEASE_STOP}
    site.step(safety=stopped, actions=frozenset({Action.RELEASE_STOP}))
    assert site.state.phase is Phase.RELEASING


def test_after_a_stop_nothing_moves_until_the_operator_says_so():
    site = Site(BY_HAND)
    site.run_to(Phase.EXECUTING)
    stopped = messages.SafetyState(emergency_stop=True, by="someone")
    site.step(safety=stopped, actions=frozenset({Action.RELEASE_STOP}))
    asked = len(site.asked)
    site.run_to(Phase.DECIDING)
    for _ in range(5):
        site.step()
    assert site.names()[asked:] == ["safety/release_stop", "authority/acquire"]


def attempt(mode, outcome, version, *, x=0.85, variant="b2", condition=()):
    return Attempt("s", (x, 0.0, 0.5), version, mode is Mode.REFINE, outcome, 1.0, variant, mode, condition)


CLOSED = (
    attempt(Mode.AUTONOMOUS, COLLIDED, 2),
    attempt(Mode.REFINE, REACHED, 2),
    attempt(Mode.AUTONOMOUS, REACHED, 3),
)


def test_the_loop_has_closed_when_all_three_happened_in_order():
    assert loop_has_closed(CLOSED)


@pytest.mark.parametrize("failure", [MISSED, COLLIDED, Outcome(reached=True, kicked_over=True, collision=False)])
def test_whatever_the_first_prediction_failed_by_counts(failure):
    assert loop_has_closed((attempt(Mode.AUTONOMOUS, failure, 2), *CLOSED[1:]))


@pytest.mark.parametrize(
    "attempts",
    [
        CLOSED[1:],
        CLOSED[:2],
        (CLOSED[0], CLOSED[2], CLOSED[1]),
        (attempt(Mode.AUTONOMOUS, REACHED, 2), *CLOSED[1:]),
        (*CLOSED[:2], attempt(Mode.AUTONOMOUS, REACHED, 2)),
        (*CLOSED[:2], attempt(Mode.AUTONOMOUS, REACHED, 3, x=0.9)),
        (*CLOSED[:2], attempt(Mode.AUTONOMOUS, REACHED, 3, condition=(0.1, 0.0))),
        (*CLOSED[:2], attempt(Mode.AUTONOMOUS, REACHED, 3, variant="b1")),
        (*CLOSED[:2], attempt(Mode.REFINE, REACHED, 3)),
    ],
    ids=[
        "no attempt before",
        "no success",
        "wrong order",
        "no failure",
        "no update",
        "elsewhere",
        "another condition",
        "another variant",
        "with a hand",
    ],
)
def test_the_loop_has_not_closed_when_a_part_is_missing(attempts):
    assert not loop_has_closed(attempts)
