"""A recorded motion is read as written, or one line says what is wrong with its file, where, and what is right."""

import numpy as np
import pytest

from lfd.exceptions import LfdError, TableError
from lfd.motion.provenance import Provenance
from lfd.motion.recording import demonstration_from_arrays
from lfd.store.recording_file import read_demonstration, read_recording
from tests import recordings as recorded

HEADER = "t,x,y,z,qw,qx,qy,qz,place"
ROWS = ("0,0.5,0.0,0.4,1,0,0,0,7", "0.5,0.6,0.1,0.5,0.8,0,0.6,0,7.5", "1.5,0.8,0.05,0.5,0,0,1,0,8")


@pytest.fixture
def write(tmp_path):
    def write_(*lines, encoding="utf-8"):
        path = tmp_path / "motion.csv"
        path.write_text("\n".join(lines), encoding=encoding)
        return path

    return write_


def test_columns_become_arrays(write):
    recording = read_recording(write(HEADER, *ROWS), ["Place"])
    np.testing.assert_array_equal(recording.times, [0.0, 0.5, 1.5])
    np.testing.assert_array_equal(recording.positions, [[0.5, 0.0, 0.4], [0.6, 0.1, 0.5], [0.8, 0.05, 0.5]])
    np.testing.assert_array_equal(recording.orientations, [[1, 0, 0, 0], [0.8, 0, 0.6, 0], [0, 0, 1, 0]])
    np.testing.assert_array_equal(recording.others, [[7.0], [7.5], [8.0]])


@pytest.mark.parametrize("axes", ["x", "x,y", "x,y,z"])
def test_a_motion_has_as_many_axes_as_the_file_names(write, axes):
    columns = f"t,{axes}".split(",")
    picked = [0, *range(1, len(columns))]
    lines = [",".join(row.split(",")[i] for i in picked) for row in ROWS]
    recording = read_recording(write(",".join(columns), *lines))
    assert recording.positions.shape == (3, len(columns) - 1)
    assert recording.orientations is None


@pytest.mark.parametrize(
    ("separator", "decimal", "encoding"),
    [
        (",", ".", "utf-8-sig"),
        (";", ",", "latin-1"),
        ("\t", ".", "utf-16"),
        (";", ",", "utf-16-le"),
        ("|", ".", "utf-8"),
    ],
)
def test_a_file_is_read_whichever_way_it_is_written(write, separator, decimal, encoding):
    plain = read_recording(write(HEADER, *ROWS), ["place"])
    lines = [row.replace(",", separator).replace(".", decimal) for row in (HEADER, *ROWS)]
    other = read_recording(write(*lines, separator * 8, "", encoding=encoding), ["place"])
    for name in ("times", "positions", "orientations", "others"):
        np.testing.assert_array_equal(getattr(other, name), getattr(plain, name))


def test_a_demonstration_from_a_file_is_the_one_from_its_arrays(write):
    path, whose = write(HEADER, *ROWS), Provenance("anna", 4.0, 0.5)
    recording = read_recording(path)
    made = demonstration_from_arrays(
        recording.times, recording.positions, [7.0], recording.orientations, [1.0, 2.0, 3.0], provenance=whose
    )
    for read in (
        read_demonstration(path, 7, origin=[1.0, 2.0, 3.0], provenance=whose),
        read_demonstration(path, condition_columns=["place"], origin=[1.0, 2.0, 3.0], provenance=whose),
    ):
        np.testing.assert_array_equal(read.trajectory.positions, made.trajectory.positions)
        np.testing.assert_array_equal(read.trajectory.orientations, made.trajectory.orientations)
        np.testing.assert_array_equal(read.condition, made.condition)
        np.testing.assert_array_equal(read.origin, made.origin)
        assert read.provenance == whose


def test_how_far_the_gripper_is_open_is_a_column_that_may_be_there(write):
    rows = ("0.0,0.1,0.08", "0.1,0.2,0.08", "0.2,0.3,0")
    read = read_demonstration(write("t,x,opening [m]", *rows), 7)
    np.testing.assert_array_equal(read.trajectory.opening, [0.08, 0.08, 0.0])
    assert read_demonstration(write("t,x", "0,1", "1,2"), 7).trajectory.opening is None


@pytest.mark.parametrize(("cell", "said"), [("80", "write metres, 0.08"), ("-0.01", "0 is closed"), ("open", "number")])
def test_what_is_no_opening_of_a_gripper_is_named(write, cell, said):
    with pytest.raises(TableError, match=said) as caught:
        read_recording(write("t,x,opening", "0,0.1,0", f"1,0.2,{cell}"))
    assert (caught.value.line, caught.value.column) == (3, "opening")


def test_a_demonstration_without_a_condition_is_refused(write):
    with pytest.raises(LfdError, match="condition"):
        read_demonstration(write(HEADER, *ROWS))


@pytest.mark.parametrize(
    ("lines", "facts", "said"),
    [
        ((), (None, None, None), ("empty", "t,x")),
        ((HEADER,), (None, None, None), ("0 sample(s)", "at least 2")),
        ((HEADER, ROWS[0]), (None, None, None), ("1 sample(s)",)),
        (ROWS, (1, None, None), ("no column t, x", "these are numbers", "t,x")),
        (("time,x,y", "0,1,2"), (1, None, None), ("no column t;", "t,x")),
        (("t,x,z", "0,1,2"), (None, None, None), ("z without y",)),
        (("t,x,qw,qx,qy", "0,1,1,0,0"), (None, None, None), ("no column qz beside qw, qx, qy",)),
        (("t [ms],x", "0,1"), (1, None, None), ("column t is in 'ms'", "give s")),
        (("t,x [mm]", "0,1"), (1, None, None), ("column x is in 'mm'", "give m")),
        ((HEADER, ROWS[0], "0.5,left,0,0.4,1,0,0,0,7"), (3, "x", "left"), ("'left' is not a number",)),
        ((HEADER, ROWS[0], "0.5,0.6,0,0.4,1,0,0,0,here"), (3, "place", "here"), ("'here' is not a number",)),
        ((HEADER, ROWS[0], "0.5,0.6,0"), (3, "z", ""), ("the line has too few",)),
        ((HEADER, ROWS[0], f"{ROWS[1]},5"), (3, None, None), ("10 cell(s) under 9 columns",)),
        ((HEADER, ROWS[0], "0,5,0,6,0,1,0,5,0,8,0,0,6,0,7"), (3, None, None), ("decimal commas", "semicolons")),
        ((HEADER, ROWS[0], ROWS[0]), (3, "t", "0"), ("0 s repeats 0 s of line 2", "leave one of them out")),
        ((HEADER, *ROWS[:2], ROWS[0]), (4, "t", "0"), ("0 s follows 0.5 s of line 3", "order the lines")),
        ((HEADER, ROWS[0], ROWS[1].replace("0.5", "5000", 1)), (3, "t", "5000"), ("milliseconds", "write seconds")),
        (("t,x,y", "0,1,412.5", "1,1,412"), (2, "y", "412.5"), ("millimetres", "0.4125 for 412.5")),
        ((HEADER, ROWS[0], ROWS[1].replace("0.8", "0.7")), (3, None, None), ("norm 0.92", "not 1")),
    ],
)
def test_what_is_wrong_is_named_with_its_place_and_what_would_be_right(write, lines, facts, said):
    path = write(*lines)
    with pytest.raises(TableError) as caught:
        read_recording(path, ["place"] if lines and lines[0] == HEADER else [])
    assert (caught.value.line, caught.value.column, caught.value.value) == facts
    for words in (str(path), *said):
        assert words in str(caught.value)
    assert "\n" not in str(caught.value)


def test_what_is_expected_can_be_widened(write):
    path = write("t,x", "0,1", "7200,50")
    assert read_recording(path, largest_m=100.0, largest_s=1e4).positions[1, 0] == 50.0


@pytest.mark.data
def test_recordings_of_people_are_read_as_they_are():
    """Every sample of a set, the object's place as the camera saw it before the motion."""
    files = sorted((recorded.FOLDER / "demonstrations").glob("*/*.csv"))
    if not files:
        pytest.skip(f"the recordings are not at {recorded.FOLDER}")
    for path in files[::12]:
        read = read_recording(path, ["object_x", "object_y", "object_z"])
        expected = recorded.demonstration(path)
        np.testing.assert_allclose(read.others[0] - read.positions[0], expected.condition, atol=1e-12)
        assert read.times[-1] - read.times[0] == pytest.approx(expected.trajectory.duration)
