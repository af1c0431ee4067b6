"""Pictures of the board as a known camera sees it, drawn by MuJoCo."""

import cv2
import mujoco
import numpy as np

from tests.services.camera.calibration.eyes import BOARD

WIDTH, HEIGHT, FOVY = 640, 480, 42.0
FOCAL = HEIGHT / 2 / np.tan(np.radians(FOVY) / 2)


class Studio:
    """A board alone in the world, that looks up."""

    def __init__(self):
        from sim.world.drawing import Canvas

        picture = np.ascontiguousarray(np.repeat(BOARD.picture()[..., None], 3, axis=2))
        width, height = BOARD.size
        spec = mujoco.MjSpec()
        texture = spec.add_texture(
            name="board",
            type=mujoco.mjtTexture.mjTEXTURE_2D,
            width=picture.shape[1],
            height=picture.shape[0],
            nchannel=3,
        )
        texture.data = picture.tobytes()
        material = spec.add_material(name="board", emission=0.6, specular=0.0)
        material.textures[mujoco.mjtTextureRole.mjTEXROLE_RGB] = "board"
        spec.worldbody.add_geom(
            type=mujoco.mjtGeom.mjGEOM_BOX, size=[width / 2, height / 2, 0.0005], material="board", pos=[0.0, 0.0, 0.0]
        )
        spec.worldbody.add_light(pos=[0.0, 0.0, 3.0], dir=[0.0, 0.0, -1.0])
        eye = spec.worldbody.add_body(name="eye", mocap=True)
        eye.add_camera(name="eye", fovy=FOVY)
        self._model = spec.compile()
        self._data = mujoco.MjData(self._model)
        self._canvas = Canvas(self._model, WIDTH, HEIGHT)

    def picture(self, board):
        """BGR, while the board is placed so in the camera's optical frame."""
        # The board's frame is at a corner of its squares, x right and y down on the print; the box's at its middle.
        box = np.eye(4)
        box[:3, :3] = np.diag([1.0, -1.0, -1.0])
        box[:3, 3] = [BOARD.columns * BOARD.square / 2, BOARD.rows * BOARD.square / 2, 0.0]
        eye = np.linalg.inv(board @ box)
        turned = np.zeros(4)
        mujoco.mju_mat2Quat(turned, (eye[:3, :3] @ np.diag([1.0, -1.0, -1.0])).ravel())
        self._data.mocap_pos[0], self._data.mocap_quat[0] = eye[:3, 3], turned
        mujoco.mj_forward(self._model, self._data)
        camera = mujoco.MjvCamera()
        camera.type, camera.fixedcamid = mujoco.mjtCamera.mjCAMERA_FIXED, 0
        return cv2.cvtColor(np.ascontiguousarray(self._canvas.draw(self._data, camera)), cv2.COLOR_RGB2BGR)

    def close(self):
        self._canvas.close()
