// SPDX-License-Identifier: Apache-2.0
// Image -> scanline OpenEXR.
#include <IexBaseExc.h>
#include <ImfMultiPartInputFile.h>
#include <ImfThreading.h>

#include <algorithm>
#include <optional>

#include "runtime/base/files/atomic_file.hpp"
#include "runtime/base/files/stamp.hpp"
#include "runtime/io/image/exr.hpp"
#include "runtime/io/image/exr_chunk_spool.hpp"
#include "runtime/io/image/exr_chunk_writer.hpp"

namespace voxelume {

namespace {

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

/// Bands of an image -> the chunks of a file, in the order of a file that is written as a whole:
/// part after part. What belongs to later parts waits, compressed, in a spool.
class ExrEncoder {
  public:
    /// `name` is the file's.
    ExrEncoder(ByteSink& sink, const std::filesystem::path& name, const ImageWindow& window,
               const ExrStorage& storage, ExrChunkWriter::Attributes texts)
        : sink_(sink),
          name_(name),
          window_(window),
          storage_(storage),
          texts_(std::move(texts)),
          writer_(sink, name) {}

    void add(const Image& band) {
        check_image(sink_, band);
        const std::vector<ExrPlane> planes = planes_of(band, storage_.color);
        const std::vector<ExrPart> parts =
            storage_.is_multi_part ? parts_by_layer(planes) : std::vector<ExrPart>{{"", planes}};
        if (rows_ == 0) begin(band, parts);
        const bool is_whole = band.height == window_.size.y;
        const int threads =
            is_whole ? Imf::globalThreadCount()
                     : threads_for_band(band_chunk_bytes(band, planes), Imf::globalThreadCount());
        for (size_t part = 0; part < parts.size(); ++part)
            compress_chunks(parts[part].planes, band.width, band.height, threads,
                            [&](const ExrChunk& chunk) {
                                replaced_ += chunk.replaced;
                                if (part == 0 || is_whole)
                                    writer_.chunk(part, rows_ + chunk.row, chunk.bytes);
                                else
                                    spool().put(part, rows_ + chunk.row, chunk.bytes);
                            });
        rows_ += band.height;
    }

    /// Returns how many values weren't finite.
    size_t finish() {
        if (rows_ != window_.size.y) sink_.fail("rows of the image are missing");
        if (spool_)
            spool_->take_out([&](size_t part, int row, const std::string& bytes) {
                writer_.chunk(part, row, bytes);
            });
        spool_.reset();
        writer_.finish();
        return replaced_;
    }

    void retell(const std::string& name, const std::string& text) { writer_.retell(name, text); }

  private:
    void begin(const Image& band, const std::vector<ExrPart>& parts) {
        ExrChunkWriter::Attributes attributes = band.attributes;
        attributes.insert(texts_.begin(), texts_.end());
        writer_.header(window_, attributes, parts);
    }

    static size_t band_chunk_bytes(const Image& band, const std::vector<ExrPlane>& planes) {
        return size_t(kExrChunkRows) * size_t(band.width) * sizeof(float) * planes.size();
    }

    ExrChunkSpool& spool() {
        if (!spool_) spool_.emplace(name_);
        return *spool_;
    }

    ByteSink& sink_;
    std::filesystem::path name_;
    ImageWindow window_;
    ExrStorage storage_;
    ExrChunkWriter::Attributes texts_;
    ExrChunkWriter writer_;
    std::optional<ExrChunkSpool> spool_;
    int rows_ = 0;
    size_t replaced_ = 0;
};

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

class ExrRows final : public ImageRows {
  public:
    ExrRows(const std::filesystem::path& path, const ImageWindow& window, const ExrStorage& storage,
            const std::map<std::string, std::string>& texts)
        : file_(path), encoder_(file_, path, window, storage, texts) {}

    void add(const Image& band) override { encoder_.add(band); }
    void retell(const std::string& name, const std::string& text) override {
        encoder_.retell(name, text);
    }
    void finish() override { commit(); }

    size_t commit() {
        const size_t replaced = encoder_.finish();
        check_rows(file_);
        file_.commit();
        return replaced;
    }

  private:
    AtomicFile file_;
    ExrEncoder encoder_;
};

}  // namespace

void set_exr_threads(int threads) {
    Imf::setGlobalThreadCount(threads);
}

double exr_band_bytes(double row_bytes) {
    const double chunk = kExrChunkRows * row_bytes;
    return chunk * kChunkCopies * (1 + threads_for_band(size_t(chunk), Imf::globalThreadCount()));
}

std::unique_ptr<ImageRows> exr_rows(const std::filesystem::path& path, const ImageWindow& window,
                                    const ExrStorage& storage,
                                    const std::map<std::string, std::string>& others) {
    return std::make_unique<ExrRows>(path, window, storage, others);
}

size_t write_exr(const std::filesystem::path& path, const Image& image, const ExrStorage& storage,
                 const std::map<std::string, std::string>& others) {
    ExrRows file(path, window_of(image), storage, others);
    file.add(image);
    return file.commit();
}

std::string exr_bytes(const Image& image, const ExrStorage& storage,
                      const std::map<std::string, std::string>& others) {
    MemorySink sink("OpenEXR");
    ExrEncoder encoder(sink, "image.exr", window_of(image), storage, others);
    encoder.add(image);
    encoder.finish();
    std::string bytes = sink.take();
    seal(bytes);
    return bytes;
}

}  // namespace voxelume
