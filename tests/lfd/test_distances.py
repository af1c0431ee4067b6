import numpy as np

from lfd.distances import squared_distances


def test_every_point_is_compared_with_every_other(rng):
    a, b = rng.normal(size=(4, 3)), rng.normal(size=(5, 3))
    wanted = [[np.linalg.norm(x - y) ** 2 for y in b] for x in a]
    np.testing.assert_allclose(squared_distances(a, b), wanted, rtol=1e-12)


def test_a_point_is_at_no_distance_from_itself(rng):
    points = 1e3 + rng.normal(size=(6, 2))
    assert not np.diagonal(squared_distances(points, points)).any()


def test_where_there_are_no_points_there_are_no_distances():
    assert squared_distances(np.empty((0, 3)), np.ones((2, 3))).shape == (0, 2)
