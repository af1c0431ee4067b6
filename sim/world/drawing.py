"""Drawing a MuJoCo model into an array, without a display.

MuJoCo's own renderer takes its OpenGL library from an environment variable, once, when MuJoCo is
first imported. Here the library is looked for when something is to be drawn: EGL, then OSMesa;
what other projects have put into the environment for theirs is passed over.
"""

import ctypes
import os
from typing import Protocol

import mujoco
import numpy as np
from numpy.typing import NDArray

from sim.exceptions import DrawingLibraryMissing

Image = NDArray[np.uint8]
Depth = NDArray[np.float64]

_LIBRARIES = {"egl": ("libEGL.so.1", "libGL.so.1"), "osmesa": ("libOSMesa.so.8",)}
_OF_DRIVERS = ("EGL_", "__EGL", "GALLIUM_", "LIBGL_", "MESA_", "MUJOCO_EGL_", "PYOPENGL_")
_PLATFORM = "PYOPENGL_PLATFORM"
_MAX_GEOMS = 2000


class GraphicsContext(Protocol):
    """What MuJoCo's EGL and OSMesa contexts have in common."""

    def make_current(self) -> None:
        """Draw with this context from now on, in this thread."""

    def free(self) -> None:
        """Give the context back."""


class Canvas:
    """A place to draw one model in; used by one thread, and closed at the end.

    Args:
        model: What to draw.
        width: Of the pictures [px].
        height: Of the pictures [px].

    Raises:
        DrawingLibraryMissing: Neither EGL nor OSMesa can be used.
    """

    def __init__(self, model: mujoco.MjModel, width: int, height: int) -> None:
        model.vis.global_.offwidth, model.vis.global_.offheight = width, height
        self._graphics = open_graphics(width, height)
        self._graphics.make_current()
        self._context = mujoco.MjrContext(model, mujoco.mjtFontScale.mjFONTSCALE_100)
        mujoco.mjr_setBuffer(mujoco.mjtFramebuffer.mjFB_OFFSCREEN, self._context)
        self._model = model
        self._scene = mujoco.MjvScene(model, _MAX_GEOMS)
        self._scene.flags[mujoco.mjtRndFlag.mjRND_SHADOW] = False
        self._scene.flags[mujoco.mjtRndFlag.mjRND_REFLECTION] = False
        self._option = mujoco.MjvOption()
        self._frame = mujoco.MjrRect(0, 0, width, height)
        self._near, self._far = (
            float(model.stat.extent * plane) for plane in (model.vis.map.znear, model.vis.map.zfar)
        )

    def draw(self, data: mujoco.MjData, camera: mujoco.MjvCamera) -> Image:
        """Draw a state.

        Args:
            data: State whose positions are up to date.
            camera: Where to look from.

        Returns:
            The picture in RGB, shape (height, width, 3), its first row at the top.
        """
        mujoco.mjv_updateScene(self._model, data, self._option, None, camera, mujoco.mjtCatBit.mjCAT_ALL, self._scene)
        self._graphics.make_current()
        mujoco.mjr_render(self._frame, self._scene, self._context)
        picture = np.empty((self._frame.height, self._frame.width, 3), dtype=np.uint8)
        mujoco.mjr_readPixels(picture, None, self._frame, self._context)
        return np.flipud(picture)

    def depth(self) -> Depth:
        """Return how far along the view is what was drawn last.

        Returns:
            Distances along the optical axis, shape (height, width) [m], the first row at the top; where there is
            nothing it is that of the far clipping plane, beyond everything that is drawn.
        """
        read = np.empty((self._frame.height, self._frame.width), dtype=np.float32)
        self._graphics.make_current()
        mujoco.mjr_readPixels(None, read, self._frame, self._context)
        shares = np.flipud(read).astype(np.float64)  # of a perspective: 0 at the near plane, 1 at the far one
        return self._near / (1.0 - shares * (1.0 - self._near / self._far))

    def close(self) -> None:
        """Give the drawing library's resources back; a second call does nothing."""
        self._graphics.make_current()
        self._context.free()
        self._graphics.free()


def open_graphics(width: int, height: int) -> GraphicsContext:
    """Open a drawing context of EGL, or of OSMesa where there is no EGL.

    Raises:
        DrawingLibraryMissing: Neither can be used.
    """
    library = _available()
    os.environ[_PLATFORM] = library
    try:
        # Imported here because the import itself loads the library.
        if library == "egl":
            from mujoco.egl import GLContext  # noqa: PLC0415
        else:
            from mujoco.osmesa import GLContext  # noqa: PLC0415
        context: GraphicsContext = GLContext(width, height)
    except (ImportError, AttributeError, RuntimeError, ValueError, ctypes.ArgumentError) as error:
        raise DrawingLibraryMissing(f"{library}: {_reason(error)}", _foreign()) from error
    return context


def _reason(error: Exception) -> str:
    return next(iter(str(error).splitlines()), type(error).__name__)


def _foreign() -> list[str]:
    """Variables that are set and change which driver the library takes."""
    return sorted(name for name in os.environ if name.startswith(_OF_DRIVERS) and name != _PLATFORM)


def _available() -> str:
    # PyOpenGL settles on one library in its first import, so it must not try in vain.
    for name, files in _LIBRARIES.items():
        try:
            for file in files:
                ctypes.CDLL(file)
        except OSError:
            continue
        return name
    raise DrawingLibraryMissing("neither libEGL nor libOSMesa is installed")
