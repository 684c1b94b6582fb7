#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""Times a scene after Whitted 1980 in voxelume and in POV-Ray: whole processes in turn, seconds of
computing on all cores. With one sample for each pixel, and with adaptive anti-aliasing, whose error is
told, too: the root mean square of the difference to the same renderer's 256 samples, in display
values, clipped to 0..1."""
import argparse
import json
import pathlib
import resource
import statistics
import subprocess
import tempfile

import numpy
from PIL import Image

SIZE = (1024, 768)
LIGHT, OBSERVER, TARGET, ANGLE = (2.2, 7, 5.7), (-1.57, 2.75, 6.31), (0.05, 1.1, 0), 45.2
GLASS, MIRROR = ((-0.48, 1.72, 1.12), 0.9), ((0.95, 0.9, -0.09), 0.8)
SCENE = {
    "voxelume": 1,
    "world": {"voxel_size": 0.02, "bounds": {"min": [-4.1, -0.2, -6.1], "max": [4.1, 3.2, 4.1]},
              "background": [0.1, 0.25, 0.6], "ambient": [0.25, 0.25, 0.25]},
    "materials": {
        "floor": {"color": [0.9, 0.75, 0.05],
                  "checker": {"color": [0.75, 0.05, 0.03], "size": [1, 0, 1]}},
        "glass": {"color": [1, 1, 1], "diffuse": 0.02, "specular": 0.6, "shininess": 200,
                  "reflection": 0.08, "refraction": 0.9, "ior": 1.5},
        "mirror": {"color": [0.9, 0.9, 1], "diffuse": 0.25, "specular": 0.5, "shininess": 60,
                   "reflection": 0.65}},
    "models": {"floor": {"shape": "box", "size": [8, 0.1, 10], "surface": "exact"},
               "glass": {"shape": "sphere", "radius": GLASS[1], "surface": "exact"},
               "mirror": {"shape": "sphere", "radius": MIRROR[1], "surface": "exact"}},
    "objects": [{"model": "floor", "material": "floor", "position": [0, -0.05, -1]},
                {"model": "glass", "material": "glass", "position": GLASS[0]},
                {"model": "mirror", "material": "mirror", "position": MIRROR[0]}],
    "lights": [{"type": "point", "position": LIGHT, "intensity": 55}],
    "observer": {"position": OBSERVER, "look_at": TARGET,
                 "display": {"shape": "pyramid", "angle": ANGLE, "near": 0.5}},
    "render": {"size": SIZE, "depth": 5, "shadow": "filtered"}}
POV = """#version 3.7;
global_settings { assumed_gamma 1 max_trace_level 5 ambient_light 1 }
camera { location <%g, %g, %g> right -x*4/3 look_at <%g, %g, %g> angle %g }
background { rgb <0.1, 0.25, 0.6> }
light_source { <%g, %g, %g> rgb 110/3.14159 fade_distance 1 fade_power 2 }
box { <-4, -0.1, -6>, <4, 0, 4>
  pigment { checker rgb <0.9, 0.75, 0.05> rgb <0.75, 0.05, 0.03> } finish { ambient 0.25 diffuse 1 } }
sphere { <%g, %g, %g>, %g pigment { rgbt <1, 1, 1, 0.9> }
  finish { ambient 0 diffuse 0.02 phong 0.6 phong_size 200 reflection 0.08 } interior { ior 1.5 } }
sphere { <%g, %g, %g>, %g pigment { rgb <0.9, 0.9, 1> }
  finish { ambient 0.25 diffuse 0.25 phong 0.5 phong_size 60 reflection 0.65 } }
""" % (*OBSERVER, *TARGET, ANGLE, *LIGHT, *GLASS[0], GLASS[1], *MIRROR[0], MIRROR[1])


def seconds(command, folder):
    before = resource.getrusage(resource.RUSAGE_CHILDREN)
    subprocess.run(command, cwd=folder, check=True, stdout=subprocess.DEVNULL,
                   stderr=subprocess.DEVNULL)
    after = resource.getrusage(resource.RUSAGE_CHILDREN)
    return after.ru_utime + after.ru_stime - before.ru_utime - before.ru_stime


def picture(file):
    return numpy.asarray(Image.open(file).convert("RGB")).astype(float) / 255


def main():
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("program", type=pathlib.Path)
    parser.add_argument("--runs", type=int, default=5)
    options = parser.parse_args()
    program = str(options.program.resolve())
    with tempfile.TemporaryDirectory() as name:
        folder = pathlib.Path(name)
        (folder / "scene.json").write_text(json.dumps(SCENE))
        (folder / "scene.pov").write_text(POV)

        def ours(file, *words):
            return [program, "render", "-q", "scene.json", "-o", file, *words]

        def theirs(file, *words):
            return ["povray", "scene.pov", f"+W{SIZE[0]}", f"+H{SIZE[1]}", "-D", f"+O{file}", *words]
        references = {}
        for who, command in (("voxelume", ours("a.png", "--samples", "256")),
                             ("povray", theirs("a.png", "+A0.0", "+AM1", "+R16", "-J"))):
            seconds(command, folder)
            references[who] = picture(folder / "a.png")
        rows = [("one sample", [], ["-A"])]
        for samples in (4, 8, 16):
            rows.append((f"adaptive 0.1, {samples}", ["--samples", str(samples), "--set",
                                                      "render.adaptive=0.1"], None))
        for threshold in (0.1, 0.3):
            rows.append((f"+A{threshold} +AM2", None, [f"+A{threshold}", "+AM2", "+R2", "-J"]))
        print("| what | voxelume s | error | POV-Ray s | error |\n| --- | --- | --- | --- | --- |")
        for what, our_words, their_words in rows:
            cells = []
            times = {"voxelume": [], "povray": []}
            for _ in range(1 + options.runs):  # the first compiles
                if our_words is not None:
                    times["voxelume"].append(seconds(ours("v.png", *our_words), folder))
                if their_words is not None:
                    times["povray"].append(seconds(theirs("p.png", *their_words), folder))
            for who, file in (("voxelume", "v.png"), ("povray", "p.png")):
                if not times[who]:
                    cells += ["", ""]
                    continue
                error = numpy.sqrt(numpy.mean((picture(folder / file) - references[who])**2))
                cells += [f"{statistics.median(times[who][1:]):.2f}", f"{error:.4f}"]
            print(f"| {what} | " + " | ".join(cells) + " |", flush=True)


if __name__ == "__main__":
    main()
