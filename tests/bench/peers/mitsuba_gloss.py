#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""Holds the light of a glossy ball against Mitsuba 3's.

Usage: mitsuba_gloss.py VOXELUME

Renders a white metal ball of small roughness, under a rectangular light and a dim even sky, in global
light here and by Mitsuba's path integrator (roughconductor with GGX, reflectance 1), and compares
squares of 4 x 4 pixels on the ball. Mitsuba's surface loses what facets reflect several times, so
its image is divided by that of the same ball in even white light, which shows the loss.
Fails where the mean differs by 0.5 % or squares by 2 %. Where Mitsuba isn't installed (pip install
mitsuba) it says so and ends with 77, as tests do that are skipped.
"""
import json
import math
import pathlib
import subprocess
import sys
import tempfile

SIZE = 128
SQUARE = 4
SAMPLES = 512
MAX_MEAN, MAX_SQUARES = 0.005, 0.02
SKIPPED = 77
RADIUS, EYE, ANGLE, FAR = 0.5, 2.0, 30.0, 0.85
LIGHT = {"y": 1.2, "size": 0.6, "radiance": 20.0}
SKY = 0.2


def find_mitsuba():
    """Mitsuba with a variant of colours, and numpy; None without them."""
    try:
        import mitsuba
        import numpy
    except ImportError:
        return None
    mitsuba.set_variant("scalar_rgb")
    return mitsuba, numpy


def our_image(mi, np, voxelume, roughness):
    """The ball's light in this program."""
    area = LIGHT["size"] ** 2
    scene = {
        "voxelume": 1,
        "world": {"voxel_size": 0.02, "background": [SKY] * 3,
                  "bounds": {"min": [-0.6, -0.6, -0.6], "max": [0.6, 0.6, 0.6]}},
        "materials": {"metal": {"base_color": [1, 1, 1], "metallic": 1, "roughness": roughness}},
        "models": {"ball": {"shape": "sphere", "radius": RADIUS, "surface": "exact"}},
        "objects": [{"model": "ball", "material": "metal"}],
        "lights": [{"type": "rectangle", "position": [0, LIGHT["y"], 0], "direction": [0, -1, 0],
                    "up": [0, 0, 1], "size": [LIGHT["size"]] * 2,
                    "intensity": LIGHT["radiance"] * area / math.pi}],
        "observer": {"position": [0, 0, -EYE], "look_at": [0, 0, 0],
                     "display": {"shape": "pyramid", "angle": ANGLE}},
        "render": {"size": [SIZE, SIZE], "samples": SAMPLES, "light": "global", "bounces": 1},
    }
    with tempfile.TemporaryDirectory() as name:
        folder = pathlib.Path(name)
        (folder / "scene.json").write_text(json.dumps(scene))
        subprocess.run([voxelume, "render", str(folder / "scene.json"), "-o",
                        str(folder / "ours.exr"), "--channels", "RGBA", "-q"], check=True)
        bitmap = mi.Bitmap(str(folder / "ours.exr"))
        names = [field.name for field in bitmap.struct_()]
        values = np.array(bitmap).astype(float)
        return np.stack([values[:, :, names.index(c)] for c in "RGB"], axis=-1)


def mitsuba_image(mi, np, roughness, is_furnace):
    """The ball's light in Mitsuba, or in even white light."""
    up = mi.ScalarTransform4f().look_at(origin=[0, LIGHT["y"], 0], target=[0, 0, 0],
                                        up=[0, 0, 1])
    scene = {
        "type": "scene",
        "integrator": {"type": "path", "max_depth": 2},
        "sky": {"type": "constant", "radiance": {"type": "rgb", "value": 1.0 if is_furnace else SKY}},
        "light": {"type": "rectangle",
                  "to_world": up @ mi.ScalarTransform4f().scale(LIGHT["size"] / 2),
                  "emitter": {"type": "area",
                              "radiance": {"type": "rgb", "value": LIGHT["radiance"]}}},
        "ball": {"type": "sphere", "radius": RADIUS,
                 "bsdf": {"type": "roughconductor", "material": "none", "distribution": "ggx",
                          "alpha": roughness ** 2}},
        "sensor": {"type": "perspective", "fov": ANGLE,
                   "to_world": mi.ScalarTransform4f().look_at(
                       origin=[0, 0, -EYE], target=[0, 0, 0], up=[0, 1, 0]),
                   "sampler": {"type": "independent", "sample_count": SAMPLES},
                   "film": {"type": "hdrfilm", "width": SIZE, "height": SIZE,
                            "rfilter": {"type": "box"}}},
    }
    if is_furnace:
        del scene["light"]
    return np.array(mi.render(mi.load_dict(scene))).astype(float)[:, :, :3]


def squares_on_ball(np, image):
    """The means of the squares that lie on the ball, away from its silhouette."""
    half = math.tan(math.radians(ANGLE / 2))
    edge = RADIUS / math.sqrt(EYE ** 2 - RADIUS ** 2) / half * FAR
    means = []
    for y in range(0, SIZE, SQUARE):
        for x in range(0, SIZE, SQUARE):
            corners = [(2 * (x + i) / SIZE - 1, 2 * (y + j) / SIZE - 1)
                       for i in (0, SQUARE) for j in (0, SQUARE)]
            if max(math.hypot(*corner) for corner in corners) < edge:
                means.append(image[y:y + SQUARE, x:x + SQUARE].mean(axis=(0, 1)))
    return np.array(means)


def compare(mi, np, voxelume, roughness):
    """Prints the differences of the two images. True if they are small."""
    ours = squares_on_ball(np, our_image(mi, np, voxelume, roughness))
    theirs = squares_on_ball(np, mitsuba_image(mi, np, roughness, False))
    theirs /= squares_on_ball(np, mitsuba_image(mi, np, roughness, True))
    mean = float(ours.mean() / theirs.mean() - 1)
    each = np.abs(ours / theirs - 1)
    print(f"roughness {roughness}: mean {mean:+.4f}, squares RMS "
          f"{float(np.sqrt((each ** 2).mean())):.4f}, largest {each.max():.4f} of {len(each)}")
    return abs(mean) < MAX_MEAN and np.sqrt((each ** 2).mean()) < MAX_SQUARES


def main():
    if len(sys.argv) != 2:
        sys.exit(__doc__)
    found = find_mitsuba()
    if not found:
        print("Mitsuba isn't installed: pip install mitsuba")
        sys.exit(SKIPPED)
    results = [compare(*found, sys.argv[1], roughness) for roughness in (0.15, 0.3)]
    sys.exit(0 if all(results) else 1)


if __name__ == "__main__":
    main()
