"""`retouch echo` shows what passes, whoever sent it."""

import msgpack

from services.commands.echo import decoded, shown


def test_a_foreign_map_is_shown_by_its_fields():
    assert shown(decoded(msgpack.packb({"a": 1, "later": [1.5, None]}))) == "{a: 1, later: [1.5, None]}"


def test_what_is_no_msgpack_is_shown_as_bytes():
    assert shown(decoded(b"\xc1abc")) == repr(b"\xc1abc")


def test_long_fields_are_shown_by_their_length():
    assert shown({"data": b"\0" * 1000, "list": list(range(100))}) == "{data: <1000 bytes>, list: <100 items>}"
