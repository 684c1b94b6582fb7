#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""Writes the matrix of drivers: what each OpenCL driver here makes of shipped scenes.

Each scene is rendered twice by each driver, with nothing of it compiled before and again. A row has
the seconds of both and the MD5 of the file, or the reason why there is none; bold are hashes that
the first driver with a picture hasn't. Drivers are one ICD file each, Oclgrind where it is
installed: it interprets kernels, and so renders 16 x 12 pixels instead of 64 x 48. Its hashes are
compared with those of the first driver in that size.

Usage: bench_drivers.py PROGRAM ASSETS [--scenes NAME...] [--icd FILE...] [--limit SECONDS]
"""
import argparse
import hashlib
import os
import shutil
import subprocess
import tempfile
import time
from pathlib import Path

SCENES = Path(__file__).resolve().parents[2] / "scenes"


class Driver:
    def __init__(self, icd=None):
        self.name = Path(icd).stem if icd else "oclgrind"
        self.before = [] if icd else ["oclgrind"]
        self.variables = {"OCL_ICD_VENDORS": str(icd)} if icd else {}
        if self.name == "rusticl":
            self.variables["RUSTICL_ENABLE"] = "llvmpipe"
        self.size = "64x48" if icd else "16x12"


def device_of(driver, program, cache):
    """What `devices` says of the driver, which runs the self-test of known bits."""
    run = subprocess.run(
        [*driver.before, program, "devices", "--json"],
        env=os.environ | driver.variables | {"VOXELUME_CACHE_DIR": cache},
        capture_output=True,
        text=True,
    )
    return run.stdout


def picture(driver, program, scene, size, assets, cache, limit):
    """(seconds, MD5 or None, the last line of what was said) of one process."""
    with tempfile.TemporaryDirectory() as folder:
        file = Path(folder) / "a.exr"
        command = [*driver.before, program, "render", str(SCENES / f"{scene}.json"), "-q"]
        command += ["--assets", assets, "--frames", "1", "--size", size, "--samples", "1"]
        command += ["--device", "0", "-o", str(file)]
        environment = os.environ | driver.variables | {"VOXELUME_CACHE_DIR": cache}
        start = time.monotonic()
        try:
            run = subprocess.run(
                command, env=environment, capture_output=True, text=True, timeout=limit
            )
        except subprocess.TimeoutExpired:
            return limit, None, f"no picture after {limit:.0f} s"
        seconds = time.monotonic() - start
        written = sorted(Path(folder).glob("*.exr"))
        if run.returncode or not written:
            said = (run.stderr.strip() or "nothing was said").splitlines()[-1]
            said = said.split("not usable: ")[-1].split(" (VOXELUME")[0]
            return seconds, None, f"exit code {run.returncode}: {said}"
        return seconds, hashlib.md5(written[0].read_bytes()).hexdigest(), ""


def main():
    options = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    options.add_argument("program")
    options.add_argument("assets")
    options.add_argument("--scenes", nargs="+", default=["cubes", "solids", "bunny", "whitted"])
    options.add_argument("--icd", nargs="+", default=sorted(Path("/etc/OpenCL/vendors").glob("*")))
    options.add_argument("--limit", type=float, default=300)
    given = options.parse_args()
    drivers = [Driver(Path(icd).resolve()) for icd in given.icd]
    if shutil.which("oclgrind"):
        drivers.append(Driver())
    expected = {}
    print("| Driver | scene, pixels | first, s | again, s | MD5, its beginning |")
    print("| --- | --- | --- | --- | --- |")
    for driver in drivers:
        with tempfile.TemporaryDirectory() as cache:
            if device_of(driver, given.program, cache).strip() in ("", "[]"):
                print(f"| {driver.name} | no device | | | |", flush=True)
                continue
            for scene in given.scenes:
                row = [
                    picture(driver, given.program, scene, driver.size, given.assets, cache, limit)
                    for limit in 2 * [given.limit]
                ]
                said = row[0][2] or row[1][2]
                key = (scene, driver.size)
                if not said and driver.size == "16x12" and key not in expected:
                    expected[key] = reference(drivers[0], given, scene, driver.size)
                hashes = {part[1] for part in row}
                right = not said and hashes == {expected.setdefault(key, row[0][1])}
                text = said or " ".join(sorted(name[:10] for name in hashes))
                print(
                    f"| {driver.name} | {scene}, {driver.size} | {row[0][0]:.2f} | {row[1][0]:.2f} "
                    f"| {text if right or said else f'**{text}**'} |",
                    flush=True,
                )


def reference(driver, given, scene, size):
    """The hash of the first driver's picture in another size."""
    with tempfile.TemporaryDirectory() as cache:
        return picture(driver, given.program, scene, size, given.assets, cache, given.limit)[1]


if __name__ == "__main__":
    main()
