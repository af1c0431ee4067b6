from services.robot.latch import Latch


def test_the_emergency_stop_latches_with_its_first_author():
    latch = Latch().pressed("ann", "smoke", "8:00").pressed("bob", "", "8:01")
    assert (latch.latched, str(latch), latch.at) == (True, "emergency stop by ann: smoke", "8:00")


def test_a_stop_without_a_reason_names_who_pressed():
    assert str(Latch().pressed("ann", "", "8:00")) == "emergency stop by ann"


def test_a_release_says_who_and_when_and_what_had_been_pressed():
    latch = Latch().pressed("ann", "smoke", "8:00").released("bob", "8:05")
    assert (latch.latched, latch.by, latch.released_by, latch.at) == (False, "ann", "bob", "8:05")


def test_the_next_press_is_a_stop_of_its_own():
    latch = Latch().pressed("ann", "smoke", "8:00").released("bob", "8:05").pressed("eve", "fire", "9:00")
    assert (latch.latched, latch.by, latch.reason, latch.at, latch.released_by) == (True, "eve", "fire", "9:00", "")
