from pathlib import Path

import mujoco
import numpy as np
import pytest
from scipy.spatial.transform import Rotation

from sim.exceptions import UnknownVariant
from sim.robots.catalogue import DEFAULT
from sim.robots.description import RobotDescription
from sim.tasks import THESIS, scene
from sim.tasks.reaching import ReachingScene
from sim.world.contacts import Contact, collisions
from sim.world.physics import CONTROL_PERIOD, World

pytestmark = pytest.mark.sim
SCENE = pytest.mark.parametrize("place", THESIS.values(), ids=THESIS)
REST = np.zeros(len(DEFAULT.joint_names))
OPEN = DEFAULT.gripper.opening


@SCENE
def test_nothing_moves_in_twenty_seconds_of_rest(place: ReachingScene, description: RobotDescription) -> None:
    world = World(place, place.variants[0], description)
    for _ in range(100):  # the object settles by a tenth of a millimetre
        world.step(place.posture, REST, OPEN)
    settled = world.observe()
    for _ in range(2000):
        world.step(place.posture, REST, OPEN)
    seen = world.observe()
    np.testing.assert_allclose(seen.object_position, settled.object_position, atol=1e-5)
    assert Rotation.from_quat(seen.object_orientation, scalar_first=True).magnitude() < 1e-3
    np.testing.assert_allclose(seen.q, place.posture, atol=1e-6)
    assert seen.contacts == ()


@SCENE
def test_the_start_is_clear_in_both_variants(place: ReachingScene, description: RobotDescription) -> None:
    world = World(place, place.variants[0], description)
    for variant in place.variants:
        world.reset(place.training_positions[0], variant)
        assert world.clearance() >= 0.03


def test_a_step_takes_one_control_period(description: RobotDescription) -> None:
    place = scene("table")
    world = World(place, "clear", description)
    world.step(place.posture, REST, OPEN)
    assert world.observe().time == pytest.approx(CONTROL_PERIOD)


def test_a_moving_reference_is_followed_without_lag(description: RobotDescription) -> None:
    place = scene("table")
    world = World(place, "clear", description)
    speed = np.array([0.01, -0.1, -0.1, 0.1, 0.1, 0.1, 0.1, -0.1])
    for tick in range(1, 101):
        world.step(place.posture + tick * CONTROL_PERIOD * speed, speed, OPEN)
    np.testing.assert_allclose(world.observe().q, place.posture + speed, atol=1e-3)


def test_a_far_reference_does_not_make_a_blocked_arm_push_hard(description: RobotDescription) -> None:
    """The reference is held a radian into the table top; unbounded servos pushed with 579 N."""
    place = scene("table")
    world = World(place, "clear", description)
    into_the_table = place.posture + np.array([-0.2, 0.0, -0.5, 0.0, 0.0, 0.0, 0.0, 0.0])
    forces = [0.0]
    for _ in range(400):
        world.step(into_the_table, REST, OPEN)
        forces += [contact.force for contact in world.observe().contacts]
    assert 1.0 < max(forces) < 200.0


def test_a_table_pushes_the_arm_that_sinks_into_it_up_and_what_is_free_is_not_pushed(
    description: RobotDescription,
) -> None:
    place = scene("table")
    world = World(place, "clear", description)
    world.step(place.posture, REST, OPEN)
    assert not world.observe().contact_force.any()
    sinking = np.array([-0.05, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0])
    for tick in range(1, 400):
        world.step(place.posture + tick * CONTROL_PERIOD * sinking, sinking, OPEN)
        seen = world.observe()
        if seen.contact_force[2] > 1.0:
            break
    assert seen.contact_force[2] > 1.0
    for contact in seen.contacts:
        assert np.linalg.norm(contact.push) == pytest.approx(contact.force)
    world.reset(place.training_positions[0])
    assert not world.observe().contact_force.any()


def test_contacts_name_link_and_box(description: RobotDescription) -> None:
    place = scene("table")
    world = World(place, "clear", description)
    sinking = np.array([-0.05, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0])
    contacts: tuple[Contact, ...] = ()
    for tick in range(1, 400):
        world.step(place.posture + tick * CONTROL_PERIOD * sinking, sinking, OPEN)
        if contacts := world.observe().contacts:
            break
    assert contacts[0].environment_geom == "table_top"
    assert contacts[0].robot_geom.startswith(("arm", "gripper", "wrist"))
    assert contacts[0].position[2] == pytest.approx(0.66, abs=0.005)


def test_whatever_was_touched_within_a_period_counts_with_its_largest_force(
    description: RobotDescription, monkeypatch: pytest.MonkeyPatch
) -> None:
    """The gripper sinks onto the table and is drawn away: what the physics' own steps saw, the period tells."""
    place = scene("table")
    world, still = World(place, "clear", description), World(place, "clear", description)
    seen: list[Contact] = []

    def stepped(model: mujoco.MjModel, data: mujoco.MjData) -> None:
        mj_step(model, data)
        seen.extend(collisions(model, data))

    mj_step = mujoco.mj_step
    monkeypatch.setattr(mujoco, "mj_step", stepped)
    sinking, q = np.array([-0.05, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0]), place.posture
    left = 0
    for tick in range(400):
        speed = sinking if tick < 260 else -4.0 * sinking
        q = q + CONTROL_PERIOD * speed
        seen.clear()
        world.step(q, speed, OPEN)
        told = {(one.robot_geom, one.environment_geom): one.force for one in world.observe().contacts}
        for one in seen:
            assert told[one.robot_geom, one.environment_geom] >= one.force
        still.set_state(world.state)
        left += bool(told) and not still.observe().contacts
    assert left > 0, "a period at whose end the gripper had left the table was told as one with a contact"


def test_a_state_can_be_carried_to_another_world(description: RobotDescription) -> None:
    place = scene("dishwasher")
    first, second = World(place, "b1", description), World(place, "b1", description)
    first.reset(place.training_positions[1])
    second.set_state(first.state)
    np.testing.assert_array_equal(second.observe().object_position, first.observe().object_position)
    np.testing.assert_array_equal(second.observe().q, first.observe().q)


def test_an_unknown_variant_is_refused(description: RobotDescription) -> None:
    place = scene("table")
    with pytest.raises(UnknownVariant, match="clear, box"):
        World(place, "b1", description)


def test_no_log_file_is_written_where_the_process_runs(
    description: RobotDescription, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.chdir(tmp_path)
    place = scene("table")
    world = World(place, "clear", description)
    broken = world.state
    broken[:] = np.nan  # MuJoCo warns of it
    world.set_state(broken)
    world.step(place.posture, REST, OPEN)
    assert list(tmp_path.iterdir()) == []
