#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""Holds the voxels of NIfTI, NRRD, numpy and .vox files, and the colours of JPEG textures of inks,
against what other readers make of them.

Arrays with all 48 orders and directions of axes are written by nibabel and pynrrd. The program
converts them to NRRD, which pynrrd reads: each voxel lies where nibabel's or pynrrd's own map has
it. Exits with 77, which skips the test, where the modules aren't installed.

Usage: array_readers_test.py PROGRAM
"""
import itertools
import json
import pathlib
import subprocess
import sys
import tempfile

try:
    import nibabel
    import nrrd
    import numpy
    from midvoxio.voxio import get_vox, vox_to_arr
except ImportError:
    sys.exit(77)
try:
    from PIL import Image
except ImportError:
    Image = None

# Left, up and front of right-anterior-superior and of left-posterior-superior coordinates.
FROM_RAS = numpy.array([[-1, 0, 0], [0, 0, 1], [0, 1, 0]])
FROM_LPS = numpy.array([[1, 0, 0], [0, 0, 1], [0, -1, 0]])


def maps():
    """The 48 signed permutations with three different spacings, and an origin each."""
    for order in itertools.permutations(range(3)):
        for signs in itertools.product((1, -1), repeat=3):
            rows = numpy.zeros((3, 3))
            for axis in range(3):
                rows[axis, order[axis]] = signs[axis] * (1.5, 2.0, 0.75)[axis]
            yield rows, numpy.array([10.0, -20.5, 3.25]) * signs


def places(values, rows, origin):
    """The middles of the cells that aren't 0, in whole micrometres."""
    indices = numpy.argwhere(values != 0)
    return {tuple(p) for p in numpy.rint(1000 * (indices @ rows.T + origin)).astype(int).tolist()}


def written_places(path):
    values, header = nrrd.read(str(path))
    rows = header["space directions"].T * 1000
    return places(values, rows, header["space origin"] * 1000)


def check_materials(program, folder):
    """The materials of a scene in a MagicaVoxel file."""
    materials = {"metal": {"base_color": [1, 0.7, 0.2], "metallic": 0.75, "roughness": 0.25},
                 "glass": {"diffuse": 0.5, "refraction": 0.5, "ior": 1.5},
                 "lamp": {"emission": [4, 2, 1]}}
    scene = {"voxelume": 1, "world": {"voxel_size": 0.25}, "materials": materials,
             "models": {"box": {"shape": "box", "size": [1, 1, 1]}},
             "objects": [{"model": "box", "material": name, "position": [2 * i, 0, 0]}
                         for i, name in enumerate(materials)]}
    (folder / "m.json").write_text(json.dumps(scene))
    subprocess.run([program, "voxelize", folder / "m.json", "-o", folder / "m.vox"], check=True)
    found = {m.dic["_type"]: m.dic for m in get_vox(str(folder / "m.vox")).materials}
    assert set(found) == {"_metal", "_glass", "_emit"}, found
    for kind, key, value in (("_metal", "_metal", 0.75), ("_metal", "_rough", 0.25),
                             ("_glass", "_trans", 0.5), ("_glass", "_ri", 1.5),
                             ("_emit", "_emit", 1), ("_emit", "_flux", 1)):
        assert float(found[kind][key]) == value, (kind, key, found[kind])


def check_halves(convert, folder, rng):
    """Voxels of float16, whose bytes lie in either order."""
    values = rng.random((6, 5, 4)).astype(numpy.float16)
    for order in "<>":
        numpy.save(folder / "h.npy", values.astype(order + "f2"))
        read = numpy.load(convert(folder / "h.npy", folder / "i.npy"))
        found = set(map(tuple, numpy.argwhere(read)))
        expected = numpy.argwhere(values >= 0.5)
        assert found == set(map(tuple, expected - expected.min(0))), order


def check_inks(program, folder):
    """The colours that PIL makes of a CMYK JPEG, with which a box is painted."""
    if Image is None:
        return
    inks = numpy.zeros((16, 16, 4), numpy.uint8)
    inks[:] = (30, 180, 90, 40)
    picture = Image.fromarray(inks, "CMYK")
    picture.save(folder / "inks.jpg", quality=100)
    expected = Image.open(folder / "inks.jpg").convert("RGB").getpixel((8, 8))
    (folder / "inks.mtl").write_text("newmtl ink\nKd 1 1 1\nmap_Kd inks.jpg\n")
    corners = [(x, y, z) for x in (0, 1) for y in (0, 1) for z in (0, 1)]
    faces = "1 2 4 3", "5 7 8 6", "1 5 6 2", "3 4 8 7", "1 3 7 5", "2 6 8 4"
    text = "mtllib inks.mtl\nvt 0.5 0.5\nusemtl ink\n"
    text += "".join("v %d %d %d\n" % corner for corner in corners)
    text += "".join("f " + " ".join(n + "/1" for n in face.split()) + "\n" for face in faces)
    (folder / "inks.obj").write_text(text)
    subprocess.run([program, "voxelize", folder / "inks.obj", "-o", folder / "inks.npy",
                    "--resolution", "8"], check=True, capture_output=True)
    read = numpy.load(folder / "inks.npy")
    found = read[read[..., 3] > 0][:, :3].astype(int)
    assert len(found) > 0 and abs(found - expected).max() <= 2, (found[0], expected)


def main():
    program = sys.argv[1]
    rng = numpy.random.default_rng(5)
    with tempfile.TemporaryDirectory() as name:
        folder = pathlib.Path(name)

        def convert(source, target):
            subprocess.run([program, "convert", source, target], check=True)
            return target

        for i, (rows, origin) in enumerate(maps()):
            values = (rng.random((3, 4, 5)) < 0.3).astype(numpy.int16) * 7
            affine = numpy.eye(4)
            affine[:3, :3] = rows
            affine[:3, 3] = origin
            is_pair = i % 4 > 1
            kinds = ((nibabel.Nifti1Image, nibabel.Nifti2Image),
                     (nibabel.Nifti1Pair, nibabel.Nifti2Pair))
            image = kinds[is_pair][i % 2](values, affine)
            image.header.set_xyzt_units("mm")
            if i % 3 == 0:  # the quaternion alone
                image.set_sform(None, code=0)
                image.set_qform(affine, code=1)
            names = ("a.hdr", "b.img.gz") if is_pair else ("a.nii", "a.nii.gz")
            source = folder / names[i % 5 > 0]
            nibabel.save(image, source)
            found = written_places(convert(source, folder / "a.nrrd"))
            loaded = nibabel.load(source).affine
            expected = places(values, FROM_RAS @ loaded[:3, :3], FROM_RAS @ loaded[:3, 3])
            assert found == expected, f"NIfTI {i}"

            nrrd.write(str(folder / "b.nrrd"), values,
                       {"space": "left-posterior-superior", "space directions": rows.T,
                        "space origin": origin, "encoding": "raw" if i % 2 else "gzip"})
            found = written_places(convert(folder / "b.nrrd", folder / "c.nrrd"))
            assert found == places(values, FROM_LPS @ rows, FROM_LPS @ origin), f"NRRD {i}"

        check_materials(program, folder)
        check_halves(convert, folder, rng)
        check_inks(program, folder)
        colors = rng.integers(0, 256, (6, 5, 4, 3), dtype=numpy.uint8)
        colors[0, 0, 0] = colors[5, 4, 3] = (1, 2, 3)
        for order in "CF":
            numpy.save(folder / "d.npy", numpy.asarray(colors, order=order))
            read = numpy.load(convert(folder / "d.npy", folder / "e.npy"))
            assert read.shape == (6, 5, 4, 4), read.shape
            assert (read[..., :3] == colors).all(), order
            assert ((read[..., 3] == 255) == colors.any(-1)).all(), order

        # MagicaVoxel's Z is up, and its Y goes away from the front.
        vox = vox_to_arr(str(convert(folder / "d.npy", folder / "f.vox")))
        assert vox.shape == (6, 4, 5, 4), vox.shape
        expected = colors.transpose(0, 2, 1, 3)[:, ::-1]
        assert (numpy.rint(255 * vox[..., :3]).astype(int) == expected).all()
        assert ((vox[..., 3] > 0) == expected.any(-1)).all()


main()
