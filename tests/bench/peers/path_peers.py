#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""Times paths to an error beside Mitsuba 3 and Cycles: a voxel monument, a city and a mesh.

Usage: path_peers.py VOXELUME MESH.obj [FOLDER]

Renders the scenes of path_cases.py by Mitsuba's path integrator (llvm_ad_rgb, and scalar_rgb up to
16 samples) and by Cycles with 1 to 256 samples, denoisers off, writes what it measured to
peers.json, and has `voxelume bench` measure its own pictures and compare: the mean squared relative
error against two pictures of Mitsuba's, of REFERENCE samples each, and the seconds of the picture
without loading, of several runs the fastest. The cubes are quads with colours at their corners
there. The city is rendered twice here: of instances, as in the others, and `placed`, with its
houses in the world's voxels, where `auto` puts them. FOLDER keeps all files. Where Mitsuba isn't
installed (pip install mitsuba; DRJIT_LIBLLVM_PATH names an LLVM of 16 or later) it says so and ends
with 77; Cycles (pip install bpy) is left out where it isn't. With LLVM a picture of the city takes
20 seconds.
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
from peer_mitsuba import load_mitsuba

SAMPLES = (1, 4, 16, 64, 256)
REFERENCE = 2048  # samples of each of two
RUNS, SECONDS = 5, 10  # no more runs of a row, and none after so many seconds


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


def mitsuba_picture(mi, np, scene, samples, seed):
    start = time.perf_counter()
    picture = np.array(mi.render(scene, spp=samples, seed=seed)).astype(float)[:, :, :3]
    return picture, time.perf_counter() - start


def error_of(picture, references):
    """The mean squared relative error, to which the references' own noise adds nothing on
    average."""
    a, b = references
    light = (a + b) / 2
    floor = 0.01 * light.mean() ** 2
    return float(((picture - a) * (picture - b) / (light ** 2 + floor)).mean())


class Peers:
    """What other programs measure of one scene."""

    def __init__(self, name, references):
        self.name, self.references, self.rows = name, references, []

    def measure(self, program, counts, picture_of):
        """Adds a row for each number of samples; `picture_of` takes it and a seed."""
        for samples in counts:
            picture_of(samples, 0)  # compiles, loads
            runs = []
            while len(runs) < RUNS and sum(seconds for _, seconds in runs) < SECONDS:
                runs.append(picture_of(samples, len(runs) + 1))
            light = sum(reference.mean() for reference in self.references) / 2
            self.rows.append({
                "program": program, "scene": self.name, "samples": samples,
                "relative_mse": max(
                    statistics.median(error_of(p, self.references) for p, _ in runs), 0),
                "light": runs[0][0].mean() / light,
                "seconds": min(seconds for _, seconds in runs)})
            print(self.rows[-1], flush=True)


def write_exr(mi, np, path, picture):
    bitmap = mi.Bitmap(picture.astype(np.float32), pixel_format=mi.Bitmap.PixelFormat.RGB)
    bitmap.write(str(path))


def measure(folder, name, case):
    """The rows of the other programs, and the names of two references."""
    mi, np = load_mitsuba("llvm_ad_rgb")
    (folder / f"{name}.json").write_text(json.dumps(case.ours))
    scene = mitsuba_scene(mi, np, case, folder)
    references = [mitsuba_picture(mi, np, scene, REFERENCE, seed)[0] for seed in (98, 99)]
    files = [f"{name}_reference{number}.exr" for number in range(2)]
    for file, picture in zip(files, references):
        write_exr(mi, np, folder / file, picture)
    peers = Peers(name, references)
    try:
        cycles = CyclesScene(np, case, folder)
    except ImportError:
        print("Cycles isn't installed: pip install bpy")
    else:
        peers.measure("Cycles", SAMPLES, lambda samples, seed: cycles.render(mi, samples, seed))
    peers.measure("Mitsuba, llvm", SAMPLES,
                  lambda samples, seed: mitsuba_picture(mi, np, scene, samples, seed))
    mi, np = load_mitsuba("scalar_rgb")
    scalar = mitsuba_scene(mi, np, case, folder)
    peers.measure("Mitsuba, scalar", [s for s in SAMPLES if s <= 16],
                  lambda samples, seed: mitsuba_picture(mi, np, scalar, samples, seed))
    return peers.rows, files


def main():
    if len(sys.argv) not in (3, 4):
        sys.exit(__doc__)
    _, np = load_mitsuba("llvm_ad_rgb")
    with tempfile.TemporaryDirectory() as name:
        folder = pathlib.Path(sys.argv[3] if len(sys.argv) == 4 else name)
        folder.mkdir(exist_ok=True)
        cases = {"cubes": cubes_case(np, folder), "city": city_case(np, folder),
                 "mesh": mesh_case(np, folder, pathlib.Path(sys.argv[2]))}
        measured = {"rows": [], "references": {}}
        for name, case in cases.items():
            rows, measured["references"][name] = measure(folder, name, case)
            measured["rows"] += rows
            if name == "city":  # whose picture is the same wherever its voxels are
                (folder / "placed.json").write_text(
                    json.dumps(city_case(np, folder, "auto").ours))
                measured["rows"] += [{**row, "scene": "placed"} for row in rows]
                measured["references"]["placed"] = measured["references"]["city"]
            (folder / "peers.json").write_text(json.dumps({"global": measured}, indent=1))
        scenes = [word for name in measured["references"]
                  for word in ("--scene", str(folder / f"{name}.json"))]
        subprocess.run([sys.argv[1], "bench", *scenes, "--samples",
                        ",".join(str(s) for s in SAMPLES), "--repeat", str(RUNS), "--peers",
                        str(folder / "peers.json"), "-o", str(folder / "report.html"), "--json",
                        str(folder / "report.json"), "--plot", str(folder / "noise.svg")],
                       check=True)


if __name__ == "__main__":
    main()
