"""The shapes of a description, as all its readers take them: meshes as STL beside it, those that are drawn thinned."""

import xml.etree.ElementTree as ET
from collections.abc import Collection
from pathlib import Path
from typing import NamedTuple

import numpy as np

from sim.robots import meshes

_VISUAL_TRIANGLES = 20_000
_PACKAGE, _FILE = "package://", "file://"


class _Shape(NamedTuple):
    kind: str
    element: ET.Element
    path: Path
    scale: tuple[float, ...]


def convert(root: ET.Element, source: Path, scratch: Path, target: Path) -> None:
    """Write every mesh of a description as STL, and name it by where it will lie.

    Args:
        root: The description, which is changed.
        source: Its file, from which meshes are looked for.
        scratch: Where to write.
        target: Where that will lie.
    """
    found = [
        _Shape(kind, mesh, _existing(mesh, source), _scale(mesh))
        for kind in ("visual", "collision")
        for mesh in root.iterfind(f"link/{kind}/geometry/mesh")
    ]
    loaded = {path: meshes.read(path) for path in dict.fromkeys(shape.path for shape in found)}
    drawn = sum(len(loaded[path]) for path in {shape.path for shape in found if shape.kind == "visual"})
    names: dict[tuple[str, Path, tuple[float, ...]], str] = {}
    for kind, mesh, path, scale in found:
        key = kind, path, scale
        if key not in names:
            triangles = loaded[path]
            if kind == "visual":
                triangles = meshes.thin(triangles, max(1, _VISUAL_TRIANGLES * len(triangles) // drawn))
            names[key] = _free(f"{path.stem}_{kind}", names.values())
            meshes.write_stl(scratch / names[key], meshes.scaled(triangles, scale))
        mesh.attrib["filename"] = str(target / names[key])
        mesh.attrib.pop("scale", None)
    for geometry in root.iterfind("link/visual/geometry"):
        _mesh_ball(geometry, scratch, target)


def mesh_path(filename: str, source: Path) -> Path | None:
    """Return where a mesh lies that a description names; None where it does not.

    Args:
        filename: As the description names it: by package, by path, or by where it lies beside the description.
        source: The description's file; a package is one of the folders above it, or lies in one.
    """
    if not filename.startswith(_PACKAGE):
        path = source.parent / filename.removeprefix(_FILE)
        return path if path.is_file() else None
    name, _, rest = filename.removeprefix(_PACKAGE).partition("/")
    for folder in source.absolute().parents:
        for path in (folder / rest, folder / name / rest):
            if path.is_file():
                return path
    return None


def _existing(mesh: ET.Element, source: Path) -> Path:
    path = mesh_path(mesh.attrib["filename"], source)
    if path is None:  # looked for before anything is built
        raise FileNotFoundError(mesh.attrib["filename"])
    return path


def _scale(mesh: ET.Element) -> tuple[float, ...]:
    return tuple(float(word) for word in mesh.attrib.get("scale", "1 1 1").split())


def _free(stem: str, taken: Collection[str]) -> str:
    """A file's name that no other shape has."""
    number, name = 1, f"{stem}.stl"
    while name in taken:
        number += 1
        name = f"{stem}_{number}.stl"
    return name


def _mesh_ball(geometry: ET.Element, scratch: Path, target: Path) -> None:
    """Draw a ball as a mesh: who draws links knows meshes, boxes and cylinders."""
    ball = geometry.find("sphere")
    if ball is None:
        return
    radius = float(ball.attrib["radius"])
    name = f"ball_{radius:g}.stl"
    meshes.write_stl(scratch / name, np.asarray(radius * meshes.ball(), np.float32))
    geometry.remove(ball)
    ET.SubElement(geometry, "mesh", {"filename": str(target / name)})
