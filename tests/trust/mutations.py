# SPDX-License-Identifier: Apache-2.0
"""Damages bytes: flips, cuts, huge counts, repetitions, nesting, parts in other places."""
import gzip
import re
import struct
import zlib

PNG = b"\x89PNG\r\n\x1a\n"
VALUE = re.compile(rb'(?<=[:\[,=])\s*("[^"\\]{0,60}"|-?[0-9][0-9.eE+-]*)')
DEPTHS = (100, 20000, 300000)


def flip(data, chosen):
    data = bytearray(data)
    for _ in range(chosen.randint(1, 8)):
        data[chosen.randrange(len(data))] ^= 1 << chosen.randrange(8)
    return bytes(data)


def cut(data, chosen):
    return data[:chosen.randrange(len(data))]


def huge(data, chosen):
    """Writes a number of 2^31 or the like over four bytes, or over digits."""
    at = chosen.randrange(len(data))
    number = chosen.choice([0x7FFFFFFF, 0x80000000, 0xFFFFFFFF, 0x40000000, 0x10000])
    form = chosen.choice(["<I", ">I"])
    if data[at:at + 1].isdigit():
        end = at
        while data[end:end + 1].isdigit():
            end += 1
        return data[:at] + str(number).encode() + data[end:]
    return data[:at] + struct.pack(form, number) + data[at + 4:]


def repeat(data, chosen):
    """Repeats a part of the file many times."""
    at = chosen.randrange(len(data))
    end = min(len(data), at + chosen.randint(1, 64))
    return data[:at] + data[at:end] * chosen.choice([2, 100, 5000]) + data[end:]


def nest(data, chosen):
    """Puts many opening brackets, or the file's own beginning, into it."""
    at = chosen.randrange(len(data))
    return data[:at] + chosen.choice([b"[", b'{"a":', b"(", data[:8]]) * 20000 + data[at:]


def wrap(data, chosen):
    """Puts a value into many brackets that are closed again, or a new member of an object. Where
    the file has JSON, it stays so."""
    depth = chosen.choice(DEPTHS)
    left, right = chosen.choice([(b"[", b"]"), (b'{"a":', b"}")])
    places = [match.span(1) for match in VALUE.finditer(data[:1 << 20])]
    braces = [match.end() for match in re.finditer(rb"\{(?=\s*\")", data[:1 << 20])]
    if braces and (not places or chosen.random() < 0.5):
        at = chosen.choice(braces)
        return data[:at] + b'"zz":' + left * depth + b"1" + right * depth + b"," + data[at:]
    at, end = chosen.choice(places or [(0, len(data))])
    return data[:at] + left * depth + data[at:end] + right * depth + data[end:]


def splice(data, chosen):
    a, b = sorted(chosen.randrange(len(data)) for _ in range(2))
    at = chosen.randrange(len(data))
    return data[:at] + data[a:b] + data[at:]


MUTATIONS = [flip, flip, flip, cut, huge, huge, repeat, nest, wrap, splice]


def with_right_sums(data):
    """A PNG whose chunks have the checksums of what is in them now."""
    parts, at = [data[:8]], 8
    while at + 12 <= len(data):
        end = at + 8 + struct.unpack_from(">I", data, at)[0]
        if end + 4 > len(data):
            break
        parts += [data[at:end], struct.pack(">I", zlib.crc32(data[at + 4:end]))]
        at = end + 4
    return b"".join(parts) + data[at:]


def damaged(data, chosen):
    packed = data[:2] == b"\x1f\x8b" and chosen.random() < 0.7
    if packed:
        data = gzip.decompress(data)
    for _ in range(chosen.choice([1, 1, 2])):
        data = chosen.choice(MUTATIONS)(data, chosen) or b"x"
    if data.startswith(PNG) and chosen.random() < 0.7:
        data = with_right_sums(data)
    return gzip.compress(data, mtime=0) if packed else data
