# SPDX-License-Identifier: Apache-2.0
"""Arrays of voxels show what they hold, in all their forms."""
import numpy as np
import pytest

import voxelume
from voxelume._colors import voxel_bytes


def cells():
    """7 x 5 x 3 voxels that differ, about half of which are there."""
    x, y, z = np.indices((7, 5, 3))
    rgba = np.stack([30 * x + 10, 40 * y + 20, 80 * z + 30,
                     np.where((x * 5 + y * 3 + z * 7) % 11 < 5, 255, 0)], axis=3)
    return rgba.astype(np.uint8)


def linear(codes):
    v = codes / 255
    return np.where(v <= 0.04045, v / 12.92, ((v + 0.055) / 1.055) ** 2.4)


def scene_along_z(array):
    """White light from everywhere, seen along -Z: column x, y is pixel x of row 4 - y."""
    return {
        "voxelume": 1,
        "world": {"voxel_size": 1, "bounds": {"min": [-2, -2, -2], "max": [9, 7, 5]},
                  "background": [0, 0, 0], "ambient": [1, 1, 1]},
        "materials": {"own": {"color": [1, 1, 1]}},
        "models": {"cells": {"voxels": array}},
        "objects": [{"model": "cells", "material": "own"}], "lights": [],
        "observer": {"position": [3.5, 2.5, 5], "look_at": [3.5, 2.5, 0],
                     "display": {"shape": "box", "size": [7, 5, 7]}},
        "render": {"size": [7, 5]}}


def test_each_pixel_shows_the_foremost_voxel_of_its_column(device):
    array = cells()
    image = voxelume.render(scene_along_z(array), devices=device, cache=False)
    there = array[..., 3] > 0
    foremost = 2 - np.argmax(there[:, :, ::-1], axis=2)
    seen = np.take_along_axis(array, foremost[:, :, None, None], axis=2)[:, :, 0, :3]
    expected = np.where(there.any(axis=2)[..., None], linear(seen), 0)
    got = image.rgba[::-1, :, :3].transpose(1, 0, 2)
    np.testing.assert_allclose(got, expected, atol=1e-3)
    assert there.any(axis=2).sum() > 20


def test_a_view_is_drawn_as_its_copy(device):
    array = cells()
    big = np.zeros((14, 10, 6, 4), np.uint8)
    big[::2, ::2, ::2] = array
    a = voxelume.render(scene_along_z(big[::2, ::2, ::2]), devices=device, cache=False)
    b = voxelume.render(scene_along_z(array), devices=device, cache=False)
    assert voxelume.compare(a, b)["flip"] == 0


@pytest.mark.parametrize("array, colors, threshold, expected", [
    (np.array([[[True, False]]]), (1.0, 0.5, 0.0), None, [[255, 128, 0, 255], [255, 128, 0, 0]]),
    (np.array([[[0.4, 0.6]]]), (1, 2, 3, 4), 0.5, [[1, 2, 3, 0], [1, 2, 3, 4]]),
    (np.array([[[-1, 7]]]), [[[(9, 8, 7), (6, 5, 4)]]], None, [[9, 8, 7, 0], [6, 5, 4, 255]]),
    (np.array([[[(0, 0, 0), (0, 9, 0)]]]), None, None, [[0, 0, 0, 0], [0, 9, 0, 255]]),
    (np.array([[[(0.2, 0, 0, 0), (0, 1, 0, 0.4)]]]), None, None,
     [[51, 0, 0, 0], [0, 255, 0, 102]]),
    (np.array([[[(0, 257, 128, 65535), (65535, 514, 129, 0)]]], np.uint16), None, None,
     [[0, 1, 0, 255], [255, 2, 1, 0]]),
    (np.array([[[np.nan, 2.0]]]), (1, 1, 1), None, [[1, 1, 1, 0], [1, 1, 1, 255]]),
])
def test_every_form_becomes_bytes(array, colors, threshold, expected):
    assert voxel_bytes(array, colors, threshold)[0, 0].tolist() == expected


def test_bytes_are_used_where_they_lie():
    array = cells()
    assert np.shares_memory(voxel_bytes(array), array)


@pytest.mark.parametrize("array, arguments, words", [
    (np.zeros((2, 2)), {}, "(2, 2)"),
    (np.zeros((2, 2, 2)), {}, "no voxel of the array is there"),
    (np.ones((2, 2, 2)), {"colors": np.ones((2, 2, 3))}, "don't fit"),
    (np.ones((2, 2, 2, 4)), {"colors": (1, 1, 1)}, "colours of their own"),
    (np.ones((2, 2, 2, 4)), {"threshold": 1}, "threshold"),
    (np.ones((2, 2, 2), complex), {"colors": (1j, 0, 0)}, "not complex128"),
    (np.full((2, 2, 2, 4), 256), {}, "go from 0 to 255, and these from 256 to 256"),
    (np.ones((2, 2, 2)), {"colors": (-1, 0, 0)}, "save them as uint8, uint16 or floats"),
    (np.array([[["a"]]]), {}, "numbers or bools"),
    (np.ones((0, 2, 2)), {}, "has no voxels"),
    (np.ones((2, 2, 2)), {"up": "x"}, "up is"),
])
def test_arrays_without_sense_are_errors(array, arguments, words):
    with pytest.raises(voxelume.Error) as caught:
        voxelume.scene_of_voxels(array, **arguments)
    assert words in str(caught.value)
    assert caught.value.kind == "usage"


def test_one_line_draws_an_array(device):
    x, y, z = np.indices((12, 12, 12)) - 5.5
    image = voxelume.voxels(x * x + y * y + z * z < 30, size=(96, 72), devices=device)
    assert (image.width, image.height) == (96, 72)
    assert image._repr_png_().startswith(b"\x89PNG\r\n\x1a\n")
    upright = voxelume.voxels(np.ones((2, 2, 9), bool), size=(60, 60), ground=False,
                              background=(0, 0, 0), devices=device)
    rows, columns = np.nonzero(upright["R"])
    assert np.ptp(rows) > 2 * np.ptp(columns)
    lying = voxelume.voxels(np.ones((2, 2, 9), bool), up="y", size=(60, 60), ground=False,
                            background=(0, 0, 0), longitude=90, devices=device)
    rows, columns = np.nonzero(lying["R"])
    assert np.ptp(columns) > 2 * np.ptp(rows)
