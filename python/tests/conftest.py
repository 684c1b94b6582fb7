# SPDX-License-Identifier: Apache-2.0
"""One device and one small scene for all tests."""
import os

import pytest

import voxelume


@pytest.fixture(scope="session")
def device():
    return voxelume.open_devices(os.environ.get("VXL_TEST_DEVICE", "cpu"))


@pytest.fixture
def room():
    """A red ball over a grey box, which rises in three frames; 64 x 48 pixels."""
    return {
        "voxelume": 1,
        "world": {"voxel_size": 0.02, "bounds": {"min": [-1, 0, -1], "max": [1, 2, 1]},
                  "background": [0, 0, 0.5], "ambient": [0.25, 0.25, 0.25]},
        "materials": {"red": {"color": [0.8, 0, 0]}, "grey": {"color": [0.4, 0.4, 0.4]}},
        "models": {"ball": {"shape": "sphere", "radius": 0.3},
                   "box": {"shape": "box", "size": [1.2, 0.4, 0.8]}},
        "objects": [
            {"name": "ball", "model": "ball", "material": "red", "position": [0, 0.9, 0]},
            {"name": "box", "model": "box", "material": "grey", "position": [0, 0.2, 0]}],
        "lights": [{"name": "lamp", "type": "point", "position": [0.5, 1.8, 0.9], "intensity": 2}],
        "observer": {"position": [0, 0.8, 3], "look_at": [0, 0.8, 0],
                     "display": {"shape": "pyramid", "angle": 44, "near": 1, "far": 5,
                                 "voxels": [48, 36, 64]}},
        "animation": {"frames": 3, "tracks": [{"target": "objects.ball.position", "keys": [
            {"frame": 1, "value": [0, 0.9, 0]}, {"frame": 3, "value": [0, 1.3, 0]}]}]},
        "render": {"size": [64, 48]}}
