// SPDX-License-Identifier: Apache-2.0
#include "cli/doctor_pictures.hpp"

#include <fmt/format.h>
#include <xxhash.h>

#include <memory>
#include <span>
#include <utility>

namespace voxelume::cli {
namespace {

// Matt objects of each surface, without anything that sends rays on.
constexpr const char* kMatt = R"({"voxelume": 1,
"world": {"voxel_size": 0.1, "bounds": {"min": [-1, -1, -1], "max": [1.3, 1.1, 1.2]},
          "ambient": [0.2, 0.1, 0.1], "medium": {"absorption": [0.2, 0.1, 0.3]},
          "sky": {"kind": "gradient", "samples": 2}},
"materials": {"glow": {"emission": [3, 2, 1]}},
"models": {"ball": {"shape": "sphere", "radius": 0.4, "surface": "smooth"},
           "egg": {"shape": "sphere", "radius": 0.3, "surface": "exact"},
           "box": {"shape": "box", "size": [0.5, 0.4, 0.3], "surface": "cubes", "set": "solid"}},
"objects": [{"model": "ball", "position": [-0.4, 0.1, 0.2]},
            {"model": "egg", "position": [0.3, -0.3, 0.1]},
            {"model": "box", "position": [0.6, 0.5, 0.4]},
            {"model": "box", "position": [-0.6, -0.7, 0.4], "material": "glow"},
            {"model": "ball", "position": [0.7, -0.6, 0.6], "placement": "instance"}],
"lights": [{"type": "directional", "direction": [1, -1, 1], "group": "key"}],
"observer": {"position": [0.1, 0.3, -3], "look_at": [0, 0, 0],
             "display": {"shape": "pyramid", "angle": 40}},
"render": {"size": [28, 18], "samples": 2}})";

// Glass around the observer, mirrors, a lamp and a light with an area.
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

// What a display of voxels shows from all around.
constexpr const char* kLattice = R"({"voxelume": 1,
"world": {"voxel_size": 0.1, "bounds": {"min": [-1, -1, -1], "max": [1, 1, 1]},
          "ambient": [0.3, 0.2, 0.2]},
"materials": {"veil": {"opacity": 0.4}},
"models": {"ball": {"shape": "sphere", "radius": 0.5, "surface": "smooth"},
           "box": {"shape": "box", "size": [0.5, 0.4, 0.3], "surface": "cubes"}},
"objects": [{"model": "ball", "material": "MATERIAL", "position": [-0.2, 0.1, 0.2]},
            {"model": "box", "position": [0.5, -0.4, 0.1]}],
"lights": [{"type": "directional", "direction": [1, -1, 1]}],
"observer": {"position": [0, 0, -1], "look_at": [0, 0, 0],
             "display": {"shape": "box", "size": [1.8, 1.7, 1.9], "voxels": [18, 17, 19],
                         "layout": "LAYOUT", "visibility": "VISIBILITY"}}})";

std::string with(std::string text,
                 std::initializer_list<std::pair<const char*, const char*>> words) {
    for (const auto& [word, value] : words)
        text.replace(text.find(word), std::string_view(word).size(), value);
    return text;
}

class Hasher {
  public:
    Hasher() : state_(XXH3_createState(), &XXH3_freeState) { XXH3_64bits_reset(state_.get()); }

    template <class Value>
    void add(std::span<const Value> values) {
        XXH3_64bits_update(state_.get(), values.data(), values.size_bytes());
    }
    std::string digits() const { return fmt::format("{:016x}", XXH3_64bits_digest(state_.get())); }

  private:
    std::unique_ptr<XXH3_state_t, decltype(&XXH3_freeState)> state_;
};

std::string hash_of(const Image& image) {
    Hasher hasher;
    for (const std::string& channel : image.channels()) hasher.add(image.plane(channel));
    hasher.add(image.object_ids());
    hasher.add(image.material_ids());
    return hasher.digits();
}

std::string hash_of(const Volume& volume) {
    Hasher hasher;
    hasher.add(volume.indices());
    hasher.add(volume.colors());
    hasher.add(volume.opacities());
    hasher.add(volume.depths());
    hasher.add(volume.object_ids());
    return hasher.digits();
}

/// Each channel, but for what moves.
Channels all_channels() {
    Channels channels = kNoChannels;
    for (const ChannelRow& row : channel_table()) channels.*row.member = true;
    channels.motion = false;
    return channels;
}

}  // namespace

std::vector<KnownPicture> known_pictures() {
    return {
        {"matt", kMatt, false, "ad9720e7ffb503cf"},
        {"local light", with(kLocal, {{"LIGHT", "local"}}), false, "5177d8b338a1e18f"},
        {"global light", with(kLocal, {{"LIGHT", "global"}}), false, "1580ec99b3ef267d"},
        {"display of rays",
         with(kLattice, {{"MATERIAL", "veil"}, {"LAYOUT", "rays"}, {"VISIBILITY", "observer"}}),
         true, "d1e45f18131b8882"},
        {"display of voxels",
         with(kLattice,
              {{"MATERIAL", "default"}, {"LAYOUT", "lattice"}, {"VISIBILITY", "outside"}}),
         true, "cc4a0bcaa963c2f4"},
    };
}

PictureResult render_known(const KnownPicture& picture, const Device& device,
                           std::map<std::string, uint64_t>& launches) {
    const Scene scene = Scene::parse(picture.scene, std::string(picture.name));
    RenderOptions options;
    options.channels = all_channels();
    options.cache.enabled = false;
    Statistics statistics;
    PictureResult result;
    result.hash = picture.is_volume
                      ? hash_of(render_volume(scene, {device}, 1, options, &statistics))
                      : hash_of(render_image(scene, {device}, 1, options, &statistics));
    for (const auto& [kernel, count] : statistics.launches)
        if (count > std::exchange(launches[kernel], count)) result.kernels.push_back(kernel);
    return result;
}

}  // namespace voxelume::cli
