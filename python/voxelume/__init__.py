# SPDX-License-Identifier: Apache-2.0
"""Images of voxel worlds, flat and volumetric.

    import numpy as np, voxelume
    x, y, z = np.indices((32, 32, 32)) - 16
    voxelume.voxels(x**2 + y**2 + z**2 < 200).write("ball.png")

`voxels` draws an array; `render` a scene, which is a file or a dict of the same form;
`render_frames` an animation; `render_volume` makes volumetric images. The units are metres and
degrees, colours are linear Rec. 709. Processes that render are started with "spawn", not "fork":
OpenCL's threads don't live on in a fork.
"""
from ._devices import limit_memory, open_devices
from ._errors import Error
from ._native import (Device, DeviceInfo, Image, Scene, Volume, __version__, compare,
                      list_devices)
from ._pictures import dense, png_of
from ._rendering import (plan, render, render_frames, render_volume, scene_of_voxels, voxels)
from ._scenes import parse_scene, scene

__all__ = [
    "Device", "DeviceInfo", "Error", "Image", "Scene", "Volume", "__version__", "compare", "dense",
    "limit_memory", "list_devices", "open_devices", "parse_scene", "plan", "png_of", "render",
    "render_frames", "render_volume", "scene", "scene_of_voxels", "voxels",
]
