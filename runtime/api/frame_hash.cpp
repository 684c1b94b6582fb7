// SPDX-License-Identifier: Apache-2.0
#include "runtime/api/frame_hash.hpp"

#include <fmt/format.h>
#include <xxhash.h>

#include <array>
#include <fstream>
#include <memory>
#include <vector>

#include "runtime/api/guarded.hpp"
#include "runtime/api/handles.hpp"
#include "runtime/base/cache_key.hpp"
#include "runtime/base/disk_cache.hpp"
#include "runtime/base/stamp.hpp"
#include "runtime/base/version.hpp"
#include "runtime/scene/scene_animation.hpp"
#include "runtime/voxelume/render.hpp"

namespace voxelume::api {
namespace {

/// The files whose contents a scene shows, at the frame that it is at.
std::vector<std::filesystem::path> files_of(const Scene& scene) {
    std::vector<std::filesystem::path> files;
    const auto add = [&files](const std::filesystem::path& file) {
        if (!file.empty()) files.push_back(file);
    };
    for (const Model& model : scene.models) {
        add(model.mesh);
        add(model.voxels);
        if (model.morph) add(model.morph->mesh);
    }
    if (const auto* grid = std::get_if<GridDensity>(&scene.world.medium.density)) add(grid->file);
    return files;
}

/// Empty for a file that can't be read: rendering says why.
std::string read_hash(const std::filesystem::path& file) {
    const std::unique_ptr<XXH3_state_t, decltype(&XXH3_freeState)> state(XXH3_createState(),
                                                                         &XXH3_freeState);
    XXH3_128bits_reset(state.get());
    std::ifstream stream(file, std::ios::binary);
    if (!stream) return {};
    std::vector<char> block(size_t{1} << 20);
    while (stream.read(block.data(), std::streamsize(block.size())) || stream.gcount() > 0)
        XXH3_128bits_update(state.get(), block.data(), size_t(stream.gcount()));
    if (stream.bad()) return {};
    const XXH128_hash_t hash = XXH3_128bits_digest(state.get());
    return fmt::format("{:016x}{:016x}", hash.high64, hash.low64);
}

void add_settings(const RenderSettings& render, CacheKey& key) {
    key.add_all(render.size).add_all(render.crop.first).add_all(render.crop.frame);
    key.add(render.samples);
}

void add_options(const v1::ImageFileOptions& options, CacheKey& key) {
    const v1::Channels& c = options.channels;
    key.add(options.exposure).add(options.float_color);
    key.add(c.color).add(c.depth).add(c.position).add(c.normal).add(c.object);
}

}  // namespace

const std::string& FrameHashes::hash_of_file(const std::filesystem::path& file) {
    const auto [entry, is_new] = files_.try_emplace(file);
    if (is_new) entry->second = read_hash(file);
    return entry->second;
}

std::string FrameHashes::of(int frame) {
    const Scene& scene = inside(scene_);
    CacheKey key;
    key.add_text(version()).add_text(scene_.implementation().hash);
    add_settings(scene.render, key);
    add_options(options_, key);
    if (moves(scene)) key.add(frame);
    for (const std::filesystem::path& file : files_of(scene_at(scene, frame)))
        key.add_text(hash_of_file(file));
    const std::array<std::string_view, 1> parts = {key.bytes()};
    return cache_key(parts);
}

}  // namespace voxelume::api

namespace voxelume::v1 {

std::vector<std::string> frame_hashes(const Scene& scene, const std::vector<int>& frames,
                                      const ImageFileOptions& options) {
    return api::guarded([&] {
        api::FrameHashes hashes(scene, options);
        std::vector<std::string> list;
        list.reserve(frames.size());
        for (const int frame : frames) list.push_back(hashes.of(frame));
        return list;
    });
}

FrameFileState check_frame_file(const std::filesystem::path& file, std::string_view hash) {
    return api::guarded([&] { return static_cast<FrameFileState>(check_stamp(file, hash)); });
}

}  // namespace voxelume::v1
