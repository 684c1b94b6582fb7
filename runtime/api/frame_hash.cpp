// SPDX-License-Identifier: Apache-2.0
#include "runtime/api/frame_hash.hpp"

#include <fmt/format.h>
#include <xxhash.h>

#include <array>
#include <fstream>
#include <functional>
#include <memory>
#include <vector>

#include "runtime/api/guarded.hpp"
#include "runtime/api/handles.hpp"
#include "runtime/assets/model_cache.hpp"
#include "runtime/base/cache_key.hpp"
#include "runtime/base/disk_cache.hpp"
#include "runtime/base/error.hpp"
#include "runtime/base/stamp.hpp"
#include "runtime/base/version.hpp"
#include "runtime/io/mesh/mesh_reader.hpp"
#include "runtime/scene/scene_animation.hpp"
#include "runtime/voxelume/render.hpp"

namespace voxelume::api {
namespace {

/// Where hashes of files are asked for.
struct FileHashes {
    std::function<void(const std::filesystem::path&)> add_file;
    std::function<void(const std::filesystem::path&)> add_mesh;  ///< with all that it leads to
};

/// Adds the files whose contents a scene shows, at the frame that it is at.
void add_files(const Scene& scene, const FileHashes& hashes) {
    for (const Model& model : scene.models) {
        if (!model.mesh.empty()) hashes.add_mesh(model.mesh);
        if (!model.voxels.empty()) hashes.add_file(model.voxels);
        if (model.morph && !model.morph->mesh.empty()) hashes.add_mesh(model.morph->mesh);
    }
    if (const auto* grid = std::get_if<GridDensity>(&scene.world.medium.density))
        hashes.add_file(grid->file);
}

/// The hash of a mesh's file and of the libraries, textures and buffers that it leads to.
std::string read_mesh_hash(const std::filesystem::path& file) {
    try {
        return mesh_source(read_mesh_bytes(file), file, 0);
    } catch (const Error&) {
        return {};
    }
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
    key.add_all(render.size).add(render.samples).add(int(render.light));
}

void add_options(const v1::ImageFileOptions& options, CacheKey& key) {
    const v1::Channels& c = options.channels;
    key.add(options.exposure).add(options.float_color);
    key.add(c.color).add(c.depth).add(c.position).add(c.normal).add(c.object);
}

}  // namespace

std::string FrameHashes::of(int frame) {
    const Scene& scene = inside(scene_);
    CacheKey key;
    key.add_text(version()).add_text(scene_.implementation().hash);
    add_settings(scene.render, key);
    add_options(options_, key);
    if (moves(scene)) key.add(frame);
    const auto adder = [&](std::string (*read)(const std::filesystem::path&)) {
        return [this, &key, read](const std::filesystem::path& file) {
            const auto [entry, is_new] = files_.try_emplace(file);
            if (is_new) entry->second = read(file);
            key.add_text(entry->second);
        };
    };
    add_files(scene_at(scene, frame), {adder(read_hash), adder(read_mesh_hash)});
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
