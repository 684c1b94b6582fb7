#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""Feeds damaged files of all formats to all commands that read: a documented exit code, a sentence,
under a second of computing, and no more memory than the file's size allows."""
import argparse
import gzip
import json
import pathlib
import random
import struct
import sys
import tempfile

import outputs
from runs import CODES, Tally, files_below, run, sentence_faults

sys.path.insert(0, str(pathlib.Path(__file__).resolve().parent.parent / "fuzz"))
import make_seeds  # noqa: E402

SLICES = {f"s.{number:04}.png" for number in range(1, 1000)}  # but for the first
MAX_SECONDS = 1.0
MAX_BYTES = 2 << 30

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


def glb():
    data = struct.pack("<9f3I", 0, 0, 0, 1, 0, 0, 0, 1, 0, 0, 1, 2)
    tree = {"asset": {"version": "2.0"}, "scene": 0, "scenes": [{"nodes": [0]}],
            "nodes": [{"mesh": 0}],
            "meshes": [{"primitives": [{"attributes": {"POSITION": 0}, "indices": 1}]}],
            "buffers": [{"byteLength": len(data)}],
            "bufferViews": [{"buffer": 0, "byteOffset": 0, "byteLength": 36},
                            {"buffer": 0, "byteOffset": 36, "byteLength": 12}],
            "accessors": [{"bufferView": 0, "componentType": 5126, "count": 3, "type": "VEC3",
                           "min": [0, 0, 0], "max": [1, 1, 0]},
                          {"bufferView": 1, "componentType": 5125, "count": 3, "type": "SCALAR"}]}
    text = json.dumps(tree).encode()
    text += b" " * (-len(text) % 4)
    body = struct.pack("<2I", len(text), 0x4E4F534A) + text
    body += struct.pack("<2I", len(data), 0x004E4942) + data
    return b"glTF" + struct.pack("<2I", 2, 12 + len(body)) + body


def written(program, folder):
    """Files that the program itself writes: of each output format, one."""
    outputs.write_inputs(folder)
    for arguments in outputs.PREPARATIONS:
        assert run(program, arguments, folder).code == 0
    (folder / "out").mkdir()
    for name, arguments in outputs.commands():
        result = run(program, arguments, folder)
        assert result.code == 0, (name, result)
    whole = files_below(folder / "out")
    for name in whole:
        (folder / "out" / name).unlink()
    unread = (".html", ".planes", ".rgb332", ".rgb565", ".ply")
    for name, data in whole.items():
        if not name.endswith(unread) and name not in SLICES:
            yield name.split(".")[-1], data


def seeds(program, folder):
    """Pairs of an ending and a whole file's bytes."""
    yield "json", json.dumps(outputs.SCENE).encode()
    yield from [("obj", OBJ), ("ply", PLY), ("stl", STL), ("glb", glb())]
    for name, files in make_seeds.SEEDS.items():
        if name not in ("mtl", "draco", "meshopt", "1.png", "hdr"):
            for data in files:
                ending = "nii.gz" if name == "nii" and data[:2] == b"\x1f\x8b" else name
                yield ending, data
    yield from written(program, folder)


def flip(data, chosen):
    data = bytearray(data)
    for _ in range(chosen.randint(1, 8)):
        data[chosen.randrange(len(data))] ^= 1 << chosen.randrange(8)
    return bytes(data)


def cut(data, chosen):
    return data[:chosen.randrange(len(data))]


def huge(data, chosen):
    """Writes a number of 2^31 or the like over four bytes, or over digits."""
    at = chosen.randrange(len(data))
    number = chosen.choice([0x7FFFFFFF, 0x80000000, 0xFFFFFFFF, 0x40000000, 0x10000])
    form = chosen.choice(["<I", ">I"])
    if data[at:at + 1].isdigit():
        end = at
        while data[end:end + 1].isdigit():
            end += 1
        return data[:at] + str(number).encode() + data[end:]
    return data[:at] + struct.pack(form, number) + data[at + 4:]


def repeat(data, chosen):
    """Repeats a part of the file many times."""
    at = chosen.randrange(len(data))
    end = min(len(data), at + chosen.randint(1, 64))
    return data[:at] + data[at:end] * chosen.choice([2, 100, 5000]) + data[end:]


def nest(data, chosen):
    """Puts many opening brackets, or the file's own beginning, into it."""
    at = chosen.randrange(len(data))
    return data[:at] + chosen.choice([b"[", b'{"a":', b"(", data[:8]]) * 20000 + data[at:]


def splice(data, chosen):
    a, b = sorted(chosen.randrange(len(data)) for _ in range(2))
    at = chosen.randrange(len(data))
    return data[:at] + data[a:b] + data[at:]


MUTATIONS = [flip, flip, flip, cut, huge, huge, repeat, nest, splice]


def damaged(data, chosen):
    packed = data[:2] == b"\x1f\x8b" and chosen.random() < 0.7
    if packed:
        data = gzip.decompress(data)
    for _ in range(chosen.choice([1, 1, 2])):
        data = chosen.choice(MUTATIONS)(data, chosen) or b"x"
    return gzip.compress(data, mtime=0) if packed else data


def commands(file, chosen):
    """The arguments of a command that reads the file."""
    ending = file.name.split(".", 1)[1]
    if ending == "json":
        choices = [["check", file.name], ["info", file.name],
                   ["convert", file.name, "out/o.nrrd"]]
    else:
        choices = [["info", file.name], ["info", "--verify", file.name], ["check", file.name],
                   ["import", file.name, "-o", "out/o.json"],
                   ["convert", file.name, "out/o.npy"], ["convert", file.name, "out/o.nrrd"],
                   ["view", file.name, "-o", "out/o.png"],
                   ["voxelize", file.name, "--resolution", "16", "-o", "out/o.vxm", "-q"],
                   ["diff", file.name, file.name]]
    return chosen.choice(choices)


def faults_of(result, folder):
    if result.hung:
        return ["it hangs"]
    faults = []
    if result.code not in CODES:
        faults.append(f"exit code {result.code}: {result.err[-300:].strip()}")
    elif result.code > 1:
        faults += sentence_faults(result)
        if left := list(files_below(folder / "out")):
            faults.append(f"it leaves {left}")
        if result.cpu > MAX_SECONDS:
            faults.append(f"refusing takes {result.cpu:.2f} s")
    if result.peak > MAX_BYTES:
        faults.append(f"it takes {result.peak >> 20} MB")
    return faults


def main():
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("program", type=pathlib.Path)
    parser.add_argument("--files", type=int, default=20000)
    parser.add_argument("--seed", type=int, default=25)
    parser.add_argument("--keep", type=pathlib.Path, help="folder for files that show a fault")
    options = parser.parse_args()
    tally = Tally("damaged files")
    with tempfile.TemporaryDirectory() as name:
        folder = pathlib.Path(name)
        program = options.program.resolve()
        whole = list(seeds(program, folder))
        codes = {}
        for number in range(options.files):
            chosen = random.Random(options.seed * 1000003 + number)
            ending, data = chosen.choice(whole)
            file = folder / f"f.{ending}"
            file.write_bytes(damaged(data, chosen))
            arguments = commands(file, chosen)
            result = run(program, arguments, folder)
            faults = faults_of(result, folder)
            tally.add(f"number {number}, {' '.join(arguments)}", faults)
            codes[result.code] = codes.get(result.code, 0) + 1
            if faults and options.keep:
                options.keep.mkdir(exist_ok=True)
                (options.keep / f"{number}.{ending}").write_bytes(file.read_bytes())
            file.unlink()
            for left in (folder / "out").iterdir():
                left.unlink()
    return tally.end(f", seed {options.seed}; exit codes: {sorted(codes.items())}") > 0


if __name__ == "__main__":
    raise SystemExit(main())
