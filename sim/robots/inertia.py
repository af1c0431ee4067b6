"""Inertias that a rigid body can have."""

import xml.etree.ElementTree as ET

import numpy as np
from numpy.typing import NDArray

_SMALLEST = 1e-7  # [kg m^2]
_LIGHTEST = 1e-4  # [kg]


def give_where_needed(root: ET.Element) -> None:
    """Give every link that a joint moves, and that has no inertia, hardly any: nothing moves that has none.

    Args:
        root: The description.
    """
    links = {link.attrib["name"]: link for link in root.iterfind("link")}
    for joint in root.iterfind("joint"):
        child = joint.find("child")
        if child is None or joint.attrib["type"] == "fixed":
            continue
        link = links[child.attrib["link"]]
        if link.find("inertial") is None:
            inertial = ET.SubElement(link, "inertial")
            ET.SubElement(inertial, "mass", {"value": repr(_LIGHTEST)})
            small = repr(_SMALLEST)
            moments = {"ixx": small, "ixy": "0", "ixz": "0", "iyy": small, "iyz": "0", "izz": small}
            ET.SubElement(inertial, "inertia", moments)


def repair(inertial: ET.Element) -> None:
    """Make an inertia of a description sound: positive, and obeying the triangle inequality.

    Args:
        inertial: Element of a link.
    """
    mass = inertial.find("mass")
    element = inertial.find("inertia")
    if mass is None or element is None:
        return
    mass.attrib["value"] = str(max(float(mass.attrib["value"]), _LIGHTEST))
    repaired = _physical(_matrix(element.attrib))
    if repaired is not None:
        rows, columns = np.triu_indices(3)
        for row, column in zip(rows, columns, strict=True):
            element.attrib[f"i{'xyz'[row]}{'xyz'[column]}"] = repr(float(repaired[row, column]))


def _matrix(values: dict[str, str]) -> NDArray[np.float64]:
    xx, xy, xz, yy, yz, zz = (float(values[key]) for key in ("ixx", "ixy", "ixz", "iyy", "iyz", "izz"))
    return np.array([[xx, xy, xz], [xy, yy, yz], [xz, yz, zz]])


def _physical(inertia: NDArray[np.float64]) -> NDArray[np.float64] | None:
    """Return the nearest sound inertia, or None if it is sound already."""
    moments, axes = np.linalg.eigh(inertia)
    sound = np.maximum(moments, _SMALLEST)
    # The largest moment may not exceed the sum of the others; a little less, so that rounding cannot undo it.
    sound[2] = min(sound[2], 0.999 * (sound[0] + sound[1]))
    if np.allclose(sound, moments, rtol=1e-12, atol=0.0):
        return None
    return np.asarray((axes * sound) @ axes.T)
