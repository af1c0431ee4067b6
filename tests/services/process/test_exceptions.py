"""The tree of failures in the docstring is the tree in the code."""

import re
from pathlib import Path

import services
from services.process import exceptions

CLASS = re.compile(r"^class (\w+)\(([^)]*)\):", re.MULTILINE)


def in_code():
    """Name to bases of every class under `services` that is an exception of the tree."""
    bases = {}
    for path in Path(services.__file__).parent.rglob("*.py"):
        for name, given in CLASS.findall(path.read_text(encoding="utf-8")):
            bases[name] = [base.strip() for base in given.split(",")]

    def belongs(name):
        return name == "ServiceError" or any(belongs(base) for base in bases.get(name, ()))

    return {name: found for name, found in bases.items() if belongs(name)}


def drawn():
    """Name to the class that it hangs from in the docstring."""
    above, result = [], {}
    for line in exceptions.__doc__.splitlines():
        name = line.strip("│├└─ ").split(" ")[0]
        if not name or not (line.startswith("ServiceError") or line.strip("│ ").startswith(("├", "└"))):
            continue
        depth = line.index(name) // 4
        above[depth:] = [name]
        result[name] = above[depth - 1] if depth else "Exception"
    return result


def test_every_failure_is_drawn_below_its_base():
    code, tree = in_code(), drawn()
    assert set(tree) == set(code)
    for name, base in tree.items():
        assert base in code[name]
