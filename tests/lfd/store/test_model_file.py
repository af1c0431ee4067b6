import numpy as np
import pytest

from lfd.exceptions import StorageError
from lfd.models.adaptive.adaptation import AdaptiveProMP
from lfd.models.promp import ConditionedProMP
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


def test_nothing_in_the_file_is_executed(tmp_path):
    path = tmp_path / "model.npz"
    np.savez(path, header=np.array([{"format": "retouch-model/1"}], dtype=object))
    with pytest.raises(StorageError, match="not a model"):
        load(path)
