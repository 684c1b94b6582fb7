#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""Holds the light that glass and a mirror throw against Mitsuba 3's.

Usage: mitsuba_glass.py VOXELUME [SAMPLES]

Renders a ball of clear glass and a mirror ball on a grey floor under a rectangular light, which
here is one of `lights`, and compares squares of 8 x 8 pixels with Mitsuba's path integrator
(dielectric and conductor without roughness). Paths end where they are scattered 8 times, in
Mitsuba's count, too. Fails where the mean differs by 0.5 %, or squares by 3 % of the mean (RMS),
which is three times what the noise of 1,024 samples makes.
Where Mitsuba isn't installed (pip install mitsuba) it says so and ends with 77, as tests do that
are skipped.
"""
import math
import sys

from peer_mitsuba import load_mitsuba, our_image, sensor, squares_of

SIZE = 128
SQUARE = 8
SAMPLES = 1024
MAX_MEAN, MAX_SQUARES = 0.005, 0.03
BOUNCES = 8
RADIUS, GREY, ANGLE = 0.3, 0.5, 40.0
BALLS = {"glass": [0.38, RADIUS, 0.0], "mirror": [-0.38, RADIUS, 0.1]}
EYE, TARGET = [0.0, 0.9, -2.0], [0.0, 0.15, 0.0]
LIGHT = {"y": 1.3, "size": 0.5, "radiance": 10.0}
SKY = 0.1


def our_balls(mi, np, voxelume, samples):
    thick = 0.1
    scene = {
        "voxelume": 1,
        "world": {"voxel_size": 0.02, "background": [SKY] * 3,
                  "bounds": {"min": [-1.5, -0.1, -1.5], "max": [1.5, 1.4, 1.5]}},
        "materials": {"grey": {"color": [GREY] * 3},
                      "glass": {"diffuse": 0, "reflection": 1, "refraction": 1, "fresnel": True,
                                "ior": 1.5},
                      "mirror": {"diffuse": 0, "reflection": 1}},
        "models": {"ball": {"shape": "sphere", "radius": RADIUS, "surface": "exact"},
                   "floor": {"shape": "box", "size": [3, thick, 3], "surface": "exact"}},
        "objects": [{"model": "floor", "material": "grey", "position": [0, -thick / 2, 0]}] +
                   [{"model": "ball", "material": name, "position": at}
                    for name, at in BALLS.items()],
        "lights": [{"type": "rectangle", "position": [0, LIGHT["y"], 0], "direction": [0, -1, 0],
                    "size": [LIGHT["size"]] * 2,
                    "intensity": LIGHT["radiance"] * LIGHT["size"] ** 2 / math.pi}],
        "observer": {"position": EYE, "look_at": TARGET,
                     "display": {"shape": "pyramid", "angle": ANGLE}},
        "render": {"size": [SIZE, SIZE], "samples": samples, "light": "global",
                   "bounces": BOUNCES, "filter": "box"},
    }
    return our_image(mi, np, voxelume, scene)


def mitsuba_image(mi, np, samples):
    """Mitsuba's picture; its light hides the sky behind it, so it has the sky's radiance more."""
    transform = mi.ScalarTransform4f
    lamp = transform().look_at(origin=[0, LIGHT["y"], 0], target=[0, 0, 0], up=[0, 0, 1])
    floor = transform().rotate([1, 0, 0], -90)
    scene = {
        "type": "scene",
        "integrator": {"type": "path", "max_depth": BOUNCES + 1, "rr_depth": 100},
        "sky": {"type": "constant", "radiance": {"type": "rgb", "value": SKY}},
        "light": {"type": "rectangle",
                  "to_world": lamp @ transform().scale(LIGHT["size"] / 2),
                  "emitter": {"type": "area",
                              "radiance": {"type": "rgb", "value": LIGHT["radiance"] + SKY}}},
        "floor": {"type": "rectangle", "to_world": floor @ transform().scale(1.5),
                  "bsdf": {"type": "diffuse", "reflectance": {"type": "rgb", "value": GREY}}},
        "sensor": sensor(mi, SIZE, samples, EYE, TARGET, ANGLE),
    }
    surfaces = {"glass": {"type": "dielectric", "int_ior": 1.5, "ext_ior": 1.0},
                "mirror": {"type": "conductor", "material": "none"}}
    for name, at in BALLS.items():
        scene[name] = {"type": "sphere", "center": at, "radius": RADIUS, "bsdf": surfaces[name]}
    return np.array(mi.render(mi.load_dict(scene))).astype(float)[:, :, :3]


def main():
    if len(sys.argv) not in (2, 3):
        sys.exit(__doc__)
    mi, np = load_mitsuba()
    samples = int(sys.argv[2]) if len(sys.argv) == 3 else SAMPLES
    ours = squares_of(our_balls(mi, np, sys.argv[1], samples), SQUARE)
    theirs = squares_of(mitsuba_image(mi, np, samples), SQUARE)
    mean = float(ours.mean() / theirs.mean() - 1)
    each = np.abs(ours - theirs) / theirs.mean()
    rms = float(np.sqrt((each ** 2).mean()))
    print(f"glass and mirror: mean {mean:+.4f}, squares RMS {rms:.4f} of the mean, "
          f"largest {each.max():.4f} of {each[..., 0].size}")
    sys.exit(0 if abs(mean) < MAX_MEAN and rms < MAX_SQUARES else 1)


if __name__ == "__main__":
    main()
