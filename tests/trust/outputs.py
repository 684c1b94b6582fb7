# SPDX-License-Identifier: Apache-2.0
"""A command for each format that the program writes."""
import json

SCENE = {
    "voxelume": 1,
    "world": {"voxel_size": 0.1, "bounds": {"min": [-1, -1, -1], "max": [1, 1, 1]},
              "ambient": [0.2, 0.2, 0.2]},
    "models": {"ball": {"shape": "sphere", "radius": 0.8}},
    "objects": [{"model": "ball"}],
    "lights": [{"type": "point", "position": [2, 3, 4]}],
    "observer": {"position": [0, 0, 4], "look_at": [0, 0, 0],
                 "display": {"shape": "pyramid", "angle": 40, "near": 2, "far": 6,
                             "voxels": [48, 40, 40], "layout": "lattice"}},
    "render": {"size": [160, 120]},
}

VOLUMES = ["v.vdb", "v.nrrd", "v.raw", "s.####.png", "v.ply", "v.kv6", "v.planes",
           "v.cplanes", "v.rgb332", "v.rgb565"]
VOXELS = ["m.vox", "m.kv6", "m.binvox", "m.npy", "m.nrrd", "m.vxm", "m.vdb"]


def write_inputs(folder):
    """Writes the scenes that the commands read; PREPARATIONS make `v.nrrd` and `m.vox` of it."""
    (folder / "scene.json").write_text(json.dumps(SCENE))
    rays = json.loads(json.dumps(SCENE))
    rays["observer"]["display"]["layout"] = "rays"
    (folder / "rays.json").write_text(json.dumps(rays))


PREPARATIONS = [["render", "scene.json", "--volume", "v.nrrd", "-q"],
                ["voxelize", "scene.json", "-o", "m.vox", "-q"]]


def commands():
    """Pairs of a name and arguments; every command writes to the folder `out` alone."""
    yield "image .exr", ["render", "scene.json", "-q", "-o", "out/a.exr"]
    yield "image .png", ["render", "scene.json", "-q", "-o", "out/a.png"]
    yield "stats .json", ["render", "scene.json", "-q", "-o", "out/b.png",
                          "--stats-json", "out/stats.json"]
    yield "volume .exr", ["render", "rays.json", "-q", "--volume", "out/v.exr"]
    for name in VOLUMES:
        yield f"volume {name[2:]}", ["convert", "v.nrrd", f"out/{name}"]
    for name in VOXELS:
        yield f"voxels {name[1:]}", ["convert", "m.vox", f"out/{name}"]
    yield "scene .json", ["import", "m.vox", "-o", "out/scene.json"]
    yield "page .html", ["view", "v.nrrd", "-o", "out/page.html"]
