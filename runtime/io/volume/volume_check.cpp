// SPDX-License-Identifier: Apache-2.0
#include "runtime/io/volume/volume_check.hpp"

#include "runtime/base/files/file_hash.hpp"
#include "runtime/base/files/stamp.hpp"
#include "runtime/base/json_text.hpp"
#include "runtime/base/text.hpp"
#include "runtime/io/volume/volume_json.hpp"

namespace voxelume {

namespace {

/// The header of data; null for a file that is none.
VolumeJson header_of_data(const VolumePath& path) {
    using enum VolumeFormat;
    for (const VolumeFormat format : {raw, planes, color_planes, rgb332, rgb565})
        if (VolumeJson header = read_header(path, format); !header.empty()) return header;
    return {};
}

/// True if the data have the bytes of an entry from `offset` on.
bool has_bytes(const InputFile& data, uint64_t offset, const VolumeJson& entry) {
    const auto bytes = json_integer<uint64_t>(entry.at("bytes"));
    if (offset > data.size() || bytes > data.size() - offset) return false;
    return entry.at("xxh3_64") == fmt::format("{:016x}", hash_of_bytes(data, offset, bytes));
}

bool is_as_described(const InputFile& data, const VolumeJson& header) {
    if (!header.contains("arrays"))
        return header.at("bytes") == data.size() && has_bytes(data, 0, header);
    uint64_t end = 0;
    for (const VolumeJson& array : header.at("arrays")) {
        if (array.at("offset") != end || !has_bytes(data, end, array)) return false;
        end += json_integer<uint64_t>(array.at("bytes"));
    }
    return end == data.size();
}

}  // namespace

std::optional<bool> is_volume_data_as_written(const VolumePath& path) {
    const bool is_header = ending_of(path) == ".json";
    const VolumePath header_path = is_header ? path : header_path_of(path);
    const VolumeJson header = header_of_data(header_path);
    if (header.empty()) return {};
    if (is_as_written(header_path) == false) return false;
    try {
        const VolumePath name = header.at("data").get<std::string>();
        if (name.has_parent_path() || !name.has_filename() || name == "..") return false;
        const InputFile data(is_header ? header_path.parent_path() / name : path);
        return is_as_described(data, header);
    } catch (const VolumeJson::exception&) {
        return false;
    }
}

}  // namespace voxelume
