#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""Renders animations whose model and density are sequences of OpenVDB files, with frames that
overlap and without: none may hang. A bare fork of the process, which has threads, hung after 46 to
72 frames."""
import argparse
import json
import os
import pathlib
import tempfile

import outputs
from runs import Tally, run

IDENTIFIER = slice(21, 57)  # where OpenVDB's files have an identifier, so that each differs


def write_sequence(program, folder, files):
    """Writes a scene, and the files that it names."""
    (folder / "ball.obj").write_text(
        "v 1 1 1\nv -1 -1 1\nv -1 1 -1\nv 1 -1 -1\nf 1 2 4\nf 1 3 2\nf 1 4 3\nf 2 3 4\n")
    made = run(program, ["voxelize", "ball.obj", "--resolution", "12", "--surface", "smooth",
                         "-o", "one.vdb", "-q"], folder)
    if made.code != 0:
        raise SystemExit(f"sequences.py: voxelize ends with {made.code}: {made.err}")
    one = bytearray((folder / "one.vdb").read_bytes())
    for number in range(1, files + 1):
        one[IDENTIFIER] = b"%08x-0000-4000-8000-000000000000" % number
        (folder / f"s.{number:04d}.vdb").write_bytes(one)
    sequence = {"first": 1, "last": files}
    scene = json.loads(json.dumps(outputs.SCENE))
    scene["models"] = {"thing": {"voxels": "s.####.vdb", "surface": "smooth",
                                 "sequence": sequence}}
    scene["objects"] = [{"model": "thing"}]
    scene["world"]["medium"] = {"absorption": [1, 1, 1], "density": {
        "kind": "grid", "file": "s.####.vdb", "grid": "surface", "sequence": sequence}}
    del scene["observer"]["display"]["voxels"], scene["observer"]["display"]["layout"]
    scene["render"]["size"] = [8, 6]
    (folder / "sequence.json").write_text(json.dumps(scene))


def main():
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("program", type=pathlib.Path)
    parser.add_argument("--frames", type=int, default=2000)
    parser.add_argument("--times", type=int, default=20)
    options = parser.parse_args()
    program, tally = options.program.resolve(), Tally("sequences")
    with tempfile.TemporaryDirectory() as name:
        folder = pathlib.Path(name)
        write_sequence(program, folder, options.frames)
        for number in range(options.times):
            words = ["--no-overlap"] if number % 2 else []
            (folder / "out").mkdir(exist_ok=True)
            result = run(program, ["render", "sequence.json", "--frames", f"1-{options.frames}",
                                   "--no-cache", "-q", "-o", "out/f.####.png", *words], folder,
                         hang_seconds=300 + options.frames)
            faults = ["it hangs"] if result.hung else []
            if result.code != 0:
                faults.append(f"exit code {result.code}: {result.err}")
            if (done := len(os.listdir(folder / "out"))) != options.frames:
                faults.append(f"{done} files for {options.frames} frames")
            tally.add(f"{options.frames} frames, run {number}, {' '.join(words)}", faults)
            print(f"run {number}: {done} frames, {len(faults)} faults", flush=True)
            for file in (folder / "out").iterdir():
                file.unlink()
    return tally.end(f" of {options.frames} frames each") > 0


if __name__ == "__main__":
    raise SystemExit(main())
