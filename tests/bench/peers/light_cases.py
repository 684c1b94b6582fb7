# SPDX-License-Identifier: Apache-2.0
"""Scenes of global light in this program and in Mitsuba, of equal shapes, lights and surfaces.

Paths are scattered 64 times at most in both, and end by chance before, without loss on average."""
import json
import math
import pathlib

import mitsuba_sky
from path_cases import GREY, SKY, Mesh, mesh_case, write_ply
from path_peers import shapes_of
from peer_mitsuba import sensor

BOUNCES = 64
ROUGHNESS = 0.1  # Mitsuba's facets lose light that ours return later: there, little
SCENES = pathlib.Path(__file__).resolve().parents[3] / "scenes"
FLOOR = {"shape": "box", "size": [4, 0.2, 4], "surface": "exact"}


class Scene:
    """`ours` is this program's scene, `theirs` Mitsuba's, whose camera `place` adds."""

    def __init__(self, ours, theirs):
        self.ours = ours
        self.theirs = {"type": "scene", "integrator": {"type": "path", "max_depth": BOUNCES + 1},
                       **theirs}
        ours["render"].update({"light": "global", "bounces": BOUNCES, "filter": "box"})

    def place(self, mi, size):
        """Gives both the same camera for square pictures."""
        observer = self.ours["observer"]
        self.ours["render"]["size"] = [size, size]
        self.theirs["sensor"] = sensor(mi, size, 16, observer["position"], observer["look_at"],
                                       observer["display"]["angle"])


def matt(color):
    return {"type": "diffuse", "reflectance": {"type": "rgb", "value": color}}


def even_sky(color):
    return {"type": "constant", "radiance": {"type": "rgb", "value": color}}


def placed_shapes(mi, ours, surfaces):
    """A scene's boxes and balls in Mitsuba. Materials have the surfaces that are given; others are
    matt."""
    place, shapes = mi.ScalarTransform4f, {}
    for number, item in enumerate(ours["objects"]):
        model = ours["models"][item["model"]]
        if "shape" not in model:
            continue
        psi, theta, gamma = item.get("turn", [0, 0, 0])
        at = place().translate(item["position"]) @ place().rotate([0, 1, 0], psi)
        at = at @ place().rotate([1, 0, 0], theta) @ place().rotate([0, 0, 1], gamma)
        half = [s / 2 for s in model["size"]] if model["shape"] == "box" else [model["radius"]] * 3
        material = item["material"]
        shapes[f"object{number}"] = {
            "type": {"box": "cube", "sphere": "sphere"}[model["shape"]],
            "to_world": at @ place().scale(half),
            "bsdf": surfaces.get(material) or matt(ours["materials"][material]["color"])}
    return shapes


def rectangle_light(mi, light):
    """One of our `lights`, which shines downwards. Nobody sees it, and nothing is hidden by it."""
    place = mi.ScalarTransform4f
    width, height = light["size"]
    radiance = [c * light["intensity"] * math.pi / (width * height) for c in light["color"]]
    at = place().translate(light["position"]) @ place().rotate([1, 0, 0], 90)
    return {"type": "rectangle", "bsdf": {"type": "null"},
            "to_world": at @ place().scale([width / 2, height / 2, 1]),
            "emitter": {"type": "area", "radiance": {"type": "rgb", "value": radiance}}}


def box_mesh(np, half, middle):
    corners = np.array([[x, y, z] for x in (-1, 1) for y in (-1, 1) for z in (-1, 1)])
    quads = np.array([[0, 1, 3, 2], [4, 6, 7, 5], [0, 4, 5, 1], [2, 3, 7, 6], [0, 2, 6, 4],
                      [1, 5, 7, 3]])
    return Mesh(corners * half + middle,
                np.concatenate([quads[:, [0, 1, 2]], quads[:, [0, 2, 3]]]))


def ring_mesh(np, radius, tube, middle):
    """A torus of few faces, whose axis is Z."""
    around, across = 24, 10
    u, v = np.meshgrid(np.arange(around), np.arange(across), indexing="ij")
    a, b = 2 * math.pi * u / around, 2 * math.pi * v / across
    reach = radius + tube * np.cos(b)
    points = np.stack([reach * np.cos(a), reach * np.sin(a), tube * np.sin(b)], axis=-1)

    def number(i, j):
        return ((i % around) * across + j % across).ravel()
    quads = np.stack([number(u, v), number(u + 1, v), number(u + 1, v + 1), number(u, v + 1)],
                     axis=1)
    return Mesh(points.reshape(-1, 3) + middle,
                np.concatenate([quads[:, [0, 1, 2]], quads[:, [0, 2, 3]]]))


def stage(np, folder, glow, emission, materials, objects, sky, color=0.0):
    """A grey floor, `objects` on it and a mesh that glows, which is written into the folder."""
    write_ply(np, folder / "glow.ply", glow)
    return {
        "voxelume": 1,
        "world": {"voxel_size": 0.04, "sky": {"kind": "constant", "color": sky},
                  "bounds": {"min": [-2, -0.2, -2], "max": [2, 2.2, 2]}},
        "materials": {"grey": {"color": [GREY] * 3},
                      "glow": {"color": [color] * 3, "emission": emission}, **materials},
        "models": {"floor": FLOOR, "ball": {"shape": "sphere", "radius": 0.5, "surface": "exact"},
                   "glow": {"mesh": "glow.ply", "surface": "exact", "shading": "flat"}},
        "objects": [{"model": "floor", "material": "grey", "position": [0, -0.1, 0]},
                    {"model": "glow", "material": "glow"}] + objects,
        "observer": {"position": [0.6, 1.5, -3.4], "look_at": [0, 0.55, 0],
                     "display": {"shape": "pyramid", "angle": 34}},
        "render": {},
    }


def staged(mi, folder, ours, surfaces):
    """The stage in Mitsuba."""
    glow = ours["materials"]["glow"]
    return Scene(ours, {
        "sky": even_sky(ours["world"]["sky"]["color"]),
        "glow": {"type": "ply", "filename": str(folder / "glow.ply"), "face_normals": True,
                 "bsdf": matt(glow["color"]),
                 "emitter": {"type": "area",
                             "radiance": {"type": "rgb", "value": glow["emission"]}}},
        **placed_shapes(mi, ours, surfaces)})


def cornell_box(mi, _, __, ___):
    lines = (SCENES / "cornell.json").read_text().splitlines()
    ours = json.loads("\n".join(line for line in lines if not line.startswith("//")))
    del ours["$schema"]
    return Scene(ours, {
        "integrator": {"type": "path", "max_depth": BOUNCES + 2, "hide_emitters": True},
        "light": rectangle_light(mi, ours["lights"][0]), **placed_shapes(mi, ours, {})})


def sky_lit_bunny(mi, np, folder, bunny):
    case = mesh_case(np, folder, bunny)
    del case.ours["lights"]
    return Scene(case.ours, {"sky": even_sky(SKY), **shapes_of(mi, np, case, folder)})


def ball_under_lamp(mi, np, folder, material, surface):
    """A ball of a material on a floor under a lamp, beside a blue ball."""
    ours = stage(np, folder, box_mesh(np, [0.6, 0.03, 0.6], [0, 2.1, 0]), [8, 7, 6],
                 {"ball": material, "blue": {"color": [0.2, 0.4, 0.8]}},
                 [{"model": "ball", "material": "ball", "position": [-0.45, 0.55, 0]},
                  {"model": "ball", "material": "blue", "position": [0.75, 0.55, 0.6]}],
                 [0.2, 0.25, 0.3])
    return staged(mi, folder, ours, {"ball": surface})


def glossy_ball(mi, np, folder, _):
    return ball_under_lamp(
        mi, np, folder, {"base_color": [1, 1, 1], "metallic": 1, "roughness": ROUGHNESS},
        {"type": "roughconductor", "material": "none", "distribution": "ggx",
         "alpha": ROUGHNESS ** 2})


def rough_glass_ball(mi, np, folder, _):
    scene = ball_under_lamp(
        mi, np, folder, {"base_color": [1, 1, 1], "transmission": 1, "roughness": ROUGHNESS},
        {"type": "roughdielectric", "int_ior": 1.5, "ext_ior": 1.0, "distribution": "ggx",
         "alpha": ROUGHNESS ** 2})
    # Mitsuba's chance leaves few of the paths that glass keeps inside, each a thousand times as
    # bright: none ends by chance.
    scene.theirs["integrator"]["rr_depth"] = BOUNCES + 2
    return scene


def emissive_mesh(mi, np, folder, _):
    ours = stage(np, folder, ring_mesh(np, 0.6, 0.2, [0.2, 0.9, 0.5]), [4, 3, 2],
                 {"red": {"color": [0.8, 0.3, 0.2]}},
                 [{"model": "ball", "material": "red", "position": [-0.4, 0.5, -0.2]}],
                 [0.05, 0.07, 0.1], color=0.5)
    return staged(mi, folder, ours, {})


def scattering_ball(mi, np, _, __):
    """A ball of a medium over a floor. Its density is 1 in all voxels whose middles lie in it."""
    radius, height, voxel, cells = 0.6, 0.8, 0.1, 12
    scattering, absorption = [4.5, 4.0, 3.5], [0.5, 1.0, 1.5]
    thick = scattering[0] + absorption[0]
    ours = {
        "voxelume": 1,
        "world": {"voxel_size": voxel, "bounds": {"min": [-2, -0.2, -2], "max": [2, 2.4, 2]},
                  "sky": {"kind": "constant", "color": [0.3, 0.4, 0.5]},
                  "medium": {"scattering": scattering, "absorption": absorption, "anisotropy": 0.5,
                             "density": {"kind": "ball", "center": [0, height, 0],
                                         "radius": radius}}},
        "materials": {"grey": {"color": [GREY] * 3}},
        "models": {"floor": FLOOR},
        "objects": [{"model": "floor", "material": "grey", "position": [0, -0.1, 0]}],
        "lights": [{"type": "rectangle", "position": [0.5, 2.2, 0], "direction": [0, -1, 0],
                    "size": [0.8, 0.8], "color": [1, 0.9, 0.7], "intensity": 2}],
        "observer": {"position": [0.6, 1.5, -3.4], "look_at": [0, 0.55, 0],
                     "display": {"shape": "pyramid", "angle": 34}},
        "render": {},
    }
    middles = (np.arange(cells) + 0.5) * voxel - radius
    z, y, x = np.meshgrid(middles, middles, middles, indexing="ij")
    inside = (x * x + y * y + z * z <= radius * radius).astype(np.float32)
    place = mi.ScalarTransform4f
    low = place().translate([-radius, height - radius, -radius]) @ place().scale(2 * radius)
    medium = {"type": "heterogeneous", "scale": thick,
              "sigma_t": {"type": "gridvolume", "grid": mi.VolumeGrid(inside[..., None]),
                          "filter_type": "nearest", "to_world": low, "raw": True},
              "albedo": {"type": "constvolume",
                         "value": {"type": "rgb", "value": [s / thick for s in scattering]}},
              "phase": {"type": "hg", "g": 0.5}}
    return Scene(ours, {
        "integrator": {"type": "volpath", "max_depth": BOUNCES + 2},
        "sky": even_sky(ours["world"]["sky"]["color"]),
        "light": rectangle_light(mi, ours["lights"][0]),
        "smoke": {"type": "cube", "bsdf": {"type": "null"}, "interior": medium,
                  "to_world": place().translate([0, height, 0]) @ place().scale(radius)},
        **placed_shapes(mi, ours, {})})


def environment_map(mi, np, folder, _):
    mitsuba_sky.write_sky(mi, np, folder)
    theirs = mitsuba_sky.mitsuba_scene(mi, np)
    theirs["integrator"]["max_depth"] = BOUNCES + 1
    return Scene(mitsuba_sky.our_scene(), theirs)


SCENE_MAKERS = {"Cornell box": cornell_box, "sky-lit bunny": sky_lit_bunny,
                "glossy ball": glossy_ball, "rough-glass ball": rough_glass_ball,
                "emissive mesh": emissive_mesh, "scattering ball": scattering_ball,
                "environment map": environment_map}
