// SPDX-License-Identifier: Apache-2.0
// Volumetric image -> dense arrays in one .raw file, and a .json that describes them.
#include <xxhash.h>

#include <algorithm>
#include <array>
#include <memory>

#include "runtime/base/files/atomic_file.hpp"
#include "runtime/base/text.hpp"
#include "runtime/image/volume_geometry.hpp"
#include "runtime/io/volume/volume_json.hpp"
#include "runtime/io/volume/volume_rows.hpp"

namespace voxelume {

namespace {

/// Writes one array row by row. `fill(row, column, i)` stores the i-th listed voxel's values at
/// `column` of `row`.
template <class Value, class Fill>
VolumeJson write_array(AtomicFile& file, const Volume& volume, const char* name, const char* type,
                       size_t components, Fill fill) {
    const uint64_t offset = file.position();
    const glm::ivec3& size = volume.frame.size;
    std::vector<Value> row(components * size_t(size.x));
    const std::unique_ptr<XXH3_state_t, decltype(&XXH3_freeState)> state(XXH3_createState(),
                                                                         XXH3_freeState);
    XXH3_64bits_reset(state.get());
    VolumeRows rows(volume);
    for (uint64_t r = 0; r < uint64_t(size.y) * uint64_t(size.z); ++r) {
        std::ranges::fill(row, Value(0));
        const auto [first, last] = rows.next();
        for (size_t i = first; i < last; ++i) fill(&row[components * rows.column(i)], i);
        XXH3_64bits_update(state.get(), row.data(), row.size() * sizeof(Value));
        file.write(row.data(), row.size() * sizeof(Value));
    }
    const std::string checksum = fmt::format("{:016x}", XXH3_64bits_digest(state.get()));
    return {{"name", name},
            {"type", type},
            {"components", components},
            {"offset", offset},
            {"bytes", file.position() - offset},
            {"xxh3_64", checksum}};
}

VolumeJson write_arrays(AtomicFile& file, const Volume& volume) {
    VolumeJson arrays = VolumeJson::array();
    arrays.push_back(
        write_array<float>(file, volume, "rgba", "float32", 4, [&](float* values, size_t i) {
            const glm::vec3& color = volume.colors[i];
            const std::array<float, 4> rgba = {color.r, color.g, color.b, volume.opacities[i]};
            std::ranges::copy(rgba, values);
        }));
    arrays.push_back(
        write_array<float>(file, volume, "depth", "float32", 1,
                           [&](float* value, size_t i) { *value = volume.depths[i]; }));
    arrays.push_back(
        write_array<uint32_t>(file, volume, "object", "uint32", 1,
                              [&](uint32_t* value, size_t i) { *value = volume.objects[i]; }));
    arrays.push_back(write_array<uint8_t>(
        file, volume, "kind", "uint8", 1,
        [&](uint8_t* value, size_t i) { *value = uint8_t(uint8_t(volume.kinds[i]) + 1); }));
    return arrays;
}

VolumePath data_path_of(const VolumePath& path) {
    return ending_of(path) == ".json" ? VolumePath(path).replace_extension(".raw") : path;
}

}  // namespace

std::vector<VolumePath> raw_files_of(const VolumePath& path) {
    const VolumePath data = data_path_of(path);
    return {data, header_path_of(data)};
}

void write_volume_raw(const VolumePath& path, const Volume& volume) {
    const VolumePath data = data_path_of(path);
    AtomicFile file(data);
    VolumeJson header = start_header(data, volume, VolumeFormat::raw);
    const glm::ivec3& size = volume.frame.size;
    const bool rays = volume.frame.layout == VolumeLayout::rays;
    header["shape"] = {size.x, size.y, size.z};
    header["axes"] = rays ? VolumeJson{"u", "v", "k"} : VolumeJson{"x", "y", "z"};
    header["axis_order"] = "components fastest, then the axes in their order, the first fastest";
    header["color"] = "linear Rec. 709, not multiplied by opacity";
    header["kinds"] = {"nothing", "space", "object", "unseen"};
    header["voxels"] = volume.indices.size();
    header["arrays"] = write_arrays(file, volume);
    file.commit();
    write_json(header_path_of(data), header);
}

}  // namespace voxelume
