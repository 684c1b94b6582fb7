#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""Has each call that writes fail, of every format: exit code 5, a sentence of path and cause.

The call fails with all later ones, as on a full disk; alone; or it writes a wrong byte."""
import argparse
import errno
import os
import pathlib
import random
import shutil
import tempfile

import outputs
from runs import Tally, files_below, run, sentence_faults

CHANGED = "other bytes are read back than were written"
MODES = ["", ":once", "wrong"]
CAUSES = {errno.ENOSPC: "the disk is full", errno.EDQUOT: "quota",
          errno.EIO: os.strerror(errno.EIO)}


def counted_calls(program, library, arguments, folder):
    """The number of calls with which a run writes to `out`, and the bytes of its files."""
    counts = folder / "counts"
    counts.unlink(missing_ok=True)
    (folder / "out").mkdir()
    result = run(program, arguments, folder, environment={
        "LD_PRELOAD": str(library), "VXL_WRITE_FAULT": f"{folder}/out:0:0",
        "VXL_WRITE_COUNTS": str(counts)})
    assert result.code == 0, result
    whole = files_below(folder / "out")
    shutil.rmtree(folder / "out")
    return int(counts.read_text()), whole


def is_as_without_fault(result, folder, whole):
    return result.code == 0 and all(
        data == whole[name] or name == "stats.json"
        for name, data in files_below(folder / "out").items())


def faults_of(result, folder, whole, cause):
    faults = []
    if result.hung:
        return ["it hangs"]
    # Calls that sync or rename write no bytes that could be wrong.
    if cause == CHANGED and is_as_without_fault(result, folder, whole):
        return []
    if result.code != 5:
        faults.append(f"exit code {result.code}: {result.err.strip()}")
    faults += sentence_faults(result)
    if cause not in result.err:
        faults.append(f"the cause is missing in {result.err.strip()!r}")
    if "out/" not in result.err:
        faults.append(f"the path is missing in {result.err.strip()!r}")
    # A run that writes several files may have ended some; when the folder can't be synced, all.
    for name, data in files_below(folder / "out").items():
        if data != whole.get(name) and name != "stats.json":
            faults.append(f"it leaves a part of {name}")
    return faults


def main():
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("program", type=pathlib.Path)
    parser.add_argument("library", type=pathlib.Path,
                        help="what tests/support/write_faults.cpp makes")
    parser.add_argument("--tries", type=int, default=192,
                        help="pairs of a call and a fault, of each format, if it has more")
    parser.add_argument("--seed", type=int, default=25)
    options = parser.parse_args()
    chosen, tally = random.Random(options.seed), Tally("broken disks")
    program, library = options.program.resolve(), options.library.resolve()
    with tempfile.TemporaryDirectory() as name:
        folder = pathlib.Path(name)
        outputs.write_inputs(folder)
        for arguments in outputs.PREPARATIONS:
            assert run(program, arguments, folder).code == 0
        for what, arguments in outputs.commands():
            calls, whole = counted_calls(program, library, arguments, folder)
            tries = [(number, mode) for number in range(1, calls + 1) for mode in MODES]
            if len(tries) > options.tries:
                tries = sorted({tries[0], tries[-1], *chosen.sample(tries, options.tries - 2)})
            for number, mode in tries:
                error = chosen.choice(list(CAUSES))
                is_wrong = mode == "wrong"
                fault = mode if is_wrong else f"{error}{mode}"
                (folder / "out").mkdir()
                result = run(program, arguments, folder, environment={
                    "LD_PRELOAD": str(library),
                    "VXL_WRITE_FAULT": f"{folder}/out:{number}:{fault}"})
                tally.add(f"{what}, call {number} of {calls}, {errno.errorcode[error]} {mode}",
                          faults_of(result, folder, whole, CHANGED if is_wrong else CAUSES[error]))
                shutil.rmtree(folder / "out")
    return tally.end(f", seed {options.seed}") > 0


if __name__ == "__main__":
    raise SystemExit(main())
