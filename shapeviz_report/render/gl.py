"""What a camera sees, by pyrender: the one module that talks to it.

pyrender draws, in software through OSMesa, what is nearest to the camera together with a value of it.
"""

from __future__ import annotations

import atexit
import ctypes
import functools
import os
from types import ModuleType
from typing import TYPE_CHECKING

import numpy as np
import numpy.typing as npt

from shapeviz_report.errors import RenderError
from shapeviz_report.render.camera import Camera
from shapeviz_report.types import FloatArray, IntArray

if TYPE_CHECKING:
    from pyrender import OffscreenRenderer

_REMEDY = (
    "Install it (Debian and Ubuntu: apt install libosmesa6) and run this again, or leave out --renderer: pictures are "
    "then drawn without it."
)


def check() -> None:
    """Make sure that this process can draw.

    Raises
    ------
    RenderError
        If the library is missing or gives no context, with what to install.
    """
    _open_renderer(1).delete()


def draw(
    positions: FloatArray, faces: IntArray, values: FloatArray, camera: Camera
) -> tuple[npt.NDArray[np.float32], npt.NDArray[np.float32]]:
    """Depth (h, w) and values (h, w, 3), in steps of 1/255, of the nearest surface; see
    :func:`shapeviz_report.render.rasteriser.rasterise`.

    Raises
    ------
    RenderError
        As :func:`check`.
    """
    renderer = _renderer(camera.size)
    pyrender = _import_pyrender()
    scene = pyrender.Scene(bg_color=(0.0, 0.0, 0.0, 0.0))
    primitive = pyrender.Primitive(
        positions=positions.astype(np.float32),
        indices=faces.astype(np.uint32),
        color_0=np.column_stack([values, np.ones(len(values))]).astype(np.float32),
        material=pyrender.MetallicRoughnessMaterial(baseColorFactor=(1.0, 1.0, 1.0, 1.0), doubleSided=True),
    )
    scene.add(pyrender.Mesh([primitive]))
    scene.add(
        pyrender.IntrinsicsCamera(
            fx=camera.focal_length,
            fy=camera.focal_length,
            cx=camera.centre[0],
            cy=camera.centre[1],
            znear=camera.near,
            zfar=camera.far,
        ),
        pose=camera.pose,
    )
    colour, depth = renderer.render(scene, pyrender.RenderFlags.FLAT)
    return depth, colour.astype(np.float32) / np.float32(255.0)


@functools.cache
def _import_pyrender() -> ModuleType:
    # PyOpenGL picks its library when it is first imported, so the choice comes before that, once a process. pyrender
    # takes a second to import: not before there is something to draw.
    os.environ["PYOPENGL_PLATFORM"] = "osmesa"
    try:
        import pyrender
        from OpenGL.platform import PLATFORM
    except (ImportError, AttributeError) as error:  # PyOpenGL goes on with None for a library it did not find
        raise RenderError(f"The library libOSMesa cannot be loaded. {_REMEDY}") from error
    # pyrender keeps its compiled shaders by the current context, which PyOpenGL 3.1 gives as a new pointer object
    # every time. As an address it is the same each time; otherwise every picture compiles, and keeps, its own.
    PLATFORM.GetCurrentContext.restype = ctypes.c_void_p
    return pyrender


def _open_renderer(size: int) -> OffscreenRenderer:
    pyrender = _import_pyrender()
    try:
        return pyrender.OffscreenRenderer(size, size)
    except Exception as error:  # whatever the graphics library raises, there is no picture
        raise RenderError(f"OSMesa cannot draw on this machine ({error!r}). {_REMEDY}") from error


@functools.cache
def _renderer(size: int) -> OffscreenRenderer:
    """The one renderer of this process and size: to make it takes far longer than a picture."""
    renderer = _open_renderer(size)
    atexit.register(renderer.delete)
    return renderer
