#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""Holds the light of a glossy ball against Mitsuba 3's.

Usage: mitsuba_gloss.py VOXELUME [SAMPLES]

Renders a white metal ball of small roughness, under a rectangular lamp and a dim even sky. Here it
is in global light, once with an emissive object as the lamp and once with one of `lights`; there by
Mitsuba's path integrator (roughconductor with GGX, reflectance 1). Compares squares of 4 x 4 pixels
on the ball. Mitsuba's surface loses what facets reflect several times: it is
added by Kulla and Conty's formula, with the albedos that Mitsuba's own ball shows in even light.
Fails where the mean differs by 0.2 % or squares by 2 % (RMS). Where Mitsuba isn't installed (pip install
mitsuba) it says so and ends with 77, as tests do that are skipped.
"""
import math
import sys

from peer_mitsuba import load_mitsuba, our_image, sensor

SIZE = 128
SQUARE = 4
SAMPLES = 512
MAX_MEAN, MAX_SQUARES = 0.002, 0.02
RADIUS, EYE, ANGLE, FAR = 0.5, 2.0, 30.0, 0.85
LIGHT = {"y": 1.2, "size": 0.6, "radiance": 20.0}
SKY = 0.2


def our_ball(mi, np, voxelume, roughness, samples, is_object):
    """The ball's light in this program. The lamp hides the sky behind it, as Mitsuba's does; one of
    `lights` shines on top of it instead."""
    thin = 1e-4
    scene = {
        "voxelume": 1,
        "world": {"voxel_size": 0.02, "background": [SKY] * 3,
                  "bounds": {"min": [-0.6, -0.6, -0.6], "max": [0.6, 1.3, 0.6]}},
        "materials": {"metal": {"base_color": [1, 1, 1], "metallic": 1, "roughness": roughness},
                      "lamp": {"color": [0, 0, 0], "emission": [LIGHT["radiance"]] * 3}},
        "models": {"ball": {"shape": "sphere", "radius": RADIUS, "surface": "exact"},
                   "lamp": {"shape": "box", "size": [LIGHT["size"], thin, LIGHT["size"]],
                            "surface": "exact"}},
        "objects": [{"model": "ball", "material": "metal"},
                    {"model": "lamp", "material": "lamp",
                     "position": [0, LIGHT["y"] + thin / 2, 0]}],
        "observer": {"position": [0, 0, -EYE], "look_at": [0, 0, 0],
                     "display": {"shape": "pyramid", "angle": ANGLE}},
        "render": {"size": [SIZE, SIZE], "samples": samples, "light": "global", "bounces": 1},
    }
    if not is_object:
        radiance = LIGHT["radiance"] - SKY
        scene["objects"].pop()
        scene["lights"] = [{"type": "rectangle", "position": [0, LIGHT["y"], 0],
                            "direction": [0, -1, 0], "size": [LIGHT["size"]] * 2,
                            "intensity": radiance * LIGHT["size"] ** 2 / math.pi}]
    return our_image(mi, np, voxelume, scene)


def mitsuba_image(mi, np, roughness, samples, is_furnace):
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
        "sensor": sensor(mi, SIZE, samples, [0, 0, -EYE], [0, 0, 0], ANGLE),
    }
    if is_furnace:
        del scene["light"]
    return np.array(mi.render(mi.load_dict(scene))).astype(float)[:, :, :3]


def points_on_ball(np):
    """Of each pixel, the ball's normal where its middle is seen and the cosine of the angle to the
    viewer; 0 beside the ball."""
    half = math.tan(math.radians(ANGLE / 2))
    at = (2 * (np.arange(SIZE) + 0.5) / SIZE - 1) * half
    x, y = np.meshgrid(-at, -at)  # the right-hand side is -X
    way = np.stack([x, y, np.ones_like(x)], axis=-1)
    way /= np.linalg.norm(way, axis=-1, keepdims=True)
    along = EYE * way[..., 2]
    inside = np.maximum(along ** 2 - EYE ** 2 + RADIUS ** 2, 0)
    normal = (way * (along - np.sqrt(inside))[..., None] - [0, 0, EYE]) / RADIUS
    cosine = -np.einsum("yxc,yxc->yx", normal, way)
    return normal, np.where(inside > 0, cosine, 0)


def light_returned_later(np, furnace):
    """What Mitsuba's ball lacks of the lamp's and the sky's light: facets return it later."""
    normal, cosine = points_on_ball(np)
    seen = cosine > 0.02
    steps = np.linspace(0, 1, 41)
    number = np.digitize(cosine[seen], steps)
    lost = 1 - furnace.mean(axis=-1)[seen]
    counts = np.maximum(np.bincount(number, minlength=42), 1)
    middles = np.bincount(number, cosine[seen], 42) / counts
    means = np.bincount(number, lost, 42) / counts
    used = np.bincount(number, minlength=42) > 0

    def missing(c):
        return np.interp(c, middles[used], means[used])
    fine = (np.arange(2000) + 0.5) / 2000
    mean = (2 * fine * missing(fine)).mean()
    at = (np.arange(24) + 0.5) / 24 - 0.5
    lamp = np.array([[a * LIGHT["size"], LIGHT["y"], b * LIGHT["size"]] for a in at for b in at])
    way = lamp[None, None] - RADIUS * normal[:, :, None]
    squared = (way ** 2).sum(axis=-1)
    way /= np.sqrt(squared)[..., None]
    c = np.maximum((way * normal[:, :, None]).sum(axis=-1), 0)
    part = LIGHT["size"] ** 2 / len(lamp)
    arriving = (missing(c) * c * way[..., 1] / squared).sum(axis=-1) * part / math.pi
    later = SKY * mean + (LIGHT["radiance"] - SKY) * arriving
    return (missing(cosine) * later / mean)[..., None]


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


def compare(mi, np, voxelume, roughness, samples):
    """Prints the differences of our images to Mitsuba's. True if they are small."""
    lit, furnace = (mitsuba_image(mi, np, roughness, samples, even) for even in (False, True))
    theirs = squares_on_ball(np, lit + light_returned_later(np, furnace))
    are_close = True
    for is_object in (True, False):
        ours = squares_on_ball(
            np, our_ball(mi, np, voxelume, roughness, samples, is_object))
        mean = float(ours.mean() / theirs.mean() - 1)
        each = np.abs(ours / theirs - 1)
        rms = float(np.sqrt((each ** 2).mean()))
        print(f"roughness {roughness}, {'emissive object' if is_object else 'light'}: "
              f"mean {mean:+.4f}, squares RMS {rms:.4f}, largest {each.max():.4f} of {len(each)}")
        are_close &= abs(mean) < MAX_MEAN and rms < MAX_SQUARES
    return are_close


def main():
    if len(sys.argv) not in (2, 3):
        sys.exit(__doc__)
    samples = int(sys.argv[2]) if len(sys.argv) == 3 else SAMPLES
    found = load_mitsuba()
    results = [compare(*found, sys.argv[1], roughness, samples) for roughness in (0.15, 0.3)]
    sys.exit(0 if all(results) else 1)


if __name__ == "__main__":
    main()
