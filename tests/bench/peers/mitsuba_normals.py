#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""Holds the shading normals of exact meshes against Mitsuba 3's.

Usage: mitsuba_normals.py VOXELUME MESH.obj...

Renders each mesh with its vertex normals as an exact model, sends Mitsuba's AOV integrator
(sh_normal) along the same rays and prints the angles between the two normals. A mesh without
normals gets averages weighted by angles. Fails where their root mean square is 0.5 degrees or more.
Where Mitsuba isn't installed (pip install mitsuba) it says so and ends with 77, as tests do that are
skipped.
"""
import json
import pathlib
import subprocess
import sys
import tempfile

SIZE = (640, 480)
MAX_RMS_DEGREES = 0.5
SKIPPED = 77


def find_mitsuba():
    """Mitsuba with the first variant that this machine can run, and numpy; None without them."""
    try:
        import mitsuba
        import numpy
    except ImportError:
        return None
    mitsuba.set_variant("llvm_ad_rgb")
    return mitsuba, numpy


def read_obj(path):
    """Positions, normals, and for each corner of each triangle its position and normal."""
    positions, normals, corners = [], [], []
    for line in path.read_text().splitlines():
        words = line.split()
        if not words:
            continue
        if words[0] == "v":
            positions.append([float(w) for w in words[1:4]])
        elif words[0] == "vn":
            normals.append([float(w) for w in words[1:4]])
        elif words[0] == "f":
            face = [(w.split("/") + ["", ""])[:3] for w in words[1:]]
            face = [(int(v) - 1, int(n) - 1 if n else -1) for v, _, n in face]
            corners += [[face[0], face[i], face[i + 1]] for i in range(1, len(face) - 1)]
    return positions, normals, corners


def angle_weighted(np, positions, triangles):
    """Normals of vertices: means of the faces around them, weighted by their angles there.

    Vertices at one position are one."""
    places, joined = np.unique(positions, axis=0, return_inverse=True)
    positions, triangles = places, joined.reshape(-1)[triangles]
    p = positions[triangles]
    face = np.cross(p[:, 1] - p[:, 0], p[:, 2] - p[:, 0])
    face /= np.maximum(np.linalg.norm(face, axis=1, keepdims=True), 1e-300)
    normals = np.zeros_like(positions)
    for i in range(3):
        u, v = p[:, (i + 1) % 3] - p[:, i], p[:, (i + 2) % 3] - p[:, i]
        angle = np.arctan2(np.linalg.norm(np.cross(u, v), axis=1), np.sum(u * v, axis=1))
        np.add.at(normals, triangles[:, i], face * angle[:, None])
    normals = normals[joined.reshape(-1)]
    lengths = np.linalg.norm(normals, axis=1, keepdims=True)
    return np.where(lengths > 0, normals / np.maximum(lengths, 1e-300), [0.0, 0.0, 1.0])


def write_mesh(np, source, target):
    """Writes the mesh with normals. Returns its corners' box."""
    positions, normals, corners = read_obj(source)
    triangles = np.array([[v for v, _ in t] for t in corners])
    points = np.array(positions)
    numbers = np.array([[n for _, n in t] for t in corners])
    if not normals:
        normals, numbers = angle_weighted(np, points, triangles), triangles
    with target.open("w") as file:
        for word, rows in (("v", points), ("vn", normals)):
            file.writelines(f"{word} {x:.9g} {y:.9g} {z:.9g}\n" for x, y, z in rows)
        for t, n in zip(triangles + 1, numbers + 1):
            file.write("f " + " ".join(f"{a}//{b}" for a, b in zip(t, n)) + "\n")
    used = points[triangles.ravel()]
    return used.min(axis=0), used.max(axis=0)


def write_scene(np, folder, low, high):
    """Writes a scene of the mesh. Returns the observer's position."""
    centre, length = (low + high) / 2, float(np.max(high - low))
    eye = centre + length * np.array([0.7, 0.6, -1.6])
    margin = 0.05 * length
    scene = {
        "voxelume": 1,
        "world": {"voxel_size": length / 256,
                  "bounds": {"min": list(low - margin), "max": list(high + margin)}},
        "models": {"mesh": {"mesh": "mesh.obj", "surface": "exact"}},
        "objects": [{"model": "mesh"}],
        "observer": {"position": list(eye), "look_at": list(centre),
                     "display": {"shape": "pyramid", "angle": 40}},
        "render": {"size": list(SIZE)},
    }
    (folder / "scene.json").write_text(json.dumps(scene))
    return eye


def our_planes(mi, np, image):
    """The P and N planes of an image."""
    bitmap = mi.Bitmap(str(image))
    names = [field.name for field in bitmap.struct_()]
    values = np.array(bitmap).reshape(-1, len(names))
    return [values[:, [names.index(f"{plane}.{a}") for a in "XYZ"]].astype(float)
            for plane in "PN"]


def mitsuba_normals(mi, np, mesh, eye, ways):
    """Mitsuba's shading normals and distances along rays, in units of `ways`."""
    scene = mi.load_dict({"type": "scene",
                          "integrator": {"type": "aov", "aovs": "n:sh_normal,p:position"},
                          "mesh": {"type": "obj", "filename": str(mesh)}})
    directions = ways / np.linalg.norm(ways, axis=1, keepdims=True)
    rays = mi.RayDifferential3f(mi.Point3f(*[float(e) for e in eye]),
                                mi.Vector3f(directions.T.astype(np.float32)))
    sampler = mi.load_dict({"type": "independent"})
    sampler.seed(0, len(ways))
    _, _, values = scene.integrator().sample(scene, sampler, rays)
    values = np.array([np.array(v) for v in values]).astype(float)
    normal, point = values[-6:-3].T, values[-3:].T
    return normal, np.linalg.norm(point - eye, axis=1) / np.linalg.norm(ways, axis=1)


def compare(mi, np, voxelume, mesh):
    """Prints the angles between our normals and Mitsuba's. True if they are small."""
    with tempfile.TemporaryDirectory() as name:
        folder = pathlib.Path(name)
        low, high = write_mesh(np, mesh, folder / "mesh.obj")
        eye = write_scene(np, folder, low, high)
        subprocess.run([voxelume, "render", str(folder / "scene.json"), "-o",
                        str(folder / "ours.exr"), "--channels", "P,N", "-q"], check=True)
        points, ours = our_planes(mi, np, folder / "ours.exr")
        seen = np.linalg.norm(ours, axis=1) > 0
        points, ours = points[seen], ours[seen]
        theirs, reach = mitsuba_normals(mi, np, folder / "mesh.obj", eye, points - eye)
    same = np.abs(reach - 1) < 1e-3  # others pass the edge of a silhouette
    ours, theirs = ours[same], theirs[same]
    theirs *= np.sign(np.sum(ours * theirs, axis=1))[:, None]  # Mitsuba's don't face the ray
    angles = np.degrees(np.arctan2(np.linalg.norm(np.cross(ours, theirs), axis=1),
                                   np.sum(ours * theirs, axis=1)))
    rms = float(np.sqrt(np.mean(angles ** 2)))
    print(f"{mesh.name}: RMS {rms:.4f} degrees, 99 % below {np.percentile(angles, 99):.4f}, "
          f"largest {angles.max():.3f}, {len(angles)} of {int(seen.sum())} pixels")
    return rms < MAX_RMS_DEGREES and len(angles) > 0.99 * seen.sum()


def main():
    if len(sys.argv) < 3:
        sys.exit(__doc__)
    found = find_mitsuba()
    if not found:
        print("Mitsuba isn't installed: pip install mitsuba")
        sys.exit(SKIPPED)
    meshes = [pathlib.Path(name) for name in sys.argv[2:]]
    results = [compare(*found, sys.argv[1], mesh) for mesh in meshes]
    sys.exit(0 if all(results) else 1)


if __name__ == "__main__":
    main()
