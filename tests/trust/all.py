#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""Runs all programs of this folder one after the other, or a share of what each tries."""
import argparse
import pathlib
import subprocess
import sys

HERE = pathlib.Path(__file__).resolve().parent
MIN_FRAMES = 100  # fewer tell nothing of growth
MIN_SEQUENCE = 80  # a bare fork hung after 46 to 72, so fewer tell nothing


def main():
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("program", type=pathlib.Path)
    parser.add_argument("library", type=pathlib.Path,
                        help="what tests/support/write_faults.cpp makes")
    parser.add_argument("share", type=float, nargs="?", default=1.0)
    options = parser.parse_args()
    program, library = str(options.program.resolve()), str(options.library.resolve())

    def part(count, minimum=2):
        return str(max(minimum, round(count * options.share)))

    runs = [["kills.py", program, "--kills", part(1000)],
            ["broken_disks.py", program, library, "--tries", part(192)],
            ["damaged_files.py", program, "--files", part(20000)],
            ["endurance.py", program, "--frames", part(10000, MIN_FRAMES),
             "--processes", part(10000, 4)],
            ["sequences.py", program, "--frames", part(2000, MIN_SEQUENCE), "--times",
             part(20, 1)]]
    codes = [subprocess.run([sys.executable, HERE / run[0], *run[1:]]).returncode for run in runs]
    return int(any(codes))


if __name__ == "__main__":
    raise SystemExit(main())
