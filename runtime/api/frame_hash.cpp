// SPDX-License-Identifier: Apache-2.0
#include "runtime/api/frame_hash.hpp"

#include <algorithm>
#include <array>
#include <functional>
#include <vector>

#include "runtime/api/border/guarded.hpp"
#include "runtime/api/border/handles.hpp"
#include "runtime/api/image_files.hpp"
#include "runtime/assets/model_cache.hpp"
#include "runtime/base/error.hpp"
#include "runtime/base/files/cache_key.hpp"
#include "runtime/base/files/disk_cache.hpp"
#include "runtime/base/files/file_hash.hpp"
#include "runtime/base/files/stamp.hpp"
#include "runtime/base/text.hpp"
#include "runtime/base/version.hpp"
#include "runtime/io/mesh/mesh_reader.hpp"
#include "runtime/io/voxel_file_table.hpp"
#include "runtime/scene/scene_animation.hpp"
#include "runtime/scene/scene_motion.hpp"
#include "runtime/scene/shutter.hpp"
#include "runtime/voxelume/files.hpp"
#include "runtime/voxelume/render.hpp"

namespace voxelume::api {
namespace {

/// The functions that add the hashes of files.
struct FileHashes {
    std::function<void(const std::filesystem::path&)> add_mesh;    ///< with its companion files
    std::function<void(const std::filesystem::path&)> add_voxels;  ///< with its companion files
    std::function<void(const Model&)> add_given;                   ///< voxels in memory
};

/// Adds the files whose contents a scene shows, at the frame that it is at.
void add_files(const Scene& scene, const FileHashes& hashes) {
    for (const Model& model : scene.models) {
        if (!model.mesh.empty()) hashes.add_mesh(model.mesh);
        if (model.given)
            hashes.add_given(model);
        else if (!model.voxels.empty())
            hashes.add_voxels(model.voxels);
        if (model.morph && !model.morph->mesh.empty()) hashes.add_mesh(model.morph->mesh);
    }
    if (const auto* grid = std::get_if<GridDensity>(&scene.world.medium.density)) {
        hashes.add_voxels(grid->file);
        for (const GridDensity& other : grid->others) hashes.add_voxels(other.file);
    }
    if (scene.world.sky && !scene.world.sky->file.empty()) hashes.add_voxels(scene.world.sky->file);
}

/// True if some file may be replaced by another one at other moments.
bool files_change(const Scene& scene) {
    return any_part_changes(scene, [](const MovingPart& part) {
        return !part.sequences.empty() || std::ranges::any_of(part.tracks, [](const Track& track) {
            return !track.files.empty();
        });
    });
}

/// The hash of a mesh's file and of the libraries, textures and buffers that it leads to; empty for
/// a file that can't be read, for which rendering reports the reason.
std::string read_mesh_hash(const std::filesystem::path& file) {
    try {
        return mesh_source(read_mesh_bytes(file), file);
    } catch (const Error&) {
        return {};
    }
}

/// The hash of a file of voxels, and of the file that has its values.
std::string read_voxels_hash(const std::filesystem::path& file) {
    std::string hash = hash_of_file(file);
    try {
        const VoxelFileFormat* format = voxel_file_format(file);
        if (!format || !format->array) return hash;
        const CellArray array = format->array(file);
        for (const std::filesystem::path& other : {array.header, array.data})
            if (!other.empty() && other != file) hash += hash_of_file(other);
        for (size_t slice = 1; slice < array.slices.size(); ++slice)
            hash += hash_of_file(array.slices[slice]);
    } catch (const Error&) {
        return hash;
    }
    return hash;
}

template <class Value>
std::string_view bytes_of(const std::vector<Value>& values) {
    return {reinterpret_cast<const char*>(values.data()), sizeof(Value) * values.size()};
}

/// The hash of voxels in memory.
std::string hash_of_voxels(const VoxelModel& voxels) {
    CacheKey key;
    key.add_all(voxels.frame.size);
    const std::array<std::string_view, 4> parts = {
        key.bytes(), bytes_of(voxels.slots), bytes_of(voxels.occupancy), bytes_of(voxels.colors)};
    return cache_key(parts);
}

void add_settings(const RenderSettings& render, CacheKey& key) {
    key.add_all(render.size).add_all(render.crop.first).add_all(render.crop.frame);
    key.add(render.samples).add(int(render.light));
    if (render.noise.is_given()) key.add(render.noise.error).add(render.noise.seconds);
}

/// The settings of the whole picture that a crop is a part of.
RenderSettings without_crop(RenderSettings render) {
    if (render.crop.frame.x > 0) render.size = render.crop.frame;
    render.crop = {};
    return render;
}

}  // namespace

std::string FrameHashes::hash(int frame, bool is_of_volume) {
    const Scene& scene = inside(scene_);
    CacheKey key;
    key.add_text(version()).add_text(scene_.implementation().hash);
    add_settings(is_of_volume ? without_crop(scene.render) : scene.render, key);
    if (moves(scene)) key.add(frame);
    const auto adder = [&](std::string (*read)(const std::filesystem::path&)) {
        return [this, &key, read](const std::filesystem::path& file) {
            const auto [entry, is_new] = files_.try_emplace(file);
            if (is_new) entry->second = read(file);
            key.add_text(entry->second);
        };
    };
    const auto add_given = [&](const Model& model) {
        const auto [entry, is_new] = files_.try_emplace(model.voxels);
        if (is_new) entry->second = hash_of_voxels(*model.given);
        key.add_text(entry->second);
    };
    const FileHashes hashes{adder(read_mesh_hash), adder(read_voxels_hash), add_given};
    const bool shows_moments = !is_of_volume && files_change(scene);
    for (const double moment :
         shows_moments ? moments_of(scene, frame) : std::vector{double(frame)})
        add_files(scene_at(scene, moment), hashes);
    const std::array<std::string_view, 1> parts = {key.bytes()};
    return cache_key(parts);
}

std::string hash_for_image(const std::string& hash, const ImageFormatEntry& format,
                           const v1::ImageFileOptions& options) {
    CacheKey key;
    key.add_text(hash);
    const v1::Channels& c = options.channels;
    if (!format.holds_channels) {
        key.add(options.exposure).add(int(options.view_transform)).add(options.png_bits);
    } else {
        key.add(options.float_color);
        if (options.multi_part) key.add_text("multi-part");
        for (const v1::ChannelRow& row : v1::channel_table())
            if (c.*row.member) key.add_text(row.name);
    }
    const std::array<std::string_view, 2> parts = {format.ending, key.bytes()};
    return cache_key(parts);
}

}  // namespace voxelume::api

namespace voxelume::v1 {
namespace {

std::vector<std::string> hashes_of(const Scene& scene, const std::vector<int>& frames,
                                   std::string (api::FrameHashes::*hash)(int frame)) {
    return api::guarded([&] {
        api::FrameHashes hashes(scene);
        std::vector<std::string> list;
        list.reserve(frames.size());
        for (const int frame : frames) list.push_back((hashes.*hash)(frame));
        return list;
    });
}

}  // namespace

std::vector<std::string> frame_hashes(const Scene& scene, const std::vector<int>& frames) {
    return hashes_of(scene, frames, &api::FrameHashes::of);
}

std::vector<std::string> volume_hashes(const Scene& scene, const std::vector<int>& frames) {
    return hashes_of(scene, frames, &api::FrameHashes::of_volume);
}

FrameFileState image_file_state(const std::filesystem::path& file, const std::string& hash,
                                const ImageFileOptions& options) {
    return api::guarded([&] {
        const std::string own = api::hash_for_image(hash, api::format_of_image(file), options);
        return static_cast<FrameFileState>(check_stamp(file, own));
    });
}

std::string hash_of_file(const std::filesystem::path& file) {
    return api::guarded([&] { return voxelume::hash_of_file(file); });
}

FrameFileState volume_file_state(const std::filesystem::path& file, const std::string& hash) {
    return api::guarded([&] { return static_cast<FrameFileState>(check_stamp(file, hash)); });
}

}  // namespace voxelume::v1
