#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""Renders thousands of frames in one process, and starts thousands on one cache: neither memory
nor descriptors nor files may grow."""
import argparse
import json
import os
import pathlib
import subprocess
import tempfile
import time

import outputs
from runs import Tally, run

GROWTH = 1.1  # of resident memory, from the first fifth of the frames to the last
ROOM = 64 << 20  # bytes: memory that glibc takes from the system at once, as tests let it


def moving_scene(frames):
    scene = json.loads(json.dumps(outputs.SCENE))
    scene["render"]["size"] = [16, 12]
    scene["world"]["voxel_size"] = 0.25
    scene["animation"] = {"frames": frames, "tracks": [
        {"target": "objects[0].turn", "keys": [{"frame": 1, "value": [0, 0, 0]},
                                               {"frame": frames, "value": [0, 3600, 0]}]},
        {"target": "models.ball.radius", "keys": [{"frame": 1, "value": 0.8},
                                                  {"frame": frames, "value": 0.6}]}]}
    return scene


def watch(process, out, frames):
    """Pairs of frames done and (resident bytes, descriptors), from time to time."""
    seen = []
    while process.poll() is None:
        try:
            pages = int(pathlib.Path(f"/proc/{process.pid}/statm").read_text().split()[1])
            files = len(os.listdir(f"/proc/{process.pid}/fd"))
        except (FileNotFoundError, ProcessLookupError, PermissionError):
            break
        done = len(os.listdir(out))
        if done:
            seen.append((done, pages * 4096, files))
        time.sleep(min(1.0, frames / 2000))
    process.wait()
    return seen or [(frames, 0, 0)]


def long_process(program, folder, frames, tally):
    (folder / "moving.json").write_text(json.dumps(moving_scene(frames)))
    (folder / "out").mkdir()
    process = subprocess.Popen([str(program), "render", "moving.json", "-q", "-o",
                                "out/f.######.exr"], cwd=folder)
    seen = watch(process, folder / "out", frames)
    faults = [] if process.returncode == 0 else [f"exit code {process.returncode}"]
    early = [s for s in seen if s[0] < 0.2 * frames] or seen[:1]
    late = [s for s in seen if s[0] > 0.8 * frames] or seen[-1:]
    bytes_early, bytes_late = max(s[1] for s in early), max(s[1] for s in late)
    if bytes_late > GROWTH * bytes_early + ROOM:
        faults.append(f"memory grows from {bytes_early >> 20} to {bytes_late >> 20} MB")
    if max(s[2] for s in late) > max(s[2] for s in early) + 4:
        faults.append(f"descriptors grow from {early[-1][2]} to {late[-1][2]}")
    if (done := len(os.listdir(folder / "out"))) != frames:
        faults.append(f"{done} files for {frames} frames")
    tally.add(f"{frames} frames in one process", faults)
    print(f"{frames} frames in one process: {bytes_early >> 20} MB and {max(s[2] for s in early)} "
          f"descriptors early, {bytes_late >> 20} MB and {max(s[2] for s in late)} late", flush=True)


def many_processes(program, folder, count, tally):
    cache = folder / "cache"
    environment = {"VOXELUME_CACHE_DIR": str(cache)}
    sizes = []
    for number in range(count):
        result = run(program, ["render", "scene.json", "-q", "--size", "16x12", "-o", "a.exr"],
                     folder, environment=environment)
        if result.code != 0:
            tally.add(f"process {number}", [f"exit code {result.code}: {result.err}"])
        if number in (count // 2, count - 1):  # what is kept depends on how long it took
            files = [path for path in cache.rglob("*") if path.is_file()]
            sizes.append((len(files), sum(path.stat().st_size for path in files)))
    faults = [] if sizes[-1][0] <= sizes[0][0] + 2 else [f"the cache grows: {sizes}"]
    tally.add(f"{count} processes on one cache", faults)
    print(f"{count} processes on one cache: files and bytes {sizes}", flush=True)


def main():
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("program", type=pathlib.Path)
    parser.add_argument("--frames", type=int, default=10000)
    parser.add_argument("--processes", type=int, default=10000)
    options = parser.parse_args()
    tally = Tally("endurance")
    with tempfile.TemporaryDirectory() as name:
        folder = pathlib.Path(name)
        outputs.write_inputs(folder)
        long_process(options.program.resolve(), folder, options.frames, tally)
        many_processes(options.program.resolve(), folder, options.processes, tally)
    return tally.end() > 0


if __name__ == "__main__":
    raise SystemExit(main())
