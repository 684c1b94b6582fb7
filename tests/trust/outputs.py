# SPDX-License-Identifier: Apache-2.0
"""A command for each format that the program writes."""
import json
import math

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
    moving = json.loads(json.dumps(SCENE))
    moving["animation"] = {"frames": 4, "tracks": [
        {"target": "objects[0].position", "keys": [{"frame": 1, "value": [0, 0, 0]},
                                                   {"frame": 4, "value": [0.3, 0, 0]}]}]}
    (folder / "moving.json").write_text(json.dumps(moving))
    (folder / "globe.obj").write_text(globe(60))
    mesh = json.loads(json.dumps(SCENE))
    mesh["models"]["ball"] = {"mesh": "globe.obj", "surface": "smooth"}
    mesh["world"]["voxel_size"] = 0.02
    (folder / "mesh.json").write_text(json.dumps(mesh))


def globe(count):
    """A mesh whose grid takes so long that the cache of models keeps it."""
    lines = []
    for i in range(count + 1):
        for k in range(2 * count):
            a, b = math.pi * i / count, math.pi * k / count
            lines.append(f"v {math.sin(a) * math.cos(b):.6f} {math.cos(a):.6f} "
                         f"{math.sin(a) * math.sin(b):.6f}")
    for i in range(count):
        for k in range(2 * count):
            a, b = 2 * count * i + k + 1, 2 * count * i + (k + 1) % (2 * count) + 1
            lines.append(f"f {a} {b} {b + 2 * count} {a + 2 * count}")
    return "\n".join(lines) + "\n"


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


def long_commands():
    """The same for runs that write several files, or one in several steps."""
    yield "animation", ["render", "moving.json", "-q", "--frames", "1-4", "-o", "out/f.####.png"]
    yield "volumes", ["render", "moving.json", "-q", "--frames", "1-2", "--volume",
                      "out/v.####.nrrd"]
    yield "part of an image", ["render", "scene.json", "-q", "-o", "out/p.exr", "--shard", "1/2"]
    yield "part of frames", ["render", "moving.json", "-q", "--frames", "1-4", "-o",
                             "out/f.####.exr", "--shard", "2/2"]
    yield "bands", ["render", "scene.json", "-q", "--size", "3000x2000", "--memory-limit", "400MB",
                    "-o", "out/b.exr"]
    yield "voxelized .vxm", ["voxelize", "globe.obj", "-q", "--resolution", "64", "-o", "out/m.vxm",
                             "-o", "out/m.vdb"]
