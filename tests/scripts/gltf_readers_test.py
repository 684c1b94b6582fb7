#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""Holds the scene that is made of a glTF file against what other readers make of it.

A file with nested nodes, matrices and mirrors, a camera and lights is written and read by
pygltflib, and its turns become matrices by trimesh. The matrices of objects, the observer and the
lights agree to 1e-6. Exits with 77, which skips the test, where the modules aren't installed.

Usage: gltf_readers_test.py PROGRAM
"""
import json
import pathlib
import random
import struct
import subprocess
import sys
import tempfile

try:
    import numpy
    import pygltflib
    import trimesh
except ImportError:
    sys.exit(77)

TOLERANCE = 1e-6


def near(found, expected, what):
    error = numpy.max(numpy.abs(numpy.asarray(found, float) - numpy.asarray(expected, float)))
    assert error <= TOLERANCE * max(1, numpy.max(numpy.abs(expected))), f"{what}: off by {error}"


def random_turn(rng):
    q = numpy.array([rng.gauss(0, 1) for _ in range(4)])
    return (q / numpy.linalg.norm(q)).tolist()


def write(path):
    """A tree of 40 nodes, each with the triangle, and among them a camera and three lights."""
    rng = random.Random(21)
    positions = struct.pack("<9f", 0, 0, 0, 7, 0, 0, 0, 5, 3)
    gltf = pygltflib.GLTF2(
        asset=pygltflib.Asset(version="2.0"),
        scene=0,
        scenes=[pygltflib.Scene(nodes=[0])],
        buffers=[pygltflib.Buffer(byteLength=len(positions))],
        bufferViews=[pygltflib.BufferView(buffer=0, byteOffset=0, byteLength=len(positions))],
        accessors=[pygltflib.Accessor(bufferView=0, componentType=5126, count=3, type="VEC3",
                                      min=[0, 0, 0], max=[7, 5, 3])],
        meshes=[pygltflib.Mesh(name="triangle", primitives=[
            pygltflib.Primitive(attributes=pygltflib.Attributes(POSITION=0))])],
        cameras=[pygltflib.Camera(type="perspective", perspective=pygltflib.Perspective(
            yfov=0.6, znear=0.1, zfar=1000, aspectRatio=4 / 3))],
        extensionsUsed=["KHR_lights_punctual"],
        extensions={"KHR_lights_punctual": {"lights": [
            {"type": "point", "intensity": 300},
            {"type": "spot", "intensity": 100, "color": [1, 0.5, 0.25],
             "spot": {"outerConeAngle": 0.5, "innerConeAngle": 0.2}},
            {"type": "directional", "intensity": 3}]}},
    )
    for number in range(40):
        node = pygltflib.Node(name=f"node {number}", mesh=0, children=[])
        if number % 5 == 4:
            turn = trimesh.transformations.quaternion_matrix(random_turn(rng))
            turn[:3, 3] = [rng.uniform(-3, 3) for _ in range(3)]
            node.matrix = (turn @ numpy.diag([1, 1, -1, 1])).T.flatten().tolist()
        else:
            node.translation = [rng.uniform(-9, 9) for _ in range(3)]
            node.rotation = random_turn(rng)
            if number % 3 == 0:
                node.scale = [rng.uniform(0.5, 1.5), rng.uniform(0.5, 1.5), rng.uniform(-1.5, -0.5)]
        gltf.nodes.append(node)
        if number > 0:
            gltf.nodes[rng.randrange(number)].children.append(number)
    for name, parent, extra in [("eye", 7, {"camera": 0}), ("lamp 0", 3, {}), ("lamp 1", 5, {}),
                                ("lamp 2", 11, {})]:
        node = pygltflib.Node(name=name, translation=[1, 2, 3], rotation=random_turn(rng), **extra)
        if not extra:
            node.extensions = {"KHR_lights_punctual": {"light": int(name[-1])}}
        gltf.nodes[parent].children.append(len(gltf.nodes))
        gltf.nodes.append(node)
    gltf.set_binary_blob(positions)
    gltf.save_binary(str(path))


def local_matrix(node):
    if node.matrix is not None:
        return numpy.array(node.matrix).reshape(4, 4).T
    x, y, z, w = node.rotation or [0, 0, 0, 1]
    matrix = trimesh.transformations.quaternion_matrix([w, x, y, z])
    matrix[:3, :3] *= numpy.array(node.scale or [1, 1, 1])
    matrix[:3, 3] = node.translation or [0, 0, 0]
    return matrix


def places(path):
    """The matrix of each node into the world, by its name."""
    gltf = pygltflib.GLTF2().load(str(path))
    found = {}

    def visit(number, parent):
        node = gltf.nodes[number]
        found[node.name] = parent @ local_matrix(node)
        for child in node.children or []:
            visit(child, found[node.name])

    visit(0, numpy.eye(4))
    return found


def direction(matrix):
    return -matrix[:3, 2] / numpy.linalg.norm(matrix[:3, 2])


def compare(scene, graph):
    assert len(scene["objects"]) == 40, "40 nodes, and no ground beside a file's own lights"
    for thing in scene["objects"]:
        near(thing["matrix"], graph[thing["name"]][:3], thing["name"])
    observer, eye = scene["observer"], graph["eye"]
    near(observer["position"], eye[:3, 3], "the observer's position")
    aim = numpy.subtract(observer["look_at"], observer["position"])
    near(aim / numpy.linalg.norm(aim), direction(eye), "the observer's direction")
    # The picture is 4:3, as the camera is.
    near(observer["display"]["angle"],
         numpy.degrees(2 * numpy.arctan(numpy.tan(0.3) * 4 / 3)), "the angle")
    lights = {light["name"]: light for light in scene["lights"]}
    near(lights["lamp 0"]["position"], graph["lamp 0"][:3, 3], "the point light")
    near(lights["lamp 1"]["position"], graph["lamp 1"][:3, 3], "the spot light")
    near(lights["lamp 1"]["direction"], direction(graph["lamp 1"]), "the spot light's direction")
    near(lights["lamp 2"]["direction"], direction(graph["lamp 2"]), "the sun")
    near(lights["lamp 1"]["angle"], numpy.degrees(1.0), "the cone")
    near(lights["lamp 1"]["inner_angle"], numpy.degrees(0.4), "the inner cone")
    near(lights["lamp 1"]["color"], [1, 0.5, 0.25], "the colour")
    ratio = lights["lamp 0"]["intensity"] / lights["lamp 1"]["intensity"]
    assert abs(ratio - 3) < 1e-4, f"intensities in proportion: {ratio}"


def main():
    with tempfile.TemporaryDirectory() as folder:
        path = pathlib.Path(folder) / "tree.glb"
        write(path)
        scene = path.with_suffix(".json")
        subprocess.run([sys.argv[1], "import", path, "-o", scene], check=True)
        compare(json.loads(scene.read_text()), places(path))
    print("40 objects, a camera and 3 lights agree")


main()
