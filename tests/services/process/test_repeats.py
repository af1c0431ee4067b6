"""A line that comes again and again is told a few times, then counted."""

from services.process.repeats import KINDS_KEPT, MOST, WHILE_S, Repeats

LOST = "the authority was lost"


def test_of_one_kind_a_few_lines_are_told_and_the_rest_is_counted_once():
    repeats = Repeats()
    told = [repeats.told(LOST, 0.1 * second) for second in range(265)]
    assert [lines for lines in told if lines] == [(LOST,)] * MOST
    assert repeats.due(WHILE_S) == (f"{265 - MOST} more like this in 60 s: {LOST}",)
    assert repeats.due(WHILE_S) == ()


def test_another_kind_is_told_all_the_same_and_after_a_while_this_one_again():
    repeats = Repeats()
    for _ in range(50):
        repeats.told(LOST, 0.0)
    assert repeats.told("nothing is recorded", 1.0) == ("nothing is recorded",)
    assert repeats.told(LOST, WHILE_S) == (f"{50 - MOST} more like this in 60 s: {LOST}", LOST)


def test_lines_that_differ_in_figures_only_are_of_one_kind():
    repeats = Repeats()
    told = [repeats.told(f"refused: epoch {number} is old", 0.0) for number in range(9)]
    assert sum(map(len, told)) == MOST
    assert repeats.rest() == (f"{9 - MOST} more like this in 60 s: refused: epoch 8 is old",)


def test_what_comes_seldom_is_told_each_time():
    repeats = Repeats()
    assert all(repeats.told(LOST, WHILE_S * minute) == (LOST,) for minute in range(9))
    assert repeats.rest() == ()


def test_any_number_of_kinds_is_told_and_few_are_kept():
    repeats = Repeats()
    names = ["x" * (number + 1) for number in range(3 * KINDS_KEPT)]
    assert all(repeats.told(name, 0.0) == (name,) for name in names)
    assert len(repeats._kinds) <= KINDS_KEPT
