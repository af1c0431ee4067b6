"""The laws that the analyses of the thesis rest on, at a small size; and each of them once as a whole."""

from dataclasses import replace

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from lfd.models.dmp import DMP
from lfd.models.gaussian import JointGaussian
from lfd.models.promp import PrompOptions
from services.offline.result import Arrangement
from services.reproduction.analyses import ANALYSES
from services.reproduction.analyses.dmp import reproduced
from services.reproduction.analyses.factor_ten import identity_error
from services.reproduction.analyses.incremental import deviations, miscounted
from services.reproduction.analyses.linear import measured_shrinkage, shrinkage
from services.reproduction.analyses.next_waypoint import Course, overshoot, step_response
from services.reproduction.analyses.shifted_start import shift
from services.reproduction.analyses.sine import OFFSET, PHASE, TURNED, best_affine
from services.reproduction.analyses.time_warping import EXAMPLE_X, EXAMPLE_Y, TABLE_D1, accumulated
from services.reproduction.analysis import Context
from services.reproduction.functions import TAUGHT, rms
from services.reproduction.models import BY_NAME, DEFAULT, THESIS
from services.reproduction.operator import Operator
from services.reproduction.scripted import demonstrate, object_grid, reaches
from services.reproduction.teaching import Question, answered
from sim.tasks import TABLE
from sim.tasks import THESIS as SCENES
from sim.tasks.particle import PARTICLE

seeds = st.integers(0, 10_000)


@given(seeds, st.integers(1, 3), st.integers(1, 6))
def test_welford_is_exact_and_the_miscounted_recursion_is_not(seed, first, more):
    samples = np.random.default_rng(seed).normal(size=(first + more, 5))
    found = deviations(samples, first)
    assert max(found.mean.max(), found.covariance.max()) < 1e-12
    # From one sample the first update is right by chance: there is no covariance yet to be multiplied.
    assert found.miscounted[0 if first > 1 else 1 :].min(initial=1.0) > 1e-3


@given(seeds)
def test_the_miscounted_covariance_never_shrinks(seed):
    samples = np.random.default_rng(seed).normal(size=(8, 3))
    joint = JointGaussian.fit(samples[:2])
    for x in samples[2:]:
        updated = miscounted(joint, x)
        assert np.linalg.eigvalsh(updated.covariance - joint.covariance).min() > -1e-12
        joint = updated


@pytest.mark.parametrize("noise", [PrompOptions().conditioning_noise, 3.0])
@pytest.mark.parametrize("b", [1.0, 3.0, 7.0])
def test_the_conditioning_noise_draws_a_line_towards_the_mean_by_the_closed_form(noise, b):
    # The ten basis functions do not draw a line to the last percent.
    assert measured_shrinkage(noise, b) == pytest.approx(shrinkage(noise, b), rel=0.02, abs=1e-9)


def test_no_model_that_is_affine_in_the_condition_comes_nearer_than_the_best():
    model = THESIS.fit(PHASE.motions())
    error = rms(np.array([PHASE.predicted(model, b) - PHASE.outputs(b) for b in TAUGHT]))
    least = rms(np.array([best_affine(PHASE, b) - PHASE.outputs(b) for b in TAUGHT]))
    assert least <= error < 1.01 * least
    assert least > 0.3


def test_sines_are_predicted_from_a_condition_in_which_they_are_affine():
    for family in (OFFSET, TURNED):
        model = THESIS.fit(family.motions())
        assert max(family.error(model, b) for b in (1.0, 2.5, 4.2)) < 0.02


@given(seeds, st.floats(1e-3, 1.0), st.floats(0.1, 100.0))
def test_a_factor_on_the_condition_is_a_smaller_noise(seed, noise, factor):
    samples = np.random.default_rng(seed).normal(size=(6, 8))
    assert identity_error(samples, samples[0, -3:], noise, factor) < 1e-8


def test_one_demonstration_shifts_the_start_by_as_much_as_the_condition_differs():
    first, *others = [demonstrate(TABLE, p, None) for p in TABLE.training_positions]
    thesis, default = THESIS.fit([first]), DEFAULT.fit([first])
    own = shift(thesis, first.situation)
    for other in others:
        away = np.linalg.norm(other.condition - first.condition)
        assert shift(thesis, other.situation) == pytest.approx(away, abs=own + 1e-9)
        assert shift(default, other.situation) < 1e-9


def test_table_d1_comes_out():
    np.testing.assert_array_equal(accumulated(EXAMPLE_X, EXAMPLE_Y), TABLE_D1)


@pytest.mark.parametrize("scene", SCENES.values(), ids=SCENES)
def test_a_scripted_motion_goes_from_its_start_to_the_object(scene):
    rng = np.random.default_rng(1)
    for position in object_grid(scene, 2):
        start = scene.start.position + rng.uniform(-0.05, 0.05, 3)
        motion = demonstrate(scene, position, rng, start=start)
        np.testing.assert_allclose(motion.trajectory.positions[0], start, atol=1e-12)
        np.testing.assert_allclose(motion.condition, position - start, atol=1e-12)
        assert reaches(motion.trajectory, position, scene)
        assert not reaches(motion.trajectory, position + np.array([0.0, 0.2, 0.0]), scene)


def test_a_primitive_ends_where_it_is_led():
    taught, other = (demonstrate(TABLE, TABLE.training_positions[i], None) for i in (0, -1))
    led = reproduced(DMP.fit(taught.trajectory), other, other.trajectory)
    np.testing.assert_allclose(led.positions[-1], other.trajectory.positions[-1], atol=1e-4)


def test_the_operator_comes_to_rest_where_the_known_and_the_seen_say():
    known, wanted = np.array([0.02, 0.0, -0.01]), np.array([0.05, 0.01, 0.0])
    operator = Operator(persistence=0.5, period=0.01)
    position = np.zeros(3)
    for _ in range(4000):
        position = operator.move(known, wanted - position)
    np.testing.assert_allclose(position, wanted, atol=1e-6)


def test_the_operator_does_not_act_on_what_is_seen_before_the_reaction_time():
    operator = Operator(persistence=1.0, period=0.01)
    moved = [np.linalg.norm(operator.move(np.zeros(3), np.ones(3))) for _ in range(30)]
    assert moved[19] == 0.0
    assert moved[-1] > 0.0


def test_a_look_ahead_is_a_delay_in_the_operators_loop():
    assert overshoot(0.3, 0.0) == overshoot(0.3, 0.27) == 0.0
    overshoots = [overshoot(1.5, length, duration=5.0) for length in (0.0, 0.1, 0.2, 0.3)]
    assert overshoots == sorted(overshoots)
    assert overshoots[0] > 0.0


def test_a_step_response_is_read_off_a_course():
    progress = np.linspace(0.0, 1.0, 2001)
    time = np.maximum(20.0 * progress - 6.0, 0.0)
    wanted = np.outer(progress >= 0.3, [0.0, 0.0, 0.06])
    along = 0.06 * (1.0 - np.exp(-time / 0.5) * np.cos(4.0 * time))
    across = 0.01 * time * np.exp(-time)
    course = Course(progress, wanted, np.column_stack([across, np.zeros(2001), along]))
    response = step_response(course)
    assert response.overshoot == pytest.approx(along.max() - 0.06)
    assert response.sideways == pytest.approx(0.01 * np.exp(-1.0), rel=1e-3)
    late = np.abs(along - 0.06) > 0.003
    assert response.settling == pytest.approx(time[np.flatnonzero(late)[-1]], abs=0.02)
    still = step_response(replace(course, offset=wanted))
    assert (still.overshoot, still.sideways, still.settling) == (0.0, 0.0, 0.0)


SIMULATED = {"via-points", "obstacle", "table", "dishwasher", "initial-poses", "slow-adaptation"}
"""Minutes each: the laws that they rest on are tested above and beside, and one condition of one scene below."""


SHORT = {
    "dmp._GRID": 1,  # six models at nine places take minutes
    "dmp.DURATION_S": 3.0,
    "next_waypoint._DURATION": 3.0,
}
"""Sizes of the analyses that follow: enough to find numbers."""


@pytest.mark.sim
@pytest.mark.parametrize("name", [one.name for one in ANALYSES if one.name not in SIMULATED])
def test_an_analysis_finds_numbers_and_draws_them(name, monkeypatch):
    for size, value in SHORT.items():
        monkeypatch.setattr(f"services.reproduction.analyses.{size}", value)
    shares = []
    found = analysis(name).run(Context(0, shares.append))
    assert found.rows
    assert all(figure.image.startswith(b"<?xml") for figure in found.figures)
    assert len({figure.name for figure in found.figures}) == len(found.figures) > 0
    values = [v for row in found.rows for v in (row.thesis, *row.values.values()) if isinstance(v, float)]
    assert np.all(np.isfinite(values))
    assert np.all(np.isfinite([figure for claim in found.claims for figure in (claim.value, claim.bound)]))
    assert all(claim.sentence.endswith(".") for claim in found.claims)
    assert {name for row in found.rows for name in row.values} <= BY_NAME.keys()
    assert sorted(shares) == shares


@pytest.mark.sim
@pytest.mark.parametrize("name", ["planes", "time-warping"])
def test_an_analysis_depends_on_nothing_but_the_code_and_the_seed(name):
    first, again, other = (analysis(name).run(Context(seed, illustrated=False)) for seed in (0, 0, 1))
    assert first == again
    assert first.rows != other.rows
    assert [claim.sentence for claim in first.claims] == [claim.sentence for claim in other.claims]


@pytest.mark.sim
def test_every_model_is_taught_the_same_condition_by_the_same_person(hurried):
    shown, asked = (Arrangement("free", condition=place) for place in ((0.0, 0.0), (0.1, 0.1)))
    answer = answered(Question(PARTICLE, (shown,), (asked,), ()), Context(0, illustrated=False))
    assert answer.rounds.keys() == BY_NAME.keys()
    for contender in BY_NAME.values():
        (course,) = answer.first(contender)
        # From one demonstration nobody knows that the via-points have moved; from one correction everybody does.
        assert course.needed_refinement
        assert course.updates == 1
        assert course.success


def analysis(name):
    (found,) = (a for a in ANALYSES if a.name == name)
    return found
