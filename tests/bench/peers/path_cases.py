# SPDX-License-Identifier: Apache-2.0
"""Scenes of global light that this program, Mitsuba and Cycles render: a monument of voxels, a city
of instances and a mesh, under an even sky and a sun."""
import math

SIZE = (256, 192)
BOUNCES = 8
SKY, SUN, SUN_WAY = [0.5, 0.65, 0.9], [2.0, 1.8, 1.5], [-0.5, -0.8, -0.45]
ANGLE = 40.0
GREY = 0.7
BUILDINGS, BLOCKS, STREET = 8, 32, 24  # models, blocks along a side of the city, their distance


class Mesh:
    """Points, triangles, and a linear colour at each point, or none for grey."""

    def __init__(self, points, triangles, colors=None):
        self.points, self.triangles, self.colors = points, triangles, colors


class Case:
    """What all programs render.

    `ours` is this program's scene. `meshes` has a Mesh for each name and `placed` the name and the
    position of each object, `floor` the middle and the size of a grey box, if there is one."""

    def __init__(self, place, ours, meshes, placed, floor=None):
        self.place, self.ours, self.meshes = place, ours, meshes
        self.placed, self.floor = placed, floor


class Place:
    """Where the observer of a box of things stands."""

    def __init__(self, np, low, high):
        self.low, self.high = np.array(low, float), np.array(high, float)
        length = float(max(self.high - self.low))
        self.look_at = list((self.low + self.high) / 2)
        self.eye = list(np.array(self.look_at) + length * np.array([0.8, 0.75, 1.3]))
        self.length = length


def monument(np):
    """Voxels of (x, y, z, red, green, blue, opacity): terraces, pillars and a pond of colours."""
    random = np.random.default_rng(5)
    size = np.array([128, 64, 128])
    x, y, z = np.indices(size)
    height = 6 + 3 * np.sin(x / 11) * np.cos(z / 13)
    cells = y < height
    for step in range(6):
        half = 48 - 7 * step
        cells |= (abs(x - 64) < half) & (abs(z - 64) < half) & (y < 12 + 5 * step)
    for px in range(20, 110, 12):
        for pz in range(20, 110, 12):
            cells |= ((x - px) ** 2 + (z - pz) ** 2 < 9) & (y < 50 - 0.3 * abs(px - 64))
    color = np.stack([120 + y, 190 - x // 2, 90 + z], axis=-1)
    color = np.clip(color + random.integers(-25, 26, tuple(size) + (1,)), 30, 235)
    return np.concatenate([color, np.where(cells, 255, 0)[..., None]], axis=-1).astype(np.uint8)


def building(np, number):
    """Voxels of a house with rows of windows, narrower above."""
    random = np.random.default_rng(number)
    side, height = int(random.integers(10, 20)), int(random.integers(14, 60))
    x, y, z = np.indices((side, height, side))
    inset = np.where(y > 0.7 * height, 2, 0)
    cells = (x >= inset) & (x < side - inset) & (z >= inset) & (z < side - inset)
    is_window = (y % 4 == 2) & ((x + z) % 3 != 0)
    wall = np.broadcast_to(random.integers(90, 220, 3), cells.shape + (3,))
    color = np.where(is_window[..., None], [40, 50, 70], wall)
    color = np.clip(color + random.integers(-12, 13, cells.shape + (1,)), 10, 245)
    return np.concatenate([color, np.where(cells, 255, 0)[..., None]], axis=-1).astype(np.uint8)


def linear(np, codes):
    v = codes / 255.0
    return np.where(v <= 0.04045, v / 12.92, ((v + 0.055) / 1.055) ** 2.4)


def mesh_of_cubes(np, cells):
    """The faces of cubes that no other cube covers, each of its own colour."""
    there = np.pad(cells[..., 3] > 0, 1)
    colors = linear(np, cells[..., :3])
    inner = there[1:-1, 1:-1, 1:-1]
    faces, paint = [], []
    for axis in range(3):
        u, v = np.eye(3)[(axis + 1) % 3], np.eye(3)[(axis + 2) % 3]
        for side in (0, 1):
            beside = np.roll(there, 1 - 2 * side, axis)[1:-1, 1:-1, 1:-1]
            at = np.argwhere(inner & ~beside)
            low = at + side * np.eye(3)[axis]
            ring = [low, low + u, low + u + v, low + v]
            faces.append(np.stack(ring if side else ring[::-1], axis=1))
            paint.append(colors[tuple(at.T)])
    corners = np.concatenate(faces)
    first = 4 * np.arange(len(corners))[:, None]
    triangles = np.concatenate([first + [0, 1, 2], first + [0, 2, 3]])
    return Mesh(corners.reshape(-1, 3), triangles, np.repeat(np.concatenate(paint), 4, axis=0))


def read_obj(np, path):
    points, faces = [], []
    for line in path.read_text().splitlines():
        words = line.split()
        if words and words[0] == "v":
            points.append([float(w) for w in words[1:4]])
        elif words and words[0] == "f":
            face = [int(w.split("/")[0]) - 1 for w in words[1:]]
            faces += [[face[0], face[i], face[i + 1]] for i in range(1, len(face) - 1)]
    return np.array(points), np.array(faces)


def write_ply(np, path, mesh):
    """A mesh, with a colour at each corner if it has some."""
    columns = mesh.points if mesh.colors is None else np.hstack([mesh.points, mesh.colors])
    names = ["x", "y", "z"] + ([] if mesh.colors is None else ["r", "g", "b"])
    with path.open("wb") as file:
        lines = ["ply", "format binary_little_endian 1.0", f"element vertex {len(mesh.points)}"]
        lines += [f"property float {name}" for name in names]
        lines += [f"element face {len(mesh.triangles)}", "property list uchar int vertex_index"]
        file.write(("\n".join(lines) + "\nend_header\n").encode())
        file.write(columns.astype("<f4").tobytes())
        rows = np.zeros(len(mesh.triangles), dtype=[("n", "u1"), ("v", "<i4", 3)])
        rows["n"], rows["v"] = 3, mesh.triangles
        file.write(rows.tobytes())


def our_scene(place, models, objects, voxel):
    margin = voxel * math.ceil(0.02 * place.length / voxel)  # voxels of a file lie on the world's
    return {
        "voxelume": 1,
        "world": {"voxel_size": voxel, "bounds": {"min": list(place.low - margin),
                                                  "max": list(place.high + margin)},
                  "sky": {"kind": "constant", "color": SKY}},
        "materials": {"matt": {"color": [GREY] * 3}, "own": {"color": [1, 1, 1]}},
        "models": models, "objects": objects,
        # A white surface that faces it has its intensity as radiance, and there a pi-th.
        "lights": [{"type": "directional", "direction": SUN_WAY,
                    "color": [c / math.pi for c in SUN]}],
        "observer": {"position": place.eye, "look_at": place.look_at,
                     "display": {"shape": "pyramid", "angle": ANGLE}},
        "render": {"size": list(SIZE), "light": "global", "bounces": BOUNCES, "filter": "box"},
    }


def cubes_case(np, folder):
    cells = monument(np)
    np.save(folder / "monument.npy", cells)
    place = Place(np, [0, 0, 0], cells.shape[:3])
    ours = our_scene(place, {"m": {"voxels": "monument.npy"}},
                     [{"model": "m", "material": "own"}], 1)
    return Case(place, ours, {"m": mesh_of_cubes(np, cells)}, [("m", [0, 0, 0])])


def city_case(np, folder, placement="instance"):
    """A thousand houses of eight kinds, as instances or, by `auto`, as voxels of the world here."""
    random = np.random.default_rng(11)
    models, meshes, objects, placed = {}, {}, [], []
    for number in range(BUILDINGS):
        cells, name = building(np, number), f"house{number}"
        np.save(folder / f"{name}.npy", cells)
        models[name] = {"voxels": f"{name}.npy"}
        meshes[name] = mesh_of_cubes(np, cells)
    side = BLOCKS * STREET
    for x in range(0, side, STREET):
        for z in range(0, side, STREET):
            name, at = f"house{random.integers(BUILDINGS)}", [x + 2, 0, z + 2]
            objects.append({"model": name, "material": "own", "placement": placement,
                            "position": at})
            placed.append((name, at))
    place = Place(np, [0, -4, 0], [side, 60, side])
    floor = ([side / 2, -2, side / 2], [side, 4, side])
    models["floor"] = {"shape": "box", "size": floor[1], "surface": "exact"}
    objects.append({"model": "floor", "material": "matt", "position": floor[0]})
    voxel = 4 if placement == "instance" else 1
    return Case(place, our_scene(place, models, objects, voxel), meshes, placed, floor)


def mesh_case(np, folder, file):
    points, faces = read_obj(np, file)
    low, high = points.min(axis=0), points.max(axis=0)
    length = float(max(high - low))
    ground = low[1] - 0.02 * length
    place = Place(np, [low[0] - 0.5 * length, ground - 0.05 * length, low[2] - 0.5 * length],
                  high + [0.5 * length, 0, 0.5 * length])
    mesh = Mesh(points, faces)
    write_ply(np, folder / "mesh.ply", mesh)
    size = [float(place.high[0] - place.low[0]), 0.05 * length,
            float(place.high[2] - place.low[2])]
    middle = [float((place.low[0] + place.high[0]) / 2), float(ground - 0.025 * length),
              float((place.low[2] + place.high[2]) / 2)]
    ours = our_scene(place, {
        "mesh": {"mesh": "mesh.ply", "surface": "exact", "shading": "flat"},
        "floor": {"shape": "box", "size": size, "surface": "exact"}}, [
        {"model": "mesh", "material": "matt"},
        {"model": "floor", "material": "matt", "position": middle}], length / 256)
    return Case(place, ours, {"mesh": mesh}, [("mesh", [0, 0, 0])], (middle, size))
