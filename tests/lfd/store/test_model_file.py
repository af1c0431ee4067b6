import json
from dataclasses import replace

import numpy as np
import pytest

from lfd.exceptions import StorageError
from lfd.models.adaptive.adaptation import AdaptiveOptions, AdaptiveProMP
from lfd.models.adaptive.correction import CorrectionOptions
from lfd.models.promp import ConditionedProMP
from lfd.motion.demonstration import Demonstration, Provenance
from lfd.store.model_file import load, save

PLACES = [[0.9, 0.3, 0.6], [0.85, 0.05, 0.62], [0.92, -0.3, 0.58]]


@pytest.mark.parametrize("kind", [AdaptiveProMP, ConditionedProMP])
def test_a_loaded_model_predicts_and_learns_as_the_saved_one(tmp_path, reach, kind):
    model = kind.fit([reach(place) for place in PLACES])
    for bend in (0.2, -0.1):
        model = model.updated(reach([0.9, 0.1, 0.6], bend=bend))
    save(model, tmp_path / "model.npz")
    loaded = load(tmp_path / "model.npz")
    wanted = reach([0.88, 0.0, 0.6]).situation
    for a, b in ((model, loaded), (model.updated(reach(PLACES[0])), loaded.updated(reach(PLACES[0])))):
        there, back = a.predict(wanted), b.predict(wanted)
        np.testing.assert_allclose(back.trajectory.positions, there.trajectory.positions, atol=1e-12)
        np.testing.assert_allclose(back.position_covariances, there.position_covariances, atol=1e-12)


@pytest.mark.parametrize("kind", [AdaptiveProMP, ConditionedProMP])
def test_what_the_gripper_does_is_loaded_as_it_was_saved(tmp_path, reach, kind):
    def grasping(place, at):
        shown = reach(place)
        opening = np.where(shown.trajectory.phases < at, 0.08, 0.01)
        return replace(shown, trajectory=replace(shown.trajectory, opening=opening))

    model = kind.fit([grasping(place, 0.8) for place in PLACES]).updated(grasping(PLACES[0], 0.6))
    loaded, wanted = there_and_back(model, tmp_path / "model.npz"), reach([0.88, 0.0, 0.6]).situation
    for a, b in ((model, loaded), (model.updated(grasping(PLACES[0], 0.7)), loaded.updated(grasping(PLACES[0], 0.7)))):
        np.testing.assert_array_equal(b.predict(wanted).trajectory.opening, a.predict(wanted).trajectory.opening)


def test_a_file_from_before_there_was_a_gripper_is_read(tmp_path, reach):
    model, path = AdaptiveProMP.fit([reach(place) for place in PLACES]), tmp_path / "model.npz"
    save(model, path)
    with np.load(path) as file:
        content = dict(file)
    header = json.loads(content["header"].tobytes()) | {"format": "retouch-model/4"}
    np.savez(path, **(content | {"header": np.frombuffer(json.dumps(header).encode(), dtype=np.uint8)}))
    same_prediction(model, load(path), reach([0.88, 0.0, 0.6]).situation)


def there_and_back(model, path):
    save(model, path)
    return load(path)


def same_prediction(model, loaded, wanted):
    there, back = model.predict(wanted), loaded.predict(wanted)
    np.testing.assert_allclose(back.trajectory.positions, there.trajectory.positions, atol=1e-12)
    np.testing.assert_allclose(back.position_covariances, there.position_covariances, atol=1e-12)
    assert (back.known, back.way) == (there.known, there.way)


def test_corrections_that_there_was_no_room_for_can_still_be_taken_back(tmp_path, reach):
    options = AdaptiveOptions(correction=CorrectionOptions(most=2))
    states = [AdaptiveProMP.fit([reach(place) for place in PLACES], options)]
    for i, bend in enumerate((0.2, -0.1, 0.15, -0.2)):
        states.append(states[-1].updated(reach([0.9, 0.1 * i, 0.6], bend=bend)))
    loaded = there_and_back(states[-1], tmp_path / "model.npz")
    for before in (states[3], states[2]):
        loaded = loaded.undone()
        same_prediction(before, loaded, reach([0.88, 0.0, 0.6]).situation)


def test_times_of_corrections_are_kept_and_so_is_that_there_is_none(tmp_path, reach):
    options = AdaptiveOptions(correction=CorrectionOptions(half_life_s=3600.0))
    model = AdaptiveProMP.fit([reach(place) for place in PLACES], options)
    for at_s, y in ((1e9, 0.0), (None, 0.1), (1e9 + 7200.0, 0.2)):
        told = replace(reach([0.9, y, 0.6], bend=0.2), provenance=Provenance(at_s=at_s))
        model = model.updated(told)
    loaded = there_and_back(model, tmp_path / "model.npz")
    assert [c.at_s for c in loaded.corrections.held] == [1e9, None, 1e9 + 7200.0]
    assert loaded.options == options
    same_prediction(model, loaded, reach([0.88, 0.0, 0.6]).situation)


def test_a_dimension_without_a_unit_and_one_that_does_not_matter_stay_so(tmp_path, reach):
    """Ten places on a line; the second number never varied, the third is noise."""
    rng = np.random.default_rng(4)
    demonstrations = []
    for y in np.linspace(-0.3, 0.3, 10):
        one = reach([0.9, y, 0.6], bend=y**2)
        demonstrations.append(Demonstration(one.trajectory, one.origin, np.array([y, 3.0, rng.normal()])))
    model = AdaptiveProMP.fit(demonstrations)
    loaded = there_and_back(model, tmp_path / "model.npz")
    scale, again = model.corrections.regression.scale, loaded.corrections.regression.scale
    for name in ("centre", "unit", "lengths", "relevance"):
        np.testing.assert_array_equal(getattr(again, name), getattr(scale, name))
    assert np.isinf(again.unit[1])
    for condition in ([0.1, 3.0, 0.0], [0.1, 4.0, 0.0]):
        wanted = replace(demonstrations[0].situation, condition=np.array(condition))
        same_prediction(model, loaded, wanted)


def test_a_model_is_replaced_whole_and_nothing_is_left_beside_it(tmp_path, reach):
    path = tmp_path / "model.npz"
    for place in PLACES:
        save(AdaptiveProMP.fit([reach(place)]), path)
    assert [p.name for p in tmp_path.iterdir()] == ["model.npz"]


def test_what_is_no_model_is_refused_in_one_line(tmp_path, reach):
    path = tmp_path / "model.npz"
    with pytest.raises(StorageError, match="cannot be read"):
        load(path)
    for content in (b"", b"PK\x03\x04 nothing", b"no zip at all"):
        path.write_bytes(content)
        with pytest.raises(StorageError, match="not a model"):
            load(path)
    save(AdaptiveProMP.fit([reach(PLACES[0])]), path)
    whole = path.read_bytes()
    path.write_bytes(whole[: len(whole) // 2])
    with pytest.raises(StorageError, match="not a model"):
        load(path)
    with pytest.raises(StorageError, match="cannot be written"):
        save(AdaptiveProMP.fit([reach(PLACES[0])]), tmp_path / "missing" / "model.npz")


def altered(path, alter):
    """The file, its options altered."""
    with np.load(path) as file:
        content = dict(file)
    header = json.loads(content["header"].tobytes())
    alter(header["options"]["correction"])
    np.savez(path, **(content | {"header": np.frombuffer(json.dumps(header).encode(), dtype=np.uint8)}))


def test_a_model_that_was_saved_before_there_was_an_option_has_its_default(tmp_path, reach):
    path = tmp_path / "model.npz"
    model = AdaptiveProMP.fit([reach(PLACES[0])])
    save(model, path)
    altered(path, lambda options: options.pop("drift"))
    assert load(path).options == model.options


def test_an_option_that_there_is_not_is_refused(tmp_path, reach):
    path = tmp_path / "model.npz"
    save(AdaptiveProMP.fit([reach(PLACES[0])]), path)
    altered(path, lambda options: options.update(other=1.0))
    with pytest.raises(StorageError, match="not a model"):
        load(path)


def test_nothing_in_the_file_is_executed(tmp_path):
    path = tmp_path / "model.npz"
    np.savez(path, header=np.array([{"format": "retouch-model/1"}], dtype=object))
    with pytest.raises(StorageError, match="not a model"):
        load(path)
