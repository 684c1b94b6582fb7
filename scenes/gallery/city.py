#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""Writes city.vox: 1,000 houses, which are instances of 16, with lit windows."""
import random
import struct
import sys

random.seed(4)
WALLS = [(104, 98, 92), (86, 82, 84), (122, 104, 90), (70, 76, 84), (140, 128, 112), (96, 72, 62)]
DARK, WARM, COLD, ROOF, STREET, GRASS, LEAF, TRUNK = 7, 8, 9, 10, 11, 12, 13, 14
PALETTE = WALLS + [(24, 28, 36), (255, 196, 120), (214, 226, 255), (52, 50, 52), (46, 46, 50),
                   (58, 84, 46), (50, 92, 44), (74, 56, 42)]


def chunk(name, content=b"", children=b""):
    return name + struct.pack("<ii", len(content), len(children)) + content + children


def text(value):
    return struct.pack("<i", len(value)) + value.encode()


def attributes(**pairs):
    return struct.pack("<i", len(pairs)) + b"".join(text("_" + k) + text(v) for k, v in pairs.items())


def house(number):
    """A tower: floors of three voxels, windows on all sides, sometimes a smaller part on top."""
    wall = 1 + number % len(WALLS)
    voxels = {}

    def part(x0, y0, x1, y1, z0, z1):
        for z in range(z0, z1):
            for x in range(x0, x1):
                for y in range(y0, y1):
                    sides = (x in (x0, x1 - 1)) + (y in (y0, y1 - 1))
                    if not sides and z < z1 - 1:
                        continue
                    color = wall
                    along = y - y0 if x in (x0, x1 - 1) else x - x0
                    if sides == 1 and (z - z0) % 3 and along % 2 and z < z1 - 2:
                        lit = random.Random((number, x, y, (z - z0) // 3).__repr__()).random()
                        color = WARM if lit < 0.2 else COLD if lit < 0.26 else DARK
                    if z == z1 - 1:
                        color = ROOF if not sides else wall
                    voxels[x, y, z] = color

    width, depth = random.choice([9, 11, 13]), random.choice([9, 11, 13])
    height = random.choice([14, 17, 20, 26, 32, 41, 50, 62]) if number else 86
    part(0, 0, width, depth, 0, height)
    if height > 24:
        part(2, 2, width - 2, depth - 2, height, height + height // 3 // 3 * 3 + 2)
    return voxels


def tree():
    voxels = {(2, 2, z): TRUNK for z in range(3)}
    for x in range(5):
        for y in range(5):
            for z in range(2, 7):
                if (x - 2) ** 2 + (y - 2) ** 2 + (z - 4) ** 2 < 6.5:
                    voxels[x, y, z] = LEAF
    return voxels


def ground(color, size):
    return {(x, y, 0): color for x in range(size) for y in range(size)}


def model(voxels):
    size = [max(v[i] for v in voxels) + 1 for i in range(3)]
    content = struct.pack("<i", len(voxels))
    content += b"".join(bytes((*place, color)) for place, color in voxels.items())
    return size, chunk(b"SIZE", struct.pack("<iii", *size)) + chunk(b"XYZI", content)


models = [house(n) for n in range(16)] + [tree(), ground(STREET, 128), ground(GRASS, 14)]
sizes, chunks = zip(*(model(voxels) for voxels in models))
TREE, STREETS, LAWN = 16, 17, 18
PITCH = 18
placed = []  # model, middle in x and y, lowest z, turn
for i in range(5):
    for j in range(5):
        placed.append((STREETS, 128 * i - 256, 128 * j - 256, -1, 0))
houses = 0
cells = [(i, j) for i in range(-16, 17) for j in range(-16, 17)]
cells.sort(key=lambda c: c[0] ** 2 + c[1] ** 2)
for i, j in cells:
    x, y = PITCH * i, PITCH * j
    if (i * 7 + j * 13) % 17 == 0 and houses:  # a park
        placed.append((LAWN, x, y, 0, 0))
        for k in range(4):
            placed.append((TREE, x + random.choice([-4, 0, 4]), y + random.choice([-4, 4]), 1, k))
    elif houses < 1000:
        near = i * i + j * j < 30
        pick = 0 if not houses else random.randrange(16)
        if not near and sizes[pick][2] > 45 and random.random() < 0.7:
            pick = random.randrange(1, 16)
        placed.append((pick, x, y, 0, random.randrange(4)))
        houses += 1

nodes, children = b"", []
number = 2
for index, x, y, z, turn in placed:
    size = sizes[index]
    rotation = {0: 4, 1: 17, 2: 52, 3: 33}[turn]
    place = f"{x} {y} {z + size[2] // 2}"
    nodes += chunk(b"nTRN", struct.pack("<i", number) + attributes() +
                   struct.pack("<iiii", number + 1, -1, 0, 1) + attributes(t=place, r=str(rotation)))
    nodes += chunk(b"nSHP", struct.pack("<i", number + 1) + attributes() +
                   struct.pack("<ii", 1, index) + attributes())
    children.append(number)
    number += 2
root = chunk(b"nTRN", struct.pack("<i", 0) + attributes() + struct.pack("<iiii", 1, -1, 0, 1) + attributes())
group = chunk(b"nGRP", struct.pack("<i", 1) + attributes() + struct.pack("<i", len(children)) +
              struct.pack(f"<{len(children)}i", *children))
palette = b"".join(bytes((*c, 255)) for c in PALETTE) + bytes(4 * (256 - len(PALETTE)))
emissive = b"".join(chunk(b"MATL", struct.pack("<i", m) + attributes(type="_emit", emit="0.5", flux=flux))
                    for m, flux in ((WARM, "1"), (COLD, "1")))
def setting(**values):
    return chunk(b"rOBJ", attributes(**values))


light = (setting(type="_inf", i="2.2", k="255 140 84", angle="9 128", area="0.2") +
         setting(type="_uni", i="0.4", k="112 132 216") +
         setting(type="_bg", color="48 54 98") + setting(type="_ground", enable="0"))
camera = chunk(b"rCAM", struct.pack("<i", 0) + attributes(
    mode="pers", focus="0 0 34", angle="-17 33 0", radius="260", fov="50"))
body = b"".join(chunks) + root + group + nodes + light + camera + chunk(b"RGBA", palette) + emissive
with open(sys.argv[1] if len(sys.argv) > 1 else "city.vox", "wb") as file:
    file.write(b"VOX " + struct.pack("<i", 150) + chunk(b"MAIN", b"", body))
print(houses, "houses,", len(placed), "instances", file=sys.stderr)
