#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""Holds global light in seven scenes against Mitsuba 3's.

Usage: mitsuba_light.py VOXELUME [--quick] [--samples SAMPLES] [--size PIXELS] [--only SCENE]
                        [--bunny FILE]

Renders the scenes of light_cases.py with more and more samples here and SAMPLES (16,384 by default)
in Mitsuba, by its path integrators with LLVM or, where there is none (DRJIT_LIBLLVM_PATH names it),
its scalar variant. Prints by how much the mean of each picture differs, the differences of squares
of 16 x 16 pixels as shares of the picture's mean, and the power of the samples by which the mean of
these, squared, grows: -1 is noise alone. Mitsuba's own noise isn't in the RMS, since squared
differences are products of those to two pictures of Mitsuba's; it does in the largest one. Fails
where a mean differs by more than MAX_ERRORS standard errors, or squares by more than samples
explain. --quick takes few samples of small pictures. Where Mitsuba isn't installed (pip install
mitsuba) it says so and ends with 77, as tests do that are skipped; without FILE the bunny is left
out.
"""
import argparse
import json
import pathlib
import subprocess
import sys
import tempfile

from light_cases import SCENE_MAKERS
from peer_mitsuba import colors_of, load_mitsuba, squares_of

SQUARE = 16
MAX_ERRORS = 4  # of the mean: seven scenes go beyond these once in 2,000 runs
MAX_NOISE = 3  # times: squares are few, and bright paths are rarer than variances tell
PASS = 256  # samples a pixel that Mitsuba takes at once
BUNNY = "/usr/share/glmark2/models/bunny.obj"


def load_fastest():
    """Mitsuba with LLVM, or else its scalar variant, and numpy."""
    mi, np = load_mitsuba()
    try:
        mi.set_variant("llvm_ad_rgb")
        mi.Float(1) + mi.Float(1)
    except (ImportError, RuntimeError):
        mi.set_variant("scalar_rgb")
    return mi, np


def our_picture(mi, np, voxelume, folder, scene, samples):
    """A picture of this program's, and the variance of each of its pixels."""
    (folder / "scene.json").write_text(json.dumps(scene))
    image = folder / "ours.exr"
    subprocess.run([voxelume, "render", str(folder / "scene.json"), "-o", str(image), "--samples",
                    str(samples), "--channels", "RGBA,variance", "--float", "-q"], check=True)
    return colors_of(mi, np, image), colors_of(mi, np, image, "variance.")


def mitsuba_picture(mi, np, scene, samples, seed):
    """The mean of several passes, so that memory suffices."""
    passes = max(samples // PASS, 1)
    pictures = (np.array(mi.render(scene, spp=samples // passes, seed=seed + number))
                for number in range(passes))
    return sum(picture[:, :, :3].astype(float) for picture in pictures) / passes


class Comparison:
    """Two pictures of Mitsuba's beside some of ours; numbers are shares of the former's mean."""

    def __init__(self, np, references):
        self.np = np
        self.squares = [squares_of(reference, SQUARE) for reference in references]
        self.mean = float(sum(reference.mean() for reference in references)) / 2
        apart = (self.squares[0] - self.squares[1]) / self.mean / 2
        self.their_square = float((apart ** 2).mean())
        # Colours share their noise.
        self.their_error = (self.their_square / apart[..., 0].size) ** 0.5

    def add(self, picture, variance):
        """The mean's difference, its standard error, the mean squared difference of squares, what
        the variance of our samples makes of that, and the largest difference of a square."""
        np, mean = self.np, self.mean
        error = float(np.sqrt(variance.mean(axis=(0, 1)) / variance[..., 0].size).mean()) / mean
        ours = squares_of(picture, SQUARE)
        squared = float(((ours - self.squares[0]) * (ours - self.squares[1])).mean()) / mean ** 2
        noise = float(variance.mean()) / SQUARE ** 2 / mean ** 2
        largest = np.abs(ours - sum(self.squares) / 2).max() / mean
        return picture.mean() / mean - 1, np.hypot(error, self.their_error), squared, noise, largest


def percent(squared):
    """The root of a mean square, or what is below Mitsuba's noise."""
    return f"{100 * squared ** 0.5:.3f} %" if squared > 0 else "0"


def compare(mi, np, voxelume, name, scene, folder, arguments):
    """Prints the differences of a scene. True if noise explains them."""
    scene.place(mi, arguments.size)
    loaded = mi.load_dict(scene.theirs)
    half = arguments.samples // 2
    seen = Comparison(np, [mitsuba_picture(mi, np, loaded, half, seed) for seed in (0, 1000)])
    print(f"{name}: Mitsuba's squares have an error of {percent(seen.their_square)}", flush=True)
    rows = []
    for samples in arguments.counts:
        rows.append(seen.add(*our_picture(mi, np, voxelume, folder, scene.ours, samples)))
        mean, error, squared, noise, largest = rows[-1]
        print(f"  {samples:>4} samples: mean {100 * mean:+.3f} +- {100 * error:.3f} %, squares "
              f"{percent(squared)} RMS where samples explain {percent(noise)}, "
              f"largest {100 * largest:.2f} %", flush=True)
    falls = [(np.log(samples), np.log(row[2])) for samples, row in zip(arguments.counts, rows)
             if row[2] > 0]
    if len(falls) > 1:
        print(f"  slope {np.polyfit(*zip(*falls), 1)[0]:+.2f}")
    mean, error, squared, noise, _ = rows[-1]
    is_close = abs(mean) < MAX_ERRORS * error and squared < MAX_NOISE * (noise + seen.their_square)
    if not is_close:
        print("  differs by more than noise")
    return is_close


def read_arguments():
    parser = argparse.ArgumentParser(description=__doc__,
                                     formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("voxelume")
    parser.add_argument("--quick", action="store_true")
    parser.add_argument("--samples", type=int)
    parser.add_argument("--size", type=int)
    parser.add_argument("--only")
    parser.add_argument("--bunny", type=pathlib.Path, default=pathlib.Path(BUNNY))
    arguments = parser.parse_args()
    arguments.counts = (16, 64) if arguments.quick else (16, 64, 256, 1024, 4096)
    arguments.samples = arguments.samples or (256 if arguments.quick else 16384)
    arguments.size = arguments.size or (48 if arguments.quick else 64)
    return arguments


def main():
    arguments = read_arguments()
    mi, np = load_fastest()
    results = []
    for name, make in SCENE_MAKERS.items():
        if arguments.only not in (None, name):
            continue
        if "bunny" in name and not arguments.bunny.exists():
            print(f"{name}: left out without {arguments.bunny}")
            continue
        with tempfile.TemporaryDirectory() as folder_name:
            folder = pathlib.Path(folder_name)
            scene = make(mi, np, folder, arguments.bunny)
            results.append(compare(mi, np, arguments.voxelume, name, scene, folder, arguments))
    sys.exit(0 if results and all(results) else 1)


if __name__ == "__main__":
    main()
