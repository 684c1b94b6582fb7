#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""Times paths to an error beside Mitsuba 3: a voxel monument and a mesh under a sky and a sun.

Usage: mitsuba_paths.py VOXELUME MESH.obj [FOLDER]

Renders both scenes with 1 to 256 samples, in global light here and by Mitsuba's path integrator
(llvm_ad_rgb, and scalar_rgb up to 16), denoisers off, and prints for each the mean squared relative
error against Mitsuba's picture of REFERENCE samples, the seconds of the image without loading, and
the product of both, which is even for unbiased light: the smaller, the sooner an error is reached.
The cubes are quads with colours at their corners there. FOLDER keeps the scenes. Where Mitsuba isn't
installed (pip install mitsuba; DRJIT_LIBLLVM_PATH names an LLVM of 16 or later) it says so and ends
with 77.
"""
import json
import math
import pathlib
import statistics
import subprocess
import sys
import tempfile
import time

SIZE = (256, 192)
SAMPLES = (1, 4, 16, 64, 256)
REFERENCE = 4096
RUNS = 5
BOUNCES = 8
SKY, SUN, SUN_WAY = [0.5, 0.65, 0.9], [2.0, 1.8, 1.5], [-0.5, -0.8, -0.45]
ANGLE = 40.0
SKIPPED = 77


def monument(np):
    """Voxels of (x, y, z, red, green, blue, opacity): terraces, pillars and a pond of colours."""
    random = np.random.default_rng(5)
    size = np.array([128, 64, 128])
    x, y, z = np.indices(size)
    height = 6 + 3 * np.sin(x / 11) * np.cos(z / 13)
    cells = y < height
    for step in range(6):
        half = 48 - 7 * step
        cells |= (abs(x - 64) < half) & (abs(z - 64) < half) & (y < 12 + 5 * step)
    for px in range(20, 110, 12):
        for pz in range(20, 110, 12):
            cells |= ((x - px) ** 2 + (z - pz) ** 2 < 9) & (y < 50 - 0.3 * abs(px - 64))
    color = np.stack([120 + y, 190 - x // 2, 90 + z], axis=-1)
    color = np.clip(color + random.integers(-25, 26, tuple(size) + (1,)), 30, 235)
    return np.concatenate([color, np.where(cells, 255, 0)[..., None]], axis=-1).astype(np.uint8)


def linear(np, codes):
    v = codes / 255.0
    return np.where(v <= 0.04045, v / 12.92, ((v + 0.055) / 1.055) ** 2.4)


def quads(np, cells):
    """The faces of cubes that no other cube covers: corners, and a linear colour each."""
    there = np.pad(cells[..., 3] > 0, 1)
    colors = linear(np, cells[..., :3])
    inner = there[1:-1, 1:-1, 1:-1]
    faces, paint = [], []
    for axis in range(3):
        u, v = np.eye(3)[(axis + 1) % 3], np.eye(3)[(axis + 2) % 3]
        for side in (0, 1):
            beside = np.roll(there, 1 - 2 * side, axis)[1:-1, 1:-1, 1:-1]
            at = np.argwhere(inner & ~beside)
            low = at + side * np.eye(3)[axis]
            ring = [low, low + u, low + u + v, low + v]
            faces.append(np.stack(ring if side else ring[::-1], axis=1))
            paint.append(colors[tuple(at.T)])
    return np.concatenate(faces), np.concatenate(paint)


def find_mitsuba(variant):
    try:
        import mitsuba
        import numpy
        mitsuba.set_variant(variant)
    except ImportError:  # Mitsuba, or LLVM
        return None
    return mitsuba, numpy


def read_obj(np, path):
    points, faces = [], []
    for line in path.read_text().splitlines():
        words = line.split()
        if words and words[0] == "v":
            points.append([float(w) for w in words[1:4]])
        elif words and words[0] == "f":
            face = [int(w.split("/")[0]) - 1 for w in words[1:]]
            faces += [[face[0], face[i], face[i + 1]] for i in range(1, len(face) - 1)]
    return np.array(points), np.array(faces)


class Place:
    """Where the observer of a box of things stands."""

    def __init__(self, np, low, high):
        self.low, self.high = np.array(low, float), np.array(high, float)
        length = float(max(self.high - self.low))
        self.look_at = list((self.low + self.high) / 2)
        self.eye = list(np.array(self.look_at) + length * np.array([0.8, 0.75, 1.3]))
        self.length = length


def our_scene(place, models, objects, voxel):
    margin = voxel * math.ceil(0.02 * place.length / voxel)  # voxels of a file lie on the world's
    return {
        "voxelume": 1,
        "world": {"voxel_size": voxel, "bounds": {"min": list(place.low - margin),
                                                  "max": list(place.high + margin)},
                  "sky": {"kind": "constant", "color": SKY}},
        "materials": {"matt": {"color": [0.7, 0.7, 0.7]}, "own": {"color": [1, 1, 1]}},
        "models": models, "objects": objects,
        # A white surface that faces it has its intensity as radiance, and there a pi-th.
        "lights": [{"type": "directional", "direction": SUN_WAY,
                    "color": [c / math.pi for c in SUN]}],
        "observer": {"position": place.eye, "look_at": place.look_at,
                     "display": {"shape": "pyramid", "angle": ANGLE}},
        "render": {"size": list(SIZE), "light": "global", "bounces": BOUNCES},
    }


def their_scene(mi, place, shapes):
    transform = mi.ScalarTransform4f
    return {
        "type": "scene",
        "integrator": {"type": "path", "max_depth": BOUNCES + 2},
        "sky": {"type": "constant", "radiance": {"type": "rgb", "value": SKY}},
        "sun": {"type": "directional", "direction": SUN_WAY,
                "irradiance": {"type": "rgb", "value": SUN}},
        "sensor": {"type": "perspective", "fov": ANGLE,
                   "to_world": transform().look_at(origin=place.eye, target=place.look_at,
                                                   up=[0, 1, 0]),
                   "sampler": {"type": "independent"},
                   "film": {"type": "hdrfilm", "width": SIZE[0], "height": SIZE[1],
                            "rfilter": {"type": "box"}}},
        **shapes,
    }


def write_ply(np, path, points, triangles, colors=None):
    """A mesh, with a colour at each corner if there are some."""
    columns = points if colors is None else np.hstack([points, colors])
    names = ["x", "y", "z"] + ([] if colors is None else ["r", "g", "b"])
    with path.open("wb") as file:
        lines = ["ply", "format binary_little_endian 1.0", f"element vertex {len(points)}"]
        lines += [f"property float {name}" for name in names]
        lines += [f"element face {len(triangles)}", "property list uchar int vertex_index"]
        file.write(("\n".join(lines) + "\nend_header\n").encode())
        file.write(columns.astype("<f4").tobytes())
        rows = np.zeros(len(triangles), dtype=[("n", "u1"), ("v", "<i4", 3)])
        rows["n"], rows["v"] = 3, triangles
        file.write(rows.tobytes())


def cubes_case(np, folder):
    cells = monument(np)
    np.save(folder / "monument.npy", cells)
    place = Place(np, [0, 0, 0], cells.shape[:3])
    corners, paint = quads(np, cells)
    first = 4 * np.arange(len(corners))[:, None]
    triangles = np.concatenate([first + [0, 1, 2], first + [0, 2, 3]])
    write_ply(np, folder / "monument.ply", corners.reshape(-1, 3), triangles,
              np.repeat(paint, 4, axis=0))
    ours = our_scene(place, {"m": {"voxels": "monument.npy"}},
                     [{"model": "m", "material": "own"}], 1)
    theirs = {"m": {"type": "ply", "filename": str(folder / "monument.ply"),
                    "face_normals": True,
                    "bsdf": {"type": "diffuse", "reflectance": {"type": "mesh_attribute",
                                                                "name": "vertex_color"}}}}
    return place, ours, theirs


def mesh_case(np, folder, mesh):
    points, faces = read_obj(np, mesh)
    low, high = points.min(axis=0), points.max(axis=0)
    length = float(max(high - low))
    ground = low[1] - 0.02 * length
    place = Place(np, [low[0] - 0.5 * length, ground - 0.05 * length, low[2] - 0.5 * length],
                  high + [0.5 * length, 0, 0.5 * length])
    write_ply(np, folder / "mesh.ply", points, faces)
    floor = [float(place.high[0] - place.low[0]), 0.05 * length,
             float(place.high[2] - place.low[2])]
    middle = [float((place.low[0] + place.high[0]) / 2), float(ground - 0.025 * length),
              float((place.low[2] + place.high[2]) / 2)]
    ours = our_scene(place, {
        "mesh": {"mesh": "mesh.ply", "surface": "exact", "shading": "flat"},
        "floor": {"shape": "box", "size": floor, "surface": "exact"}}, [
        {"model": "mesh", "material": "matt"},
        {"model": "floor", "material": "matt", "position": middle}], length / 256)
    matt = {"type": "diffuse", "reflectance": {"type": "rgb", "value": 0.7}}

    def floor_shape(mi):
        return {"type": "cube", "bsdf": matt,
                "to_world": mi.ScalarTransform4f().translate(middle)
                @ mi.ScalarTransform4f().scale([s / 2 for s in floor])}
    theirs = {"mesh": {"type": "ply", "filename": str(folder / "mesh.ply"), "face_normals": True,
                       "bsdf": matt}, "floor": floor_shape}
    return place, ours, theirs


def our_picture(mi, np, voxelume, folder, name, samples):
    """The picture, and the seconds that it took without loading."""
    image, facts = folder / f"{name}.exr", folder / "facts.json"
    subprocess.run([voxelume, "render", str(folder / f"{name}.json"), "--samples", str(samples),
                    "-o", str(image), "--channels", "RGBA", "-q", "--stats-json", str(facts)],
                   check=True)
    bitmap = mi.Bitmap(str(image))
    names = [field.name for field in bitmap.struct_()]
    values = np.array(bitmap).astype(float)
    seconds = json.loads(facts.read_text())["seconds"]["image"]
    return np.stack([values[:, :, names.index(c)] for c in "RGB"], axis=-1), seconds


def their_picture(mi, np, scene, samples, seed):
    start = time.perf_counter()
    picture = np.array(mi.render(scene, spp=samples, seed=seed)).astype(float)[:, :, :3]
    return picture, time.perf_counter() - start


def error_of(np, picture, reference):
    """The mean squared relative error."""
    floor = 0.01 * reference.mean() ** 2
    return float(np.mean((picture - reference) ** 2 / (reference ** 2 + floor)))


def row(name, samples, errors, seconds):
    error, second = statistics.median(errors), statistics.median(seconds)
    print(f"  {name:<8} {samples:>4} samples: relative MSE {error:.3e}, {second:7.3f} s, "
          f"product {error * second:.3e}", flush=True)


def compare(variants, voxelume, folder, name, case):
    place, ours, theirs = case
    (folder / f"{name}.json").write_text(json.dumps(ours))
    print(f"{name}, {SIZE[0]}x{SIZE[1]}")
    reference = None
    for variant in variants:
        mi, np = find_mitsuba(variant)
        shapes = {key: value(mi) if callable(value) else value for key, value in theirs.items()}
        scene = mi.load_dict(their_scene(mi, place, shapes))
        if reference is None:
            reference, _ = their_picture(mi, np, scene, REFERENCE, 99)
            picture, _ = our_picture(mi, np, voxelume, folder, name, 1024)
            print(f"  mean light beside Mitsuba's: {picture.mean() / reference.mean():.4f}")
            for samples in SAMPLES:
                runs = [our_picture(mi, np, voxelume, folder, name, samples)
                        for _ in range(RUNS + 1)][1:]
                row("ours", samples, [error_of(np, p, reference) for p, _ in runs],
                    [s for _, s in runs])
        for samples in SAMPLES:
            if variant.startswith("scalar") and samples > 16:
                continue
            their_picture(mi, np, scene, samples, 0)  # compiles
            runs = [their_picture(mi, np, scene, samples, seed + 1) for seed in range(RUNS)]
            row(variant.split("_")[0], samples, [error_of(np, p, reference) for p, _ in runs],
                [s for _, s in runs])


def main():
    if len(sys.argv) not in (3, 4):
        sys.exit(__doc__)
    found = find_mitsuba("llvm_ad_rgb")
    if not found:
        print("Mitsuba isn't installed: pip install mitsuba")
        sys.exit(SKIPPED)
    _, np = found
    with tempfile.TemporaryDirectory() as name:
        folder = pathlib.Path(sys.argv[3] if len(sys.argv) == 4 else name)
        folder.mkdir(exist_ok=True)
        variants = ("llvm_ad_rgb", "scalar_rgb")
        compare(variants, sys.argv[1], folder, "cubes", cubes_case(np, folder))
        compare(variants, sys.argv[1], folder, "mesh",
                mesh_case(np, folder, pathlib.Path(sys.argv[2])))


if __name__ == "__main__":
    main()
