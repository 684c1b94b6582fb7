// SPDX-License-Identifier: Apache-2.0
// NRRD of voxelume -> volumetric image.
#include <zlib.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <map>

#include "runtime/base/files/input_file.hpp"
#include "runtime/image/volume_geometry.hpp"
#include "runtime/io/volume/volume_formats.hpp"
#include "runtime/io/volume/volume_frame_text.hpp"

namespace voxelume {

namespace {

struct NrrdHeader {
    std::map<std::string, std::string> fields, keys;
    uint64_t data_start = 0;
};

std::string unescape(std::string_view text) {
    std::string plain;
    for (size_t i = 0; i < text.size(); ++i) {
        const bool is_escape = text[i] == '\\' && i + 1 < text.size();
        plain += !is_escape ? text[i] : text[++i] == 'n' ? '\n' : text[i];
    }
    return plain;
}

NrrdHeader read_header(const InputFile& file) {
    constexpr uint64_t kLongestHeader = uint64_t{1} << 20;
    std::string start(std::min(file.size(), kLongestHeader), '\0');
    file.read(0, start.data(), start.size());
    if (!start.starts_with("NRRD000")) file.refuse("not a NRRD file");
    const size_t end = start.find("\n\n");
    if (end == std::string::npos) file.refuse("its header has no end; it is truncated");
    NrrdHeader header;
    header.data_start = end + 2;
    for (size_t line = start.find('\n') + 1; line <= end;) {
        const size_t line_end = start.find('\n', line);
        const std::string_view text(start.data() + line, line_end - line);
        line = line_end + 1;
        if (text.empty() || text[0] == '#') continue;
        const size_t colon = text.find(':');
        if (colon == std::string::npos || colon + 2 > text.size())
            file.refuse("a line of its header has no value");
        const std::string name(text.substr(0, colon));
        (text[colon + 1] == '=' ? header.keys : header.fields)[name] =
            unescape(text.substr(colon + 2));
    }
    return header;
}

/// Returns the array's floats piece by piece.
class NrrdData {
  public:
    NrrdData(const InputFile& file, uint64_t start, bool compressed)
        : file_(file), position_(start), compressed_(compressed), block_(1 << 16) {
        constexpr int kGzip = 15 + 16;
        if (compressed && inflateInit2(&stream_, kGzip) != Z_OK) file.refuse("zlib doesn't start");
    }
    ~NrrdData() {
        if (compressed_) inflateEnd(&stream_);
    }
    NrrdData(const NrrdData&) = delete;
    NrrdData& operator=(const NrrdData&) = delete;

    void read(std::vector<float>& values) {
        const size_t size = values.size() * sizeof values[0];
        if (compressed_) {
            inflate_into(values.data(), size);
        } else {
            file_.read(position_, values.data(), size);
            position_ += size;
        }
    }

    /// Refuses a file whose array isn't its whole rest. Reading to the end also verifies gzip's
    /// checksum.
    void expect_end() {
        if (compressed_) {
            char beyond = 0;
            stream_.next_out = reinterpret_cast<Bytef*>(&beyond);
            stream_.avail_out = 1;
            int code = Z_OK;
            while (!ended_ && code == Z_OK && stream_.avail_out == 1) code = inflate_block();
            if (!ended_ || stream_.avail_out != 1 || stream_.avail_in > 0 ||
                position_ != file_.size())
                file_.refuse("its data don't end where they should; it is damaged");
        } else if (position_ != file_.size()) {
            file_.refuse("it has more data than its sizes say; it is damaged");
        }
    }

  private:
    int inflate_block() {
        if (stream_.avail_in == 0) {
            const size_t size = std::min<uint64_t>(block_.size(), file_.size() - position_);
            if (size == 0) file_.refuse("its data end too early; it is truncated");
            file_.read(position_, block_.data(), size);
            position_ += size;
            stream_.next_in = block_.data();
            stream_.avail_in = static_cast<uInt>(size);
        }
        const int code = inflate(&stream_, Z_NO_FLUSH);
        ended_ = code == Z_STREAM_END;
        return code;
    }
    void inflate_into(void* data, size_t size) {
        stream_.next_out = static_cast<Bytef*>(data);
        stream_.avail_out = static_cast<uInt>(size);
        while (stream_.avail_out > 0) {
            const int code = inflate_block();
            if (code != Z_OK && !(code == Z_STREAM_END && stream_.avail_out == 0))
                file_.refuse("its compressed data are damaged");
        }
    }

    const InputFile& file_;
    uint64_t position_;
    bool compressed_, ended_ = false;
    z_stream stream_{};
    std::vector<Bytef> block_;
};

/// The number of values a voxel, 4 or 7. The file's sizes have to agree with the frame's.
size_t take_channels(const InputFile& file, NrrdHeader& header, const VolumeFrame& frame) {
    const glm::ivec3& size = frame.size;
    for (const size_t channels : {size_t{4}, size_t{7}})
        if (header.fields["sizes"] == fmt::format("{} {} {} {}", channels, size.x, size.y, size.z))
            return channels;
    file.refuse("its sizes aren't the display's");
}

bool take_compression(const InputFile& file, NrrdHeader& header, uint64_t bytes) {
    const std::string encoding = header.fields["encoding"];
    if ((encoding != "raw" && encoding != "gzip") || header.fields["type"] != "float" ||
        header.fields["endian"] != "little")
        file.refuse("it isn't encoded as voxelume does it");
    const uint64_t stored = file.size() - header.data_start;
    if (encoding == "raw") {
        if (stored != bytes) file.refuse("it hasn't as much data as its sizes say; it is damaged");
        return false;
    }
    constexpr uint64_t kMaxDeflated = 1032;
    if (bytes / kMaxDeflated > stored)
        file.refuse("it is far too small for its sizes; it is damaged");
    return true;
}

/// Fills in depth and kind, which RGBA alone doesn't have: the depth is the voxel's middle, and an
/// opaque voxel is taken for an object.
void complete(Volume& volume) {
    const glm::dmat4 observer_from_world = glm::inverse(volume.frame.world_from_observer);
    for (size_t i = 0; i < volume.indices.size(); ++i) {
        const glm::ivec3 cell = cell_of(volume.frame, volume.indices[i]);
        const glm::dvec3 center(observer_from_world *
                                glm::dvec4(voxel_center(volume.frame, cell), 1));
        const double depth = depth_is_along_z(volume.frame) ? center.z : glm::length(center);
        volume.depths.push_back(static_cast<float>(depth));
        volume.objects.push_back(0);
        volume.kinds.push_back(volume.opacities[i] >= 1 ? VoxelKind::object : VoxelKind::space);
    }
}

void take_voxel(const InputFile& file, Volume& volume, uint64_t index, const float* values,
                size_t channels) {
    if (std::all_of(values, values + channels, [](float value) { return value == 0; })) return;
    volume.indices.push_back(index);
    volume.colors.emplace_back(values[0], values[1], values[2]);
    volume.opacities.push_back(values[3]);
    if (channels == 4) return;
    constexpr float kMaxObjects = 16777216;  // float holds every whole number up to this one
    if (!(values[5] >= 0 && values[5] <= kMaxObjects && values[6] >= 1 && values[6] <= 3))
        file.refuse("a voxel has no object or kind");
    volume.depths.push_back(values[4]);
    volume.objects.push_back(static_cast<uint32_t>(values[5]));
    volume.kinds.push_back(static_cast<VoxelKind>(int(values[6]) - 1));
}

}  // namespace

Volume read_volume_nrrd(const VolumePath& path) {
    const InputFile file(path);
    NrrdHeader header = read_header(file);
    const auto frame = header.keys.extract(kFrameKey);
    if (!frame) file.refuse("a NRRD file, but not of a display");
    Volume volume;
    volume.frame = read_frame_text(frame.mapped(), path.string());
    volume.attributes = header.keys;
    const size_t channels = take_channels(file, header, volume.frame);
    const uint64_t bytes = voxel_count(volume.frame) * channels * sizeof(float);
    NrrdData data(file, header.data_start, take_compression(file, header, bytes));
    const auto width = size_t(volume.frame.size.x);
    std::vector<float> row(width * channels);
    for (uint64_t start = 0; start < voxel_count(volume.frame); start += width) {
        data.read(row);
        for (size_t x = 0; x < width; ++x)
            take_voxel(file, volume, start + x, &row[x * channels], channels);
    }
    data.expect_end();
    if (channels == 4) complete(volume);
    return volume;
}

}  // namespace voxelume
