// SPDX-License-Identifier: Apache-2.0
// Volumetric image along sight rays -> deep scanline OpenEXR.
#include <ImfChannelList.h>
#include <ImfChromaticitiesAttribute.h>
#include <ImfDeepFrameBuffer.h>
#include <ImfDeepScanLineOutputFile.h>
#include <ImfHeader.h>
#include <ImfInputFile.h>  // the linter takes its forward declaration for our class
#include <ImfPartType.h>
#include <ImfStandardAttributes.h>
#include <ImfStringAttribute.h>

#include <algorithm>
#include <cmath>

#include "runtime/image/volume_geometry.hpp"
#include "runtime/io/image/exr_stream.hpp"
#include "runtime/io/image_codec/deep_exr_decoder.hpp"
#include "runtime/io/volume/volume_exr.hpp"
#include "runtime/io/volume/volume_formats.hpp"
#include "runtime/io/volume/volume_frame_text.hpp"

namespace voxelume {

namespace {

using volume_exr::kFloatChannels;

/// The listed voxels in the order of pixels, and those of a pixel in the order of k.
struct PixelOrder {
    std::vector<uint64_t> first;   ///< where each pixel's voxels begin in `voxels`, and their end
    std::vector<uint32_t> voxels;  ///< positions in the volume's arrays
};

PixelOrder order_by_pixel(const Volume& volume) {
    const uint64_t pixels = uint64_t(volume.frame.size.x) * uint64_t(volume.frame.size.y);
    PixelOrder order;
    order.first.resize(pixels + 1);
    for (const uint64_t index : volume.indices) ++order.first[index % pixels + 1];
    for (uint64_t i = 0; i < pixels; ++i) order.first[i + 1] += order.first[i];
    std::vector<uint64_t> next(order.first.begin(), order.first.end() - 1);
    order.voxels.resize(volume.indices.size());
    for (uint32_t i = 0; i < order.voxels.size(); ++i)
        order.voxels[next[volume.indices[i] % pixels]++] = i;
    return order;
}

/// The boundaries of the steps, which still differ when they are scaled. Two neighbouring steps
/// share the same float.
std::vector<float> step_bounds(AtomicFile& file, const VolumeFrame& frame) {
    std::vector<float> bounds;
    for (int k = 0; k <= frame.size.z; ++k)
        bounds.push_back(static_cast<float>(frame.display.near + frame.step * k));
    const auto is_short = [](float near, float far) { return far - near < far * 0x1p-22f; };
    if (std::ranges::adjacent_find(bounds, is_short) != bounds.end())
        file.fail("the steps are too short for a deep image's depths, which are float32");
    return bounds;
}

/// One row of pixels: its samples, channel by channel, and OpenEXR's pointers to them.
class DeepRowWriter {
  public:
    DeepRowWriter(const Volume& volume, std::vector<float> bounds)
        : volume_(volume),
          bounds_(std::move(bounds)),
          pixels_(uint64_t(volume.frame.size.x)),
          counts_(pixels_) {
        for (auto& pointers : float_pointers_) pointers.resize(pixels_);
        for (auto& pointers : id_pointers_) pointers.resize(pixels_);
    }

    /// A frame buffer whose every row is this one: its stride is zero.
    Imf::DeepFrameBuffer frame_buffer() {
        Imf::DeepFrameBuffer buffer;
        buffer.insertSampleCountSlice(
            Imf::Slice(Imf::UINT, reinterpret_cast<char*>(counts_.data()), sizeof counts_[0], 0));
        for (size_t c = 0; c < kFloatChannels.size(); ++c)
            buffer.insert(kFloatChannels[c], slice_of(Imf::FLOAT, float_pointers_[c]));
        for (size_t c = 0; c < kDeepIdChannels.size(); ++c)
            buffer.insert(kDeepIdChannels[c], slice_of(Imf::UINT, id_pointers_[c]));
        return buffer;
    }

    void fill(const PixelOrder& order, uint64_t row) {
        const uint64_t begin = order.first[row * pixels_], end = order.first[(row + 1) * pixels_];
        for (auto& samples : floats_) samples.resize(end - begin);
        for (auto& samples : ids_) samples.resize(end - begin);
        for (uint64_t pixel = 0; pixel < pixels_; ++pixel) {
            const uint64_t first = order.first[row * pixels_ + pixel];
            counts_[pixel] = static_cast<uint32_t>(order.first[row * pixels_ + pixel + 1] - first);
            const DepthScales scales = depth_scales(volume_.frame, glm::dvec2(pixel, row) + 0.5);
            for (uint64_t i = first; i < order.first[row * pixels_ + pixel + 1]; ++i)
                put_sample(i - begin, order.voxels[i], scales);
            for (size_t c = 0; c < floats_.size(); ++c)
                float_pointers_[c][pixel] = floats_[c].data() + (first - begin);
            for (size_t c = 0; c < ids_.size(); ++c)
                id_pointers_[c][pixel] = ids_[c].data() + (first - begin);
        }
    }

  private:
    template <class Value>
    static Imf::DeepSlice slice_of(Imf::PixelType type, std::vector<Value*>& pointers) {
        return Imf::DeepSlice(type, reinterpret_cast<char*>(pointers.data()), sizeof(Value*), 0,
                              sizeof(Value));
    }

    void put_sample(uint64_t at, uint32_t voxel, const DepthScales& scales) {
        const glm::ivec3 cell = cell_of(volume_.frame, volume_.indices[voxel]);
        const float near = bounds_[size_t(cell.z)], far = bounds_[size_t(cell.z) + 1];
        const float opacity = volume_.opacities[voxel], depth = volume_.depths[voxel];
        const bool is_surface = volume_.kinds[voxel] == VoxelKind::object;
        const float surface = std::isfinite(depth) ? std::clamp(depth, near, far) : near;
        const glm::vec3 color = volume_.colors[voxel] * opacity;
        const double front = is_surface ? surface : near, back = is_surface ? surface : far;
        const std::array<float, 8> values = {color.r,
                                             color.g,
                                             color.b,
                                             opacity,
                                             depth,
                                             float(front * scales.z),
                                             float(back * scales.z),
                                             float(front * scales.distance)};
        for (size_t c = 0; c < values.size(); ++c) floats_[c][at] = values[c];
        ids_[0][at] = volume_.objects[voxel];
        ids_[1][at] = static_cast<uint32_t>(volume_.kinds[voxel]);
        ids_[2][at] = static_cast<uint32_t>(cell.z);
    }

    const Volume& volume_;
    std::vector<float> bounds_;
    uint64_t pixels_;
    std::vector<uint32_t> counts_;
    std::array<std::vector<float>, kFloatChannels.size()> floats_;
    std::array<std::vector<uint32_t>, kDeepIdChannels.size()> ids_;
    std::array<std::vector<float*>, kFloatChannels.size()> float_pointers_;
    std::array<std::vector<uint32_t*>, kDeepIdChannels.size()> id_pointers_;
};

Imf::Header make_header(const Volume& volume) {
    Imf::Header header(volume.frame.size.x, volume.frame.size.y);
    header.setType(Imf::DEEPSCANLINE);
    header.compression() = Imf::ZIPS_COMPRESSION;
    Imf::addChromaticities(header, Imf::Chromaticities());  // the default is Rec. 709
    for (const char* name : kFloatChannels)
        header.channels().insert(name, Imf::Channel(Imf::FLOAT));
    for (const char* name : kDeepIdChannels)
        header.channels().insert(name, Imf::Channel(Imf::UINT));
    for (const auto& [name, text] : volume.attributes)
        header.insert(name, Imf::StringAttribute(text));
    header.insert(kFrameKey, Imf::StringAttribute(write_frame_text(volume.frame)));
    header.insert(volume_exr::kChecksumKey,
                  Imf::StringAttribute(std::string(volume_exr::kChecksumDigits, '0')));
    return header;
}

void write_rows(AtomicFile& file, const VolumePath& path, const Volume& volume) {
    const PixelOrder order = order_by_pixel(volume);
    DeepRowWriter row(volume, step_bounds(file, volume.frame));
    ExrStream stream(file, path.string());
    Imf::DeepScanLineOutputFile output(stream, make_header(volume));
    output.setFrameBuffer(row.frame_buffer());
    for (int y = 0; y < volume.frame.size.y; ++y) {
        row.fill(order, uint64_t(y));
        output.writePixels(1);
    }
    // The destructor writes the table of rows. A failure there reaches commit() through the
    // AtomicFile.
}

}  // namespace

void write_volume_exr(const VolumePath& path, const Volume& volume) {
    AtomicFile file(path);
    if (volume.indices.size() > UINT32_MAX)
        file.fail("it has more than 2^32 voxels that show something");
    try {
        write_rows(file, path, volume);
    } catch (const Iex::BaseExc& error) {
        file.fail(error.what());
    }
    const InputFile written(file.temporary());
    const uint64_t offset = volume_exr::find_checksum(written);
    if (offset == 0) {
        file.read_back();
        file.fail("its texts are too long for a header");
    }
    const std::string checksum = volume_exr::compute_checksum(written, offset);
    file.seek(offset);
    file.write(checksum.data(), checksum.size());
    file.commit();
}

}  // namespace voxelume
