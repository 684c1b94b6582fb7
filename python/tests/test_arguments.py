# SPDX-License-Identifier: Apache-2.0
"""Wrong arguments are errors that name them, whatever they are; unusual right ones are taken."""
import math
import re

import numpy as np
import pytest

import voxelume
from voxelume._colors import voxel_bytes

NAN, INF = math.nan, math.inf
BOX = np.ones((2, 3, 4), bool)
MASKED = np.ma.array(np.ones((2, 2, 2)), mask=np.arange(8).reshape(2, 2, 2) == 3)


def expect_error(call, words, kind="usage"):
    with pytest.raises(voxelume.Error) as caught:
        call()
    assert words in str(caught.value)
    assert caught.value.kind == kind
    assert "\n" not in str(caught.value)


@pytest.mark.parametrize("dtype", [">u2", "<u2", ">f4", ">f8", "<f2", ">i4", ">i8", "g", "u1"])
def test_colours_may_have_any_order_of_bytes(dtype):
    full = {"u": 65535 if dtype[-1] == "2" else 255, "i": 255, "f": 1}[np.dtype(dtype).kind]
    array = np.array([[[(0, full, 0, full), (full, 0, 0, 0)]]], dtype)
    assert voxel_bytes(array)[0, 0].tolist() == [[0, 255, 0, 255], [255, 0, 0, 0]]
    colors = voxel_bytes(np.ones((1, 1, 2), bool), array[..., :3])
    assert colors[0, 0].tolist() == [[0, 255, 0, 255], [255, 0, 0, 255]]
    assert voxel_bytes(array[..., 1])[0, 0, :, 3].tolist() == [255, 0]


@pytest.mark.parametrize("change", [lambda a: a[::-1, ::2, ::-1], np.asfortranarray,
                                    lambda a: a.transpose(2, 0, 1, 3), lambda a: a[:, 1:2]])
def test_arrays_may_have_any_strides(change):
    array = np.arange(4 * 3 * 5 * 4, dtype=np.uint8).reshape(4, 3, 5, 4)
    np.testing.assert_array_equal(voxel_bytes(change(array)), change(array))


def test_what_a_mask_hides_is_not_there():
    there = voxel_bytes(MASKED)[..., 3] > 0
    np.testing.assert_array_equal(there, ~MASKED.mask)
    four = np.ma.array(np.full((2, 1, 1, 4), 200, np.uint8))
    four[1, 0, 0, 2] = np.ma.masked
    assert voxel_bytes(four)[..., 3].ravel().tolist() == [200, 0]
    assert four.data[1, 0, 0].tolist() == [200] * 4  # the caller's bytes stay as they are
    three = np.ma.array(np.full((2, 1, 1, 3), 200, np.uint8))
    three[0] = np.ma.masked
    assert voxel_bytes(three)[..., 3].ravel().tolist() == [0, 255]
    assert voxel_bytes(np.ones((2, 1, 1)), three)[..., 3].ravel().tolist() == [0, 255]
    assert voxel_bytes(np.ma.array(BOX, mask=False)).shape == (2, 3, 4, 4)
    expect_error(lambda: voxelume.scene_of_voxels(np.ma.array(BOX, mask=True)), "is there")


def test_bools_may_have_a_threshold():
    assert voxel_bytes(np.array([[[True, False]]]), threshold=0.5)[0, 0, :, 3].tolist() == [255, 0]
    assert voxel_bytes(np.array([[[True, False]]]), threshold=-1)[0, 0, :, 3].tolist() == [255] * 2


@pytest.mark.parametrize("array, words", [
    (0, "not ()"), (np.array(3.0), "not ()"), (True, "not ()"), ([], "not (0,)"),
    (None, "not object"), ("text", "not <U4"), ({1}, "not object"), ([[1, 2], [3]], "no array"),
    (np.zeros((0, 0, 0)), "has no voxels"), (np.zeros((2, 0, 2, 4)), "has no voxels"),
    (np.ones((2, 2, 2, 2)), "(2, 2, 2, 2)"), (np.ones((2, 2, 2, 2, 2)), "(2, 2, 2, 2, 2)"),
    (np.ones((2, 2, 2), complex), "not complex128"), (np.ones((2, 2, 2), object), "not object"),
    (np.ones((2, 2, 2), "m8[s]"), "not timedelta64[s]"), (np.ones((2, 2, 2), "M8[s]"), "datetime"),
    (np.ones((2, 2, 2), [("a", int)]), "not [("), (np.full((2, 2, 2), NAN), "is there"),
])
def test_what_is_no_array_of_voxels_is_an_error(array, words):
    expect_error(lambda: voxelume.scene_of_voxels(array), words)


@pytest.mark.parametrize("shape", [(70000, 1, 1), (65536, 65536, 65536), (60000, 60000, 60000, 4)])
def test_arrays_that_are_too_large_take_no_memory(shape):
    array = np.broadcast_to(np.uint8(1), shape)
    expect_error(lambda: voxelume.scene_of_voxels(array), "too large", "limit")


@pytest.mark.parametrize("name, values", [
    ("colors", [1, "red", (1, 2), (1,) * 5, [[1, 2, 3]], np.zeros((2, 3, 4, 0)), np.ma.masked]),
    ("threshold", [NAN, INF, "x", True, (1, 2)]),
    ("size", [(16.5, 12), (0, 4), (-1, 2), 16, (16,), (1, 2, 3), "ab", (NAN, 1), (True, 2),
              (10**12, 1), None, np.array(3)]),
    ("samples", [0, -1, 2.5, NAN, "4", True, 5000, 10**20, None]),
    ("longitude", [NAN, INF, -INF, "x", None, True, 361, 1e308, [1]]),
    ("latitude", [NAN, 91, -91, "x", np.array([1, 2])]),
    ("parallel", [1, "yes", None]), ("ground", [0, "no"]),
    ("background", [(1, 2), (1, 2, NAN), "red", 5, (1,) * 4, ("a", "b", "c"), {"r": 1}]),
    ("up", ["x", "Z", None, 1, ["z"]]),
])
def test_wrong_arguments_of_voxels_are_named(name, values):
    word = {"colors": "colour"}.get(name, name)
    for value in values:
        expect_error(lambda: voxelume.scene_of_voxels(BOX, **{name: value}), word)


def test_numbers_may_be_numpys():
    made = voxelume.scene_of_voxels(
        BOX, size=np.array([16, 12]), samples=np.int8(2), longitude=np.float32(20),
        latitude=np.int64(5), parallel=np.bool_(True), background=np.array([1, 0.5, 0]))
    assert made.size == [16, 12]


@pytest.mark.parametrize("name, values", [
    ("frame", [0, -1, NAN, 1.5, "1", None, 10**12, True]),
    ("devices", [[], [1], NAN, object(), True]),
    ("channels", [[], None, [1], 5, "colour", [""]]),
    ("size", [(8.5, 6), 5]), ("samples", [0, 2.5]), ("light", ["x", 1, "LOCAL"]),
    ("progress", [1, "x"]), ("warn", [1]), ("strict", [1, "x"]), ("cache", [1, None]),
])
def test_wrong_arguments_of_render_are_named(device, room, name, values):
    word = {"devices": "", "channels": "channel"}.get(name, name)
    for value in values:
        expect_error(lambda: voxelume.render(room, **{"devices": device, name: value}), word)


@pytest.mark.parametrize("name, values", [
    ("frames", [5, "1-2", [], [1.5], [NAN], [True], [0], [10**12], {1: 2}, np.array(1)]),
    ("images", [5, [5], "a.gif", [""], None, "\0.png"]), ("volumes", [5, "a.xyz"]),
    ("deliver", [5]), ("wants", ["foo", None, 1]),
])
def test_wrong_arguments_of_render_frames_are_named(device, room, tmp_path, monkeypatch, name,
                                                    values):
    monkeypatch.chdir(tmp_path)
    word = {"frames": "frame", "images": "image", "volumes": "volume"}.get(name, name)
    for value in values:
        expect_error(lambda: voxelume.render_frames(
            room, **{"frames": [1], "images": "a.#.png", "devices": device, name: value}), word)
    assert list(tmp_path.iterdir()) == []  # nor the files with good names
    if name == "wants":
        expect_error(lambda: voxelume.render_frames(room, wants="foo"),
                     'wants is "images", "volumes" or "both", not \'foo\'')


@pytest.mark.parametrize("source", [None, 1, [1], np.ones(3), re, "", "\0"])
def test_what_is_no_scene_is_an_error(source):
    expect_error(lambda: voxelume.scene(source), "scene is")


@pytest.mark.parametrize("change, key", [
    ({"world": {"voxel_size": NAN}}, "world.voxel_size"),
    ({"lights": [{"intensity": -INF}]}, "lights[0].intensity"),
    ({"observer": {"position": np.array([0, NAN, 0])}}, "observer.position[1]"),
    ({"objects": [{"model": object()}]}, "objects[0].model"),
    ({"materials": {("a", 1): {}}}, "materials"),
])
def test_values_that_scenes_cant_have_are_named_by_their_key(room, change, key):
    with pytest.raises(voxelume.Error) as caught:
        voxelume.scene({**room, **change})
    assert (caught.value.kind, caught.value.key) == ("scene", key)
    assert key in str(caught.value)


def test_scenes_that_hold_themselves_are_errors(room):
    room["world"]["again"] = room
    expect_error(lambda: voxelume.scene(room), "holds itself", "scene")
    deep = inner = {"voxelume": 1}
    for _ in range(5000):
        inner["a"] = {}
        inner = inner["a"]
    expect_error(lambda: voxelume.scene(deep), "too deep", "scene")


def test_changes_and_folders_are_checked(room):
    for changes in (5, [("a", 1)], {1: 2}):
        expect_error(lambda: voxelume.scene(room, changes=changes), "changes")
    expect_error(lambda: voxelume.scene(room, changes={"render.size": [8, NAN]}),
                 "render.size[1]", "scene")
    for assets in (5, [5], None, [""]):
        expect_error(lambda: voxelume.scene(room, assets=assets), "assets")
    for text in (5, None, "\ud800"):
        expect_error(lambda: voxelume.parse_scene(text), "text is")


def test_other_functions_check_their_arguments(device, room):
    image = voxelume.render(room, devices=device, size=(8, 6))
    expect_error(lambda: voxelume.plan(room, "cpu"), "device is")
    expect_error(lambda: voxelume.png_of(None), "image is")
    expect_error(lambda: voxelume.dense(image), "volume is")
    for exposure in (NAN, INF, 65, "x", None):
        expect_error(lambda: voxelume.png_of(image, exposure), "exposure is")
    for limit in (-1, NAN, 2.5, "1GB", None, 10**30):
        expect_error(lambda: voxelume.limit_memory(limit), "bytes is")
    for selector in (2.5, None, True, b"cpu", -1):
        expect_error(lambda: voxelume.open_devices(selector), "selector is")
    index = device[0].info.index
    assert voxelume.open_devices(index)[0].info.index == index


def test_methods_refuse_values_without_sense(device, room, tmp_path):
    scene = voxelume.scene(room)
    image = voxelume.render(scene, devices=device, size=(8, 6))
    volume = voxelume.render_volume(scene, devices=device)
    for exposure in (NAN, INF, 1e9):
        expect_error(lambda: image.write(tmp_path / "a.png", exposure=exposure), "exposure is")
        expect_error(lambda: volume.write_page(tmp_path / "a.html", exposure=exposure), "exposure")
    for angle in (NAN, INF, 1e308):
        expect_error(lambda: volume.view(around=angle), "a view is")
        expect_error(lambda: volume.view(above=angle), "a view is")
        expect_error(lambda: scene.with_noise(angle if angle != 1e308 else -1), "noise")
    expect_error(lambda: image.write(tmp_path / "a.exr", channels=[]), "channels")
    assert list(tmp_path.iterdir()) == []
    for call in (lambda: scene.with_size((8.5, 6)), lambda: scene.with_samples(2.5),
                 lambda: image.write(5), lambda: voxelume.compare(image, None)):
        with pytest.raises(TypeError):
            call()
