"""Algorithm 1: execute, refine, learn, execute again, with a scripted operator who presses what is recommended."""

from dataclasses import replace

import msgspec

from protocol import queries
from protocol.messages import Mode, Purpose
from services.station.workflow.state import Phase, Place
from tests.services.station.workflow.site import COLLIDED, MISSED, POSE, REACHED, SCRIPTED, Site


def test_the_loop_closes_by_one_correction():
    site = Site(SCRIPTED, [COLLIDED, REACHED, REACHED])
    site.run_to(Phase.FINISHED)
    assert site.state.closure.closed
    assert site.state.reason == ""
    assert [a.mode for a in site.state.attempts] == [Mode.AUTONOMOUS, Mode.REFINE, Mode.AUTONOMOUS]
    assert [a.number for a in site.state.attempts] == [1, 2, 3]
    assert site.names().count("model/add_demonstration") == 1


def test_a_refinement_that_fails_is_not_learnt():
    site = Site(SCRIPTED, [COLLIDED, MISSED, REACHED, REACHED])
    site.run_to(Phase.FINISHED)
    assert site.state.closure.closed
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


def test_without_once_a_success_leads_to_the_next_place():
    site = Site(replace(SCRIPTED, once=False), [REACHED])
    site.run_to(Phase.EXECUTING)
    site.sees(drawn=Place((0.9, 0.0, 0.5)))
    site.run_to(Phase.RESETTING)
    site.run_to(Phase.EXECUTING)
    assert site.state.placed == Place((0.9, 0.0, 0.5))


def test_the_run_is_about_the_changed_variant_and_one_object_position():
    site = Site(SCRIPTED, [COLLIDED, REACHED, REACHED])
    site.run_to(Phase.FINISHED)
    resets = {(request.variant, request.object_position) for request in site.requests(queries.RESET)}
    assert resets == {("b2", (0.85, 0.05, 0.5))}


def test_an_arrangement_is_what_every_reset_asks_for():
    arrangement = queries.Reset(0, "b1", (0.9, 0.1, 0.5), start=POSE)
    site = Site(replace(SCRIPTED, arrangement=arrangement), [COLLIDED, REACHED, REACHED])
    site.run_to(Phase.FINISHED)
    resets = [msgspec.structs.replace(request, request=0) for request in site.requests(queries.RESET)]
    assert resets == [queries.Reset(site.epoch, "b1", (0.9, 0.1, 0.5), start=POSE)] * 3


def test_a_run_without_refinements_executes_once():
    site = Site(replace(SCRIPTED, refinements_allowed=0), [COLLIDED])
    site.run_to(Phase.FINISHED)
    assert [attempt.mode for attempt in site.state.attempts] == [Mode.AUTONOMOUS]


def test_refinements_run_slower_than_predictions_and_are_learnt_in_a_predictions_tempo():
    site = Site(SCRIPTED, [COLLIDED, REACHED, REACHED])
    site.run_to(Phase.FINISHED)
    durations = [request.duration for request in site.requests(queries.EXECUTE)]
    learnt = [request.motion.duration for request in site.requests(queries.ADD_DEMONSTRATION)]
    assert (durations, learnt) == ([10.0, 20.0, 10.0], [10.0])


def test_every_execution_is_of_the_newest_prediction():
    site = Site(SCRIPTED, [COLLIDED, REACHED, REACHED])
    site.run_to(Phase.FINISHED)
    predicted = [i + 1 for i, ask in enumerate(site.asked) if ask.query is queries.PREDICT]
    assert [request.prediction for request in site.requests(queries.EXECUTE)] == predicted


def test_a_refinement_is_learnt_as_its_operators_and_as_far_as_it_is_believed():
    site = Site(replace(SCRIPTED, alpha=0.5), [COLLIDED, REACHED, REACHED])
    site.run_to(Phase.FINISHED)
    (learnt,) = site.requests(queries.ADD_DEMONSTRATION)
    assert (learnt.operator, learnt.alpha) == (SCRIPTED.operator, 0.5)
    assert learnt.motion.duration == SCRIPTED.autonomous_s
    assert (learnt.purpose, learnt.scene, learnt.object_position) == (
        Purpose.UPDATE,
        "dishwasher",
        (0.85, 0.05, 0.5),
    )


def test_too_many_refinements_end_the_run_with_the_reason():
    site = Site(SCRIPTED, [COLLIDED, *[MISSED] * 3])
    site.run_to(Phase.FINISHED)
    assert not site.state.closure.closed
    assert site.state.reason == "3 refinements did not succeed"


def test_too_many_updates_end_the_run_with_the_reason():
    site = Site(SCRIPTED, [COLLIDED, REACHED, COLLIDED, REACHED, COLLIDED])
    site.run_to(Phase.FINISHED)
    assert site.state.reason == "2 updates did not teach the model"


def test_the_run_is_about_the_variant_that_is_configured():
    site = ConditionSite(replace(SCRIPTED, variant="free"), [MISSED, REACHED, REACHED])
    site.run_to(Phase.FINISHED)
    assert {r.variant for r in site.requests(queries.RESET)} == {"free"}


CONDITION = (0.05, -0.1)


class ConditionSite(Site):
    """As `Site`, in a scene that has a condition of its own and no object to look at."""

    def __init__(self, settings, verdicts=()):
        super().__init__(settings, verdicts)
        scene = msgspec.structs.replace(
            self.view.scene, name="particle", variant="obstacle", variants=("free", "obstacle"), condition=CONDITION
        )
        self.sees(scene=scene, seen=None, drawn=Place(condition=CONDITION))


def test_a_condition_of_the_scenes_own_is_set_predicted_from_and_learnt():
    site = ConditionSite(SCRIPTED, [MISSED, REACHED, REACHED])
    site.run_to(Phase.FINISHED)
    assert site.state.closure.closed
    resets = {(r.variant, r.object_position, r.condition) for r in site.requests(queries.RESET)}
    assert resets == {("obstacle", None, CONDITION)}
    for query in (queries.PREDICT, queries.ADD_DEMONSTRATION):
        assert {(r.object_position, r.condition) for r in site.requests(query)} == {((0.0, 0.0, 0.0), CONDITION)}
    assert {a.condition for a in site.state.attempts} == {CONDITION}


def test_without_a_press_the_condition_that_the_robot_said_last_will_do():
    site = ConditionSite(replace(SCRIPTED, scripted=False))
    site.stay(10, scene_s=0.0)
    assert site.state.phase is Phase.DECIDING


def test_what_the_robot_said_of_its_condition_before_the_reset_does_not_count():
    site = ConditionSite(SCRIPTED)
    site.run_to(Phase.RESETTING)
    site.run_to(Phase.LOOKING)
    before = site.now_s
    site.stay(5, scene_s=before)
    assert site.state.phase is Phase.LOOKING
    site.step()
    assert site.state.phase is Phase.PREDICTING
