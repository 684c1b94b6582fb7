# SPDX-License-Identifier: Apache-2.0
"""Images and volumes in memory, files of them, callbacks, threads and Ctrl-C."""
import gc
import json
import signal
import subprocess
import sys
import threading
import time

import numpy as np
import pytest

import voxelume


def test_images_show_the_scene(device, room):
    image = voxelume.render(room, devices=device)
    assert (image.height, image.width) == image["Z"].shape == (48, 64)
    assert image["objectId"][2, 2] == 0 and image["B"][2, 2] == 0.5
    assert np.isinf(image["Z"][2, 2])
    assert image["objectId"][22, 32] == 1
    assert image["R"][22, 32] > 0.2 and image["G"][22, 32] == 0
    assert abs(image["Z"][22, 32] - 2.71) < 0.03
    assert image.rgba.shape == (48, 64, 4)
    assert "N.X" in image and "Q" not in image
    with pytest.raises(KeyError):
        image["Q"]


def test_planes_are_the_librarys_memory_and_outlive_the_image(device, room):
    image = voxelume.render(room, devices=device, channels=["depth"])
    assert image.channels == ["Z"]
    first, again = image["Z"], image["Z"]
    assert np.shares_memory(first, again)
    assert not first.flags.writeable and not first.flags.owndata
    with pytest.raises(ValueError):
        first[0, 0] = 1
    kept = first.copy()
    del image, again
    gc.collect()
    np.testing.assert_array_equal(first, kept)
    assert memoryview(first).nbytes == 48 * 64 * 4


def test_a_dict_gives_the_bits_of_its_text(device, room, tmp_path):
    file = tmp_path / "room.json"
    file.write_text(json.dumps(room))
    a = voxelume.render(room, devices=device)
    for b in (voxelume.render(file, devices=device), voxelume.render(str(file), devices=device),
              voxelume.render(voxelume.parse_scene(json.dumps(room)), devices=device)):
        for channel in a.channels:
            np.testing.assert_array_equal(a[channel], b[channel])


def test_volumes_are_arrays(device, room):
    volume = voxelume.render_volume(room, devices=device)
    assert volume.size == [48, 36, 64] and len(volume) > 100
    assert volume.colors.shape == (len(volume), 3)
    assert np.all(np.diff(volume.indices.astype(np.int64)) > 0)
    assert np.count_nonzero(volume.object_ids == 1) > 20
    cells = voxelume.dense(volume)
    assert cells.shape == (48, 36, 64, 4)
    first = int(volume.indices[0])
    place = first % 48, first // 48 % 36, first // (48 * 36)
    np.testing.assert_array_equal(cells[place][:3], volume.colors[0])
    assert np.count_nonzero(cells[..., 3]) == np.count_nonzero(volume.opacities)


def test_memory_is_limited(device, room):
    voxelume.limit_memory(1_000_000)
    try:
        with pytest.raises(voxelume.Error) as refused:
            voxelume.render(room, devices=device)
        assert refused.value.kind == "limit"
    finally:
        voxelume.limit_memory(0)
    assert voxelume.render(room, devices=device).width > 0


def test_files_hold_what_memory_does(device, room, tmp_path):
    image = voxelume.render(room, devices=device)
    image.write(tmp_path / "a.exr", float_color=True)
    read = voxelume.Image.read(tmp_path / "a.exr")
    np.testing.assert_array_equal(read["R"], image["R"])
    parts = voxelume.render(room, devices=device, channels=[
        "color", "materialId", "CryptoObject", "albedo", "lights"])
    parts.write(tmp_path / "parts.exr")
    read = voxelume.Image.read(tmp_path / "parts.exr")
    assert read.channels == parts.channels
    for channel in parts.channels:
        assert channel in parts and channel in read
    np.testing.assert_array_equal(read["CryptoObject00.R"], parts["CryptoObject00.R"])
    parts.write(tmp_path / "layers.exr", multi_part=True)
    assert b"CryptoObject02" in (tmp_path / "layers.exr").read_bytes()
    read = voxelume.Image.read(tmp_path / "layers.exr")
    assert read.channels == parts.channels
    np.testing.assert_array_equal(read["materialId"], parts["materialId"])
    parts.write(tmp_path / "color.exr", channels=["color"])
    assert voxelume.Image.read(tmp_path / "color.exr").channels == ["A", "B", "G", "R"]
    assert b"cryptomatte" in (tmp_path / "parts.exr").read_bytes()
    assert b"cryptomatte" not in (tmp_path / "color.exr").read_bytes()
    with pytest.raises(voxelume.Error):
        parts.write(tmp_path / "b.exr", channels=["colour"])
    image.write(tmp_path / "a.png", view_transform="agx", png_bits=16)
    assert (tmp_path / "a.png").read_bytes()[24] == 16
    for wrong in {"view_transform": "aces"}, {"png_bits": 12}:
        with pytest.raises(voxelume.Error):
            image.write(tmp_path / "b.png", **wrong)
    volume = voxelume.render_volume(room, devices=device)
    volume.write(tmp_path / "a.vdb")
    read = voxelume.Volume.read(tmp_path / "a.vdb")
    np.testing.assert_array_equal(read.indices, volume.indices)
    assert voxelume.compare(image, image)["flip"] == 0


def test_frames_are_written_and_delivered_in_order(device, room, tmp_path):
    delivered, shares = [], []
    statistics = voxelume.render_frames(
        room, [1, 3], images=tmp_path / "f.##.png", devices=device,
        deliver=lambda frame, image, volume: delivered.append((frame, image, volume)),
        progress=lambda done, frame: shares.append(done))
    assert [frame for frame, _, _ in delivered] == [1, 3]
    assert sorted(path.name for path in tmp_path.iterdir()) == ["f.01.png", "f.03.png"]
    assert shares == sorted(shares) and shares[-1] == 1
    tops = [np.argmax((image["objectId"] == 1).any(axis=1)) for _, image, _ in delivered]
    assert tops[1] < tops[0]
    assert len(statistics["frames"]) == 2


def test_errors_name_kind_and_place(room, tmp_path):
    room["objects"][1]["material"] = "gray"
    with pytest.raises(voxelume.Error) as caught:
        voxelume.scene(room)
    error = caught.value
    assert (error.kind, error.key, error.line) == ("scene", "objects[1].material", 0)
    assert str(error) == ('scene: objects[1].material: no material named "gray"; '
                          'did you mean "grey"?')
    file = tmp_path / "text.json"
    file.write_text('{"voxelume": 1,\n  "wrold": 2}')
    with pytest.raises(voxelume.Error) as caught:
        voxelume.scene(file)
    error = caught.value
    assert (error.file, error.line, error.column) == (str(file), 2, 3)
    with pytest.raises(voxelume.Error) as caught:
        voxelume.scene("no such file.json")
    assert caught.value.kind == "input"
    with pytest.raises(voxelume.Error) as caught:
        voxelume.open_devices("no such device")
    assert caught.value.kind == "device"


def test_values_of_a_scene_can_be_changed(room):
    assert voxelume.scene(room, size=(10, 8)).size == [10, 8]
    assert voxelume.scene(room, changes={"render.size": np.array([20, 10])}).size == [20, 10]
    with pytest.raises(voxelume.Error) as caught:
        voxelume.scene(room, changes={"objects.bell.position": [0, 1, 0]})
    assert "bell" in str(caught.value)
    with pytest.raises(voxelume.Error):
        voxelume.scene({**room, "lights": {1, 2}})


def test_exceptions_of_callbacks_end_the_call(device, room):
    def stop(done, frame):
        raise ZeroDivisionError("enough")
    with pytest.raises(ZeroDivisionError, match="enough"):
        voxelume.render(room, devices=device, progress=stop)
    assert voxelume.render(room, devices=device).width == 64


def test_warnings_are_heard_or_errors(device, room):
    room["objects"].append({"name": "far", "model": "ball", "position": [0, 7, 0]})
    heard = []
    voxelume.render(room, devices=device, warn=lambda *words: heard.append(words))
    assert [kind for kind, _, _ in heard] == ["outside_world"]
    with pytest.raises(voxelume.Error, match="lies outside the world"):
        voxelume.render(room, devices=device, strict=True)


def test_other_threads_run_meanwhile_and_share_a_device(device, room):
    """Python's lock is released, and calls of several threads for one device wait."""
    counts = [0]
    is_over = threading.Event()

    def count():
        while not is_over.is_set():
            counts[0] += 1
            time.sleep(0.001)
    counter = threading.Thread(target=count)
    counter.start()
    images = []
    callers = [threading.Thread(target=lambda: images.append(
        voxelume.render(room, devices=device, samples=64))) for _ in range(3)]
    for caller in callers:
        caller.start()
    for caller in callers:
        caller.join()
    is_over.set()
    counter.join()
    assert counts[0] > 5
    assert all(np.array_equal(images[0]["R"], image["R"]) for image in images)


LONG = """
import json, sys, time, voxelume
room = json.load(open(sys.argv[1]))
device = voxelume.open_devices("cpu")
voxelume.render(room, devices=device, light="global", samples=2)
start = []
def progress(done, frame):
    if not start:
        start.append(time.monotonic())
        print("begun", flush=True)
try:
    voxelume.render(room, devices=device, light="global", size=(1280, 960), samples=4096,
                    progress=progress)
except KeyboardInterrupt:
    print("interrupted", flush=True)
    voxelume.render(room, devices=device, light="global", samples=2)
    print("and well", flush=True)
"""


def test_ctrl_c_ends_a_call_within_a_tile(room, tmp_path):
    file = tmp_path / "room.json"
    file.write_text(json.dumps(room))
    with subprocess.Popen([sys.executable, "-c", LONG, str(file)], stdout=subprocess.PIPE,
                          text=True) as process:
        assert process.stdout.readline() == "begun\n"
        time.sleep(0.5)
        begun = time.monotonic()
        process.send_signal(signal.SIGINT)
        assert process.stdout.readline() == "interrupted\n"
        assert time.monotonic() - begun < 10
        assert process.stdout.readline() == "and well\n"
        assert process.wait() == 0


def test_a_plan_tells_whether_a_scene_fits(device, room):
    planned = voxelume.plan(room, device[0])
    assert planned["verdict"] == "fits" and planned["refusal"] is None
    assert 0 < planned["min_bytes"] <= planned["max_bytes"] < planned["device_bytes"]


def test_devices_say_what_they_are(device):
    assert device[0].info.is_usable
    assert any(info.name == device[0].info.name for info in voxelume.list_devices())
