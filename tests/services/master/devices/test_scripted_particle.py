"""The scripted operator leads the particle through its via-points."""

import numpy as np
import pytest

from sim.tasks import PARTICLE
from tests.services.master.devices.site import STEADY, Site, even


class ParticleSite(Site):
    """The particle, on a straight way that it has learnt for another condition."""

    scene = "particle"
    admissible = np.array(PARTICLE.freedom.axes)
    person = STEADY
    duration = 20.0
    start = PARTICLE.start

    def __init__(self, variant, condition):
        super().__init__()
        self.variant, self.condition = variant, condition
        self.prediction, self.orientations = even(PARTICLE.corridor("free", np.zeros(2)))
        self.announced = self.prediction


@pytest.mark.sim
@pytest.mark.parametrize("variant", PARTICLE.variants)
@pytest.mark.parametrize("condition", [(0.1, -0.1), (-0.1, 0.06), (0.03, 0.1), (-0.2, 0.2)])
def test_the_hand_leads_the_particle_through_its_via_points(variant, condition):
    site = ParticleSite(variant, condition)
    way = PARTICLE.corridor(variant, np.array(condition)).positions
    passed = []
    while site.progress < 1.0:
        site.tick()
        passed.append(site.robot)
    x, y, _ = np.transpose(passed)
    np.testing.assert_allclose(np.interp(PARTICLE.via_x, x, y), condition, atol=PARTICLE.tolerance)
    assert np.max(np.abs(y - np.interp(x, way[:, 0], way[:, 1]))) < 0.02
