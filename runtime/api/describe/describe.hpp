// SPDX-License-Identifier: Apache-2.0
// What is in a file, as JSON values: one function for each kind of file.
#pragma once

#include <filesystem>
#include <nlohmann/json.hpp>

#include "runtime/io/voxel_file_table.hpp"
#include "runtime/scene/scene.hpp"

namespace voxelume::api {

using Report = nlohmann::ordered_json;

/// The content of a mesh file, and the number of voxels that it would become.
Report describe_mesh(const std::filesystem::path& path);

/// A volumetric image: a deep OpenEXR, OpenVDB or NRRD file, or a JSON header of voxelume. `kind`
/// opens the report.
Report describe_volume(const std::filesystem::path& path, const char* kind);

/// A JSON file that isn't a scene: the header that accompanies a raw file or a display's own, or
/// the statistics of a run.
Report describe_json(const std::filesystem::path& path);

/// The statistics of a run: where it ran, and what it took.
Report describe_statistics(const Report& statistics);

/// A page that shows a volumetric image in a browser.
Report describe_page(const std::filesystem::path& path);

/// The header of a KV6 model.
Report describe_kv6(const std::filesystem::path& path);

/// Models, objects, materials and palette of a MagicaVoxel file, and what of it isn't shown.
Report describe_vox(const std::filesystem::path& path);

/// The size, voxels and colours of a file of a voxel editor or game, and what of it isn't shown.
Report describe_art(const std::filesystem::path& path, const VoxelFileFormat& format);

/// The placement, values or labels of an array, and what is assumed where the file doesn't say it.
Report describe_array(const std::filesystem::path& path, const VoxelFileFormat& format);

/// True if a file is to be read as a scene: it has a scene's keys, or it isn't JSON; then reading
/// it as a scene reports the line.
bool is_scene(const std::filesystem::path& path);

/// The picture, world, observer, models, objects and lights of a scene's first frame.
Report describe_scene(const Scene& scene);

}  // namespace voxelume::api
