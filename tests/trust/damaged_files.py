#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""Feeds damaged files of all formats to all commands that read: a documented exit code, a sentence,
under a second, and no more memory than the file's size allows."""
import argparse
import pathlib
import random
import tempfile

from mutations import damaged
from runs import CODES, Tally, files_below, run, sentence_faults
from whole_files import subjects

MAX_SECONDS = 1.0  # of a refusal: of computing, and of waiting
MAX_ACCEPTED = 10.0  # of computing, with a file that is read, by commands that render nothing
RENDERING = ("render", "view", "voxelize", "warm")  # take as long as their kernels and pictures do
MAX_BYTES = 2 << 30
ATTEMPTS = 3  # of which the fastest counts: the machine may be loaded, and kernels be compiled once


def is_slow(result, command):
    if result.code == 0:
        return result.cpu > MAX_ACCEPTED and command not in RENDERING
    return result.cpu > MAX_SECONDS or result.wall - result.cpu > MAX_SECONDS


def fastest_run(program, arguments, folder):
    results = []
    while len(results) < ATTEMPTS:
        for left in (folder / "out").iterdir():
            left.unlink()
        results.append(run(program, arguments, folder))
        if results[-1].hung or not is_slow(results[-1], arguments[0]):
            return results[-1]
    return min(results, key=lambda result: result.wall)


def faults_of(result, command, folder):
    if result.hung:
        return ["it hangs"]
    faults = []
    if result.code not in CODES:
        faults.append(f"exit code {result.code}: {result.err[-300:].strip()}")
    elif result.code > 0:
        faults += sentence_faults(result)
        if left := list(files_below(folder / "out")):
            faults.append(f"it leaves {left}")
    if is_slow(result, command):
        faults.append(f"{'refusing' if result.code else 'reading'} takes {result.wall:.2f} s, "
                      f"{result.cpu:.2f} of them computing")
    if result.peak > MAX_BYTES:
        faults.append(f"it takes {result.peak >> 20} MB")
    return faults


def try_one(program, folder, subject, chosen):
    """The arguments of a run with the damaged file, how it ended, and what is wrong with it."""
    for name, data in {**subject.others, subject.name: damaged(subject.data, chosen)}.items():
        (folder / name).write_bytes(data)
    arguments = chosen.choice(subject.commands)
    result = fastest_run(program, arguments, folder)
    faults = faults_of(result, arguments[0], folder)
    for name in subject.made:
        (folder / name).unlink(missing_ok=True)
    return arguments, result, faults


def main():
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("program", type=pathlib.Path)
    parser.add_argument("--files", type=int, default=20000)
    parser.add_argument("--seed", type=int, default=25)
    parser.add_argument("--keep", type=pathlib.Path, help="folder for files that show a fault")
    options = parser.parse_args()
    tally, codes, slowest = Tally("damaged files"), {}, (0, "")
    with tempfile.TemporaryDirectory() as name:
        folder = pathlib.Path(name)
        program = options.program.resolve()
        whole = list(subjects(program, folder))
        for number in range(options.files):
            chosen = random.Random(options.seed * 1000003 + number)
            subject = chosen.choice(whole)
            arguments, result, faults = try_one(program, folder, subject, chosen)
            tally.add(f"number {number}, {' '.join(arguments)}", faults)
            codes[result.code] = codes.get(result.code, 0) + 1
            if result.code == 0 and arguments[0] not in RENDERING:
                slowest = max(slowest, (round(result.cpu, 2), f"number {number}"))
            if faults and options.keep:
                options.keep.mkdir(exist_ok=True)
                (options.keep / f"{number}.{subject.name}").write_bytes(
                    (folder / subject.name).read_bytes())
            for file in (subject.name, *subject.others):
                (folder / file).unlink()
            for left in (folder / "out").iterdir():
                left.unlink()
    return tally.end(f", seed {options.seed}; exit codes: {sorted(codes.items())}; the slowest "
                     f"that is read: {slowest[0]} s, {slowest[1]}") > 0


if __name__ == "__main__":
    raise SystemExit(main())
