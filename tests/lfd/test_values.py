"""What holds for all value types of the package."""

import dataclasses
import importlib
import inspect
import pkgutil
from typing import get_args, get_origin, get_type_hints

import numpy as np
import pytest

import lfd

MODULES = [importlib.import_module(found.name) for found in pkgutil.walk_packages(lfd.__path__, "lfd.")]
VALUES = [
    cls
    for module in MODULES
    for _, cls in inspect.getmembers(module, inspect.isclass)
    if dataclasses.is_dataclass(cls) and cls.__module__ == module.__name__
]


def holds_arrays(kind):
    parts = get_type_hints(kind).values() if dataclasses.is_dataclass(kind) else get_args(kind)
    return get_origin(kind) is np.ndarray or any(map(holds_arrays, parts))


@pytest.mark.parametrize("cls", VALUES, ids=lambda cls: cls.__name__)
def test_a_value_cannot_be_changed_and_one_of_arrays_is_equal_to_itself_alone(cls):
    """`==` of arrays is no truth value: values that hold them would not compare, but raise."""
    assert cls.__dataclass_params__.frozen
    assert cls.__dataclass_params__.eq is not holds_arrays(cls)
