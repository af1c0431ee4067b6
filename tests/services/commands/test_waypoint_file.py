"""A file of waypoints: read as written, or one line that says what is wrong and where."""

import numpy as np
import pytest

from services.cli import parser
from services.commands.waypoint_file import read_waypoints
from services.process.exceptions import WaypointFileError

HEADER = "x,y,z,qw,qx,qy,qz"
ROWS = ("0.5,0.0,0.4,1,0,0,0", "0.6,0.1,0.5,0.8,0,0.6,0", "0.8,0.05,0.5,0,0,1,0")


@pytest.fixture
def write(tmp_path):
    def write_(*lines, encoding="utf-8"):
        path = tmp_path / "reach.csv"
        path.write_text("\n".join(lines), encoding=encoding)
        return path

    return write_


def test_rows_become_positions_and_quaternions_in_their_order(write):
    waypoints = read_waypoints(write(HEADER, *ROWS))
    np.testing.assert_array_equal(waypoints.positions, [[0.5, 0.0, 0.4], [0.6, 0.1, 0.5], [0.8, 0.05, 0.5]])
    np.testing.assert_array_equal(waypoints.orientations, [[1, 0, 0, 0], [0.8, 0, 0.6, 0], [0, 0, 1, 0]])


def test_columns_are_found_by_name_among_others_however_they_are_spaced(write):
    plain = read_waypoints(write(HEADER, *ROWS))
    cells = [row.split(",") for row in ROWS]
    lines = [f"7.5, {qw}, {x}, {y}, {z}, {', '.join(vector)}, here" for x, y, z, qw, *vector in cells]
    other = read_waypoints(write("t, qw, x, y, z, qx, qy, qz, note", "", *lines, ""))
    np.testing.assert_array_equal(other.positions, plain.positions)
    np.testing.assert_array_equal(other.orientations, plain.orientations)


def test_a_spreadsheets_byte_order_mark_is_no_part_of_the_first_name(write):
    assert len(read_waypoints(write(HEADER, *ROWS, encoding="utf-8-sig")).positions) == 3


@pytest.mark.parametrize(
    ("lines", "said"),
    [
        ((), ("no column x, y, z, qw, qx, qy, qz", HEADER)),
        (ROWS, ("no column x", HEADER)),
        (("x,y,z,qx,qy,qz", *ROWS), ("no column qw", HEADER)),
        ((HEADER.replace(",", ";"), *ROWS), ("no column x", HEADER)),
        ((HEADER,), ("0 row(s)", "at least 3")),
        ((HEADER, *ROWS[:2]), ("2 row(s)", "at least 3")),
        ((HEADER, ROWS[0], "0.6,left,0.5,1,0,0,0", ROWS[2]), ("line 3", "column y", "'left'")),
        ((HEADER, *ROWS[:2], "0.8,0,0.5,1,0,0"), ("line 4", "column qz", "''")),
        ((HEADER, "nan,0,0.5,1,0,0,0", *ROWS), ("line 2", "column x", "'nan'")),
        ((HEADER, *ROWS, "0.8,0,0.5,1,0,inf,0"), ("line 5", "column qy", "'inf'")),
        ((HEADER, ROWS[0], "0.6,0,0.5,1,1,0,0", ROWS[2]), ("line 3", "norm 1.41421")),
        ((HEADER, ROWS[0], "0.6,0,0.5,0,0,0,0", ROWS[2]), ("line 3", "norm 0")),
        ((HEADER, "0.6,\x00,0.5,1,0,0,0", *ROWS), ("column y",)),
    ],
)
def test_what_is_wrong_is_named_with_its_place_in_one_line(write, lines, said):
    path = write(*lines)
    with pytest.raises(WaypointFileError) as caught:
        read_waypoints(path)
    for words in (str(path), *said):
        assert words in str(caught.value)
    assert "\n" not in str(caught.value)


def test_a_file_that_is_not_there_or_no_text_is_named(tmp_path):
    with pytest.raises(WaypointFileError, match=r"absent\.csv: No such file"):
        read_waypoints(tmp_path / "absent.csv")
    with pytest.raises(WaypointFileError, match="directory"):
        read_waypoints(tmp_path)
    (tmp_path / "picture.csv").write_bytes(b"\x89PNG\r\n\xff\xfe")
    with pytest.raises(WaypointFileError, match=r"picture\.csv: not a CSV file"):
        read_waypoints(tmp_path / "picture.csv")


@pytest.mark.parametrize("text", ["0.8,-0.1,0.5", " 0.8, -0.1, 5e-1"])
def test_the_object_is_three_numbers(text):
    assert parser().parse_args(["teach", "--object", text]).object == (0.8, -0.1, 0.5)


@pytest.mark.parametrize(
    ("flag", "text"),
    [
        *(("--object", text) for text in ("", "0.8", "0.8,0.1", "0.8,0.1,0.5,1", "0.8,here,0.5", "0.8,nan,0.5")),
        *(("--duration", text) for text in ("0", "nan", "inf", "3601", "long")),
    ],
)
def test_an_object_or_duration_that_is_none_is_named(capsys, flag, text):
    with pytest.raises(SystemExit) as caught:
        parser().parse_args(["teach", flag, text])
    (line,) = capsys.readouterr().err.splitlines()
    assert caught.value.code == 2
    assert flag in line
    assert repr(text) in line
