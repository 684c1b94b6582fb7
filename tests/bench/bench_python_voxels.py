#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""Times matplotlib's `voxels` against `voxelume.voxels` on one array: a coloured gyroid of N³ cells.

Usage: bench_python_voxels.py FOLDER SECONDS [SIZE...]: pictures of both go to FOLDER, and matplotlib
is ended after SECONDS.
"""
import multiprocessing
import sys
import time
from pathlib import Path

import matplotlib
import numpy as np
import voxelume

matplotlib.use("Agg")
from matplotlib import pyplot  # noqa: E402 (after the choice of what draws)


def gyroid(size):
    """Voxels around a gyroid of two periods, and their colours."""
    x, y, z = np.indices((size, size, size)) * (4 * np.pi / size)
    value = np.sin(x) * np.cos(y) + np.sin(y) * np.cos(z) + np.sin(z) * np.cos(x)
    colors = np.stack([np.sin(x / 4), np.sin(y / 4), np.sin(z / 4)], axis=3) * 0.8 + 0.2
    return np.abs(value) < 0.35, colors


def seconds(action):
    start = time.perf_counter()
    action()
    return time.perf_counter() - start


def by_matplotlib(size, file):
    filled, colors = gyroid(size)
    figure = pyplot.figure(figsize=(6.4, 4.8), dpi=100)
    axes = figure.add_subplot(projection="3d")
    axes.voxels(filled, facecolors=colors)
    figure.savefig(file)
    pyplot.close(figure)


def by_voxelume(size, file):
    filled, colors = gyroid(size)
    voxelume.voxels(filled, colors=colors).write(file)


def seconds_of_matplotlib(size, file, limit):
    """The time that it took, as text: in a process of its own, which can be ended."""
    process = multiprocessing.get_context("spawn").Process(target=by_matplotlib, args=(size, file))
    start = time.perf_counter()
    process.start()
    process.join(limit)
    if process.exitcode is None:
        process.kill()
        process.join()
        return f"> {limit:.0f} s"
    return f"{time.perf_counter() - start:.2f} s"


def main(folder, limit, sizes):
    folder = Path(folder)
    folder.mkdir(parents=True, exist_ok=True)
    print("cells      voxels   matplotlib  voxelume, first call  voxelume, next call")
    for size in sizes:
        first, again = [seconds(lambda: by_voxelume(size, folder / f"voxelume.{size}.png"))
                        for _ in range(2)]
        theirs = seconds_of_matplotlib(size, folder / f"matplotlib.{size}.png", limit)
        voxels = np.count_nonzero(gyroid(size)[0])
        print(f"{size:3}³ {voxels:>12} {theirs:>12} {first:>19.2f} s {again:>18.2f} s", flush=True)


if __name__ == "__main__":
    main(sys.argv[1], float(sys.argv[2]), [int(size) for size in sys.argv[3:]] or [32, 64, 128])
