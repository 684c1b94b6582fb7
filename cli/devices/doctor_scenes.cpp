// SPDX-License-Identifier: Apache-2.0
// The scenes of the known pictures. Together they launch every kernel that images need.
#include <fmt/format.h>

#include <initializer_list>
#include <iterator>
#include <utility>

#include "cli/devices/doctor_pictures.hpp"

namespace voxelume::cli {
namespace {

// This scene has matt objects with each kind of surface, and nothing that sends rays on.
constexpr const char* kMatt = R"({"voxelume": 1,
"world": {"voxel_size": 0.1, "bounds": {"min": [-1, -1, -1], "max": [1.3, 1.1, 1.2]},
          "ambient": [0.2, 0.1, 0.1], "medium": {"absorption": [0.2, 0.1, 0.3]},
          "sky": {"kind": "gradient", "samples": 2}},
"materials": {"glow": {"emission": [3, 2, 1]}},
"models": {"ball": {"shape": "sphere", "radius": 0.4, "surface": "smooth"},
           "nut": {"shape": "difference", "surface": "smooth", "parts": [
               {"shape": "sphere", "radius": 0.4},
               {"shape": "sphere", "radius": 0.3, "position": [0.1, 0.3, -0.2]}]},
           "egg": {"shape": "sphere", "radius": 0.3, "surface": "exact"},
           "box": {"shape": "box", "size": [0.5, 0.4, 0.3], "surface": "cubes", "set": "solid"}},
"objects": [{"model": "ball", "position": [-0.4, 0.1, 0.2]},
            {"model": "egg", "position": [0.3, -0.3, 0.1]},
            {"model": "box", "position": [0.6, 0.5, 0.4]},
            {"model": "box", "position": [-0.6, -0.7, 0.4], "material": "glow"},
            {"model": "nut", "position": [0.7, -0.6, 0.6], "placement": "instance"}],
"lights": [{"type": "directional", "direction": [1, -1, 1], "group": "key"}],
"observer": {"position": [0.1, 0.3, -3], "look_at": [0, 0, 0],
             "display": {"shape": "pyramid", "angle": 40}},
"render": {"size": [28, 18], "samples": 2, "adaptive": 0.05}})";

// This scene has glass around the observer, mirrors, an emissive object and a light with an area.
constexpr const char* kLocal = R"({"voxelume": 1,
"world": {"voxel_size": 0.1, "bounds": {"min": [-1.5, -1.1, -2.4], "max": [1.5, 1.3, 1.6]},
          "ambient": [0.2, 0.2, 0.2], "medium": {"absorption": [0.1, 0.2, 0.3]}},
"materials": {"glass": {"diffuse": 0.2, "refraction": 0.8, "reflection": 0.2, "fresnel": true,
                        "ior": 1.1, "absorption": [0.1, 0.3, 0.2]},
              "clay": {"color": [0.8, 0.6, 0.4], "checker": {"color": [0.1, 0.2, 0.3], "size": 0.4}},
              "steel": {"diffuse": 0.3, "reflection": 0.6},
              "brass": {"base_color": [0.9, 0.7, 0.3], "metallic": 0.8, "roughness": 0.3},
              "glow": {"emission": [3, 2, 1]}},
"models": {"ball": {"shape": "sphere", "radius": 0.4, "surface": "exact"},
           "lens": {"shape": "sphere", "radius": 0.5, "surface": "smooth"},
           "ice": {"shape": "box", "size": [0.6, 0.5, 0.4], "surface": "cubes", "set": "solid"},
           "floor": {"shape": "box", "size": [2.8, 0.2, 3], "surface": "cubes"}},
"objects": [{"model": "lens", "material": "glass", "position": [0, 0.1, -2]},
            {"model": "ball", "material": "glass", "position": [0.2, 0.1, -0.3]},
            {"model": "ball", "material": "steel", "position": [-0.6, 0.3, 0.5]},
            {"model": "ice", "material": "glass", "position": [-0.8, -0.5, 0.3]},
            {"model": "floor", "material": "clay", "position": [0, -0.9, 0]},
            {"model": "ice", "material": "brass", "position": [0.9, -0.5, 0.9]},
            {"model": "ice", "material": "glow", "position": [0.9, 0.6, 0.4]}],
"lights": [{"type": "disk", "position": [0.5, 2, -1], "direction": [0, -1, 0], "radius": 0.2,
            "intensity": 9, "spots": 2, "group": "key"}],
"observer": {"position": [0, 0.1, -2.1], "look_at": [0, -0.1, 0],
             "display": {"shape": "pyramid", "angle": 60}},
"render": {"size": [28, 18], "samples": 2, "depth": 2, "bounces": 3, "shadow": "filtered",
           "light": "LIGHT"}})";

// These replace the first words of a scene's medium and lights: a medium that scatters light, and a
// light without an area.
constexpr const char* kMist = R"("medium": {"scattering": [0.5, 0.6, 0.7], "anisotropy": 0.3, )";
constexpr const char* kPoint =
    R"("lights": [{"type": "point", "position": [0.3, 0.9, 0.2], "intensity": 0.5}, )";

// These replace the first words of a scene's materials, box and lights: metal, and a light with an
// area that the metal shows.
constexpr const char* kBrass =
    R"("materials": {"brass": {"base_color": [0.9, 0.7, 0.3], "metallic": 1, "roughness": 0.2}, )";
constexpr const char* kBrassBox = R"({"model": "box", "material": "brass", )";
constexpr const char* kDisk = R"("lights": [{"type": "disk", "position": [0.4, 0.8, -0.2],
            "direction": [-0.2, -1, 0.3], "radius": 0.2}, )";

// This scene shows a voxel display that is seen from all sides.
constexpr const char* kLattice = R"({"voxelume": 1,
"world": {"voxel_size": 0.1, "bounds": {"min": [-1, -1, -1], "max": [1, 1, 1]},
          FOG"ambient": [0.3, 0.2, 0.2]},
"materials": {"veil": {"opacity": 0.4}},
"models": {"ball": {"shape": "sphere", "radius": 0.5, "surface": "smooth"},
           "box": {"shape": "box", "size": [0.5, 0.4, 0.3], "surface": "cubes"}},
"objects": [{"model": "ball", "material": "MATERIAL", "position": [-0.2, 0.1, 0.2]},
            {"model": "box", "position": [0.5, -0.4, 0.1]}],
"lights": [{"type": "directional", "direction": [1, -1, 1]}],
"observer": {"position": [0, 0, -1], "look_at": [0, 0, 0],
             "display": {"shape": "box", "size": [1.8, 1.7, 1.9], "voxels": [18, 17, 19],
                         "layout": "LAYOUT", "visibility": "VISIBILITY"}},
"render": {"samples": 2}})";

// This scene has meshes with their own textures, groups and normals, cuts in meshes, and an open
// mesh.
constexpr const char* kMeshes = R"({"voxelume": 1,
"world": {"voxel_size": 0.1, "bounds": {"min": [-1, -1, -1], "max": [1.2, 1, 1]}},
"materials": {"clay": {"color": [0.8, 0.6, 0.4]}, "glow": {"emission": [0.9, 0.4, 0.2]}},
"models": {"tinted": {"mesh": "textured.gltf", "surface": "cubes", "normals": "surface"},
           "sheet": {"mesh": "textured.gltf", "surface": "exact"},
           "notch": {"mesh": "textured.gltf", "surface": "cubes", "normals": "surface",
                     "cut": [{"shape": "sphere", "radius": 0.2}]},
           "bite": {"mesh": "textured.gltf", "surface": "smooth", "voxel_size": 0.05,
                    "cut": [{"shape": "sphere", "radius": 0.2}]},
           "bowl": {"mesh": "open.obj", "surface": "cubes", "set": "solid"},
           "orb": {"shape": "sphere", "radius": 0.3, "surface": "cubes", "normals": "surface"}},
"objects": [{"model": "tinted", "position": [-0.9, 0.2, 0.1]},
            {"model": "sheet", "position": [0.1, 0.3, 0.2], "turn": [30, 20, 0]},
            {"model": "sheet", "position": [-0.2, -0.9, 0.3], "placement": "instance"},
            {"model": "notch", "position": [0.5, -0.3, 0], "turn": [200, 0, 0]},
            {"model": "bite", "material": "glow", "position": [-0.5, -0.6, 0.2]},
            {"model": "bowl", "material": "clay", "position": [0.6, 0.4, 0.1]},
            {"model": "orb", "material": "clay", "position": [0.8, -0.6, 0.4]}],
"lights": [{"type": "directional", "direction": [1, -1, 1], "group": "key"}],
"observer": {"position": [0.1, 0.3, -3], "look_at": [0, 0, 0],
             "display": {"shape": "pyramid", "angle": 40}},
"render": {"size": [28, 18], "samples": 2}})";

// This scene has meshes of which only the tips are triangles: rays from one surface pass the
// other's back.
constexpr const char* kMixed = R"({"voxelume": 1,
"world": {"voxel_size": 0.03, "bounds": {"min": [-0.9, -0.6, -0.5], "max": [0.9, 1, 0.5]},
          "ambient": [0.2, 0.2, 0.3]},
"materials": {"clay": {"color": [0.8, 0.6, 0.4], "diffuse": 0.8, "reflection": 0.2}},
"models": {"drop": {"mesh": "drop.obj", "voxel_size": 0.03}},
"objects": [{"model": "drop", "material": "clay", "position": [-0.45, 0, 0.1]},
            {"model": "drop", "material": "clay", "position": [0.45, 0.3, 0], "turn": [20, 10, 70],
             "placement": "instance"}],
"lights": [{"type": "directional", "direction": [1, -0.4, 1]}],
"observer": {"position": [0.1, 0.9, -3], "look_at": [0, 0.2, 0],
             "display": {"shape": "pyramid", "angle": 36}},
"render": {"size": [36, 28], "depth": 1}})";

// This scene has a block that leaves the bricks in which it was.
constexpr const char* kMotion = R"({"voxelume": 1,
"world": {"voxel_size": 0.1, "bounds": {"min": [-1.6, -1, -1], "max": [4.8, 1, 1]}},
"materials": {"clay": {"color": [0.8, 0.6, 0.4]}},
"models": {"block": {"shape": "box", "size": [0.5, 0.4, 0.3], "surface": "cubes"}},
"objects": [{"model": "block", "position": [-1, 0, 0]},
            {"model": "block", "name": "slider", "position": [0.8, 0, 0], "placement": "world"},
            {"model": "block", "position": [2.4, 0, 0]},
            {"model": "block", "position": [4, 0.3, 0.3]}],
"lights": [{"type": "directional", "direction": [1, -1, 1]}],
"observer": {"position": [1.6, 0.3, -6], "look_at": [1.6, 0, 0],
             "display": {"shape": "pyramid", "angle": 60}},
"animation": {"frames": 2, "tracks": [{"target": "objects.slider.position",
    "keys": [{"frame": 1, "value": [0.8, 0, 0]}, {"frame": 2, "value": [-1, 0, 0.1]}]}]},
"render": {"size": [256, 128], "samples": 2}})";

// This text is inserted in front of an entry of the world.
constexpr const char* kFog = R"("medium": {"absorption": [0.3, 0.2, 0.1],
                                "density": {"kind": "height", "base": 0.1, "scale_height": 0.5}},
          )";

// Half of this tetrahedron has a texture of four half-transparent pixels, which also makes it
// emissive.
constexpr const char* kTextured =
    R"({"asset":{"version":"2.0"},"buffers":[{"byteLength":152,"uri":"data:application/octet-stream;b)"
    R"(ase64,AAAAAAAAAAAAAAAAAAAAPwAAAAAAAAAAAAAAAAAAAD8AAAAAAAAAAAAAAAAAAAA/Os0TvzrNE786zRO/AACAPwAA)"
    R"(AAAAAAAAAAAAAAAAgD8AAAAAAAAAAAAAAAAAAIA/AAAAAAAAAAAAAIA/AAAAAAAAAAAAAIA/AACAPwAAgD8AAAIAAQAAAA)"
    R"(EAAwABAAIAAwACAAAAAwA="}],"bufferViews":[{"buffer":0,"byteOffset":0,"byteLength":48},{"buffer")"
    R"(:0,"byteOffset":48,"byteLength":48},{"buffer":0,"byteOffset":96,"byteLength":32},{"buffer":0,")"
    R"(byteOffset":128,"byteLength":24}],"accessors":[{"bufferView":0,"componentType":5126,"count":4,)"
    R"("type":"VEC3","min":[0,0,0],"max":[0.5,0.5,0.5]},{"bufferView":1,"componentType":5126,"count":)"
    R"(4,"type":"VEC3"},{"bufferView":2,"componentType":5126,"count":4,"type":"VEC2"},{"bufferView":3)"
    R"(,"componentType":5123,"count":6,"type":"SCALAR"},{"bufferView":3,"byteOffset":12,"componentTyp)"
    R"(e":5123,"count":6,"type":"SCALAR"}],"images":[{"uri":"data:image/png;base64,iVBORw0KGgoAAAANSU)"
    R"(hEUgAAAAIAAAACCAYAAABytg0kAAAAG0lEQVR42mM4oaHRoHFC4z+DhsaJ/3fu2DQAAENHCDtARFACAAAAAElFTkSuQmCC)"
    R"("}],"textures":[{"source":0}],"materials":[{"alphaMode":"BLEND","emissiveFactor":[1,1,1],)"
    R"("emissiveTexture":{"index":0},"pbrMetallicRoughness":{"baseColorTexture":{"index":0}}},{"pbrMetallicRoughness":{"baseColorFactor":[0.9,0.6,0.2,1],"metalli)"
    R"(cFactor":0}}],"meshes":[{"primitives":[{"attributes":{"POSITION":0,"NORMAL":1,"TEXCOORD_0":2},)"
    R"("indices":3,"material":0},{"attributes":{"POSITION":0,"NORMAL":1,"TEXCOORD_0":2},"indices":4,")"
    R"(material":1}]}],"nodes":[{"mesh":0}],"scenes":[{"nodes":[0]}]})";

constexpr const char* kOpen = R"(v 0 0 0
v .5 0 0
v 0 .5 0
v 0 0 .5
f 1 3 2
f 1 2 4
f 2 3 4
)";

/// The text of a drop with its tip upwards. It is the same on every machine.
std::string drop() {
    constexpr int kAround = 12;
    constexpr double kHalf = 0.5, kLong = 0.866025,
                     kTurns[] = {1,  kLong,  kHalf,  0, -kHalf, -kLong,
                                 -1, -kLong, -kHalf, 0, kHalf,  kLong};
    constexpr double kRings[][2] = {{0.15, -0.36}, {0.26, -0.25}, {0.3, -0.1},
                                    {0.225, 0.15}, {0.15, 0.4},   {0.075, 0.65}};
    constexpr int kLast = int(std::size(kRings)) - 1;
    std::string text = "v 0 -0.4 0\nv 0 0.9 0\n";
    for (const auto& [radius, y] : kRings)
        for (int i = 0; i < kAround; ++i)
            text += fmt::format("v {:.5f} {:.5f} {:.5f}\n", radius * kTurns[i], y,
                                radius * kTurns[(i + 9) % kAround]);
    const auto at = [](int ring, int i) { return 3 + ring * kAround + i % kAround; };
    for (int i = 0; i < kAround; ++i) {
        text += fmt::format("f 1 {} {}\n", at(0, i), at(0, i + 1));
        for (int ring = 0; ring < kLast; ++ring)
            text += fmt::format("f {} {} {} {}\n", at(ring, i), at(ring + 1, i),
                                at(ring + 1, i + 1), at(ring, i + 1));
        text += fmt::format("f 2 {} {}\n", at(kLast, i + 1), at(kLast, i));
    }
    return text;
}

std::string with(std::string text,
                 std::initializer_list<std::pair<const char*, const char*>> words) {
    for (const auto& [word, value] : words)
        text.replace(text.find(word), std::string_view(word).size(), value);
    return text;
}

/// Returns the first words of a scene's lights, and eighteen lights: surfaces and points of the
/// medium choose among more than eight of a kind.
std::string many_lights() {
    std::string lights = "\"lights\": [";
    for (int i = 0; i < 9; ++i) {
        const int x = 8 * i - 32;
        lights += fmt::format(
            R"({{"type": "point", "position": [{}e-2, 0.9, 0.2], "intensity": 0.05}},
            {{"type": "disk", "position": [{}e-2, 0.8, -0.2], "direction": [0, -1, 0],
              "radius": 0.02, "intensity": 0.1}}, )",
            x, x);
    }
    return lights;
}

std::string lattice(const char* material, const char* layout, const char* visibility,
                    const char* fog) {
    return with(
        kLattice,
        {{"FOG", fog}, {"MATERIAL", material}, {"LAYOUT", layout}, {"VISIBILITY", visibility}});
}

}  // namespace

std::vector<KnownFile> known_files() {
    return {{"textured.gltf", kTextured}, {"open.obj", kOpen}, {"drop.obj", drop()}};
}

std::vector<KnownPicture> known_pictures() {
    return {
        {"matt", kMatt, false, "9ea2d98f96f15dcb"},
        {"local light", with(kLocal, {{"LIGHT", "local"}}), false, "e7caa540c340fb66"},
        {"global light",
         with(kLocal, {{"LIGHT", "global"}, {"\"medium\": {", kMist}, {"\"lights\": [", kPoint}}),
         false, "3e61fa889129ed77"},
        {"many lights",
         with(kLocal, {{"LIGHT", "global"},
                       {"\"shadow\": \"filtered\",", ""},
                       {"\"medium\": {", kMist},
                       {"\"lights\": [", many_lights().c_str()}}),
         false, "7a6fa870e14a0fb1"},
        {"meshes", kMeshes, false, "9bc19e96b72b2350"},
        {"mixed meshes", kMixed, false, "791a11d119da55c7"},
        {"moving block", kMotion, false, "f032b75863aa4f4e"},
        {"display of rays", lattice("veil", "rays", "observer", ""), true, "d1e45f18131b8882"},
        {"clear rays", lattice("default", "rays", "observer", ""), true, "10c69d6634bd4439"},
        {"rays in fog", lattice("default", "rays", "observer", kFog), true, "64f4fababf3ffcce"},
        {"display of voxels", lattice("default", "lattice", "outside", ""), true,
         "0c28be7a202cf243"},
        {"voxels in fog", lattice("veil", "lattice", "outside", kFog), true, "f70ed0e9e9077b6a"},
        {"veiled voxels", lattice("veil", "lattice", "observer", ""), true, "2de843ba4414102e"},
        {"voxels in global light",
         with(lattice("veil", "lattice", "observer", ""),
              {{"\"materials\": {", kBrass},
               {"{\"model\": \"box\", ", kBrassBox},
               {"\"lights\": [", kDisk},
               {"\"samples\": 2", "\"samples\": 2, \"light\": \"global\""}}),
         true, "4b04981855d33620"},
    };
}

}  // namespace voxelume::cli
