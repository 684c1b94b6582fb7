# SPDX-License-Identifier: Apache-2.0
"""Small valid files of formats that others define, as bytes: SEEDS, by their fuzzers' names.
"""
import base64
import bz2
import gzip
import struct
import zlib


def npy(version=1, descr="<u2"):
    header = "{'descr': '%s', 'fortran_order': False, 'shape': (2, 3, 4), }\n" % descr
    length = struct.pack("<H" if version == 1 else "<I", len(header))
    return b"\x93NUMPY" + bytes([version, 0]) + length + header.encode() + bytes(range(48))


def nrrd(encoding):
    header = ("NRRD0005\ntype: short\ndimension: 3\nspace: left-posterior-superior\n"
              "sizes: 2 3 4\nspace directions: (1,0,0) (0,2,0) (0,0,3)\nendian: little\n"
              f"encoding: {encoding}\nspace origin: (1,2,3)\nkey:=value\n\n")
    data = bytes(range(48))
    packed = {"raw": data, "gzip": gzip.compress(data, mtime=0), "bzip2": bz2.compress(data),
              "text": " ".join(str(i) for i in range(24)).encode()}
    return header.encode() + packed[encoding]


def nii():
    head = bytearray(352)
    struct.pack_into("<i", head, 0, 348)
    struct.pack_into("<8h", head, 40, 3, 2, 3, 4, 1, 1, 1, 1)
    struct.pack_into("<2h", head, 70, 4, 16)
    struct.pack_into("<8f", head, 76, 1, 1, 2, 3, 0, 0, 0, 0)
    struct.pack_into("<3f", head, 108, 352, 2, -5)
    head[123] = 2
    struct.pack_into("<2h6f", head, 252, 1, 0, 0, 0, 1, 1, 2, 3)
    head[344:347] = b"n+1"
    return bytes(head) + bytes(range(48))


def nifti_pair():
    head = bytearray(nii()[:352])
    struct.pack_into("<f", head, 108, 0)
    head[344:347] = b"ni1"
    return pair(bytes(head), bytes(range(48)))


def qb(packed):
    head = struct.pack("<6I", 257, 0, 1, packed, 0, 1) + b"\4name"
    head += struct.pack("<3I3i", 2, 2, 1, 0, 1, 2)
    if packed:
        return head + struct.pack("<6I", 2, 3, 0xFF112233, 0, 6, 0)
    return head + struct.pack("<4I", 0xFF112233, 0, 0x01445566, 0)


def kv6():
    head = b"Kvxl" + struct.pack("<3i3fi", 2, 1, 4, 1, 0.5, 2, 2)
    voxels = b"bgr\x80\1\0\x3f\x11" + b"bgr\x80\3\0\x3f\x11"
    return head + voxels + struct.pack("<2i2H", 2, 0, 2, 0)


def binvox():
    return b"#binvox 1\ndim 4 4 4\ntranslate 1 2 3\nscale 8\ndata\n" + bytes([0, 9, 1, 40, 0, 15])


def png(width, height):
    def chunk(letters, content):
        check = struct.pack(">I", zlib.crc32(letters + content))
        return struct.pack(">I", len(content)) + letters + content + check
    rows = b"".join(b"\0" + bytes(((x * 7 + y) % 256 for x in range(4 * width)))
                    for y in range(height))
    return (b"\x89PNG\r\n\x1a\n" +
            chunk(b"IHDR", struct.pack(">2I5B", width, height, 8, 6, 0, 0, 0)) +
            chunk(b"IDAT", zlib.compress(rows)) + chunk(b"IEND", b""))


def gox():
    def chunk(letters, content):
        return letters + struct.pack("<i", len(content)) + content + bytes(4)
    layer = struct.pack("<6i", 1, 0, 0, 16, -16, 0) + struct.pack("<i", 7) + b"visible"
    layer += struct.pack("<i", 1) + b"\1" + bytes(4)
    return b"GOX " + struct.pack("<i", 2) + chunk(b"BL16", png(64, 64)) + chunk(b"LAYR", layer)


def named(kind, name, value):
    return bytes([kind]) + struct.pack(">H", len(name)) + name + value


def schem():
    def size(name, n):
        return named(2, name, struct.pack(">h", n))
    palette = named(10, b"Palette", named(3, b"minecraft:stone", struct.pack(">i", 1)) +
                    named(3, b"minecraft:air", struct.pack(">i", 0)) + b"\0")
    data = named(7, b"BlockData", struct.pack(">i", 4) + b"\1\0\0\1")
    return named(10, b"Schematic", size(b"Width", 2) + size(b"Height", 2) + size(b"Length", 1) +
                 palette + data + b"\0")


def schematic():
    def size(name, n):
        return named(2, name, struct.pack(">h", n))
    return named(10, b"Schematic", size(b"Width", 2) + size(b"Height", 2) + size(b"Length", 1) +
                 named(7, b"Blocks", struct.pack(">i", 4) + b"\1\0\2\x23") +
                 named(7, b"Data", struct.pack(">i", 4) + b"\0\0\0\3") + b"\0")


def litematic():
    def place(name, x, y, z):
        return named(10, name, named(3, b"x", struct.pack(">i", x)) +
                     named(3, b"y", struct.pack(">i", y)) +
                     named(3, b"z", struct.pack(">i", z)) + b"\0")
    palette = named(9, b"BlockStatePalette", bytes([10]) + struct.pack(">i", 2) +
                    named(8, b"Name", b"\0\3air") + b"\0" + named(8, b"Name", b"\0\5stone") + b"\0")
    region = place(b"Position", 0, 1, 2) + place(b"Size", 2, -2, 2) + palette
    region += named(12, b"BlockStates", struct.pack(">iQ", 1, 0x1441))
    return named(10, b"", named(10, b"Regions", named(10, b"r", region + b"\0") + b"\0") + b"\0")


def vox():
    def chunk(letters, content):
        return letters + struct.pack("<2i", len(content), 0) + content
    body = chunk(b"SIZE", struct.pack("<3i", 3, 2, 4))
    body += chunk(b"XYZI", struct.pack("<i", 2) + bytes([0, 1, 2, 3, 2, 0, 3, 79]))
    body += chunk(b"nTRN", struct.pack("<7i", 0, 0, 1, -1, 0, 1, 0))
    body += chunk(b"nGRP", struct.pack("<4i", 1, 0, 1, 2))
    frame = struct.pack("<i", 2) + struct.pack("<i", 2) + b"_t" + struct.pack("<i", 5) + b"1 2 3"
    frame += struct.pack("<i", 2) + b"_r" + struct.pack("<i", 2) + b"20"
    body += chunk(b"nTRN", struct.pack("<6i", 2, 0, 3, -1, 0, 1) + frame)
    body += chunk(b"nSHP", struct.pack("<5i", 3, 0, 1, 0, 0))

    def dictionary(**pairs):
        texts = [t.encode() for pair in pairs.items() for t in pair]
        return struct.pack("<i", len(pairs)) + b"".join(struct.pack("<i", len(t)) + t for t in texts)
    body += chunk(b"rCAM", struct.pack("<i", 0) + dictionary(
        _mode="orth", _focus="1 2 3", _angle="-30 320 0", _radius="10", _frustum="5", _fov="45"))
    for settings in (dictionary(_type="_inf", _i="0.7", _k="255 255 0", _angle="50 50", _area="0.07"),
                     dictionary(_type="_uni", _i="0.7", _k="9 9 9"),
                     dictionary(_type="_fog_uni", _d="0.1", _k="255 0 0"),
                     dictionary(_type="_film", _expo="1", _vig="0.1"),
                     dictionary(_type="_ground", _color="80 80 80"),
                     dictionary(_type="_setting", _ground="1", _bg_c="1")):
        body += chunk(b"rOBJ", settings)
    return b"VOX " + struct.pack("<i", 150) + b"MAIN" + struct.pack("<2i", 0, len(body)) + body


def hdr(rows):
    return b"#?RADIANCE\nFORMAT=32-bit_rle_rgbe\n\n" + rows


OBJ = (b"mtllib a.mtl\no a\nv 0 0 0\nv 1 0 0 1 0.5 0\nv 1 1 0\nv 0 1 0.5\nvt 0 0\nvt 1 1\n"
       b"vn 0 0 1\nusemtl m\ng b\ns 1\nf 1/1/1 2/2/1 3//1 4\nf -1 -2 -3\nl 1 2\n")
PLY = (b"ply\nformat %s 1.0\nelement vertex 3\nproperty float x\nproperty float y\n"
       b"property float z\nproperty uchar red\nelement %s 1\nproperty list uchar int %s\n"
       b"end_header\n")
PLYS = [PLY % (b"ascii", b"face", b"vertex_indices") + b"0 0 0 9\n1 0 0 9\n0 1 0 9\n3 0 1 2\n",
        PLY % (b"binary_big_endian", b"tristrips", b"vertex_indices") +
        b"".join(struct.pack(">3fB", i == 1, i == 2, 0, 9) for i in range(3)) +
        struct.pack(">B3i", 3, 0, 1, 2),
        b"ply\nformat ascii 1.0\nelement vertex 2\nproperty double x\nproperty double y\nproperty "
        b"double z\nproperty uchar red\nproperty uchar green\nproperty uchar blue\nend_header\n"
        b"0 0 0 9 9 9\n1 2 3 255 0 1\n"]
OBJ_DRAWING = b"v 0 0 0 1 0 0\nv 1 0 0 0 1 0\nv 0 2 1 9 9 9\np 1 -1\nl 1/1 2/2 3 1\nl -2 \\\n-1\n"
STLS = [b"solid a\nfacet normal 0 0 1\nouter loop\nvertex 0 0 0\nvertex 1 0 0\nvertex 0 1 0\n"
        b"endloop\nendfacet\nendsolid a\n",
        b"COLOR=abcd".ljust(80) + struct.pack("<I12fH", 1, 0, 0, 1, 0, 0, 0, 1, 0, 0, 0, 1, 0, 999)]


def gltf(uri):
    """A moving triangle, as the text of a file; its buffer is `uri` or the file's own."""
    buffer = f'"uri": "{uri}", ' if uri else ""
    accessor = '{"bufferView": %d, "componentType": %d, "count": 3, "type": "%s"}'
    accessors = ", ".join(accessor % of for of in ((0, 5126, "VEC3"), (1, 5123, "SCALAR"),
                                                   (0, 5126, "SCALAR")))
    return ('{"asset": {"version": "2.0"}, "scenes": [{"nodes": [0]}], "nodes": [{"mesh": 0, '
            '"scale": [1, 2, 3], "children": [1]}, {"camera": 0}], "cameras": [{"type": '
            '"perspective", "perspective": {"yfov": 1, "znear": 1}}], "materials": [{"name": "m"}],'
            ' "meshes": [{"primitives": [{"attributes": {"POSITION": 0}, "indices": 1, '
            f'"material": 0}}]}}], "buffers": [{{{buffer}"byteLength": 44}}], "bufferViews": ['
            '{"buffer": 0, "byteLength": 36}, {"buffer": 0, "byteOffset": 36, "byteLength": 6}], '
            f'"accessors": [{accessors}], "animations": [{{"samplers": [{{"input": 2, "output": 0}}'
            '], "channels": [{"sampler": 0, "target": {"node": 0, "path": "translation"}}]}]}')


def glb(buffer):
    text = gltf("").encode()
    text += b" " * (-len(text) % 4)
    chunks = struct.pack("<I", len(text)) + b"JSON" + text
    chunks += struct.pack("<I", len(buffer)) + b"BIN\0" + buffer
    return b"glTF" + struct.pack("<2I", 2, 12 + len(chunks)) + chunks


TRIANGLE = struct.pack("<9f3H2x", 0, 1, 2, 3, 0, 0, 0, 4, 0, 0, 1, 2)
FLAT = b"-Y 1 +X 5\n" + bytes([2, 3, 4, 136, 1, 1, 1, 4])
PLANES = b"+Y 1 +X 8\n" + bytes([2, 2, 0, 8, 136, 7, 136, 6, 4, 1, 2, 3, 4, 132, 9, 136, 136])
MTL = b"newmtl a b\nKd 0.5 0.25 1\nKs 1 1 1\nNs 30\nd 0.5\nillum 7\nNi 1.5\nmap_Kd -s 2 2 t.png\n"

# One triangle by Draco's two methods, and by each of meshoptimizer's codecs; in front of each stands
# what codec_fuzz.cpp asks for.
DRACO = [
    "00"
    "445241434f020201010000000301010100000107ff011101010002ff000000000001000903000002"
    "010202030001010101010003035515ad2a03047081311000000000ff000000000000000000000000"
    "0000000000803f0801010101010917c9311d071d070376e4770100000009000000",
    "00"
    "445241434f0202010000000103010001020102000903000002020300010201000101000303ad2a55"
    "1503a07a81880100000000ff00000000010100040b01400100106ddb060100000009000000000000"
    "0000000000000000000000803f08"]
MESHOPT = ["00a0013c000000080800013c000000080800013c000000080800013c00000008080000000000000000"
           "00000000000000000000000000000000000000010002000300",
           "04e0f0007687566778a9866589689801690000",
           "05d000040400000000"]

def pair(first, second):
    """Two files as one input, see write_pair in fuzz_file.hpp."""
    return struct.pack("<H", len(first)) + first + second


def nhdr():
    head, data = nrrd("raw").split(b"\n\n", 1)
    return pair(head + b"\ndata file: data\n\n", data)


def model(surface, header, arrays):
    """The content of a .vxm of one brick, see model_fuzz.cpp."""
    header = {"format": "voxelume bricks 1", "surface": surface, "size": "8 8 8",
              "origin": "0 0 0", "voxel_edge": "1 1 1", **header}

    def text(of):
        return bytes([len(of)]) + of.encode()
    content = bytes([len(header)]) + b"".join(text(k) + text(v) for k, v in header.items())
    arrays = {"slots": ("I", [0]), "coordinates": ("I", [0]), **arrays}
    content += bytes([len(arrays)])
    for name, (letter, values) in arrays.items():
        content += text(name) + bytes(["BhIQf".index(letter)])
        content += struct.pack(f"<H{len(values)}{letter}", len(values), *values)
    return content


CELLS = range(512)
MODELS = [
    model("cubes", {"set": "solid", "groups": "a\nb\n"},
          {"occupancy": ("Q", [2**64 - 1] * 8), "colors": ("I", [0x10203 * (c % 9) for c in CELLS]),
           "attributes": ("I", [c % 2 for c in CELLS])}),
    model("smooth", {}, {"distance": ("h", [900 * (c % 8) - 3000 for c in CELLS])}),
    model("exact", {}, {"occupancy": ("Q", [255] * 8),
                        "triangles": ("f", [1, 1, 1, 7, 1, 1, 1, 7, 1])}),
]

# Pictures of 5 x 3 pixels: baseline and grey, progressive and coloured.
JPEGS = [base64.b64decode(text) for text in (
    "/9j/4AAQSkZJRgABAQAAAQABAAD/2wBDACgcHiMeGSgjISMtKygwPGRBPDc3PHtYXUlkkYCZlo+AjIqgtObDoKrarY"
    "qMyP/L2u71////m8H////6/+b9//j/wAALCAADAAUBAREA/8QAHwAAAQUBAQEBAQEAAAAAAAAAAAECAwQFBgcICQoL"
    "/8QAtRAAAgEDAwIEAwUFBAQAAAF9AQIDAAQRBRIhMUEGE1FhByJxFDKBkaEII0KxwRVS0fAkM2JyggkKFhcYGRolJi"
    "coKSo0NTY3ODk6Q0RFRkdISUpTVFVWV1hZWmNkZWZnaGlqc3R1dnd4eXqDhIWGh4iJipKTlJWWl5iZmqKjpKWmp6ip"
    "qrKztLW2t7i5usLDxMXGx8jJytLT1NXW19jZ2uHi4+Tl5ufo6erx8vP09fb3+Pn6/9oACAEBAAA/AFkUIwCAKCoOB+"
    "Nf/9k=",
    "/9j/4AAQSkZJRgABAQAAAQABAAD/2wBDACgcHiMeGSgjISMtKygwPGRBPDc3PHtYXUlkkYCZlo+AjIqgtObDoKrarY"
    "qMyP/L2u71////m8H////6/+b9//j/2wBDASstLTw1PHZBQXb4pYyl+Pj4+Pj4+Pj4+Pj4+Pj4+Pj4+Pj4+Pj4+Pj4"
    "+Pj4+Pj4+Pj4+Pj4+Pj4+Pj4+Pj4+Pj/wgARCAADAAUDAREAAhEBAxEB/8QAFAABAAAAAAAAAAAAAAAAAAAAAP/EAB"
    "UBAQEAAAAAAAAAAAAAAAAAAAEC/9oADAMBAAIQAxAAAAE3/8QAFRABAQAAAAAAAAAAAAAAAAAAAAH/2gAIAQEAAQUC"
    "r//EABcRAAMBAAAAAAAAAAAAAAAAAAABAhH/2gAIAQMBAT8BmVh//8QAFhEAAwAAAAAAAAAAAAAAAAAAAAER/9oACA"
    "ECAQE/Aaz/xAAUEAEAAAAAAAAAAAAAAAAAAAAA/9oACAEBAAY/An//xAAXEAADAQAAAAAAAAAAAAAAAAAAASER/9oA"
    "CAEBAAE/IUxyQ//aAAwDAQACAAMAAAAQ/wD/xAAWEQEBAQAAAAAAAAAAAAAAAAABACH/2gAIAQMBAT8Qfov/xAAXEQ"
    "ADAQAAAAAAAAAAAAAAAAAAAREx/9oACAECAQE/ELaz/8QAFxABAAMAAAAAAAAAAAAAAAAAAQARgf/aAAgBAQABPxAC"
    "CBDRs//Z",
)]

SEEDS = {
    "obj": [OBJ, OBJ_DRAWING], "ply": PLYS, "stl": STLS, "glb": [glb(TRIANGLE)],
    "gltf": [gltf("data:application/octet-stream;base64," +
                  base64.b64encode(TRIANGLE).decode()).encode()],
    "npy": [npy(), npy(2), npy(1, ">f2"), npy(1, "|u1")],
    "nrrd": [nrrd("raw"), nrrd("gzip"), nrrd("bzip2"), nrrd("text")],
    "nii": [nii(), gzip.compress(nii(), mtime=0)], "img": [nifti_pair()],
    "qb": [qb(0), qb(1)], "kv6": [kv6()],
    "binvox": [binvox()], "gox": [gox()], "vox": [vox()], "png": [png(5, 3)], "mtl": [MTL],
    "draco": [bytes.fromhex(text) for text in DRACO],
    "meshopt": [bytes.fromhex(text) for text in MESHOPT],
    "nhdr": [nhdr()], "1.png": [png(5, 3)], "hdr": [hdr(FLAT), hdr(PLANES)],
    "jpg": JPEGS, "packed": [b"3 ab/cd/program.bc\nabc0 ab/cd/kernel/0/kernel.so\n"],
    "vxm": MODELS,
    "schem": [schem(), schematic(), litematic(), gzip.compress(schem(), mtime=0)],
}
