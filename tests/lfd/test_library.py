"""The library alone: its public names, what importing it costs, and that it runs without what only processes need."""

import ast
import dataclasses
import inspect
import json
import re
import subprocess
import sys
import tomllib
from pathlib import Path

import pytest

import lfd

ROOT = Path(__file__).resolve().parents[2]
SOURCES = sorted((ROOT / "lfd").rglob("*.py"))
PROJECT = tomllib.loads((ROOT / "pyproject.toml").read_text(encoding="utf-8"))["project"]
OWN = {"lfd", "numpy", "scipy"}

NAMES = """
    AdaptiveOptions AdaptiveProMP Alignment Binding ConditionedProMP DMP Demonstration DemonstrationStore Departure
    DmpOptions GaussianBasis Interpolation LfdError Method MotionDistribution MovementModel Passing Prediction
    PrompOptions
    Provenance Purpose Recording Scaling Selection Situation StoredDemonstration Trajectory Turn ViaPoint Way align
    along_the_way
    blend demonstration_from_arrays demonstrations_from_arrays dtw from_samples joined load read_demonstration
    read_recording refine resample save situation_from_arrays through_waypoints
"""

# Another interpreter, in which only the standard library, NumPy, SciPy and the library itself can be found.
ALONE = """
import json, sys
sys.path.insert(0, sys.argv[1])
allowed = set(json.loads(sys.argv[2])) | sys.stdlib_module_names

class Nothing_else:
    def find_spec(self, name, path=None, target=None):
        if name.partition(".")[0] not in allowed and not name.startswith("_sysconfigdata"):
            raise ModuleNotFoundError(f"No module named {name!r}", name=name)

sys.meta_path.insert(0, Nothing_else())
"""


def run(program, allowed=OWN):
    """What a program prints, as JSON, where nothing else than `allowed` is installed."""
    command = [sys.executable, "-I", "-c", ALONE + program, str(ROOT), json.dumps(sorted(allowed))]
    done = subprocess.run(command, capture_output=True, text=True, timeout=60, check=False)
    assert done.returncode == 0, done.stderr
    return json.loads(done.stdout)


def test_the_public_names_are_these():
    assert sorted(lfd.__all__) == sorted(NAMES.split())


@pytest.mark.parametrize("name", lfd.__all__)
def test_a_public_name_is_that_of_its_module_and_has_a_docstring(name):
    value = getattr(lfd, name)
    assert value.__name__ == name
    assert value.__module__.startswith("lfd.")
    assert value.__doc__
    assert name in dir(lfd)


def test_what_a_type_checker_reads_is_what_is_loaded():
    tree = ast.parse((ROOT / "lfd" / "__init__.py").read_text(encoding="utf-8"))
    read = {
        alias.name: node.module
        for node in ast.walk(tree)
        if isinstance(node, ast.ImportFrom) and node.module.startswith("lfd.")
        for alias in node.names
    }
    assert read == {name: f"lfd.{module}" for name, module in lfd._HOMES.items()}
    assert set(read) == set(lfd.__all__)
    assert (ROOT / "lfd" / "py.typed").is_file()


def documented():
    """Public functions, and public classes with their public methods."""
    for name in lfd.__all__:
        value = getattr(lfd, name)
        yield name, value
        for called, method in vars(value).items() if inspect.isclass(value) else ():
            function = getattr(method, "__func__", method)
            if not called.startswith("_") and inspect.isfunction(function):
                yield f"{name}.{called}", function


@pytest.mark.parametrize(("name", "value"), list(documented()), ids=lambda one: one if isinstance(one, str) else "")
def test_a_docstring_explains_what_is_given_and_what_is_held(name, value):
    if dataclasses.is_dataclass(value):
        given = [field.name for field in dataclasses.fields(value)]
    elif inspect.isclass(value):
        given = []
    else:
        given = [one for one in inspect.signature(value).parameters if one not in ("self", "cls")]
    owner, _, method = name.partition(".")
    # What its class holds, or every model has, is explained there.
    explained = value.__doc__ + getattr(lfd, owner).__doc__ + (getattr(lfd.MovementModel, method, value).__doc__ or "")
    assert [one for one in given if not re.search(rf"\b{one}\b", explained)] == []


def test_a_name_that_is_none_is_no_attribute():
    with pytest.raises(AttributeError, match="no attribute 'ProMP'"):
        lfd.ProMP  # noqa: B018


def test_importing_it_loads_neither_numpy_nor_scipy_nor_numba():
    loaded = run("import lfd; print(json.dumps(sorted({name.partition('.')[0] for name in sys.modules})))")
    assert {"numpy", "scipy", "numba"}.isdisjoint(loaded)


def test_what_needs_no_scipy_loads_none():
    program = """
import lfd
one = lfd.demonstration_from_arrays([0, 1, 2], [[0, 0, 0], [1, 0, 0], [1, 1, 0]], 0.5)
lfd.align([one, one]), lfd.refine(one.trajectory, one.trajectory), lfd.DMP.fit(one.trajectory), lfd.read_recording
print(json.dumps("scipy" in sys.modules))
"""
    assert run(program, {"lfd", "numpy"}) is False


def test_a_model_without_scipy_says_what_to_install():
    program = """
import lfd
try:
    lfd.ConditionedProMP
except ModuleNotFoundError as error:
    print(json.dumps(str(error)))
"""
    expected = "lfd.ConditionedProMP needs the package 'scipy': install retouch[lfd]"
    assert run(program, {"lfd", "numpy"}) == expected


def test_everything_runs_where_only_numpy_and_scipy_are_installed():
    program = """
import importlib, pkgutil, lfd
modules = [one.name for one in pkgutil.walk_packages(lfd.__path__, "lfd.")]
for name in modules:
    importlib.import_module(name)
ramp = [[k / 9, k / 9, 0.1 * k] for k in range(10)]
demonstrations = lfd.demonstrations_from_arrays(list(range(10)), [ramp, ramp], [0.0, 1.0])
for kind in (lfd.AdaptiveProMP, lfd.ConditionedProMP):
    kind.fit(demonstrations).updated(demonstrations[0]).predict(demonstrations[1].situation)
long = [[0.001 * k] for k in range(800)]
print(json.dumps([len(modules), lfd.dtw(long, long).distance]))
"""
    found, distance = run(program)
    assert found == len(SOURCES) - 1
    assert distance == 0.0


def test_it_imports_numpy_scipy_and_the_standard_library_only():
    imported = set()
    for path in SOURCES:
        for node in ast.walk(ast.parse(path.read_text(encoding="utf-8"))):
            if isinstance(node, ast.Import):
                imported |= {alias.name.partition(".")[0] for alias in node.names}
            elif isinstance(node, ast.ImportFrom):
                imported.add(node.module.partition(".")[0])
    assert imported - sys.stdlib_module_names == OWN


def test_its_extra_installs_numpy_and_scipy_only():
    named = [*PROJECT["dependencies"], *PROJECT["optional-dependencies"]["lfd"]]
    assert {re.match(r"[\w-]+", one)[0] for one in named} == {"numpy", "scipy"}
