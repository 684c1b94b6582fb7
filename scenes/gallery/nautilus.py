#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""Writes nautilus.nrrd: a shell as a CT scanner measures it, by Raup's spiral of tubes."""
import array
import gzip
import math
import sys

SIZE, EDGE = (192, 192, 100), 0.7  # millimetres
GROWTH = math.log(3.0) / (2 * math.pi)  # a whorl is three times as wide as the one inside it
OUTER, LAST = 66.0, 1.72 * math.pi  # the radius of the mouth, and its angle
SEPTA = 2 * math.pi / 17
BLUR = 2.4  # millimetres


def soft(distance, inside, outside):
    """A scanner blurs borders."""
    share = min(max(0.5 - distance / BLUR, 0), 1)
    share *= share * (3 - 2 * share)
    return outside + share * (inside - outside)


def value(x, y, z):
    r, angle = math.hypot(x, y), math.atan2(y, x) % (2 * math.pi)
    result = 0.0
    for turn in range(3, -1, -1):  # from the innermost whorl on
        phi = angle - 2 * math.pi * turn
        if phi > LAST + 0.1:
            continue
        radius = OUTER * math.exp(GROWTH * (phi - LAST))
        tube = 0.40 * radius
        across = math.hypot((r - 0.6 * radius), z * 1.12)
        thick = 0.35 + 0.022 * radius
        inside = across - tube
        if inside > 3:
            continue
        if inside < -thick:  # its hollow, through which no inner whorl goes
            result = 0.0
        beyond = (phi - LAST) * r  # the mouth's rim
        result = max(result, soft(max(abs(inside) - thick, beyond), 500, 0))
        if phi < LAST - 0.75 * math.pi and inside < 0:
            curved = phi + 0.55 * SEPTA * (1 - (across / tube) ** 2)
            away = abs((curved + SEPTA / 2) % SEPTA - SEPTA / 2) * 0.6 * radius
            result = max(result, soft(away - 0.5 - 0.006 * radius, 1000, 0))
        siphuncle = math.hypot(r - 0.6 * radius, z) - 0.02 * radius - 0.2
        if phi < LAST - 0.75 * math.pi:
            result = max(result, soft(siphuncle, 450, 0))
    return result


values = array.array("h")
for k in range(SIZE[2]):
    for j in range(SIZE[1]):
        for i in range(SIZE[0]):
            at = [(index + 0.5 - size / 2) * EDGE for index, size in zip((i, j, k), SIZE)]
            values.append(round(value(at[0] - 4, at[1] - 12, at[2]) / 4) * 4)
if sys.byteorder == "big":
    values.byteswap()
header = f"""NRRD0004
type: int16
dimension: 3
space dimension: 3
sizes: {SIZE[0]} {SIZE[1]} {SIZE[2]}
space directions: ({EDGE:g},0,0) (0,{EDGE:g},0) (0,0,{EDGE:g})
space units: "mm" "mm" "mm"
endian: little
encoding: gzip

"""
with open(sys.argv[1] if len(sys.argv) > 1 else "nautilus.nrrd", "wb") as file:
    file.write(header.encode() + gzip.compress(values.tobytes(), 9, mtime=0))
