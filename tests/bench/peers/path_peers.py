#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""Times paths to an error beside Mitsuba 3 and Cycles: a voxel monument, a city and a mesh.

Usage: path_peers.py VOXELUME MESH.obj [FOLDER]

Renders the scenes of path_cases.py with 1 to 256 samples, in global light here, by Mitsuba's path
integrator (llvm_ad_rgb, and scalar_rgb up to 16) and by Cycles, denoisers off, and prints for each
the mean squared relative error against Mitsuba's picture of REFERENCE samples, the seconds of the
image without loading, and the product of both, which is even for unbiased light: the smaller, the
sooner an error is reached. The cubes are quads with colours at their corners there. FOLDER keeps
the scenes. Where Mitsuba isn't installed (pip install mitsuba; DRJIT_LIBLLVM_PATH names an LLVM of
16 or later) it says so and ends with 77; Cycles (pip install bpy) is left out where it isn't. With
LLVM a picture of the city takes 20 seconds.
"""
import json
import pathlib
import statistics
import subprocess
import sys
import tempfile
import time

from path_cases import (ANGLE, BOUNCES, GREY, SIZE, SKY, SUN, SUN_WAY, city_case, cubes_case,
                        mesh_case, write_ply)
from peer_cycles import CyclesScene
from peer_mitsuba import colors_of, load_mitsuba

SAMPLES = (1, 4, 16, 64, 256)
REFERENCE = 4096
RUNS = 5


def shapes_of(mi, np, case, folder):
    """A case's objects in Mitsuba, those that stand in several places as instances."""
    transform = mi.ScalarTransform4f
    grey = {"type": "diffuse", "reflectance": {"type": "rgb", "value": GREY}}
    own = {"type": "diffuse", "reflectance": {"type": "mesh_attribute", "name": "vertex_color"}}
    shapes = {}
    for name, mesh in case.meshes.items():
        write_ply(np, folder / f"{name}.ply", mesh)
        shapes[name] = {"type": "ply", "filename": str(folder / f"{name}.ply"),
                        "face_normals": True, "bsdf": grey if mesh.colors is None else own}
    if len(case.placed) > len(case.meshes):
        for name in case.meshes:
            shapes[name] = {"type": "shapegroup", "shape": shapes[name]}
        for number, (name, at) in enumerate(case.placed):
            shapes[f"object{number}"] = {"type": "instance", "to_world": transform().translate(at),
                                         "group": {"type": "ref", "id": name}}
    if case.floor:
        middle, size = case.floor
        shapes["floor"] = {"type": "cube", "bsdf": grey, "to_world": transform().translate(middle)
                           @ transform().scale([s / 2 for s in size])}
    return shapes


def mitsuba_scene(mi, np, case, folder):
    transform, place = mi.ScalarTransform4f, case.place
    return mi.load_dict({
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
        **shapes_of(mi, np, case, folder),
    })


def our_picture(mi, np, voxelume, folder, name, samples):
    """The picture, and the seconds that it took without loading."""
    image, facts = folder / f"{name}.exr", folder / "facts.json"
    subprocess.run([voxelume, "render", str(folder / f"{name}.json"), "--samples", str(samples),
                    "-o", str(image), "--channels", "RGBA", "-q", "--stats-json", str(facts)],
                   check=True)
    seconds = json.loads(facts.read_text())["seconds"]["image"]
    return colors_of(mi, np, image), seconds


def mitsuba_picture(mi, np, scene, samples, seed):
    start = time.perf_counter()
    picture = np.array(mi.render(scene, spp=samples, seed=seed)).astype(float)[:, :, :3]
    return picture, time.perf_counter() - start


def error_of(np, picture, reference):
    """The mean squared relative error."""
    floor = 0.01 * reference.mean() ** 2
    return float(np.mean((picture - reference) ** 2 / (reference ** 2 + floor)))


def rows(np, name, counts, reference, picture_of):
    """Prints a row for each number of samples; `picture_of` takes it and a seed."""
    for samples in counts:
        picture_of(samples, 0)  # compiles, loads
        runs = [picture_of(samples, seed + 1) for seed in range(RUNS)]
        error = statistics.median(error_of(np, picture, reference) for picture, _ in runs)
        second = statistics.median(seconds for _, seconds in runs)
        print(f"  {name:<8} {samples:>4} samples: relative MSE {error:.3e}, {second:7.3f} s, "
              f"product {error * second:.3e}", flush=True)


def compare(voxelume, folder, name, case):
    mi, np = load_mitsuba("llvm_ad_rgb")
    (folder / f"{name}.json").write_text(json.dumps(case.ours))
    print(f"{name}, {SIZE[0]}x{SIZE[1]}")
    scene = mitsuba_scene(mi, np, case, folder)
    reference, _ = mitsuba_picture(mi, np, scene, REFERENCE, 99)

    def ours(samples, _):
        return our_picture(mi, np, voxelume, folder, name, samples)
    print(f"  mean light beside Mitsuba's: {ours(1024, 0)[0].mean() / reference.mean():.4f}")
    rows(np, "ours", SAMPLES, reference, ours)
    rows(np, "llvm", SAMPLES, reference,
         lambda samples, seed: mitsuba_picture(mi, np, scene, samples, seed))
    try:
        cycles = CyclesScene(np, case, folder)
    except ImportError:
        print("  Cycles isn't installed: pip install bpy")
    else:
        light = cycles.render(mi, 1024, 1)[0].mean() / reference.mean()
        print(f"  Cycles' mean light beside Mitsuba's: {light:.4f}")
        rows(np, "cycles", SAMPLES, reference,
             lambda samples, seed: cycles.render(mi, samples, seed))
    mi, np = load_mitsuba("scalar_rgb")
    scalar = mitsuba_scene(mi, np, case, folder)
    rows(np, "scalar", [s for s in SAMPLES if s <= 16], reference,
         lambda samples, seed: mitsuba_picture(mi, np, scalar, samples, seed))


def main():
    if len(sys.argv) not in (3, 4):
        sys.exit(__doc__)
    _, np = load_mitsuba("llvm_ad_rgb")
    with tempfile.TemporaryDirectory() as name:
        folder = pathlib.Path(sys.argv[3] if len(sys.argv) == 4 else name)
        folder.mkdir(exist_ok=True)
        compare(sys.argv[1], folder, "cubes", cubes_case(np, folder))
        compare(sys.argv[1], folder, "city", city_case(np, folder))
        compare(sys.argv[1], folder, "mesh", mesh_case(np, folder, pathlib.Path(sys.argv[2])))


if __name__ == "__main__":
    main()
