# SPDX-License-Identifier: Apache-2.0
"""Mitsuba 3 as a peer: what the comparisons with it share."""
import json
import pathlib
import subprocess
import sys
import tempfile

SKIPPED = 77  # the exit code of tests that are skipped


def load_mitsuba(variant="scalar_rgb"):
    """Mitsuba with a variant, and numpy. Without them, or what the variant needs, the program says
    so and ends as tests do that are skipped."""
    try:
        import mitsuba
        import numpy
        mitsuba.set_variant(variant)
    except ImportError:
        print("Mitsuba isn't installed: pip install mitsuba")
        sys.exit(SKIPPED)
    return mitsuba, numpy


def colors_of(mi, np, image, layer=""):
    """The colours of an EXR file that this program wrote, rows x columns x 3; or a layer's, which
    is named with a dot behind it."""
    bitmap = mi.Bitmap(str(image))
    names = [field.name for field in bitmap.struct_()]
    values = np.array(bitmap).astype(float)
    return np.stack([values[:, :, names.index(layer + c)] for c in "RGB"], axis=-1)


def our_image(mi, np, voxelume, scene, write_files=lambda folder: None):
    """The colours of a scene in this program. `write_files` writes what the scene names."""
    with tempfile.TemporaryDirectory() as name:
        folder = pathlib.Path(name)
        write_files(folder)
        (folder / "scene.json").write_text(json.dumps(scene))
        image = folder / "ours.exr"
        subprocess.run([voxelume, "render", str(folder / "scene.json"), "-o", str(image),
                        "--channels", "RGBA", "-q"], check=True)
        return colors_of(mi, np, image)


def sensor(mi, size, samples, eye, target, angle):
    """A camera of Mitsuba's as our observers with a pyramid are."""
    return {"type": "perspective", "fov": angle,
            "to_world": mi.ScalarTransform4f().look_at(origin=eye, target=target, up=[0, 1, 0]),
            "sampler": {"type": "independent", "sample_count": samples},
            "film": {"type": "hdrfilm", "width": size, "height": size,
                     "rfilter": {"type": "box"}}}


def squares_of(image, side):
    """The means of a picture's squares of `side` pixels."""
    rows, columns = image.shape[0] // side, image.shape[1] // side
    return image.reshape(rows, side, columns, side, 3).mean(axis=(1, 3))
