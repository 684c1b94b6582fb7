// SPDX-License-Identifier: Apache-2.0
// OpenEXR -> Image.
#include <fmt/format.h>

#include <climits>

#include "runtime/base/main_memory.hpp"
#include "runtime/io/image/exr.hpp"
#include "runtime/io/image_codec/image_codec.hpp"

namespace voxelume {
namespace {

/// An image's planes, into which rows are decoded.
class PlaneSink : public ExrSink {
  public:
    explicit PlaneSink(const std::filesystem::path& path) : path_(path) {}

    void begin(const ExrHeader& header) override {
        require_room(path_, fmt::format("an image of {}x{} pixels", header.width, header.height),
                     header.pixel_bytes());
        width_ = size_t(header.width);
        const size_t pixels = width_ * size_t(header.height);
        for (const auto& [name, type] : header.channels)
            if (header.holds_ids(name))
                image_.id_planes[name] = std::vector<uint32_t>(pixels);
            else
                image_.planes[name] = std::vector<float>(pixels);
    }
    int rows_at_once() const override { return INT_MAX; }
    void* room(const std::string& channel, int first, int) override {
        const size_t begin = width_ * size_t(first);
        const auto ids = image_.id_planes.find(channel);
        if (ids != image_.id_planes.end()) return ids->second.data() + begin;
        return image_.planes.at(channel).data() + begin;
    }
    void take_rows() override {}

    /// The rest of an image with these planes.
    Image with(Image rest) && {
        rest.planes = std::move(image_.planes);
        rest.id_planes = std::move(image_.id_planes);
        return rest;
    }

  private:
    const std::filesystem::path& path_;
    size_t width_ = 0;
    Image image_;
};

}  // namespace

bool fits_memory(const ExrHeader& header) {
    return has_room_for(header.pixel_bytes());
}

ExrHeader read_exr_header(const std::filesystem::path& path) {
    const InputFile file(path);  // reports what is wrong with the file itself
    return decodes_apart() ? ask_exr_header(file) : decode_exr_header(file);
}

Image read_exr(const std::filesystem::path& path) {
    const InputFile file(path);
    PlaneSink planes(path);
    Image image = decodes_apart() ? ask_exr(file, planes) : decode_exr(file, planes);
    return std::move(planes).with(std::move(image));
}

}  // namespace voxelume
