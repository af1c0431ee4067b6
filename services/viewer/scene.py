"""What stands around the robot, the object, and the criteria by which a motion is judged."""

from __future__ import annotations

import numpy as np
import rerun as rr

from protocol.messages import DepthPicture, PointCloud, Pose, Quaternion, SceneState, Vector3
from services.bus.arrays import points_from_wire, vector3
from services.viewer import entities, palette
from services.viewer.kinds import ARROWS
from services.viewer.run import Run

_FORCE_SCALE = 0.03  # [m/N]
_THIN = -0.75  # [points on the screen]: Rerun's sign for not being metres
_POINT = -1.5  # [points on the screen]
_DEEP = 4000.0  # [mm] coloured as far away; as far as depth cameras see
_LEAST_FORCE = 0.05  # [N] below it there is no arrow


def log_environment(run: Run, scene: SceneState) -> None:
    """Draw the scene's boxes."""
    run.stand(
        entities.ENVIRONMENT,
        rr.Boxes3D(
            centers=[box.centre for box in scene.boxes],
            half_sizes=[box.half_sizes for box in scene.boxes],
            quaternions=[_xyzw(box.orientation) for box in scene.boxes],
            colors=[[round(255 * min(max(c, 0.0), 1.0)) for c in box.rgba] for box in scene.boxes],
            fill_mode="solid",
            show_labels=False,
        ),
        scene.boxes,
    )


def log_cloud(run: Run, cloud: PointCloud) -> None:
    """Draw what a camera sees as points."""
    positions, colours = points_from_wire(cloud.data)
    run.log(entities.CLOUD, rr.Points3D(positions, radii=[_POINT], colors=colours))


def log_depth(run: Run, depth: DepthPicture) -> None:
    """Draw how far away is what a camera sees, as a picture."""
    picture = rr.EncodedDepthImage(depth.data, media_type="image/png", meter=1000.0, depth_range=(0.0, _DEEP))
    run.log(entities.DEPTH, picture)


def log_object_seen(run: Run, pose: Pose, size: Vector3) -> None:
    """Draw the object where perception sees it; `size` is its full edge lengths [m]."""
    run.log(entities.OBJECT_SEEN, _box(pose, size, palette.OBJECT, "solid"))


def log_object_truth(run: Run, pose: Pose, size: Vector3) -> None:
    """Draw where the object really is as an outline; `size` is its full edge lengths [m]."""
    run.log(entities.OBJECT_TRUTH, _box(pose, size, palette.TRUTH, "majorwireframe"))


def log_point(run: Run, radius: float) -> None:
    """Draw a robot that has no shape as a ball of this radius [m]; it moves with the grasping frame."""
    run.log_always(entities.POINT, rr.Points3D([(0.0, 0.0, 0.0)], radii=[radius], colors=[palette.TRUTH]))


def log_reached(run: Run, radii: Vector3, *, reached: bool) -> None:
    """Draw the ellipsoid about the grasping frame in which the object's centre has to lie (thesis, eq. E.1).

    Args:
        run: where.
        radii: of the ellipsoid [m].
        reached: whether it does.
    """
    run.log(
        entities.REACHED,
        rr.Ellipsoids3D(
            half_sizes=[radii],
            colors=[palette.GO if reached else palette.STOP],
            line_radii=[_THIN],
            fill_mode="majorwireframe",
        ),
    )


def log_kick_limits(run: Run, centre: Vector3, limits: Vector3, *, kicked_over: bool) -> None:
    """Draw the box that the object's centre has to stay in (thesis, Appendix E).

    Args:
        run: where.
        centre: where the object stood at first [m].
        limits: largest displacement on each axis [m].
        kicked_over: whether it has left the box, or has toppled.
    """
    run.log(
        entities.KICK_LIMITS,
        rr.Boxes3D(
            centers=[centre],
            half_sizes=[limits],
            colors=[palette.STOP if kicked_over else palette.GO],
            radii=[_THIN],
            fill_mode="majorwireframe",
        ),
    )


def log_collision(run: Run, position: Vector3 | None, force: float) -> None:
    """Mark where the robot first touched the environment [m] and how hard [N]; no mark where it did not."""
    positions = [] if position is None else [position]
    labels = [f"collision {force:.0f} N"] * len(positions)
    run.log(entities.COLLISION, rr.Points3D(positions, radii=[0.018], colors=[palette.STOP], labels=labels))


def log_force_style(run: Run) -> None:
    """Draw every force in one colour, in one width."""
    run.log_always(entities.FORCE, rr.Arrows3D.from_fields(colors=[palette.FORCE], radii=[0.006]))


def log_force(run: Run, origin: Vector3, force: Vector3) -> None:
    """Draw the force that the master renders [N] as an arrow from this point [m]; none where hardly any is felt."""
    felt = float(np.linalg.norm(force)) > _LEAST_FORCE
    run.row(entities.FORCE, ARROWS, (origin, vector3(np.multiply(_FORCE_SCALE, force))) if felt else None)


def _box(pose: Pose, size: Vector3, colour: int, fill: str) -> rr.Boxes3D:
    return rr.Boxes3D(
        centers=[pose.position],
        sizes=[size],
        quaternions=[_xyzw(pose.orientation)],
        colors=[colour],
        radii=[_THIN],
        fill_mode=rr.components.FillMode.auto(fill),
    )


def _xyzw(orientation: Quaternion) -> rr.Quaternion:
    """The quaternion as Rerun has it, scalar last."""
    w, x, y, z = orientation
    return rr.Quaternion(xyzw=(x, y, z, w))
