"""A prediction that fails by when it closes the gripper, one correction of that moment alone, and the next ones."""

from dataclasses import replace

import numpy as np
import pytest

from lfd.models.adaptive.adaptation import AdaptiveProMP
from lfd.motion.demonstration import Demonstration, Situation
from services.offline.first_demonstrations import first_demonstrations
from services.offline.rollout import rollout
from services.robot.assembly import simulated_arm
from sim.tasks import described, scene

pytestmark = pytest.mark.sim

TOO_EARLY = 0.4  # of a motion, by which its gripper closes before it is at the object
HERE, BESIDE = np.array([0.64, 0.09, 0.56]), np.array([0.64, 0.07, 0.56])


@pytest.fixture(scope="module")
def pick():
    return scene("pick")


def earlier(demonstration):
    motion = demonstration.trajectory
    kept = motion.opening[round(TOO_EARLY * (motion.n_points - 1)) :]
    opening = np.pad(kept, (0, motion.n_points - len(kept)), mode="edge")
    return replace(demonstration, trajectory=replace(motion, opening=opening))


def test_one_correction_of_the_moment_of_closing_is_enough(pick):
    """In the simulated world, with its contacts: there, and two centimetres beside it."""
    arm = simulated_arm(pick, pick.variants[0], described(pick))

    def predicted(model, place):
        return model.predict(Situation.reaching(place, pick.start.position, pick.start.orientation)).trajectory

    def succeeds(model, place):
        return rollout(arm, predicted(model, place), place, variant=pick.variants[0]).verdict.success

    shown = first_demonstrations(pick)
    right, wrong = AdaptiveProMP.fit(shown), AdaptiveProMP.fit([earlier(one) for one in shown])
    assert not succeeds(wrong, HERE)
    retouched = replace(predicted(wrong, HERE), opening=predicted(right, HERE).opening)
    learnt = wrong.updated(Demonstration.reaching(retouched, HERE))
    assert succeeds(learnt, HERE)
    assert succeeds(learnt, BESIDE)
