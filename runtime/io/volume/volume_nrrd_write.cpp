// SPDX-License-Identifier: Apache-2.0
// Volumetric image -> NRRD: one dense array of floats with an attached header.
#include <zlib.h>

#include <algorithm>
#include <array>

#include "runtime/base/files/atomic_file.hpp"
#include "runtime/image/volume_geometry.hpp"
#include "runtime/io/volume/volume_formats.hpp"
#include "runtime/io/volume/volume_frame_text.hpp"
#include "runtime/io/volume/volume_rows.hpp"

namespace voxelume {

namespace {

/// Passes bytes on to the file, through gzip if `compress` is true. gzip's header stores no time,
/// so equal bytes give equal files.
class NrrdWriter {
  public:
    NrrdWriter(AtomicFile& file, bool compress) : file_(file), compress_(compress) {
        constexpr int kGzip = 15 + 16, kMemoryLevel = 8, kLevel = 1;
        if (compress && deflateInit2(&stream_, kLevel, Z_DEFLATED, kGzip, kMemoryLevel,
                                     Z_DEFAULT_STRATEGY) != Z_OK)
            file.fail("zlib doesn't start");
    }
    ~NrrdWriter() {
        if (compress_) deflateEnd(&stream_);
    }
    NrrdWriter(const NrrdWriter&) = delete;
    NrrdWriter& operator=(const NrrdWriter&) = delete;

    void write(const std::vector<float>& values) {
        if (!compress_) {
            file_.write(values.data(), values.size() * sizeof values[0]);
            return;
        }
        stream_.next_in = reinterpret_cast<Bytef*>(const_cast<float*>(values.data()));
        stream_.avail_in = static_cast<uInt>(values.size() * sizeof values[0]);
        while (stream_.avail_in > 0) deflate_block(Z_NO_FLUSH);
    }
    void finish() {
        if (!compress_) return;
        while (deflate_block(Z_FINISH) != Z_STREAM_END) {
        }
    }

  private:
    int deflate_block(int flush) {
        stream_.next_out = block_.data();
        stream_.avail_out = static_cast<uInt>(block_.size());
        const int code = deflate(&stream_, flush);
        file_.write(block_.data(), block_.size() - stream_.avail_out);
        return code;
    }

    AtomicFile& file_;
    bool compress_;
    z_stream stream_{};
    std::array<Bytef, 1 << 16> block_{};
};

std::string vector_text(const glm::dvec4& v) {
    return fmt::format("({},{},{})", v.x, v.y, v.z);
}

/// The fields of the samples' positions: directions and origin where a matrix describes them,
/// otherwise the known fields of each axis.
std::string axes_text(const VolumeFrame& frame) {
    const std::optional<glm::dmat4> world = world_from_voxels(frame);
    const bool rays = frame.layout == VolumeLayout::rays;
    const std::string labels = rays ? "\"u\" \"v\" \"k\"" : "\"x\" \"y\" \"z\"";
    if (!world)
        return fmt::format(
            "spacings: NaN NaN NaN {}\naxis mins: NaN NaN NaN {}\n"
            "centerings: none cell cell cell\nlabels: \"values\" {}\nunits: \"\" \"\" \"\" \"m\"\n",
            frame.step, frame.display.near, labels);
    const glm::dmat4& m = *world;
    return fmt::format(
        "space: 3D-right-handed\nspace directions: none {} {} {}\nspace origin: {}\n"
        "space units: \"m\" \"m\" \"m\"\ncenterings: none cell cell cell\nlabels: \"values\" {}\n",
        vector_text(m[0]), vector_text(m[1]), vector_text(m[2]),
        vector_text(m * glm::dvec4(0.5, 0.5, 0.5, 1)), labels);
}

/// The text of a key or value with NRRD's two escapes.
std::string escape(const std::string& text) {
    std::string escaped;
    for (const char c : text) {
        if (c == '\\')
            escaped += "\\\\";
        else if (c == '\n')
            escaped += "\\n";
        else if (c != '\r' && c != '\0')
            escaped += c;
    }
    return escaped;
}

std::string header_text(AtomicFile& file, const Volume& volume, const VolumeOptions& options) {
    const VolumeFrame& frame = volume.frame;
    const bool linear = world_from_voxels(frame).has_value();
    const char* axis_kind = linear ? "space" : "domain";
    // Dimensions come before the fields of the axes, which need them.
    std::string axes = axes_text(frame);
    std::string text = "NRRD0005\n# Volumetric image: linear Rec. 709, not multiplied by opacity\n";
    text += "type: float\ndimension: 4\n";
    if (linear) {
        const size_t end = axes.find('\n') + 1;
        text += axes.substr(0, end);
        axes.erase(0, end);
    }
    text += fmt::format("sizes: {} {} {} {}\n", options.all_values ? 7 : 4, frame.size.x,
                        frame.size.y, frame.size.z);
    text += axes;
    text += fmt::format("kinds: {} {} {} {}\nendian: little\nencoding: {}\n",
                        options.all_values ? "list" : "RGBA-color", axis_kind, axis_kind, axis_kind,
                        options.compress ? "gzip" : "raw");
    text += fmt::format("{}:={}\n", kFrameKey, escape(write_frame_text(frame)));
    for (const auto& [key, value] : volume.attributes) {
        if (key.find_first_of(":\n\r") != std::string::npos || key.empty() || key[0] == '#')
            file.fail(fmt::format("its attribute \"{}\" can't be a key of NRRD", key));
        text += fmt::format("{}:={}\n", key, escape(value));
    }
    return text + "\n";
}

}  // namespace

void write_volume_nrrd(const VolumePath& path, const Volume& volume, const VolumeOptions& options) {
    AtomicFile file(path);
    const std::string header = header_text(file, volume, options);
    file.write(header.data(), header.size());
    NrrdWriter data(file, options.compress);
    const size_t channels = options.all_values ? 7 : 4;
    const glm::ivec3& size = volume.frame.size;
    std::vector<float> row(channels * size_t(size.x));
    VolumeRows rows(volume);
    for (uint64_t r = 0; r < uint64_t(size.y) * uint64_t(size.z); ++r) {
        std::ranges::fill(row, 0.0f);
        const auto [first, last] = rows.next();
        for (size_t i = first; i < last; ++i) {
            const glm::vec3& color = volume.colors[i];
            const std::array<float, 7> values = {color.r,
                                                 color.g,
                                                 color.b,
                                                 volume.opacities[i],
                                                 volume.depths[i],
                                                 float(volume.objects[i]),
                                                 float(volume.kinds[i]) + 1.0f};
            std::copy_n(values.begin(), channels, row.begin() + long(channels * rows.column(i)));
        }
        data.write(row);
    }
    data.finish();
    file.commit();
}

}  // namespace voxelume
