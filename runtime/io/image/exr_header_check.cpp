// SPDX-License-Identifier: Apache-2.0
#include "runtime/io/image/exr_header_check.hpp"

#include <algorithm>
#include <string>

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

/// Checks the lengths inside of an attribute's value if its type has some.
void check_value(Walk walk, const std::string& name, const std::string& type, uint64_t size) {
    const auto fail = [&] {
        walk.fail(fmt::format("its attribute {} declares more than it has", name));
    };
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
bool walk_part(Walk& walk) {
    std::string name = walk.name();
    if (name.empty()) return false;
    for (; !name.empty(); name = walk.name()) {
        const std::string type = walk.name();
        const uint64_t size = walk.number();
        if (size > walk.left())
            walk.fail(fmt::format("its attribute {} declares {} bytes, and {} follow", name, size,
                                  walk.left()));
        check_value(walk, name, type, size);
        walk.skip(size);
    }
    return true;
}

}  // namespace

void check_exr_header(const InputFile& file) {
    Walk walk(file);
    if (file.size() < 8 || walk.number() != kMagic)
        walk.fail("it doesn't begin as OpenEXR files do");
    const bool has_parts = walk.number() & kMultipart;
    if (!walk_part(walk)) walk.fail("its header is empty");
    while (has_parts && walk_part(walk)) {
    }
}

}  // namespace voxelume
