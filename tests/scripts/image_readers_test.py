#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""Opens images and volumes with the programs that people open them with, and compares what these
find: OpenEXR's own module, exrheader, oiiotool, and Blender, whose compositor picks a matte, ids
and motion vectors, and whose import of OpenVDB shows grids.

Programs that aren't there are left out. Exits with 77, which skips the test, without the modules
OpenEXR and numpy.

Usage: image_readers_test.py PROGRAM
"""
import json
import pathlib
import shutil
import subprocess
import sys
import tempfile

try:
    import numpy
    import OpenEXR
except ImportError:
    sys.exit(77)
try:
    import bpy
except ImportError:
    bpy = None

SIZE, CROP = (96, 72), (8, 4, 60, 50)
CHANNELS = ("RGBA,Z,distance,P,N,objectId,materialId,CryptoObject,CryptoMaterial,albedo,direct,"
            "indirect,shadow,lights,motion")
PARTS = ["rgba", "depth"] + sorted(
    [f"Crypto{of}{rank:02}" for of in ("Object", "Material") for rank in range(3)] +
    ["P", "N", "albedo", "backward", "direct", "distance", "forward", "indirect", "light_key",
     "light_rest", "materialId", "objectId", "shadow"])
SCENE = {
    "voxelume": 1,
    "world": {"voxel_size": 0.1, "bounds": {"min": [0, 0, 0], "max": [3, 2, 1]},
              "ambient": [0.3, 0.3, 0.3]},
    "materials": {"brick": {"color": [0.7, 0.3, 0.2]}, "moss": {"color": [0.2, 0.5, 0.1]}},
    "models": {"thing": {"shape": "box", "size": [1.2, 0.8, 0.4], "surface": "cubes"}},
    "objects": [
        {"name": "thing", "model": "thing", "material": "brick", "position": [1.2, 1, 0.5]},
        {"name": "Würfel", "model": "thing", "material": "moss", "position": [2.3, 1.3, 0.6]}],
    "lights": [{"group": "key", "type": "directional", "direction": [0.2, -0.5, -1]}],
    "observer": {"position": [1.5, 1, 4], "look_at": [1.5, 1, 0.5],
                 "display": {"shape": "pyramid", "angles": [45, 34]}},
    "render": {"size": SIZE, "samples": 4},
    "animation": {"frames": 2, "tracks": [{
        "target": "objects.thing.turn",
        "keys": [{"frame": 1, "value": [0, 0, 0]}, {"frame": 2, "value": [0, 9, 0]}]}]},
}


def run(*words, binary=False):
    done = subprocess.run([str(word) for word in words], capture_output=True, text=not binary)
    assert done.returncode == 0, f"{' '.join(map(str, words))}: {done.stderr}"
    return done.stdout


def planes_of(path):
    """The channels of all parts, and where each part lies."""
    planes, windows = {}, []
    for part in OpenEXR.File(str(path), separate_channels=True).parts:
        planes |= {name: channel.pixels for name, channel in part.channels.items()}
        windows.append([tuple(corner) for corner in part.header["dataWindow"]])
    return planes, windows


def check_openexr(one, many):
    """Both files have equal channels, and every part the place of the crop."""
    single, _ = planes_of(one)
    parts, windows = planes_of(many)
    assert single.keys() == parts.keys()
    for name, plane in single.items():
        assert plane.shape == (CROP[3], CROP[2]), (name, plane.shape)
        assert plane.dtype == parts[name].dtype and (plane == parts[name]).all(), name
    first, last = CROP[:2], (CROP[0] + CROP[2] - 1, CROP[1] + CROP[3] - 1)
    assert windows == [[first, last]] * len(PARTS), windows
    assert [part.name() for part in OpenEXR.File(str(many)).parts] == PARTS
    return single


def check_exrheader(many):
    text = run("exrheader", many)
    assert text.count("dataWindow (type box2i): (8 4) - (67 53)") == len(PARTS)
    assert text.count("displayWindow (type box2i): (0 0) - (95 71)") == len(PARTS)
    for part in PARTS:
        assert f'name (type string): "{part}"' in text, part


def check_oiiotool(one, many, folder):
    """It lists the parts, finds the mattes' attributes, and takes a layer out of the file."""
    text = run("oiiotool", "--info", "-v", "-a", many)
    for part in PARTS:
        assert f'oiio:subimagename: "{part}"' in text, part
    for text in (text, run("oiiotool", "--info", "-v", one)):
        for expected in ('name: "CryptoObject"', "MurmurHash3_32", "full/display size: 96 x 72",
                         "pixel data origin: x=8, y=4"):
            assert expected in text, expected
    layer = folder / "layer.exr"
    run("oiiotool", "-i:subimage=" + str(PARTS.index("N")), many, "-o", layer)
    assert (planes_of(layer)[0]["N.X"] == planes_of(one)[0]["N.X"]).all()


def blender_compositor(path):
    """A compositor with an image, a Cryptomatte of it, and its output."""
    bpy.ops.wm.read_factory_settings(use_empty=True)
    scene = bpy.context.scene
    image = bpy.data.images.load(str(path))
    assert tuple(image.size) and image.type == "MULTILAYER", image.type  # a size loads it
    scene.camera = bpy.data.objects.new("camera", bpy.data.cameras.new("camera"))
    scene.collection.objects.link(scene.camera)
    if hasattr(scene, "compositing_node_group"):  # from Blender 5 on
        tree = bpy.data.node_groups.new("tree", "CompositorNodeTree")
        scene.compositing_node_group = tree
        tree.interface.new_socket("Image", in_out="OUTPUT", socket_type="NodeSocketColor")
        output = tree.nodes.new("NodeGroupOutput")
    else:
        scene.use_nodes = True
        tree = scene.node_tree
        tree.nodes.clear()
        output = tree.nodes.new("CompositorNodeComposite")
    scene.render.resolution_x, scene.render.resolution_y = SIZE
    scene.render.engine = "CYCLES"
    scene.cycles.samples = 1
    scene.view_settings.view_transform = "Raw"
    settings = scene.render.image_settings
    settings.file_format, settings.color_mode, settings.color_depth = "OPEN_EXR", "RGB", "32"
    passes = tree.nodes.new("CompositorNodeImage")
    passes.image = image
    matte = tree.nodes.new("CompositorNodeCryptomatteV2")
    matte.source = "IMAGE"
    matte.image = image
    return tree, output, passes, matte


def check_blender(path, planes, folder, color, depth):
    """Its passes have the file's values; its Cryptomatte node finds names and coverage."""
    tree, output, passes, matte = blender_compositor(path)
    found = {socket.name for socket in passes.outputs if socket.enabled}
    expected = set(PARTS) - {"rgba", "depth"} | {color, depth}
    assert expected <= found, expected - found
    names = [item.identifier for item in matte.bl_rna.properties["layer_name"].enum_items]
    assert {"CryptoObject", "CryptoMaterial"} <= set(names), names

    def composited(socket):
        tree.links.new(socket, output.inputs[0])
        bpy.context.scene.render.filepath = str(folder / "composited.exr")
        bpy.ops.render.render(write_still=True)
        whole = OpenEXR.File(str(folder / "composited.exr")).channels()["RGB"].pixels
        return whole.astype(numpy.float64).sum(axis=(0, 1))

    for layer, name, bits in (("CryptoObject", "thing", 0xb76346fd),
                              ("CryptoMaterial", "moss", 0xef2739ff)):
        identifier = numpy.array([bits], numpy.uint32).view(numpy.float32)[0]
        covered = sum((planes[f"{layer}{rank:02}.{share}"] *
                       (planes[f"{layer}{rank:02}.{of}"] == identifier)).sum(dtype=numpy.float64)
                      for rank in range(3) for of, share in ("RG", "BA"))
        matte.layer_name, matte.matte_id = layer, name
        picked = composited(next(s for s in matte.outputs if s.name == "Matte"))[0]
        assert covered > 50 and abs(picked - covered) < 1e-3 * covered, (name, picked, covered)
    for name, channels in (("objectId", ["objectId"]), ("materialId", ["materialId"]),
                           ("forward", ["forward.u", "forward.v"]), ("P", ["P.X", "P.Y", "P.Z"]),
                           ("light_key", ["light_key.R", "light_key.G", "light_key.B"])):
        sums = composited(next(s for s in passes.outputs if s.name == name))
        for value, channel in zip(sums, channels):
            ours = planes[channel].sum(dtype=numpy.float64)
            assert abs(value - ours) <= 1e-5 * abs(ours) + 1e-2, (name, sums, ours)


def check_blender_volume(program, folder):
    """The grids have their names, and are where and as large as `info` says."""
    display = {"shape": "box", "layout": "lattice", "size": [3, 2, 1], "voxels": [30, 20, 10]}
    scene = dict(SCENE, observer={"position": [1.5, 1, 0.5], "display": display})
    (folder / "box.json").write_text(json.dumps(scene))
    run(program, "render", folder / "box.json", "--frames", "1", "-q", "--volume",
        folder / "v####.vdb")
    facts = json.loads(run(program, "info", "--json", folder / "v0001.vdb"))["grids"]
    bpy.ops.wm.read_factory_settings(use_empty=True)
    bpy.ops.object.volume_import(filepath=str(folder / "v0001.vdb"))
    grids = bpy.context.object.data.grids
    assert grids.load(), grids.error_message
    assert {g.name for g in grids} == {fact["grid"] for fact in facts}
    types = {g.name: (g.data_type, g.channels) for g in grids}
    assert types["density"] == ("FLOAT", 1) and types["Cd"] == ("VECTOR_FLOAT", 3), types
    assert types["object"] == ("INT", 1), types
    fact = next(fact for fact in facts if fact["grid"] == "density")
    edges = [grids["density"].matrix_object[axis].to_tuple()[axis] for axis in range(3)]
    numpy.testing.assert_allclose(numpy.abs(edges), fact["voxel edges"], rtol=1e-6)


def main(program):
    with tempfile.TemporaryDirectory() as name:
        folder = pathlib.Path(name)
        (folder / "scene.json").write_text(json.dumps(SCENE))
        render = [program, "render", folder / "scene.json", "--frames", "1", "-q", "--channels",
                  CHANNELS, "--crop", ",".join(map(str, CROP))]
        run(*render, "-o", folder / "one####.exr")
        run(*render, "-o", folder / "many####.exr", "--multi-part")
        one, many = folder / "one0001.exr", folder / "many0001.exr"
        planes = check_openexr(one, many)
        tried = ["OpenEXR's module"]
        if shutil.which("exrheader"):
            check_exrheader(many)
            tried.append("exrheader")
        if shutil.which("oiiotool"):
            check_oiiotool(one, many, folder)
            tried.append("oiiotool")
        if bpy:
            check_blender(one, planes, folder, "Combined", "Depth")
            check_blender(many, planes, folder, "rgba", "depth")
            check_blender_volume(program, folder)
            tried.append("Blender " + bpy.app.version_string)
        print("all channels, parts and mattes are found by", ", ".join(tried))


main(pathlib.Path(sys.argv[1]).resolve())
