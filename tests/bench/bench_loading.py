#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""Times the reading of large files: .vox of 256³, .npy of 512³, a GLB of 108 MB. Needs numpy.

Each is rendered in 32 x 24 pixels, RUNS times from the page cache. Printed are the minima of what
`render` calls "load", and of "open", which reads a file to frame it; and beside them how long this
process takes to add the file's bytes up, which is the way of its memory.

Usage: bench_loading.py PROGRAM FOLDER [RUNS [PART OF A NAME...]]: FOLDER keeps the files, 1.3 GB.
"""
import json
import os
import struct
import subprocess
import sys
import time
from pathlib import Path

import numpy as np

random = np.random.default_rng(1)


def vox_chunk(name, content, children=b""):
    return name + struct.pack("<ii", len(content), len(children)) + content + children


def write_vox(path, cells, colors):
    voxels = np.hstack([cells, colors]).astype(np.uint8)
    size = vox_chunk(b"SIZE", struct.pack("<iii", 256, 256, 256))
    xyzi = vox_chunk(b"XYZI", struct.pack("<i", len(voxels)) + voxels.tobytes())
    palette = random.integers(0, 256, (256, 4), dtype=np.uint8)
    palette[:, 3] = 255
    main = size + xyzi + vox_chunk(b"RGBA", palette.tobytes())
    path.write_bytes(b"VOX " + struct.pack("<i", 150) + vox_chunk(b"MAIN", b"", main))


def write_vox_files(folder):
    cells = np.indices((256, 256, 256), dtype=np.uint8).reshape(3, -1).T[:, ::-1]  # x is fastest
    noise = random.integers(1, 256, (len(cells), 1))
    height = 100 + 40 * np.sin(np.arange(256) / 23)[:, None] * np.cos(np.arange(256) / 31)
    below = cells[:, 2] < height[cells[:, 0], cells[:, 1]]
    write_vox(folder / "solid.vox", cells, np.full_like(noise, 7))
    write_vox(folder / "noise.vox", cells, noise)
    write_vox(folder / "terrain.vox", cells[below], 1 + cells[below][:, 2:] // 4)
    order = random.permutation(len(cells))
    write_vox(folder / "shuffled.vox", cells[order], noise[order])


def write_arrays(folder):
    x = np.arange(512.0) - 256
    radius = np.sqrt(x[:, None, None] ** 2 + x[:, None] ** 2 + x**2)
    for name, cells in {
        "values": np.clip(255 - radius / 2, 0, 255),
        "labels2": radius < 200,
        "labels3": (radius < 220) * (1 + (radius < 100)),
        "labels5": np.clip(radius // 70, 0, 4),
        "noise5": random.integers(0, 5, radius.shape),
    }.items():
        np.save(folder / f"{name}.npy", cells.astype(np.uint8))


def write_glb(path, side=1500):
    """A wavy sheet of 4.5 million triangles with normals."""
    i, j = np.meshgrid(np.arange(side), np.arange(side), indexing="ij")
    points = np.stack([i / side, 0.1 * np.sin(i / 50) * np.cos(j / 60), j / side], -1)
    first = (i * side + j)[:-1, :-1].reshape(-1)
    corners = np.stack([first + n for n in (0, 1, side, 1, side + 1, side)], -1)
    parts = [
        points.reshape(-1, 3).astype("<f4"),
        np.tile(np.float32([0, 1, 0]), (side * side, 1)),
        corners.reshape(-1).astype("<u4"),
    ]
    buffer = b"".join(part.tobytes() for part in parts)
    views, start = [], 0
    for part in parts:
        views.append({"buffer": 0, "byteOffset": start, "byteLength": part.nbytes})
        start += part.nbytes
    count = {"count": side * side, "type": "VEC3", "componentType": 5126}
    bounds = {"min": parts[0].min(0).tolist(), "max": parts[0].max(0).tolist()}
    indices = {"count": parts[2].size, "type": "SCALAR", "componentType": 5125}
    gltf = {
        "asset": {"version": "2.0"},
        "scenes": [{"nodes": [0]}],
        "nodes": [{"mesh": 0}],
        "meshes": [{"primitives": [{"attributes": {"POSITION": 0, "NORMAL": 1}, "indices": 2}]}],
        "buffers": [{"byteLength": len(buffer)}],
        "bufferViews": views,
        "accessors": [
            {"bufferView": 0, **count, **bounds},
            {"bufferView": 1, **count},
            {"bufferView": 2, **indices},
        ],
    }
    text = json.dumps(gltf).encode()
    text += b" " * (-len(text) % 4)
    chunks = struct.pack("<I", len(text)) + b"JSON" + text
    chunks += struct.pack("<I", len(buffer)) + b"BIN\0" + buffer
    path.write_bytes(b"glTF" + struct.pack("<II", 2, 12 + len(chunks)) + chunks)


def add_up(path):
    """Seconds that the sum of a file's bytes takes."""
    words = np.memmap(path, np.uint64, "r", shape=path.stat().st_size // 8)
    start = time.perf_counter()
    words.sum()
    return time.perf_counter() - start


def load(program, path, folder):
    """Seconds of "load" and "open"."""
    report = folder / "statistics.json"
    subprocess.run(
        [program, "render", path, "-o", folder / "image.exr", "--size", "32x24", "--samples", "1",
         "--quiet", "--stats-json", report],
        check=True,
        env={**os.environ, "VOXELUME_CACHE_MB": "0"},  # kernels are kept, models aren't
    )
    seconds = json.loads(report.read_text())["seconds"]
    return seconds["load"], seconds["open"]


def main(program, folder, runs="9", *parts):
    folder = Path(folder)
    folder.mkdir(parents=True, exist_ok=True)
    if not (folder / "sheet.glb").exists():
        write_vox_files(folder)
        write_arrays(folder)
        write_glb(folder / "sheet.glb")
    print("file          MB  load, ms  open, ms  sum, ms")
    for path in sorted(folder.glob("*.*")):
        if path.suffix not in (".vox", ".npy", ".glb") or not all(p in path.name for p in parts):
            continue
        loads, opens = zip(*(load(program, path, folder) for _ in range(int(runs))))
        ways = [add_up(path) for _ in range(int(runs))]
        print(f"{path.name:12} {path.stat().st_size / 1e6:3.0f}"
              f"  {min(loads) * 1e3:8.1f}  {min(opens) * 1e3:8.1f}  {min(ways) * 1e3:7.1f}",
              flush=True)


main(*sys.argv[1:])
