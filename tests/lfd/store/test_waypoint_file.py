"""A file of waypoints: read as written, or one line that says what is wrong and where."""

from pathlib import Path

import numpy as np
import pytest

from lfd.exceptions import TableError
from lfd.store.waypoint_file import Surroundings, read_waypoints

AROUND = Surroundings(np.full(3, -1.0), np.full(3, 1.0), np.array((0.8, 0.05, 0.5)))
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
    waypoints = read_waypoints(write(HEADER, *ROWS), AROUND)
    np.testing.assert_array_equal(waypoints.positions, [[0.5, 0.0, 0.4], [0.6, 0.1, 0.5], [0.8, 0.05, 0.5]])
    np.testing.assert_array_equal(waypoints.orientations, [[1, 0, 0, 0], [0.8, 0, 0.6, 0], [0, 0, 1, 0]])


def test_what_the_gripper_does_from_each_on_is_a_column_that_may_be_there(write):
    rows = [f"{row},{opening}" for row, opening in zip(ROWS, ("0.08", "0.08", "0"), strict=True)]
    np.testing.assert_array_equal(read_waypoints(write(f"{HEADER},opening", *rows), AROUND).opening, [0.08, 0.08, 0.0])
    assert read_waypoints(write(HEADER, *ROWS), AROUND).opening is None


def test_columns_are_found_by_name_among_others_however_they_are_spaced(write):
    plain = read_waypoints(write(HEADER, *ROWS), AROUND)
    cells = [row.split(",") for row in ROWS]
    lines = [f"7.5, {qw}, {x}, {y}, {z}, {', '.join(vector)}, here" for x, y, z, qw, *vector in cells]
    other = read_waypoints(write("t, qw, x, y, z, qx, qy, qz, note", "", *lines, ""), AROUND)
    np.testing.assert_array_equal(other.positions, plain.positions)
    np.testing.assert_array_equal(other.orientations, plain.orientations)


def with_commas(line):
    """As a spreadsheet writes it where decimals are marked by commas."""
    return line.replace(",", ";").replace(".", ",")


QUOTED = tuple(",".join(f'"{cell.replace(".", ",")}"' for cell in row.split(",")) for row in ROWS)


@pytest.mark.parametrize(
    "lines",
    [
        (HEADER, *ROWS, ",,,,,,", ",,,,,,", ""),
        (f"{HEADER},,,", *(f"{row},,," for row in ROWS)),
        ("", "", HEADER, "", *ROWS),
        (with_commas(HEADER), *map(with_commas, ROWS)),
        ("sep=;", with_commas(HEADER), *map(with_commas, ROWS)),
        (HEADER.replace(",", "\t"), *(row.replace(",", "\t") for row in ROWS)),
        (HEADER.replace(",", "  "), *(row.replace(",", "  ") for row in ROWS)),
        (HEADER.replace(",", "|"), *(row.replace(",", "|") for row in ROWS)),
        (HEADER, *QUOTED),
        (" X , Y,Z,Qw,QX, qy,qz", *ROWS),
        ("x [m],y (m),z[m],qw,qx,qy,qz [-]".replace(" [-]", ""), *ROWS),
        (f"# {HEADER}", *ROWS[:2], "# nearly there", ROWS[2]),
    ],
)
def test_a_table_is_read_whichever_way_it_is_written(write, lines):
    plain, other = read_waypoints(write(HEADER, *ROWS), AROUND), read_waypoints(write(*lines), AROUND)
    np.testing.assert_array_equal(other.positions, plain.positions)
    np.testing.assert_array_equal(other.orientations, plain.orientations)


@pytest.mark.parametrize("encoding", ["utf-8", "utf-8-sig", "utf-16", "utf-16-le", "utf-16-be", "latin-1"])
@pytest.mark.parametrize("end", ["\n", "\r\n", "\r"])
def test_a_table_is_read_whichever_way_its_letters_are_encoded(tmp_path, encoding, end):
    path = tmp_path / "reach.csv"
    lines = (f"{HEADER},note", *(f"{row},Höhe" for row in ROWS))
    path.write_bytes(end.join(lines).encode(encoding))
    assert read_waypoints(path, AROUND).positions.tolist()[2] == [0.8, 0.05, 0.5]


def test_a_typographical_minus_is_a_minus(write):
    assert read_waypoints(write(HEADER, "0.5,\u22120.1,0.4,1,0,0,0", *ROWS[1:]), AROUND).positions[0, 1] == -0.1


def test_quaternions_that_were_rounded_to_two_decimals_are_made_unit(write):
    rounded = read_waypoints(write(HEADER, "0.5,0,0.4,0.7,0,0.7,0", *ROWS[1:]), AROUND)
    np.testing.assert_allclose(np.linalg.norm(rounded.orientations, axis=1), 1.0, atol=1e-15)


@pytest.mark.parametrize(("unit", "count"), [("millimetres", 1000.0), ("centimetres", 100.0), ("inches", 1.0 / 0.0254)])
def test_numbers_in_another_unit_are_refused_by_the_line_and_what_would_be_right(write, unit, count):
    lines = [",".join([*(f"{float(cell) * count:g}" for cell in row.split(",")[:3]), "1,0,0,0"]) for row in ROWS]
    with pytest.raises(TableError, match=rf"line 2, column x: .*looks like {unit}: write metres, 0\.5\d* for"):
        read_waypoints(write(HEADER, *lines), AROUND)


def test_a_number_that_is_out_of_reach_in_any_unit_is_not_explained(write):
    with pytest.raises(TableError, match=r"line 3, column z: 7 m is out of the robot's reach, -1 to 1 m$"):
        read_waypoints(write(HEADER, ROWS[0], "0.6,0.1,7,1,0,0,0", ROWS[2]), AROUND)


@pytest.mark.parametrize(
    ("lines", "said"),
    [
        ((), ("the file is empty", HEADER)),
        (("", " ", ""), ("the file is empty", HEADER)),
        ((",,,",), ("the file is empty", HEADER)),
        (("a,b,c", *ROWS), ("line 1", "no column x, y, z, qw, qx, qy, qz", HEADER)),
        (ROWS, ("line 1", "no column x", "these are numbers", HEADER)),
        (("x,y,z,qx,qy,qz", *ROWS), ("no column qw", HEADER)),
        ((HEADER.replace(",", ";"), *ROWS), ("line 2", "by commas, the first one by semicolons")),
        ((HEADER, "0,50,0,1,0,0,0,0,60,0,0,0", *ROWS), ("line 2", "12 cell(s) under 7 columns", "decimal commas")),
        ((HEADER + ",x", *(f"{row},0" for row in ROWS)), ("column x is there twice",)),
        ((HEADER.replace("y", "y [mm]", 1), *ROWS), ("column y is in 'mm'", "give m")),
        ((HEADER, *ROWS, "0_8,0,0.5,1,0,0,0"), ("line 5", "'0_8'")),
        ((HEADER, *ROWS, '"1.234,5",0,0.5,1,0,0,0'), ("line 5", "'1.234,5'", "thousands")),
        ((HEADER, *ROWS, "800 mm,0,0.5,1,0,0,0"), ("line 5", "'800 mm'", "the number alone")),
        ((HEADER, *ROWS, "0.8,0,0.5,1,0,0,0,late"), ("line 5", "8 cell(s) under 7 columns", "name the others")),
        ((HEADER, *ROWS, "1e999,0,0.5,1,0,0,0"), ("line 5", "'1e999' is not a number")),
        ((HEADER, *ROWS, '"' + "z" * 9999), ("line 5", "...")),
        ((HEADER, *[ROWS[0]] * 1001), ("1001 row(s)", "at most 1000")),
        ((HEADER, *[ROWS[0]] * 3), ("all 3 waypoints are the same point",)),
        ((HEADER, *reversed(ROWS)), ("line 4", "away from the object", "reversed")),
        ((HEADER, ROWS[0], "0.6,-1.2,0.5,1,0,0,0", ROWS[2]), ("line 3, column y", "-1.2 m", "-1 to 1 m")),
        ((HEADER,), ("0 row(s)", "at least 3")),
        ((HEADER, *ROWS[:2]), ("2 row(s)", "at least 3")),
        ((HEADER, ROWS[0], "0.6,left,0.5,1,0,0,0", ROWS[2]), ("line 3", "column y", "'left'")),
        ((HEADER, *ROWS[:2], "0.8,0,0.5,1,0,0"), ("line 4", "column qz", "''")),
        ((HEADER, "nan,0,0.5,1,0,0,0", *ROWS), ("line 2", "column x", "'nan'", "leave the line out")),
        ((HEADER, *ROWS, "0.8,0,0.5,1,0,inf,0"), ("line 5", "column qy", "'inf'")),
        ((HEADER, ROWS[0], "0.6,0,0.5,1,1,0,0", ROWS[2]), ("line 3", "norm 1.41421")),
        ((HEADER, ROWS[0], "0.6,0,0.5,0,0,0,0", ROWS[2]), ("line 3", "norm 0")),
        ((HEADER, "0.6,\x00,0.5,1,0,0,0", *ROWS), ("column y",)),
    ],
)
def test_what_is_wrong_is_named_with_its_place_in_one_line(write, lines, said):
    path = write(*lines)
    with pytest.raises(TableError) as caught:
        read_waypoints(path, AROUND)
    for words in (str(path), *said):
        assert words in str(caught.value)
    assert "\n" not in str(caught.value)


def test_a_file_that_is_not_there_or_no_text_is_named(tmp_path):
    with pytest.raises(TableError, match=r"absent\.csv: No such file"):
        read_waypoints(tmp_path / "absent.csv", AROUND)
    with pytest.raises(TableError, match="directory"):
        read_waypoints(tmp_path, AROUND)
    (tmp_path / "picture.csv").write_bytes(b"\x89PNG\r\n\x1a\n\x00\xff\xfe")
    with pytest.raises(TableError, match=r"picture\.csv: .*no text"):
        read_waypoints(tmp_path / "picture.csv", AROUND)
    with pytest.raises(TableError, match="larger than 1 MiB"):
        read_waypoints(Path("/dev/zero"), AROUND)
