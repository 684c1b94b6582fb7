// SPDX-License-Identifier: Apache-2.0
// Image -> scanline OpenEXR.
#include <IexBaseExc.h>
#include <ImfMultiPartInputFile.h>
#include <ImfThreading.h>
#include <openexr.h>

#include <algorithm>
#include <limits>

#include "runtime/base/files/atomic_file.hpp"
#include "runtime/base/files/stamp.hpp"
#include "runtime/io/image/exr.hpp"
#include "runtime/io/image/exr_chunks.hpp"
#include "runtime/io/image/exr_layers.hpp"

namespace voxelume {

namespace {

constexpr std::string_view kMatteKey = "cryptomatte/";

bool is_color(const std::string& plane) {
    return plane == "R" || plane == "G" || plane == "B" || plane == "A";
}

/// The image's planes in the order of their names, as the file stores them.
std::vector<ExrPlane> planes_of(const Image& image, ColorDepth color) {
    std::vector<ExrPlane> planes;
    planes.reserve(image.planes.size());
    for (const auto& [name, plane] : image.planes)
        planes.push_back({.name = name,
                          .values = plane.data(),
                          .is_half = is_color(name) && color == ColorDepth::float16,
                          .is_color = is_color(name)});
    for (const auto& [name, plane] : image.id_planes)
        planes.push_back({.name = name, .values = plane.data(), .is_id = true});
    std::ranges::sort(planes, {}, &ExrPlane::name);
    return planes;
}

void check_image(ByteSink& file, const Image& image) {
    if (image.width <= 0 || image.height <= 0) file.fail("the image has no pixels");
    const size_t pixels = static_cast<size_t>(image.width) * static_cast<size_t>(image.height);
    for (const auto& [name, plane] : image.planes)
        if (plane.size() != pixels) file.fail("plane " + name + " hasn't the image's size");
    for (const auto& [name, plane] : image.id_planes)
        if (plane.size() != pixels) file.fail("plane " + name + " hasn't the image's size");
}

/// OpenEXR's writer of headers and chunks, onto a ByteSink. OpenEXR 3.1.5's own stream truncates
/// small files silently on a full disk.
class ExrWriter {
  public:
    ExrWriter(ByteSink& file, const std::filesystem::path& path) : file_(file) {
        exr_context_initializer_t setup = EXR_DEFAULT_CONTEXT_INITIALIZER;
        setup.user_data = this;
        setup.error_handler_fn = [](exr_const_context_t, exr_result_t, const char*) {};
        setup.write_fn = [](exr_const_context_t, void* self, const void* bytes, uint64_t size,
                            uint64_t position, exr_stream_error_func_ptr_t) {
            return static_cast<ExrWriter*>(self)->write(bytes, size, position);
        };
        check(exr_start_write(&context_, path.c_str(), EXR_WRITE_FILE_DIRECTLY, &setup));
    }
    ~ExrWriter() { exr_finish(&context_); }
    ExrWriter(const ExrWriter&) = delete;
    ExrWriter& operator=(const ExrWriter&) = delete;

    using Attributes = std::map<std::string, std::string>;

    void header(const Image& image, const Attributes& others, const std::vector<ExrPart>& parts) {
        allow_long_names(parts);
        Attributes attributes = image.attributes;
        attributes.insert(others.begin(), others.end());
        for (size_t i = 0; i < parts.size(); ++i) {
            int part = 0;
            check(exr_add_part(context_, parts[i].name.c_str(), EXR_STORAGE_SCANLINE, &part));
            set_windows(part, image);
            constexpr exr_attr_chromaticities_t kRec709 = {0.64f, 0.33f, 0.30f,   0.60f,
                                                           0.15f, 0.06f, 0.3127f, 0.3290f};
            check(exr_attr_set_chromaticities(context_, part, "chromaticities", &kRec709));
            add_channels(part, parts[i].planes);
            if (i == 0)
                add_texts(part, attributes);
            else
                add_texts(part, matte_texts(attributes, parts[i].name));
        }
        check(exr_write_header(context_));
    }

    /// Writes the next chunk of a part. Chunks come from the top down, part after part.
    void chunk(size_t part, const ExrChunk& chunk) {
        check(exr_write_scanline_chunk(context_, int(part), first_row_ + chunk.row,
                                       chunk.bytes.data(), chunk.bytes.size()));
    }

    /// Writes the table of rows.
    void finish() { check(exr_finish(&context_)); }

  private:
    /// Readers of OpenEXR 1 refuse files that may have names of more than 31 bytes.
    void allow_long_names(const std::vector<ExrPart>& parts) {
        constexpr size_t kShortName = 31;
        const auto has_long_name = [](const ExrPart& part) {
            return std::ranges::any_of(
                part.planes, [](const ExrPlane& plane) { return plane.name.size() > kShortName; });
        };
        if (std::ranges::any_of(parts, has_long_name))
            check(exr_set_longname_support(context_, 1));  // up to 255 bytes
    }

    void add_channels(int part, const std::vector<ExrPlane>& planes) {
        for (const ExrPlane& plane : planes) {
            const exr_pixel_type_t type = plane.is_id     ? EXR_PIXEL_UINT
                                          : plane.is_half ? EXR_PIXEL_HALF
                                                          : EXR_PIXEL_FLOAT;
            check(exr_add_channel(context_, part, plane.name.c_str(), type,
                                  EXR_PERCEPTUALLY_LOGARITHMIC, 1, 1));
        }
    }

    /// Manifests of mattes come last: they may be longer than what is read in search of a stamp.
    void add_texts(int part, const Attributes& texts) {
        for (const bool of_mattes : {false, true})
            for (const auto& [name, text] : texts)
                if (name.starts_with(kMatteKey) == of_mattes)
                    check(exr_attr_set_string(context_, part, name.c_str(), text.c_str()));
    }

    /// The texts that belong to the matte whose channels are in a layer.
    static Attributes matte_texts(const Attributes& texts, const std::string& layer) {
        const std::string_view matte = matte_of_layer(layer);
        Attributes own;
        for (const auto& [name, text] : texts) {
            if (matte.empty() || !name.starts_with(kMatteKey)) continue;
            const auto of = texts.find(name.substr(0, name.rfind('/')) + "/name");
            if (of != texts.end() && of->second == matte) own.emplace(name, text);
        }
        return own;
    }

    /// A part of a picture has its place in that as its data window.
    void set_windows(int part, const Image& image) {
        const auto window = [](glm::ivec2 first, glm::ivec2 size) {
            exr_attr_box2i_t box{};
            box.min.x = first.x, box.min.y = first.y;
            box.max.x = first.x + size.x - 1, box.max.y = first.y + size.y - 1;
            return box;
        };
        const glm::ivec2 size(image.width, image.height);
        const exr_attr_box2i_t data = window(image.first, size);
        const exr_attr_box2i_t display = image.frame.x > 0 ? window({0, 0}, image.frame) : data;
        const exr_attr_v2f_t center{};
        check(exr_initialize_required_attr(context_, part, &display, &data, 1.0f, &center, 1.0f,
                                           EXR_LINEORDER_INCREASING_Y, EXR_COMPRESSION_ZIP));
        first_row_ = image.first.y;
    }

    int64_t write(const void* bytes, uint64_t size, uint64_t position) noexcept try {
        file_.seek(position);
        file_.write(bytes, size);
        return int64_t(size);
    } catch (const Error&) {
        return -1;  // the sink keeps the error, and check() reports OpenEXR's
    }

    void check(exr_result_t result) {
        if (result != EXR_ERR_SUCCESS) file_.fail(exr_get_default_error_message(result));
    }

    ByteSink& file_;
    exr_context_t context_ = nullptr;
    int first_row_ = 0;
};

}  // namespace

void set_exr_threads(int threads) {
    Imf::setGlobalThreadCount(threads);
}

namespace {

/// Returns how many values weren't finite.
size_t encode(ByteSink& sink, const std::filesystem::path& name, const Image& image,
              const ExrStorage& storage, const std::map<std::string, std::string>& others) {
    check_image(sink, image);
    const std::vector<ExrPlane> planes = planes_of(image, storage.color);
    const std::vector<ExrPart> parts =
        storage.is_multi_part ? parts_by_layer(planes) : std::vector<ExrPart>{{"", planes}};
    size_t replaced = 0;
    ExrWriter writer(sink, name);
    writer.header(image, others, parts);
    for (size_t part = 0; part < parts.size(); ++part)
        compress_chunks(parts[part].planes, image.width, image.height, Imf::globalThreadCount(),
                        [&](const ExrChunk& chunk) {
                            writer.chunk(part, chunk);
                            replaced += chunk.replaced;
                        });
    writer.finish();
    return replaced;
}

/// Reads the tables of rows, of all parts.
void check_rows(AtomicFile& file) {
    try {
        const Imf::MultiPartInputFile written(file.temporary().c_str());
        for (int part = 0; part < written.parts(); ++part)
            if (!written.partComplete(part)) file.fail("rows are missing when it is read back");
    } catch (const Iex::BaseExc& error) {
        file.fail(error.what());
    }
}

}  // namespace

size_t write_exr(const std::filesystem::path& path, const Image& image, const ExrStorage& storage,
                 const std::map<std::string, std::string>& others) {
    AtomicFile file(path);
    const size_t replaced = encode(file, path, image, storage, others);
    check_rows(file);
    file.commit();
    return replaced;
}

std::string exr_bytes(const Image& image, const ExrStorage& storage,
                      const std::map<std::string, std::string>& others) {
    MemorySink sink("OpenEXR");
    encode(sink, "image.exr", image, storage, others);
    std::string bytes = sink.take();
    seal(bytes);
    return bytes;
}

}  // namespace voxelume
