#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""Times matplotlib's `voxels` against `voxelume.voxels` on one array: a coloured gyroid of N³ cells.

Usage: bench_python_voxels.py FOLDER [SIZE...]: pictures of both go to FOLDER.
"""
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


def by_matplotlib(filled, colors, file):
    figure = pyplot.figure(figsize=(6.4, 4.8), dpi=100)
    axes = figure.add_subplot(projection="3d")
    axes.voxels(filled, facecolors=colors)
    figure.savefig(file)
    pyplot.close(figure)


def by_voxelume(filled, colors, file):
    voxelume.voxels(filled, colors=colors).write(file)


def main(folder, sizes):
    folder = Path(folder)
    folder.mkdir(parents=True, exist_ok=True)
    print("cells      voxels  matplotlib  voxelume, first call  voxelume, next call")
    for size in sizes:
        filled, colors = gyroid(size)
        ours = [seconds(lambda: by_voxelume(filled, colors, folder / f"voxelume.{size}.png"))
                for _ in range(2)]
        theirs = seconds(lambda: by_matplotlib(filled, colors, folder / f"matplotlib.{size}.png"))
        print(f"{size}³ {np.count_nonzero(filled):>12} {theirs:>9.2f} s {ours[0]:>19.2f} s "
              f"{ours[1]:>18.2f} s", flush=True)


if __name__ == "__main__":
    main(sys.argv[1], [int(size) for size in sys.argv[2:]] or [32, 64, 128])
