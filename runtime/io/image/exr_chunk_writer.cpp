// SPDX-License-Identifier: Apache-2.0
#include "runtime/io/image/exr_chunk_writer.hpp"

#include <algorithm>
#include <cstring>

#include "runtime/image/cryptomatte.hpp"

namespace voxelume {
namespace {

/// The texts that belong to the matte whose channels are in a layer.
ExrChunkWriter::Attributes matte_texts(const ExrChunkWriter::Attributes& texts,
                                       const std::string& layer) {
    const std::string_view matte = matte_of_layer(layer);
    ExrChunkWriter::Attributes own;
    for (const auto& [name, text] : texts) {
        if (matte.empty() || !name.starts_with(kMatteKey)) continue;
        const auto of = texts.find(name.substr(0, name.rfind('/')) + "/name");
        if (of != texts.end() && of->second == matte) own.emplace(name, text);
    }
    return own;
}

}  // namespace

ExrChunkWriter::ExrChunkWriter(ByteSink& file, const std::filesystem::path& path) : file_(file) {
    exr_context_initializer_t setup = EXR_DEFAULT_CONTEXT_INITIALIZER;
    setup.user_data = this;
    setup.error_handler_fn = [](exr_const_context_t, exr_result_t, const char*) {};
    setup.write_fn = [](exr_const_context_t, void* self, const void* bytes, uint64_t size,
                        uint64_t position, exr_stream_error_func_ptr_t) {
        return static_cast<ExrChunkWriter*>(self)->write(bytes, size, position);
    };
    check(exr_start_write(&context_, path.c_str(), EXR_WRITE_FILE_DIRECTLY, &setup));
}

void ExrChunkWriter::header(const ImageWindow& window, const Attributes& attributes,
                            const std::vector<ExrPart>& parts) {
    allow_long_names(parts);
    for (size_t i = 0; i < parts.size(); ++i) {
        int part = 0;
        check(exr_add_part(context_, parts[i].name.c_str(), EXR_STORAGE_SCANLINE, &part));
        set_windows(part, window, pixel_aspect_in(attributes));
        constexpr exr_attr_chromaticities_t kRec709 = {0.64f, 0.33f, 0.30f,   0.60f,
                                                       0.15f, 0.06f, 0.3127f, 0.3290f};
        check(exr_attr_set_chromaticities(context_, part, "chromaticities", &kRec709));
        add_channels(part, parts[i].planes);
        add_texts(part, i == 0 ? attributes : matte_texts(attributes, parts[i].name));
    }
    is_in_header_ = true;
    check(exr_write_header(context_));
    is_in_header_ = false;
}

void ExrChunkWriter::retell(const std::string& name, const std::string& text) {
    // An attribute has its name, the name of its type, four bytes for its size, and its value.
    const std::string begin = name + std::string("\0string\0", 8);
    const std::string length{char(text.size()), 0, 0, 0};
    const size_t found = header_.find(begin), size = found + begin.size();
    if (found == std::string::npos) return;
    if (header_.compare(size, length.size(), length) != 0)
        file_.fail(fmt::format("\"{}\" doesn't fit the place in its header: {}", text, name));
    file_.seek(size + 4);
    file_.write(text.data(), text.size());
}

void ExrChunkWriter::chunk(size_t part, int row, const std::string& bytes) {
    check(exr_write_scanline_chunk(context_, int(part), first_row_ + row, bytes.data(),
                                   bytes.size()));
}

/// Readers of OpenEXR 1 refuse files that may have names of more than 31 bytes.
void ExrChunkWriter::allow_long_names(const std::vector<ExrPart>& parts) {
    constexpr size_t kShortName = 31;
    const auto has_long_name = [](const ExrPart& part) {
        return std::ranges::any_of(
            part.planes, [](const ExrPlane& plane) { return plane.name.size() > kShortName; });
    };
    if (std::ranges::any_of(parts, has_long_name))
        check(exr_set_longname_support(context_, 1));  // up to 255 bytes
}

void ExrChunkWriter::add_channels(int part, const std::vector<ExrPlane>& planes) {
    for (const ExrPlane& plane : planes) {
        const exr_pixel_type_t type = plane.is_id     ? EXR_PIXEL_UINT
                                      : plane.is_half ? EXR_PIXEL_HALF
                                                      : EXR_PIXEL_FLOAT;
        check(exr_add_channel(context_, part, plane.name.c_str(), type,
                              EXR_PERCEPTUALLY_LOGARITHMIC, 1, 1));
    }
}

/// Manifests of mattes come last: they may be longer than what is read in search of a stamp.
void ExrChunkWriter::add_texts(int part, const Attributes& texts) {
    for (const bool of_mattes : {false, true})
        for (const auto& [name, text] : texts)
            if (name != kPixelAspect && name.starts_with(kMatteKey) == of_mattes)
                check(exr_attr_set_string(context_, part, name.c_str(), text.c_str()));
}

/// Sets the windows. The data window of a part of a picture is its position in the picture.
void ExrChunkWriter::set_windows(int part, const ImageWindow& image, double pixel_aspect) {
    const auto window = [](glm::ivec2 first, glm::ivec2 size) {
        exr_attr_box2i_t box{};
        box.min.x = first.x, box.min.y = first.y;
        box.max.x = first.x + size.x - 1, box.max.y = first.y + size.y - 1;
        return box;
    };
    const exr_attr_box2i_t data = window(image.first, image.size);
    const exr_attr_box2i_t display = image.frame.x > 0 ? window({0, 0}, image.frame) : data;
    const exr_attr_v2f_t center{};
    check(exr_initialize_required_attr(context_, part, &display, &data, float(pixel_aspect),
                                       &center, 1.0f, EXR_LINEORDER_INCREASING_Y,
                                       EXR_COMPRESSION_ZIP));
    first_row_ = image.first.y;
}

int64_t ExrChunkWriter::write(const void* bytes, uint64_t size, uint64_t position) noexcept try {
    file_.seek(position);
    file_.write(bytes, size);
    if (is_in_header_) {
        header_.resize(std::max<size_t>(header_.size(), position + size));
        std::memcpy(&header_[position], bytes, size);
    }
    return int64_t(size);
} catch (const Error&) {
    return -1;  // the sink keeps the error, and check() reports OpenEXR's
}

void ExrChunkWriter::check(exr_result_t result) {
    if (result != EXR_ERR_SUCCESS) file_.fail(exr_get_default_error_message(result));
}

}  // namespace voxelume
