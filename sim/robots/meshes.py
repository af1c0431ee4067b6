"""Triangle meshes of the robot: reading, thinning and writing them."""

from collections.abc import Sequence
from pathlib import Path
from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from sim.exceptions import DescriptionInvalid

Triangles = NDArray[np.float32]

_HEADER_BYTES = 80
_RECORD = np.dtype([("normal", "<f4", 3), ("corners", "<f4", (3, 3)), ("attribute", "<u2")])
_CREASE = np.cos(np.radians(40.0))  # triangles that bend more against each other have an edge between them
_BALL_BANDS = 12
_LEAST_GROWTH = 1.05  # of the cell, until few enough triangles are left


def read(path: Path) -> Triangles:
    """Read a mesh, whatever its format.

    Args:
        path: The file.

    Returns:
        Corners of the triangles, shape (n, 3, 3) [m].

    Raises:
        DescriptionInvalid: The file is damaged, or of a format that nobody here knows.
    """
    if path.suffix.lower() == ".stl" and not _is_text(path):
        return read_stl(path)
    try:
        return read_mesh(path)
    except (RuntimeError, ValueError) as error:  # as Coal's loader says that it cannot
        raise DescriptionInvalid(str(path), "its mesh cannot be read") from error


def _is_text(path: Path) -> bool:
    """An STL file in words: binary ones may begin like one, but are as long as they say."""
    raw = path.read_bytes()
    if not raw.startswith(b"solid") or len(raw) < _HEADER_BYTES + 4:
        return False
    count = int(np.frombuffer(raw, "<u4", 1, _HEADER_BYTES)[0])
    return len(raw) != _HEADER_BYTES + 4 + count * _RECORD.itemsize


def read_stl(path: Path) -> Triangles:
    """Read a binary STL file.

    Args:
        path: The file.

    Returns:
        Corners of the triangles, shape (n, 3, 3) [m].

    Raises:
        DescriptionInvalid: The file is cut short.
    """
    raw = path.read_bytes()
    count = int(np.frombuffer(raw, "<u4", 1, _HEADER_BYTES)[0])
    if len(raw) < _HEADER_BYTES + 4 + count * _RECORD.itemsize:
        raise DescriptionInvalid(str(path), "the file is cut short")
    corners: Triangles = np.frombuffer(raw, _RECORD, count, _HEADER_BYTES + 4)["corners"].astype(np.float32)
    return corners


def read_mesh(path: Path) -> Triangles:
    """Read a mesh of any format that Coal's loader knows, COLLADA among them.

    Args:
        path: The file.

    Returns:
        Corners of the triangles, shape (n, 3, 3) [m].
    """
    # Imported here because it takes a fifth of a second, and meshes are converted once a machine.
    import coal  # noqa: PLC0415

    mesh = coal.MeshLoader().load(str(path), np.ones(3))
    vertices = np.asarray(mesh.vertices(), dtype=np.float32)
    corners = [mesh.tri_indices(i) for i in range(mesh.num_tris)]
    triangles: Triangles = vertices[np.array([(t[0], t[1], t[2]) for t in corners])]
    return triangles


def scaled(triangles: Triangles, scale: Sequence[float]) -> Triangles:
    """Return a mesh made larger or smaller.

    Args:
        triangles: Corners, shape (n, 3, 3) [m].
        scale: Along x, y and z; a negative one mirrors it, and keeps its outside outside.
    """
    result: Triangles = (triangles * np.array(scale, np.float32)).astype(np.float32)
    return result[:, ::-1] if np.prod(scale) < 0.0 else result


def ball() -> Triangles:
    """Return a ball of radius 1 about the origin, shape (n, 3, 3)."""
    around = np.linspace(0.0, 2.0 * np.pi, 2 * _BALL_BANDS + 1)
    down = np.linspace(0.0, np.pi, _BALL_BANDS + 1)[:, None]
    x, y, z = np.broadcast_arrays(np.sin(down) * np.cos(around), np.sin(down) * np.sin(around), np.cos(down))
    grid = np.stack([x, y, z], axis=-1)
    a, b, c, d = grid[:-1, :-1], grid[1:, :-1], grid[1:, 1:], grid[:-1, 1:]
    sides = np.concatenate([np.stack([a, b, c], axis=2), np.stack([a, c, d], axis=2)])
    return np.asarray(sides.reshape(-1, 3, 3), np.float32)


def write_stl(path: Path, triangles: Triangles) -> None:
    """Write a binary STL file.

    Args:
        path: Where to.
        triangles: Corners, shape (n, 3, 3) [m].
    """
    records = np.zeros(len(triangles), _RECORD)
    records["corners"] = triangles
    records["normal"] = _normals(triangles)
    count = np.array([len(triangles)], "<u4").tobytes()
    path.write_bytes(bytes(_HEADER_BYTES) + count + records.tobytes())


def _normals(triangles: Triangles) -> NDArray[np.float32]:
    """Return each triangle's unit normal, shape (n, 3); zero where it has no area."""
    first, second = triangles[:, 1] - triangles[:, 0], triangles[:, 2] - triangles[:, 0]
    normals = np.cross(first, second)
    lengths = np.linalg.norm(normals, axis=1, keepdims=True)
    units: NDArray[np.float32] = np.divide(normals, lengths, out=np.zeros_like(normals), where=lengths > 0.0)
    return units


class Shaded(NamedTuple):
    """A mesh as graphics cards take it, each vertex once.

    Attributes:
        vertices: Shape (v, 3) [m].
        normals: By which they are lit, unit vectors, shape (v, 3).
        triangles: Indices of the vertices, shape (n, 3).
    """

    vertices: Triangles
    normals: Triangles
    triangles: NDArray[np.uint32]


def shaded(triangles: Triangles) -> Shaded:
    """Return a mesh that looks round where it is round, and keeps its edges where it has some.

    Args:
        triangles: Corners, shape (n, 3, 3) [m].
    """
    triangles = triangles[np.any(_normals(triangles), axis=1)]  # the others have no area
    vertices, vertex = np.unique(triangles.reshape(-1, 3), axis=0, return_inverse=True)
    normals = np.round(_corner_normals(triangles, vertex.reshape(-1)), 2)
    corners, corner = np.unique(np.column_stack([vertices[vertex.reshape(-1)], normals]), axis=0, return_inverse=True)
    return Shaded(
        vertices=corners[:, :3].astype(np.float32),
        normals=corners[:, 3:].astype(np.float32),
        triangles=corner.reshape(-1, 3).astype(np.uint32),
    )


def _corner_normals(triangles: Triangles, vertex: NDArray[np.intp]) -> Triangles:
    """Return the mean normal of the triangles around each corner that bend little against its own, shape (3 n, 3).

    Args:
        triangles: Shape (n, 3, 3) [m].
        vertex: At which vertex the corners lie, shape (3 n,).
    """
    flat = np.repeat(_normals(triangles), 3, axis=0)
    at_vertex = np.bincount(vertex)
    beside = at_vertex[vertex]  # corners at the same vertex, of each corner
    one = np.repeat(np.arange(len(vertex)), beside)
    nth = np.arange(len(one)) - np.repeat(np.cumsum(beside) - beside, beside)
    first = np.cumsum(at_vertex) - at_vertex
    other = np.argsort(vertex, kind="stable")[np.repeat(first[vertex], beside) + nth]
    smooth = np.sum(flat[one] * flat[other], axis=1) > _CREASE
    mean = np.zeros_like(flat)
    np.add.at(mean, one[smooth], flat[other[smooth]])
    lengths = np.linalg.norm(mean, axis=1, keepdims=True)
    units: Triangles = np.divide(mean, lengths, out=flat, where=lengths > 0.0)
    return units


def thin(triangles: Triangles, limit: int) -> Triangles:
    """Merge vertices in the cells of a grid until at most `limit` triangles are left.

    Vertex clustering (Rossignac and Borrel, 1993): the shape is kept to within one cell, which is
    all that drawing needs.

    Args:
        triangles: Corners, shape (n, 3, 3) [m].
        limit: How many triangles may be left.

    Returns:
        Corners, shape (m, 3, 3) with m <= max(limit, 1) where the mesh allows it.
    """
    if len(triangles) <= limit:
        return triangles
    vertices = triangles.reshape(-1, 3)
    extent = float(np.ptp(vertices, axis=0).max())
    cell = extent / np.sqrt(limit)
    while True:
        thinned = _cluster(vertices, cell)
        if len(thinned) <= limit or cell > extent:
            return thinned
        cell *= max(_LEAST_GROWTH, np.sqrt(len(thinned) / limit))


def _cluster(vertices: Triangles, cell: float) -> Triangles:
    _, member = np.unique(np.floor(vertices / cell).astype(np.int64), axis=0, return_inverse=True)
    member = member.reshape(-1)
    centres = np.zeros((member.max() + 1, 3), np.float64)
    np.add.at(centres, member, vertices)
    centres /= np.bincount(member)[:, None]

    faces = member.reshape(-1, 3)
    a, b, c = faces.T
    faces = faces[(a != b) & (b != c) & (c != a)]
    _, first = np.unique(np.sort(faces, axis=1), axis=0, return_index=True)
    corners: Triangles = centres[faces[np.sort(first)]].astype(np.float32)
    return corners
