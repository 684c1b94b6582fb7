#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""Writes small valid files of each format that has a fuzzer, FOLDER/FORMAT/seed, and the words that
texts are made of, FOLDER/FORMAT.dict. The program `voxelume` makes some of them.
"""
import argparse
import json
import pathlib
import re
import struct
import subprocess
import tempfile

from seeds import PLYS, SEEDS, pair

ROOT = pathlib.Path(__file__).resolve().parent.parent.parent


# A small picture and volumetric image, whose display has two voxels of surface.
SCENE = """{"voxelume": 1, "models": {"ball": {"shape": "sphere", "radius": 0.3}},
  "world": {"bounds": {"min": [0, 0, 0], "max": [1, 1, 1]}, "voxel_size": 0.25},
  "objects": [{"model": "ball", "position": [0.5, 0.5, 0.5]}],
  "observer": {"position": [0.5, 0.5, 3], "look_at": [0.5, 0.5, 0.5], "display": {
    "shape": "box", "size": [1, 1, 1], "near": 2, "layout": "%s", "voxels": [4, 4, 4]}},
  "render": {"size": [6, 5]}}"""


def made_by(program):
    """Files that the program writes: images, volumetric images and a model."""
    seeds = {}
    with tempfile.TemporaryDirectory() as folder:
        folder = pathlib.Path(folder)

        def run(*words):
            subprocess.run([program, *words], cwd=folder, check=True, stdout=subprocess.DEVNULL)
        for layout, volumes in (("lattice", ["a.nrrd", "fuzz.raw"]), ("rays", ["volume.exr"])):
            (folder / "scene.json").write_text(SCENE % layout)
            run("render", "-q", "scene.json", "-o", "a.exr",
                *(word for name in volumes for word in ("--volume", name)))
            for name in "a.exr", *volumes:
                kind = {"a.nrrd": "volume.nrrd"}.get(name, name.split(".")[-1])
                content = (folder / name).read_bytes()
                if kind == "raw":
                    content = pair((folder / "fuzz.json").read_bytes(), content)
                seeds.setdefault(kind, []).append(content)
        (folder / "scene.json").write_text(SCENE % "rays")
        run("render", "-q", "scene.json", "-o", "b.png", "--shard", "1/2")
        seeds["shard"] = [file.read_bytes() for file in folder.glob("*.shard")]
        seeds["stamp"] = [(folder / name).read_bytes() for name in ("a.exr", "a.nrrd")]
        (folder / "a.ply").write_bytes(PLYS[0])
        for surface in "cubes", "smooth", "exact":
            run("voxelize", "-q", "a.ply", "--resolution", "4", "--surface", surface, "-o", "a.vxm")
            seeds.setdefault("vxm", []).append(b"\0" + (folder / "a.vxm").read_bytes())
    return seeds


def answers(program):
    """What helper programs answer to small files, each behind the byte that chooses its question."""
    version = subprocess.run([program, "--version"], check=True, capture_output=True, text=True)
    version = version.stdout.split()[1]
    seeds = {"image": [], "grid": [], "mesh": []}
    with tempfile.TemporaryDirectory() as folder:
        folder = pathlib.Path(folder)

        def run(*words):
            subprocess.run([program, *words], cwd=folder, check=True, stdout=subprocess.DEVNULL)

        def ask(kind, choice, helper, file, *questions):
            answer = bytes([choice])
            for question in questions:  # descriptor 3 takes the answer
                command = [program.parent / helper, version, file, *question.split()]
                redirected = ["bash", "-c", 'exec "$@" <"$0" 3>&1 >/dev/null', file, *command]
                answer += subprocess.run(redirected, cwd=folder, check=True,
                                         stdout=subprocess.PIPE).stdout
            seeds[kind].append(answer)
        (folder / "scene.json").write_text(SCENE % "rays")
        run("render", "-q", "scene.json", "-o", "a.exr", "-o", "a.png", "--volume", "deep.exr",
            "--volume", "volume.vdb")
        (folder / "a.jpg").write_bytes(SEEDS["jpg"][0])
        images = "voxelume-image-decoder"
        ask("image", 0, images, "a.exr", "exr-header 0")
        ask("image", 1, images, "a.exr", "exr 0")
        ask("image", 2, images, "deep.exr", "deep-exr-header 0 0", "deep-exr 0 4")
        ask("image", 3, images, "deep.exr", "deep-exr-header 0 0", "deep-exr 0 4")
        ask("image", 4, images, "a.jpg", "jpeg 1000")
        ask("image", 5, images, "a.png", "png-shape")
        ask("image", 6, images, "a.png", "png 1000")
        (folder / "a.ply").write_bytes(PLYS[0])
        grids = "voxelume-vdb-reader"
        for i, surface in enumerate(("cubes", "smooth")):
            run("voxelize", "-q", "a.ply", "--resolution", "2", "--surface", surface, "-o", "a.vdb")
            ask("grid", 2 + i, grids, "a.vdb", f"model {i}")
        ask("grid", 0, grids, "a.vdb", "summary")
        ask("grid", 1, grids, "volume.vdb", "density density")
        ask("grid", 4, grids, "volume.vdb", "volume")
    for choice, sizes in (0, (24, 36, 12)), (1, (12,)):
        arrays = b"".join(struct.pack("<Q", size) + bytes(range(size)) for size in sizes)
        seeds["mesh"].append(bytes([choice]) + 2 * (struct.pack("<I", 0x4D434402) + arrays))
    return seeds


def words_of_schema():
    """The keys and the values of scenes that have names."""
    words = set()

    def look(value):
        if isinstance(value, dict):
            words.update(value.get("properties", {}))
            words.update(v for v in value.get("enum", []) if isinstance(v, str))
        for part in value.values() if isinstance(value, dict) else value:
            if isinstance(part, (dict, list)):
                look(part)
    look(json.loads((ROOT / "scenes/voxelume.schema.json").read_text()))
    return {f'"{word}"' for word in words} | {"1e308", "-0", "null", "[", "]", "{", "}", ": ", ", "}


def words_of_help(program):
    """The options of all commands."""
    page = subprocess.run([program, "man"], check=True, capture_output=True, text=True).stdout
    found = re.findall(r"(?:\\-){1,2}[a-z]+(?:\\-[a-z]+)*", page)
    return {word.replace("\\", "") for word in found}


def write_dictionary(file, words):
    quoted = (word.replace("\\", "\\\\").replace('"', '\\"') for word in sorted(words))
    file.write_text("".join(f'"{word}"\n' for word in quoted))


LARGEST = 10000  # bytes of a scene; more are slow to try
COMMANDS = [bytes([i]) + b"a.json\n-o\nb.exr\n--size\n64x48\n--frames\n1-9x2" for i in range(17)]
SETTINGS = b'# settings\ndevice = cpu\ncache_size = 4GB\ncache_dir = "~/a"\n'


def main():
    arguments = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    arguments.add_argument("folder", type=pathlib.Path)
    arguments.add_argument("program", type=pathlib.Path)
    given = arguments.parse_args()
    folder, program = given.folder, given.program.resolve()
    seeds = dict(SEEDS, words=[*COMMANDS, SETTINGS])
    seeds["json"] = [file.read_bytes() for file in sorted((ROOT / "scenes").glob("*.json"))
                     if not file.name.endswith("schema.json") and file.stat().st_size < LARGEST]
    for name, files in [*made_by(program).items(), *answers(program).items()]:
        seeds[name] = [*seeds.get(name, []), *files]
    for name, files in seeds.items():
        (folder / name).mkdir(parents=True, exist_ok=True)
        for i, content in enumerate(files):
            (folder / name / f"seed{i}").write_bytes(content)
    write_dictionary(folder / "json.dict", words_of_schema())
    write_dictionary(folder / "words.dict", words_of_help(program))


if __name__ == "__main__":
    main()
