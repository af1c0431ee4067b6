import tracemalloc
from functools import cache

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from lfd.exceptions import NotFinite, WrongShape
from lfd.motion import dtw as module
from lfd.motion.dtw import dtw


def sequences(numbers):
    return st.lists(st.tuples(numbers, numbers), min_size=1, max_size=8).map(np.array)


real = sequences(st.floats(-5, 5))
tied = sequences(st.integers(0, 2).map(float))  # whole numbers, so that many paths cost the same


@pytest.fixture(autouse=True)
def nothing_loaded():
    """Numba is not loaded yet, whichever test came before."""
    module._compiled_route.cache_clear()


def defined_distance(a, b):
    """The recursion that defines dynamic time warping."""

    @cache
    def total(i, j):
        cost = float(np.linalg.norm(a[i] - b[j]))
        before = [total(x, y) for x, y in ((i - 1, j), (i, j - 1), (i - 1, j - 1)) if x >= 0 and y >= 0]
        return cost + min(before, default=0.0)

    return total(len(a) - 1, len(b) - 1)


@given(real | tied, real | tied)
def test_distance_is_that_of_the_definition_and_of_the_path(a, b):
    alignment = dtw(a, b)
    i, j = alignment.path.T
    assert alignment.distance == pytest.approx(defined_distance(a, b), abs=1e-9)
    assert alignment.distance == pytest.approx(np.linalg.norm(a[i] - b[j], axis=1).sum(), abs=1e-9)


@given(real | tied, real | tied)
def test_path_leads_from_corner_to_corner_in_single_steps(a, b):
    path = dtw(a, b).path
    assert path[0].tolist() == [0, 0]
    assert path[-1].tolist() == [len(a) - 1, len(b) - 1]
    assert {tuple(step) for step in np.diff(path, axis=0)} <= {(0, 1), (1, 0), (1, 1)}


def test_table_d_1():
    """X over the columns, Y over the rows; each cell is the distance of what leads up to it."""
    X, Y = np.array([1.0, 2, 4, 3])[:, None], np.array([1.0, 1, 2, 4])[:, None]
    table = [[dtw(X[: i + 1], Y[: j + 1]).distance for i in range(4)] for j in range(4)]
    assert table == [[0, 1, 4, 6], [0, 1, 4, 6], [1, 0, 2, 3], [4, 2, 0, 1]]
    alignment = dtw(X, Y)
    assert alignment.distance == 1.0
    assert len(alignment.path) == 5
    assert X[alignment.path[:, 0], 0].tolist() == [1, 1, 2, 4, 3]
    assert Y[alignment.path[:, 1], 0].tolist() == [1, 1, 2, 4, 4]


@given(real, real)
def test_exchanging_the_sequences_changes_no_distance(a, b):
    assert dtw(a, b).distance == dtw(b, a).distance


@given(real)
def test_a_sequence_is_at_no_distance_from_itself_however_it_lingers(a):
    slow = np.repeat(a, 3, axis=0)
    alignment = dtw(slow, a)
    assert alignment.distance == 0.0
    np.testing.assert_array_equal(slow[alignment.path[:, 0]], a[alignment.path[:, 1]])


def assert_same(route, a, b):
    distance, steps = module._NUMPY_ROUTE.accumulate(a, np.array(b.T, order="C"))
    other_distance, other_steps = route.accumulate(a, np.array(b.T, order="C"))
    assert other_distance == distance
    np.testing.assert_array_equal(route.trace(other_steps), module._NUMPY_ROUTE.trace(steps))


@given(real | tied, real | tied)
def test_rows_and_diagonals_agree_to_the_last_bit_on_ties_too(a, b):
    assert_same(module._Route(module._accumulate_by_rows, module._trace), a, b)


@pytest.mark.parametrize("accumulate", [module._accumulate_by_rows, module._accumulate_by_diagonals])
@pytest.mark.parametrize(
    ("n", "m", "path"),
    [
        (3, 3, [[0, 0], [1, 1], [2, 2]]),
        (4, 2, [[0, 0], [1, 0], [2, 0], [3, 1]]),
        (2, 4, [[0, 0], [0, 1], [0, 2], [1, 3]]),
    ],
)
def test_of_equally_cheap_paths_the_one_is_taken_that_is_diagonal_from_the_end(accumulate, n, m, path):
    distance, steps = accumulate(np.zeros((n, 1)), np.zeros((1, m)))
    assert distance == 0.0
    assert module._trace(steps).tolist() == path


@pytest.mark.parametrize(("n", "m"), [(1, 90), (90, 1), (3, 200), (200, 3), (64, 64), (400, 5)])
def test_rows_and_diagonals_agree_when_one_sequence_is_much_longer(n, m, rng, monkeypatch):
    monkeypatch.setattr(module, "_BLOCK_CELLS", 300)
    route = module._Route(module._accumulate_by_rows, module._trace)
    assert_same(route, rng.normal(size=(n, 9)), rng.normal(size=(m, 9)))


@pytest.mark.parametrize("n", [40, 400])
def test_memory_is_a_byte_a_cell_and_a_block_of_distances_whatever_the_length(n, rng):
    """A quarter of a megabyte of distances, twice as much beside them, and less than that of masks and the like."""
    a, b = rng.normal(size=(n, 3)), rng.normal(size=(n, 3))
    tracemalloc.start()
    dtw(a, b)
    _, most = tracemalloc.get_traced_memory()
    tracemalloc.stop()
    assert most - n * n < 6 * 2**18


@pytest.mark.sim
@pytest.mark.parametrize("levels", [3, 1_000_000])
def test_what_numba_compiles_agrees_to_the_last_bit(levels, rng):
    pytest.importorskip("numba")
    a, b = (rng.integers(0, levels, size=(n, 7)) / 7.0 for n in (150, 130))
    assert_same(module._compiled_route(), a, b)


def test_a_short_alignment_needs_no_numba(monkeypatch):
    monkeypatch.setattr(module, "import_module", lambda name: pytest.fail(f"imports {name}"))
    dtw(np.zeros((75, 7)), np.ones((75, 7)))


class Compiler:
    """Stands in for Numba: gives back what it was to compile."""

    def __init__(self):
        self.kept = []

    def njit(self, signature, cache=False):
        self.kept.append(cache)
        return lambda function: function


def test_the_first_long_alignment_loads_numba_and_from_then_on_it_serves_the_short_ones_too(monkeypatch):
    """A dozen of half a million cells take as long as to load it."""
    compiler = Compiler()
    monkeypatch.setattr(module, "import_module", lambda name: compiler)
    compiled = module._Route(module._accumulate_by_rows, module._trace)
    assert module._route(499_999) == module._NUMPY_ROUTE
    assert module._route(500_000) == compiled
    assert module._route(1) == compiled
    assert compiler.kept == [True, True], "what was compiled is kept, for both functions, once"


def test_an_alignment_is_as_long_as_one_sequence_times_the_other(monkeypatch):
    cells = []
    monkeypatch.setattr(module, "_route", lambda number: cells.append(number) or module._NUMPY_ROUTE)
    dtw(np.zeros((7, 2)), np.zeros((3, 2)))
    assert cells == [21]


def test_without_numba_long_ones_are_aligned_all_the_same(monkeypatch):
    def missing(name):
        raise ImportError(name)

    monkeypatch.setattr(module, "import_module", missing)
    assert module._compiled_route.__wrapped__() is module._NUMPY_ROUTE


def test_where_no_cache_can_be_written_it_is_compiled_all_the_same():
    class ReadOnly:
        @staticmethod
        def njit(signature, cache=False):
            if cache:
                raise RuntimeError("no locator available")
            return lambda function: (signature, function)

    assert module._compiled(ReadOnly, "f8(f8)", abs) == ("f8(f8)", abs)


@pytest.mark.parametrize("shape", [(0, 2), (3, 0), (3,), (3, 2, 1)])
def test_what_is_no_sequence_of_points_is_refused(shape):
    for arguments in ((np.zeros(shape), np.zeros((3, 2))), (np.zeros((3, 2)), np.zeros(shape))):
        with pytest.raises(WrongShape):
            dtw(*arguments)


def test_points_of_different_dimension_are_refused():
    with pytest.raises(WrongShape, match="b has shape"):
        dtw(np.zeros((3, 2)), np.zeros((3, 3)))


@pytest.mark.parametrize("wrong", [np.nan, np.inf, 1e200])
def test_what_is_not_finite_is_refused(wrong):
    for arguments in (([[0.0], [wrong]], [[0.0]]), ([[0.0]], [[0.0], [wrong]])):
        with pytest.raises(NotFinite):
            dtw(*arguments)
