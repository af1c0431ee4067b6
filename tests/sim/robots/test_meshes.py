from pathlib import Path

import numpy as np
import pytest

from sim.exceptions import DescriptionInvalid
from sim.robots.meshes import read_stl, shaded, thin, write_stl

pytestmark = pytest.mark.sim


def _sphere(rings: int) -> np.ndarray:
    """A sphere of radius one, shape (n, 3, 3)."""
    polar, around = np.meshgrid(np.linspace(0, np.pi, rings), np.linspace(0, 2 * np.pi, 2 * rings), indexing="ij")
    points = np.stack([np.sin(polar) * np.cos(around), np.sin(polar) * np.sin(around), np.cos(polar)], axis=-1)
    a, b, c, d = points[:-1, :-1], points[1:, :-1], points[1:, 1:], points[:-1, 1:]
    return np.concatenate([np.stack([a, b, c], 2).reshape(-1, 3, 3), np.stack([a, c, d], 2).reshape(-1, 3, 3)]).astype(
        np.float32
    )


def test_an_stl_file_gives_back_what_was_written(tmp_path: Path) -> None:
    triangles = _sphere(8)
    write_stl(tmp_path / "sphere.stl", triangles)
    np.testing.assert_array_equal(read_stl(tmp_path / "sphere.stl"), triangles)


def test_an_stl_file_that_is_cut_short_is_refused(tmp_path: Path) -> None:
    path = tmp_path / "sphere.stl"
    write_stl(path, _sphere(8))
    path.write_bytes(path.read_bytes()[:-1])
    with pytest.raises(DescriptionInvalid, match="cut short"):
        read_stl(path)


def test_thinning_keeps_the_limit_and_the_shape() -> None:
    thinned = thin(_sphere(60), 1000)
    assert 300 < len(thinned) <= 1000
    np.testing.assert_allclose(np.linalg.norm(thinned, axis=2), 1.0, atol=0.05)


def test_a_mesh_within_the_limit_stays_as_it_is() -> None:
    triangles = _sphere(8)
    assert thin(triangles, len(triangles)) is triangles


def test_what_is_round_is_lit_as_round_and_has_each_vertex_once() -> None:
    triangles = _sphere(30)
    triangles = triangles[np.all(np.abs(triangles[..., 2]) < 0.98, axis=1)]  # at the poles some have no area
    mesh = shaded(triangles)
    assert len(mesh.vertices) < len(triangles)
    np.testing.assert_array_equal(mesh.vertices[mesh.triangles], triangles)
    np.testing.assert_allclose(np.linalg.norm(mesh.normals, axis=1), 1.0, atol=0.02)
    np.testing.assert_allclose(np.sum(mesh.normals * mesh.vertices, axis=1), 1.0, atol=0.05)


def test_an_edge_stays_an_edge() -> None:
    flat = np.array([[[0, 0, 0], [1, 0, 0], [1, 1, 0]], [[0, 0, 0], [1, 1, 0], [0, 1, 0]]], np.float32)
    upright = np.array([[[0, 0, 0], [0, 0, 1], [1, 0, 0]]], np.float32)
    mesh = shaded(np.concatenate([flat, upright]))
    np.testing.assert_array_equal(mesh.normals[mesh.triangles[:2]], np.broadcast_to([0.0, 0.0, 1.0], (2, 3, 3)))
    np.testing.assert_array_equal(mesh.normals[mesh.triangles[2]], np.broadcast_to([0.0, 1.0, 0.0], (3, 3)))
