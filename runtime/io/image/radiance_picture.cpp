// SPDX-License-Identifier: Apache-2.0
// The format is that of Ward 1991, "Real Pixels", and of his Radiance.
#include "runtime/io/image/radiance_picture.hpp"

#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>
#include <string_view>

#include "runtime/base/error.hpp"

namespace voxelume {
namespace {

using Rgbe = std::array<uint8_t, 4>;

/// Reads the bytes of a file one after another.
class Reader {
  public:
    Reader(std::span<const uint8_t> bytes, const std::filesystem::path& name)
        : bytes_(bytes), name_(name) {}

    [[noreturn]] void refuse(const std::string& reason) const {
        throw Error(ErrorKind::input, "{}: {}", SourcePlace(name_.string()), reason);
    }
    /// The text up to the end of a line. Lines of the header have at most 2,048 bytes.
    std::string_view line() {
        constexpr size_t kLongest = 2048;
        const std::span<const uint8_t> rest = bytes_.first(std::min(kLongest, bytes_.size()));
        const auto end = std::ranges::find(rest, uint8_t{'\n'});
        if (end == rest.end()) refuse("not a Radiance picture: a line of its header doesn't end");
        const auto length = size_t(end - rest.begin());
        const std::string_view text(reinterpret_cast<const char*>(bytes_.data()), length);
        bytes_ = bytes_.subspan(length + 1);
        return text;
    }
    std::span<const uint8_t> take(size_t count) {
        if (count > bytes_.size()) refuse("pixels are missing; the file is truncated");
        const std::span<const uint8_t> taken = bytes_.first(count);
        bytes_ = bytes_.subspan(count);
        return taken;
    }
    uint8_t byte() { return take(1)[0]; }
    Rgbe pixel() {
        const std::span<const uint8_t> four = take(4);
        return {four[0], four[1], four[2], four[3]};
    }
    size_t left() const { return bytes_.size(); }

  private:
    std::span<const uint8_t> bytes_;
    const std::filesystem::path& name_;
};

/// The size of a picture, and whether its first row is the lowest.
struct Resolution {
    int width = 0, height = 0;
    bool is_upward = false;
};

/// "-Y 512 +X 1024": rows from the top down, each from left to right.
Resolution resolution_of(std::string_view text, const Reader& reader) {
    Resolution r;
    const auto number = [&](std::string_view axis, int& to) {
        if (!text.starts_with(axis)) return false;
        text.remove_prefix(axis.size());
        const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), to);
        text.remove_prefix(size_t(end - text.data()));
        return error == std::errc() && to > 0;
    };
    r.is_upward = text.starts_with('+');
    if (!number(r.is_upward ? "+Y " : "-Y ", r.height) || !number(" +X ", r.width) ||
        (!text.empty() && text != "\r"))
        reader.refuse(
            "is a Radiance picture whose rows don't go from left to right; its header should say "
            "\"-Y height +X width\"");
    return r;
}

Resolution read_header(Reader& reader) {
    const std::string_view first = reader.line();
    if (!first.starts_with("#?"))
        reader.refuse("not a Radiance picture: it doesn't begin as they do, with #?RADIANCE");
    constexpr int kMaxLines = 4096;
    for (int i = 0; i < kMaxLines; ++i) {
        const std::string_view line = reader.line();
        if (line.empty() || line == "\r") return resolution_of(reader.line(), reader);
        if (line.starts_with("FORMAT=") && line.find("32-bit_rle_rgbe") == line.npos)
            reader.refuse("is a Radiance picture of other colours than RGB (32-bit_rle_rgbe)");
    }
    reader.refuse("not a Radiance picture: its header doesn't end");
}

/// Reads a row whose four bytes come in planes, each in runs of up to 127 equal bytes or 128
/// others.
void read_planes(Reader& reader, std::vector<Rgbe>& row) {
    for (size_t channel = 0; channel < 4; ++channel)
        for (size_t x = 0; x < row.size();) {
            const size_t code = reader.byte();
            const bool is_run = code > 128;
            const size_t count = is_run ? code - 128 : code;
            if (count == 0 || count > row.size() - x)
                reader.refuse("a run of pixels doesn't fit into its row; the file is damaged");
            const std::span<const uint8_t> bytes = reader.take(is_run ? 1 : count);
            for (size_t i = 0; i < count; ++i) row[x++][channel] = bytes[is_run ? 0 : i];
        }
}

/// Reads a row of whole pixels from `first` on. A pixel 1 1 1 n repeats the one before it n times;
/// several in a row hold the number's bytes, the lowest first.
void read_pixels(Reader& reader, Rgbe first, std::vector<Rgbe>& row) {
    unsigned shift = 0;
    Rgbe pixel = first;
    for (size_t x = 0;;) {
        if (pixel[0] == 1 && pixel[1] == 1 && pixel[2] == 1) {
            const size_t count = shift < 32 ? size_t{pixel[3]} << shift : row.size() + 1;
            if (x == 0 || count > row.size() - x)
                reader.refuse("a run of pixels doesn't fit into its row; the file is damaged");
            std::fill_n(row.begin() + ptrdiff_t(x), count, row[x - 1]);
            x += count;
            shift += 8;
        } else {
            row[x++] = pixel;
            shift = 0;
        }
        if (x >= row.size()) return;
        pixel = reader.pixel();
    }
}

void read_row(Reader& reader, std::vector<Rgbe>& row) {
    const Rgbe first = reader.pixel();
    const size_t width = size_t{first[2]} << 8 | first[3];
    if (first[0] == 2 && first[1] == 2 && first[2] < 128 && row.size() >= 8) {
        if (width != row.size())
            reader.refuse("a row has another length than the header says; the file is damaged");
        return read_planes(reader, row);
    }
    read_pixels(reader, first, row);
}

}  // namespace

glm::ivec2 parse_radiance_size(std::span<const uint8_t> bytes, const std::filesystem::path& name) {
    Reader reader(bytes, name);
    const Resolution r = read_header(reader);
    return {r.width, r.height};
}

ColorPicture parse_radiance(std::span<const uint8_t> bytes, const std::filesystem::path& name,
                            uint64_t max_pixels) {
    Reader reader(bytes, name);
    const Resolution r = read_header(reader);
    const uint64_t pixels = uint64_t(r.width) * uint64_t(r.height);
    if (pixels > max_pixels)
        reader.refuse(fmt::format("has {} x {} pixels; at most {} are allowed", r.width, r.height,
                                  max_pixels));
    // The shortest data of a row is one pixel that runs of 255 repeat, or runs of 127 bytes in four
    // planes.
    if (pixels / 127 > reader.left())
        reader.refuse(
            fmt::format("declares {} x {} pixels and is far too small for them; it is "
                        "damaged",
                        r.width, r.height));
    ColorPicture picture{r.width, r.height, std::vector<float>(size_t(pixels) * 3)};
    std::vector<Rgbe> row(size_t(r.width), Rgbe{});
    for (int y = 0; y < r.height; ++y) {
        read_row(reader, row);
        const int at = r.is_upward ? r.height - 1 - y : y;
        float* to = &picture.values[size_t(at) * size_t(r.width) * 3];
        for (const Rgbe& p : row) {
            const float scale = p[3] == 0 ? 0.0f : std::ldexp(1.0f, int(p[3]) - 136);
            for (size_t c = 0; c < 3; ++c) *to++ = float(p[c]) * scale;
        }
    }
    return picture;
}

}  // namespace voxelume
