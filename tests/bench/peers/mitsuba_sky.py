#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""Holds the light of a sky that is a picture against Mitsuba 3's.

Usage: mitsuba_sky.py VOXELUME [SAMPLES]

Renders a matt ball over a matt floor under a latitude-longitude map with a bright sun, in global light
here and by Mitsuba's path integrator (envmap, diffuse), and compares squares of 8 x 8 pixels. Fails
where the mean differs by 0.2 % or squares by 2 % (RMS). Where Mitsuba isn't installed (pip install
mitsuba) it says so and ends with 77, as tests do that are skipped.
"""
import math
import sys

from peer_mitsuba import load_mitsuba, our_image, sensor, squares_of

SIZE, SQUARE, BOUNCES = 96, 8, 3
WIDTH, HEIGHT = 1024, 512
MAX_MEAN, MAX_SQUARES = 0.002, 0.02
EYE, TARGET, ANGLE = [0.4, 1.1, -2.2], [0, 0.3, 0], 45.0
SUN, SUN_WIDTH = (0.5, 0.6, -0.62), 0.06


def sky(np, rows):
    """The picture, with its rows at these shares of the way from the zenith down."""
    u = (np.arange(WIDTH) + 0.5) / WIDTH
    longitude = 2 * math.pi * (0.5 - u)[None, :]
    theta = math.pi * np.asarray(rows)[:, None]
    x, z = np.sin(theta) * np.sin(longitude), np.sin(theta) * np.cos(longitude)
    y = np.cos(theta) + 0 * x
    sun = np.array(SUN) / np.linalg.norm(SUN)
    cosine = x * sun[0] + y * sun[1] + z * sun[2]
    glow = 80 * np.exp((cosine - 1) / SUN_WIDTH ** 2 * 2)
    return np.stack([0.3 + 0.2 * y + glow, 0.4 + 0.1 * x + 0.8 * glow, 0.6 + 0.2 * z + 0.6 * glow],
                    axis=-1).astype(np.float32)


def our_scene():
    """The scene in this program."""
    return {
        "voxelume": 1,
        "world": {"voxel_size": 0.05, "bounds": {"min": [-1.2, -0.2, -1.2], "max": [1.2, 1, 1.2]},
                  "sky": {"kind": "map", "file": "sky.exr"}},
        "materials": {"floor": {"color": [0.6, 0.5, 0.4]}, "ball": {"color": [0.3, 0.6, 0.8]}},
        "models": {"floor": {"shape": "box", "size": [2, 0.1, 2], "surface": "exact"},
                   "ball": {"shape": "sphere", "radius": 0.4, "surface": "exact"}},
        "objects": [{"model": "floor", "material": "floor", "position": [0, -0.05, 0]},
                    {"model": "ball", "material": "ball", "position": [0, 0.45, 0]}],
        "observer": {"position": EYE, "look_at": TARGET,
                     "display": {"shape": "pyramid", "angle": ANGLE}},
        "render": {"size": [SIZE, SIZE], "light": "global", "bounces": BOUNCES},
    }


def write_sky(mi, np, folder):
    mi.Bitmap(sky(np, (np.arange(HEIGHT) + 0.5) / HEIGHT)).write(str(folder / "sky.exr"))


def our_ball(mi, np, voxelume, samples):
    scene = our_scene()
    scene["render"]["samples"] = samples
    return our_image(mi, np, voxelume, scene, lambda folder: write_sky(mi, np, folder))


def mitsuba_scene(mi, np):
    """The scene in Mitsuba, whose pictures have their first and last rows at the poles."""
    place = mi.ScalarTransform4f

    def matt(color):
        return {"type": "diffuse", "reflectance": {"type": "rgb", "value": color}}
    return {
        "type": "scene",
        "integrator": {"type": "path", "max_depth": BOUNCES + 2, "rr_depth": 1000},
        "sky": {"type": "envmap", "bitmap": mi.Bitmap(sky(np, np.arange(HEIGHT) / (HEIGHT - 1)))},
        "floor": {"type": "cube", "bsdf": matt([0.6, 0.5, 0.4]),
                  "to_world": place().translate([0, -0.05, 0]) @ place().scale([1, 0.05, 1])},
        "ball": {"type": "sphere", "radius": 0.4, "center": [0, 0.45, 0],
                 "bsdf": matt([0.3, 0.6, 0.8])},
    }


def mitsuba_image(mi, np, samples):
    scene = mitsuba_scene(mi, np)
    scene["sensor"] = sensor(mi, SIZE, samples, EYE, TARGET, ANGLE)
    return np.array(mi.render(mi.load_dict(scene))).astype(float)[:, :, :3]


def main():
    if len(sys.argv) not in (2, 3):
        sys.exit(__doc__)
    mi, np = load_mitsuba()
    samples = int(sys.argv[2]) if len(sys.argv) == 3 else 256
    ours = squares_of(our_ball(mi, np, sys.argv[1], samples), SQUARE)
    theirs = squares_of(mitsuba_image(mi, np, samples), SQUARE)
    mean = float(ours.mean() / theirs.mean() - 1)
    each = np.abs(ours / theirs - 1)
    rms = float(np.sqrt((each ** 2).mean()))
    print(f"sky map, {samples} samples: mean {mean:+.4f}, squares RMS {rms:.4f}, "
          f"largest {each.max():.4f}")
    sys.exit(0 if abs(mean) < MAX_MEAN and rms < MAX_SQUARES else 1)


if __name__ == "__main__":
    main()
