// SPDX-License-Identifier: Apache-2.0
#include "runtime/io/volume/volume_json.hpp"

#include <system_error>

#include "runtime/base/error.hpp"
#include "runtime/base/files/atomic_file.hpp"
#include "runtime/base/files/input_file.hpp"
#include "runtime/base/json_text.hpp"
#include "runtime/base/text.hpp"
#include "runtime/image/volume_geometry.hpp"
#include "runtime/io/volume/volume_frame_text.hpp"

namespace voxelume {

namespace {

/// The maximum size of a header. Headers are much shorter; scenes may be longer.
constexpr uint64_t kMaxHeaderBytes = 1 << 20;

}  // namespace

VolumeJson read_header(const VolumePath& header, VolumeFormat format) {
    VolumeJson json;
    try {
        json = parse_json_text<VolumeJson>(InputFile(header).read_all(kMaxHeaderBytes));
    } catch (const Error&) {
        return {};
    }
    const bool is_one = json.is_object() && json.contains("voxelume_volume") &&
                        json.value("format", VolumeJson()) == volume_format_name(format);
    return is_one ? json : VolumeJson();
}

VolumePath header_path_of(const VolumePath& data) {
    VolumePath header = data;
    if (ending_of(data) == ".raw") return header.replace_extension(".json");
    return header += ".json";
}

void check_header(const VolumePath& header, VolumeFormat format) {
    std::error_code failed;
    if (!std::filesystem::is_regular_file(header, failed) || !read_header(header, format).empty())
        return;
    throw Error(ErrorKind::output,
                "{}: a header of format {} would go there, and this file isn't one; choose another "
                "name",
                header.string(), volume_format_name(format));
}

VolumeJson start_header(const VolumePath& data, const Volume& volume, VolumeFormat format) {
    const VolumeFrame& frame = volume.frame;
    VolumeJson header = {{"voxelume_volume", 1},
                         {"format", volume_format_name(format)},
                         {"data", data.filename().string()},
                         {"byte_order", "little"}};
    VolumeJson matrix = nullptr;
    if (const auto world = world_from_voxels(frame)) {
        matrix = VolumeJson::array();
        for (int row = 0; row < 4; ++row)
            matrix.push_back(
                {(*world)[0][row], (*world)[1][row], (*world)[2][row], (*world)[3][row]});
    }
    header["units"] = {{"length", "metre"}, {"angle", "radian"}};
    header["world_from_voxels"] = matrix;
    header[kFrameKey] = parse_json_text<VolumeJson>(write_frame_text(frame));
    header["attributes"] = volume.attributes;
    return header;
}

void write_json(const VolumePath& path, const VolumeJson& json) {
    AtomicFile file(path);
    std::string text;
    try {
        text = json.dump(2) + "\n";
    } catch (const VolumeJson::type_error& error) {
        file.fail(fmt::format("a text isn't UTF-8: {}", error.what()));
    }
    file.write(text.data(), text.size());
    file.commit();
}

}  // namespace voxelume
