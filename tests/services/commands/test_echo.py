"""`retouch echo` shows what passes, whoever sent it."""

import msgpack

from services.bus.zenoh import Passing
from services.commands.echo import Heard, decoded, shown


def test_a_foreign_map_is_shown_by_its_fields():
    assert shown(decoded(msgpack.packb({"a": 1, "later": [1.5, None]}))) == "{a: 1, later: [1.5, None]}"


def test_what_is_no_msgpack_is_shown_as_bytes():
    assert shown(decoded(b"\xc1abc")) == repr(b"\xc1abc")


def test_long_fields_are_shown_by_their_length():
    assert shown({"data": b"\0" * 1000, "list": list(range(100))}) == "{data: <1000 bytes>, list: <100 items>}"


def test_nobody_waits_for_a_reader_that_is_slow_and_what_it_misses_is_counted():
    heard = Heard(kept=1)
    heard.keep(Passing("a", b"", ""))
    heard.keep(Passing("b", b"", ""))
    assert heard.take(0.0) == Passing("a", b"", "")
    assert heard.take(0.0) is None
    assert (heard.take_missed(), heard.take_missed()) == (1, 0)
