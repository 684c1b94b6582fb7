# SPDX-License-Identifier: Apache-2.0
"""Pictures in notebooks, and arrays of images and volumes."""
from __future__ import annotations

import os
import tempfile

import numpy as np
import numpy.typing as npt

from ._arguments import instance, number
from ._native import Image, Volume


def png_of(image: Image, exposure: float = 0.0) -> bytes:
    """The image as the bytes of a PNG file; `exposure` is in stops."""
    instance("image", image, Image)
    number("exposure", exposure, 64)
    with tempfile.TemporaryDirectory(prefix="voxelume-") as folder:
        file = os.path.join(folder, "image.png")
        image.write(file, exposure=exposure)
        with open(file, "rb") as stream:
            return stream.read()


def dense(volume: Volume) -> npt.NDArray[np.float32]:
    """The voxels of a volumetric image as a new array (x, y, z, 4).

    It holds R, G, B, linear Rec. 709 and not multiplied by the opacity, and the opacity.
    """
    instance("volume", volume, Volume)
    x, y, z = volume.size
    cells = np.zeros((z * y * x, 4), np.float32)
    cells[volume.indices, :3] = volume.colors
    cells[volume.indices, 3] = volume.opacities
    return cells.reshape(z, y, x, 4).transpose(2, 1, 0, 3)


def _image_png(image: Image) -> bytes | None:
    return png_of(image) if "R" in image else None


def _volume_png(volume: Volume) -> bytes:
    return png_of(volume.view())


# Notebooks call these methods to show the values of cells.
setattr(Image, "_repr_png_", _image_png)
setattr(Volume, "_repr_png_", _volume_png)
