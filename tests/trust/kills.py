#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""Kills runs at random moments: files are whole or absent, and the next run leaves no others."""
import argparse
import pathlib
import random
import shutil
import tempfile
import time

import outputs
from runs import Tally, files_below, run


def visible(files):
    return {name: data for name, data in files.items()
            if not pathlib.Path(name).name.startswith(".")}


def strangers(cache):
    """Files and folders of processes that a run left in a cache."""
    return [str(path) for path in cache.rglob("*")
            if path.name.endswith(".tmp") or path.name.startswith(("pocl.", "pocl-"))]


KILLS_A_CACHE = 16  # one of so many is of a run with a cold cache, which takes long; the first, too


class Kills:
    def __init__(self, program, folder, seed):
        self.program, self.folder = program, folder
        self.random = random.Random(seed)
        self.out, self.tally = folder / "out", Tally("kills")
        self.commands = [*outputs.commands(), *outputs.long_commands()]
        self.seconds, self.whole, self.kills, self.caches = {}, {}, 0, 0
        self.images = {}  # by scene

    def prepare(self):
        outputs.write_inputs(self.folder)
        for arguments in outputs.PREPARATIONS:
            assert run(self.program, arguments, self.folder).code == 0

    def measure(self, name, arguments):
        """Keeps what a run writes that nobody kills, and how long it takes."""
        self.out.mkdir()
        result = run(self.program, arguments, self.folder)
        assert result.code == 0, (name, result)
        started = time.monotonic()  # its kernels are compiled by now
        assert run(self.program, arguments, self.folder).code == 0
        self.seconds[name] = time.monotonic() - started
        self.whole[name] = visible(files_below(self.out))
        shutil.rmtree(self.out)

    def image_of(self, arguments):
        if arguments[1] not in self.images:
            assert run(self.program, arguments, self.folder).code == 0
            self.images[arguments[1]] = (self.folder / "a.png").read_bytes()
        return self.images[arguments[1]]

    def kill_output(self, name, arguments):
        """Kills a run that may find what an earlier one left, then lets one end."""
        if name not in self.whole:
            self.measure(name, arguments)
        self.out.mkdir()
        faults = []
        for _ in range(self.random.randint(1, 3)):
            moment = self.random.uniform(0, 1.1 * self.seconds[name])
            run(self.program, arguments, self.folder, kill_after=moment)
            for file, data in visible(files_below(self.out)).items():
                if "stats.json" not in file and data != self.whole[name].get(file):
                    faults.append(f"{file} isn't whole after a kill at {moment:.4f} s")
            self.kills += 1
        result = run(self.program, arguments, self.folder)
        if result.code != 0:
            faults.append(f"the next run ends with {result.code}: {result.err}")
        left = set(files_below(self.out)) - set(self.whole[name])
        if left:
            faults.append(f"the next run leaves {sorted(left)}")
        shutil.rmtree(self.out)
        self.tally.add(name, faults)

    def kill_cache(self):
        """Kills a run that fills a cache of its own."""
        cache = self.folder / "cache"
        arguments = self.random.choice([["render", "scene.json", "-q", "-o", "a.png"],
                                        ["render", "mesh.json", "-q", "-o", "a.png"],
                                        ["warm", "mesh.json", "-q"]])
        environment = {"VOXELUME_CACHE_DIR": str(cache)}
        moment = self.random.uniform(0, 4)
        run(self.program, arguments, self.folder, kill_after=moment, environment=environment)
        result = run(self.program, arguments, self.folder, environment=environment)
        faults = [] if result.code == 0 else [f"the next run ends with {result.code}: {result.err}"]
        if arguments[0] == "render" and result.code == 0:
            found = (self.folder / "a.png").read_bytes()
            if found != self.image_of(arguments):
                faults.append("the next run writes another image")
        if left := strangers(cache):
            faults.append(f"the next run leaves {left} after a kill at {moment:.4f} s")
        shutil.rmtree(cache, ignore_errors=True)
        self.kills += 1
        self.caches += 1
        self.tally.add(f"cache, {arguments[0]} {arguments[1]}", faults)


def main():
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("program", type=pathlib.Path)
    parser.add_argument("--kills", type=int, default=1000)
    parser.add_argument("--seed", type=int, default=25)
    options = parser.parse_args()
    with tempfile.TemporaryDirectory() as folder:
        kills = Kills(options.program.resolve(), pathlib.Path(folder), options.seed)
        kills.prepare()
        while kills.kills < options.kills:
            if kills.caches * KILLS_A_CACHE <= kills.kills:
                kills.kill_cache()
            else:
                kills.kill_output(*kills.random.choice(kills.commands))
        return kills.tally.end(f", seed {options.seed}: {kills.kills} kills, {kills.caches} of "
                               "them with cold caches") > 0


if __name__ == "__main__":
    raise SystemExit(main())
