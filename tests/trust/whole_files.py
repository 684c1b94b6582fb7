# SPDX-License-Identifier: Apache-2.0
"""Whole files of all formats, and the commands that read them: what damaged_files.py damages."""
import dataclasses
import json
import pathlib
import struct
import sys

import outputs
from runs import files_below, run

sys.path.insert(0, str(pathlib.Path(__file__).resolve().parent.parent / "fuzz"))
import make_seeds  # noqa: E402

SLICES = {f"s.{number:04}.png" for number in range(1, 1000)}  # but for the first
UNREAD = (".html", ".planes", ".rgb332", ".rgb565", ".ply")
WITH_OTHERS = ("mtl", "draco", "meshopt", "1.png", "hdr")  # seeds of files that others name
PART = "p.exr.1-of-1.shard"

OBJ = b"""mtllib a.mtl
v 0 0 0
v 1 0 0
v 0 1 0
v 0 0 1
vt 0 0
vn 0 0 1
usemtl a
f 1/1/1 2/1/1 3/1/1
f 1 2 4
f -1 -2 -3
"""
PLY = b"""ply
format ascii 1.0
element vertex 3
property float x
property float y
property float z
element face 1
property list uchar int vertex_indices
end_header
0 0 0
1 0 0
0 1 0
3 0 1 2
"""
STL = bytes(80) + struct.pack("<I12fH", 1, 0, 0, 1, 0, 0, 0, 1, 0, 0, 0, 1, 0, 0)


@dataclasses.dataclass
class Subject:
    """A file to damage, what belongs to it, and the commands of which one reads it."""
    name: str
    data: bytes
    commands: list
    others: dict = dataclasses.field(default_factory=dict)
    made: list = dataclasses.field(default_factory=list)  # what commands write outside of `out`


def readers(name):
    if name.endswith(".json"):
        return [["check", name], ["info", name], ["convert", name, "out/o.nrrd"],
                ["warm", "-q", name]]
    return [["info", name], ["info", "--verify", name], ["check", name],
            ["import", name, "-o", "out/o.json"], ["convert", name, "out/o.npy"],
            ["convert", name, "out/o.nrrd"], ["view", name, "-o", "out/o.png"],
            ["voxelize", name, "--resolution", "16", "-o", "out/o.vxm", "-q"],
            ["diff", name, name]]


def alone(ending, data):
    return Subject(f"f.{ending}", data, readers(f"f.{ending}"))


def glb(tree, data):
    text = json.dumps({"asset": {"version": "2.0"}, "scene": 0, "scenes": [{"nodes": [0]}],
                       "nodes": [{"mesh": 0}], **tree}).encode()
    text += b" " * (-len(text) % 4)
    body = struct.pack("<2I", len(text), 0x4E4F534A) + text
    body += struct.pack("<2I", len(data), 0x004E4942) + data
    return b"glTF" + struct.pack("<2I", 2, 12 + len(body)) + body


def plain_glb():
    data = struct.pack("<9f3I", 0, 0, 0, 1, 0, 0, 0, 1, 0, 0, 1, 2)
    return glb({"meshes": [{"primitives": [{"attributes": {"POSITION": 0}, "indices": 1}]}],
                "buffers": [{"byteLength": len(data)}],
                "bufferViews": [{"buffer": 0, "byteOffset": 0, "byteLength": 36},
                                {"buffer": 0, "byteOffset": 36, "byteLength": 12}],
                "accessors": [{"bufferView": 0, "componentType": 5126, "count": 3, "type": "VEC3",
                               "min": [0, 0, 0], "max": [1, 1, 0]},
                              {"bufferView": 1, "componentType": 5125, "count": 3,
                               "type": "SCALAR"}]}, data)


def draco_glb(data):
    name = "KHR_draco_mesh_compression"
    packed = {"bufferView": 0, "attributes": {"POSITION": 0, "COLOR_0": 1}}
    return glb({"extensionsUsed": [name], "extensionsRequired": [name],
                "meshes": [{"primitives": [{"attributes": {"POSITION": 1, "COLOR_0": 2},
                                            "indices": 0, "extensions": {name: packed}}]}],
                "buffers": [{"byteLength": len(data)}],
                "bufferViews": [{"buffer": 0, "byteLength": len(data)}],
                "accessors": [{"componentType": 5125, "count": 3, "type": "SCALAR"},
                              {"componentType": 5126, "count": 3, "type": "VEC3"},
                              {"componentType": 5121, "count": 3, "type": "VEC3",
                               "normalized": True}]}, data)


def meshopt_glb(vertices, triangles):
    name = "EXT_meshopt_compression"

    def view(offset, data, mode, stride):
        packed = {"buffer": 0, "byteOffset": offset, "byteLength": len(data), "count": 3,
                  "byteStride": stride, "mode": mode}
        shown = {"byteStride": stride} if mode == "ATTRIBUTES" else {}
        return {"buffer": 0, "byteLength": 3 * stride, "extensions": {name: packed}, **shown}
    names = [name, "KHR_mesh_quantization"]
    data = vertices + triangles
    return glb({"extensionsUsed": names, "extensionsRequired": names,
                "meshes": [{"primitives": [{"attributes": {"POSITION": 0}, "indices": 1}]}],
                "buffers": [{"byteLength": len(data)}],
                "bufferViews": [view(0, vertices, "ATTRIBUTES", 8),
                                view(len(vertices), triangles, "TRIANGLES", 4)],
                "accessors": [{"bufferView": 0, "componentType": 5122, "count": 3, "type": "VEC3"},
                              {"bufferView": 1, "componentType": 5125, "count": 3,
                               "type": "SCALAR"}]}, data)


def jpg():
    """16 x 8 pixels in one grey: of each block the mean alone is coded."""
    def segment(mark, body):
        return bytes([0xFF, mark]) + struct.pack(">H", 2 + len(body)) + body
    return (b"\xff\xd8" + segment(0xDB, b"\0" + b"\x08" * 64) +
            segment(0xC0, struct.pack(">BHHB3B", 8, 8, 16, 1, 1, 0x11, 0)) +
            segment(0xC4, bytes([0x00, 1, 1, *[0] * 14, 0, 4])) +
            segment(0xC4, bytes([0x10, 1, *[0] * 15, 0])) +
            segment(0xDA, bytes([1, 1, 0, 0, 63, 0])) + b"\xbc\x7f" + b"\xff\xd9")


def mesh_files():
    """Meshes, and what they name: libraries, textures, compressed arrays."""
    yield from [alone("obj", OBJ), alone("ply", PLY), alone("stl", STL), alone("glb", plain_glb())]
    vertices, triangles = (data[1:] for data in make_seeds.SEEDS["meshopt"][:2])
    yield alone("glb", meshopt_glb(vertices, triangles))
    for data in make_seeds.SEEDS["draco"]:
        yield alone("glb", draco_glb(data[1:]))
    png = make_seeds.SEEDS["png"][0]
    yield Subject("a.mtl", make_seeds.SEEDS["mtl"][0].replace(b"a b", b"a"), readers("a.obj"),
                  {"a.obj": OBJ, "t.png": png})
    for name, data in (("t.png", png), ("t.jpg", jpg())):
        library = b"newmtl a\nmap_Kd " + name.encode() + b"\n"
        yield Subject(name, data, readers("a.obj"), {"a.obj": OBJ, "a.mtl": library})


def sky_files():
    scene = json.loads(json.dumps(outputs.SCENE))
    for data in make_seeds.SEEDS["hdr"]:
        scene["world"]["sky"] = {"kind": "map", "file": "f.hdr"}
        commands = [["info", "f.hdr"], ["check", "sky.json"],
                    ["render", "sky.json", "-q", "-o", "out/o.png"]]
        yield Subject("f.hdr", data, commands, {"sky.json": json.dumps(scene).encode()})


def written(program, folder):
    """Files that the program itself writes: of each output format, one; and those of a part."""
    outputs.write_inputs(folder)
    for arguments in [*outputs.PREPARATIONS,
                      ["render", "scene.json", "-q", "-o", "p.exr", "--shard", "1/1"]]:
        assert run(program, arguments, folder).code == 0, arguments
    (folder / "out").mkdir()
    for name, arguments in outputs.commands():
        result = run(program, arguments, folder)
        assert result.code == 0, (name, result)
    whole = files_below(folder / "out")
    for name in whole:
        (folder / "out" / name).unlink()
    for name, data in whole.items():
        if not name.endswith(UNREAD) and name not in SLICES:
            yield alone(name.split(".")[-1], data)
    pair = {name: whole[name] for name in ("v.raw", "v.json")}
    for name, data in pair.items():
        others = {other: whole for other, whole in pair.items() if other != name}
        yield Subject(name, data, readers("v.raw"), others)
    parts = {path.name: path.read_bytes() for path in folder.glob("p.exr.*")}
    others = {name: data for name, data in parts.items() if name != PART}
    yield Subject(PART, parts[PART], [["merge", "-q", PART]], others, ["p.exr"])


def subjects(program, folder):
    yield alone("json", json.dumps(outputs.SCENE).encode())
    yield from mesh_files()
    yield from sky_files()
    for name, files in make_seeds.SEEDS.items():
        if name not in WITH_OTHERS:
            for data in files:
                yield alone("nii.gz" if name == "nii" and data[:2] == b"\x1f\x8b" else name, data)
    yield from written(program, folder)
