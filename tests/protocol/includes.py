"""When one key expression includes another, by the rules of key expressions: an independent reading of them."""


def includes(wide, narrow):
    """Whether every key of `narrow` is one of `wide`; chunks that begin with @ match only themselves."""
    return _includes(tuple(wide.split("/")), tuple(narrow.split("/")))


def _includes(wide, narrow):
    if not wide:
        return not narrow
    head, rest = wide[0], wide[1:]
    if head == "**":
        return _includes(rest, narrow) or (
            bool(narrow) and not narrow[0].startswith("@") and _includes(wide, narrow[1:])
        )
    if not narrow or narrow[0] == "**":
        return False
    return (head == narrow[0] or (head == "*" and not narrow[0].startswith("@"))) and _includes(rest, narrow[1:])
