"""What a message echoes is shortened in the middle: its begin and its end say what is meant."""

from hypothesis import given
from hypothesis import strategies as st

from services.process.lines import LONGEST_LINE, LONGEST_WORD, one_line


def test_what_is_short_stays_as_it_is():
    assert one_line("robot 'kitchen' is not there") == "robot 'kitchen' is not there"


def test_several_lines_become_one():
    assert one_line(" two\nlines\t here ") == "two lines here"


def test_of_a_long_name_begin_and_end_are_kept_and_what_stands_around_it():
    line = one_line(f"the robot '{'a' * 1500}{'b' * 1500}' is not there")
    assert line.startswith("the robot 'aaa")
    assert line.endswith("bbb' is not there")
    assert len(line) < LONGEST_WORD + 40


@given(parts=st.lists(st.text(max_size=12), max_size=4), times=st.integers(0, 400))
def test_nothing_is_longer_than_a_line(parts, times):
    line = one_line("".join(part * times for part in parts))
    assert len(line) <= LONGEST_LINE
    assert len(line.splitlines()) <= 1
