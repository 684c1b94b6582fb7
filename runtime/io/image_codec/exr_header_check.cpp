// SPDX-License-Identifier: Apache-2.0
#include "runtime/io/image_codec/exr_header_check.hpp"

#include <algorithm>
#include <optional>
#include <set>
#include <string>
#include <string_view>
#include <utility>

namespace voxelume {
namespace {

constexpr uint32_t kMagic = 20000630, kMultipart = 0x1000;
constexpr uint64_t kLongestName = 256;  ///< with the zero byte behind it

/// Reads a file from its beginning on.
class Walk {
  public:
    explicit Walk(const InputFile& file) : file_(file) {}

    uint32_t number() {
        uint32_t value = 0;
        file_.read(position_, &value, sizeof value);
        position_ += sizeof value;
        return value;
    }
    uint8_t byte() {
        uint8_t value = 0;
        file_.read(position_, &value, sizeof value);
        position_ += sizeof value;
        return value;
    }
    std::string name() {
        std::string text(std::min(kLongestName, file_.size() - position_), '\0');
        file_.read(position_, text.data(), text.size());
        const size_t end = text.find('\0');
        if (end == std::string::npos) fail("a name in its header doesn't end");
        text.resize(end);
        position_ += end + 1;
        return text;
    }
    uint64_t left() const { return file_.size() - position_; }
    void skip(uint64_t bytes) { position_ += bytes; }

    [[noreturn]] void fail(const std::string& reason) const {
        file_.refuse("not a readable OpenEXR file: " + reason);
    }

  private:
    const InputFile& file_;
    uint64_t position_ = 0;
};

/// The bytes of the types of attributes that OpenEXR reads without regard to the length that the
/// file declares. Where it is another one, OpenEXR goes on reading at another position than this
/// check does.
constexpr std::pair<std::string_view, uint64_t> kSizes[] = {
    {"box2f", 16},         {"box2i", 16},    {"chromaticities", 32},
    {"compression", 1},    {"double", 8},    {"envmap", 1},
    {"deepImageState", 1}, {"float", 4},     {"int", 4},
    {"keycode", 28},       {"lineOrder", 1}, {"m33d", 72},
    {"m33f", 36},          {"m44d", 128},    {"m44f", 64},
    {"rational", 8},       {"tiledesc", 9},  {"timecode", 8},
    {"v2d", 16},           {"v2f", 8},       {"v2i", 8},
    {"v3d", 24},           {"v3f", 12},      {"v3i", 12}};

bool has_its_size(const std::string& type, uint64_t size) {
    if (type == "floatvector") return size % 4 == 0;
    if (type == "idmanifest") return size >= 4;
    const auto* row = std::ranges::find(kSizes, type, [](const auto& r) { return r.first; });
    return row == std::end(kSizes) || row->second == size;
}

/// The number of channels in a list, behind which an empty name is. Nothing if the list doesn't end
/// where its attribute does.
std::optional<uint64_t> count_channels(Walk walk, uint64_t size) {
    constexpr uint64_t kChannel = 16;  // bytes behind a channel's name
    const uint64_t end = walk.left() - size;
    for (uint64_t count = 0; walk.left() > end; ++count) {
        if (walk.name().empty()) return walk.left() == end ? std::optional(count) : std::nullopt;
        if (walk.left() < end + kChannel) return std::nullopt;
        walk.skip(kChannel);
    }
    return std::nullopt;
}

/// What one part's header declares.
struct Part {
    double columns = 0, rows = 0, channels = 0;
    double tile_pixels = 0;     // 0: it has no tiles
    double rows_at_once = 256;  // by its compression

    void add_to(ExrExtent& extent) const {
        constexpr double kMost = 0x1p60;
        const double row_bytes = 4 * columns * channels;
        const double bytes = double(extent.pixel_bytes) + row_bytes * rows;
        extent.pixel_bytes = uint64_t(std::min(bytes, kMost));
        extent.row_bytes = std::max(extent.row_bytes, uint64_t(std::min(row_bytes, kMost)));
        const double block =
            tile_pixels > 0 ? 4 * tile_pixels * channels : row_bytes * rows_at_once;
        extent.block_bytes = std::max(extent.block_bytes, uint64_t(std::min(block, kMost)));
    }
};

/// The numbers of rows that OpenEXR's compressions take at once: none, RLE, ZIPS, ZIP, PIZ, PXR24,
/// B44, B44A, DWAA and DWAB.
constexpr double kRowsAtOnce[] = {1, 1, 1, 16, 32, 16, 32, 32, 32, 256};

/// Takes what an attribute says of a part's size.
void take_size(Walk walk, const std::string& name, const std::string& type, uint64_t size,
               Part& part) {
    if (type == "chlist") part.channels += double(count_channels(walk, size).value_or(0));
    if (type == "tiledesc") {
        const double width = walk.number();
        part.tile_pixels = width * double(walk.number());
    }
    if (type == "compression") {
        const uint8_t which = walk.byte();
        if (which < std::size(kRowsAtOnce)) part.rows_at_once = kRowsAtOnce[which];
    }
    if (name != "dataWindow" || type != "box2i") return;
    int32_t sides[4] = {};
    for (int32_t& side : sides) side = int32_t(walk.number());
    part.columns = std::max(part.columns, double(sides[2]) - sides[0] + 1);
    part.rows = std::max(part.rows, double(sides[3]) - sides[1] + 1);
}

/// Checks the length of an attribute's value, and those inside of it if its type has some.
void check_value(Walk walk, const std::string& name, const std::string& type, uint64_t size) {
    const auto fail = [&] {
        walk.fail(fmt::format("its attribute {} declares more than it has", name));
    };
    if (!has_its_size(type, size))
        walk.fail(fmt::format("its attribute {} has {} bytes, which is no {}", name, size, type));
    if (type == "chlist" && !count_channels(walk, size)) fail();
    if (type == "preview") {
        const uint64_t width = size < 8 ? 0 : walk.number(), height = size < 8 ? 0 : walk.number();
        if (size < 8 || width > size || height > size || size != 8 + 4 * width * height) fail();
    }
    for (uint64_t left = size; type == "stringvector" && left > 0;) {
        const uint64_t length = left < 4 ? left : walk.number();
        if (left < 4 || length > left - 4) fail();
        walk.skip(length);
        left -= 4 + length;
    }
}

/// Walks through the attributes of one part. Returns false if there are none: the list of parts
/// ends so.
bool walk_part(Walk& walk, ExrExtent& extent) {
    std::string name = walk.name();
    if (name.empty()) return false;
    Part part;
    std::set<std::string> names;
    for (; !name.empty(); name = walk.name()) {
        // OpenEXR's two libraries would take different ones: the first and the last.
        if (!names.insert(name).second)
            walk.fail(fmt::format("it has its attribute {} twice", name));
        const std::string type = walk.name();
        const uint64_t size = walk.number();
        if (size > walk.left())
            walk.fail(fmt::format("its attribute {} declares {} bytes, and {} follow", name, size,
                                  walk.left()));
        check_value(walk, name, type, size);
        take_size(walk, name, type, size, part);
        walk.skip(size);
    }
    part.add_to(extent);
    return true;
}

}  // namespace

ExrExtent check_exr_header(const InputFile& file) {
    Walk walk(file);
    if (file.size() < 8 || walk.number() != kMagic)
        walk.fail("it doesn't begin as OpenEXR files do");
    const bool has_parts = walk.number() & kMultipart;
    ExrExtent extent;
    if (!walk_part(walk, extent)) walk.fail("its header is empty");
    while (has_parts && walk_part(walk, extent)) {
    }
    return extent;
}

}  // namespace voxelume
