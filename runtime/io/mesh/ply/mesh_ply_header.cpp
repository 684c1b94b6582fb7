// SPDX-License-Identifier: Apache-2.0
// Header of a PLY file, after Turk, "The PLY Polygon File Format", 1994.
#include "runtime/io/mesh/ply/mesh_ply_header.hpp"

#include "runtime/base/decimal.hpp"
#include "runtime/io/mesh/mesh_reader.hpp"

#include <algorithm>
#include <string_view>

namespace voxelume {
namespace {

struct TypeName {
    std::string_view name;
    PlyType type;
};

constexpr TypeName kTypeNames[] = {
    {"char", PlyType::int8},      {"int8", PlyType::int8},       {"uchar", PlyType::uint8},
    {"uint8", PlyType::uint8},    {"short", PlyType::int16},     {"int16", PlyType::int16},
    {"ushort", PlyType::uint16},  {"uint16", PlyType::uint16},   {"int", PlyType::int32},
    {"int32", PlyType::int32},    {"uint", PlyType::uint32},     {"uint32", PlyType::uint32},
    {"float", PlyType::float32},  {"float32", PlyType::float32}, {"double", PlyType::float64},
    {"float64", PlyType::float64}};

class HeaderParser {
  public:
    explicit HeaderParser(const MeshSource& source) : source_(source), line_(source.begin()) {}

    PlyHeader parse() {
        read_line();
        if (words_.size() != 1 || words_[0] != "ply") {
            fail("a PLY file begins with the line 'ply'");
        }
        for (read_line(); words_.empty() || words_[0] == "comment"; read_line()) {
            parse_comment();
        }
        parse_format();
        for (read_line(); words_.empty() || words_[0] != "end_header"; read_line()) {
            parse_declaration();
        }
        header_.body = next_;
        for (const PlyElement& element : header_.elements) {
            require_bytes_for(element);
        }
        return std::move(header_);
    }

  private:
    /// Splits the next line into words. The header's lines end in \n, with or without \r before it.
    void read_line() {
        line_ = next_ == nullptr ? source_.begin() : next_;
        const char* p = line_;
        words_.clear();
        for (p = skip_blanks(p); !ends_token(*p); p = skip_blanks(p)) {
            const char* const word = p;
            p = skip_token(p);
            words_.emplace_back(word, static_cast<size_t>(p - word));
        }
        if (*p != '\n') {
            source_.fail_at_line(p, p == source_.end() ? "the file ends inside the PLY header"
                                                       : "a zero byte inside the PLY header");
        }
        next_ = p + 1;
    }

    void parse_format() {
        if (words_.size() == 3 && words_[0] == "format" && words_[2] == "1.0") {
            if (words_[1] == "ascii") {
                header_.format = PlyFormat::ascii;
                return;
            }
            if (words_[1] == "binary_little_endian") {
                header_.format = PlyFormat::binary_little_endian;
                return;
            }
            if (words_[1] == "binary_big_endian") {
                header_.format = PlyFormat::binary_big_endian;
                return;
            }
        }
        fail(
            "the second line of a PLY file is 'format ascii 1.0', 'format binary_little_endian "
            "1.0' "
            "or 'format binary_big_endian 1.0'");
    }

    /// Programs that write meshes with a texture name it in a comment, as the format has no other
    /// place for it.
    void parse_comment() {
        if (words_.size() < 3 || words_[1] != "TextureFile" || !header_.texture.empty()) {
            return;
        }
        const std::string_view last = words_.back();
        header_.texture.assign(words_[2].data(), last.data() + last.size());
    }

    void parse_declaration() {
        if (words_.empty() || words_[0] == "comment" || words_[0] == "obj_info") {
            return parse_comment();
        }
        // Blender 2.47 left the first word of its comment out.
        if (words_[0] == "Created") {
            return;
        }
        if (words_[0] == "element" && words_.size() == 3) {
            header_.elements.push_back({std::string(words_[1]), count(words_[2]), {}});
        } else if (words_[0] == "property" && words_.size() == 3) {
            add_property({std::string(words_[2]), type(words_[1])});
        } else if (words_[0] == "property" && words_.size() == 5 && words_[1] == "list") {
            const PlyType count_type = type(words_[2]);
            if (!is_integer(count_type)) {
                fail("the count of a list can't be a float");
            }
            add_property({std::string(words_[4]), type(words_[3]), true, count_type});
        } else {
            fail(fmt::format("{} begins no complete line of a PLY header", quoted_token(line_)));
        }
    }

    void add_property(PlyProperty property) {
        if (header_.elements.empty()) {
            fail("a property before the first element");
        }
        header_.elements.back().properties.push_back(std::move(property));
    }

    uint64_t count(std::string_view word) const {
        const Integer number = scan_integer(word.data());
        if (number.end != word.data() + word.size() || number.value < 0) {
            fail(fmt::format("{} is no count of elements", quoted_token(word.data())));
        }
        return static_cast<uint64_t>(number.value);
    }

    PlyType type(std::string_view word) const {
        const TypeName* const found = std::ranges::find(kTypeNames, word, &TypeName::name);
        if (found == std::end(kTypeNames)) {
            fail(fmt::format("{} is no type of PLY", quoted_token(word.data())));
        }
        return found->type;
    }

    void require_bytes_for(const PlyElement& element) const {
        const uint64_t minimum = element.min_bytes(header_.format);
        // The last line of an ascii file may lack its newline.
        const auto left = static_cast<uint64_t>(source_.end() - header_.body) + 1;
        if (minimum != 0 && element.count > left / minimum) {
            source_.fail(
                fmt::format("the PLY header promises {} elements '{}', and the {} bytes behind "
                            "it don't hold that many; the file is damaged or incomplete",
                            element.count, element.name.substr(0, 24), left - 1));
        }
    }

    [[noreturn]] void fail(std::string_view sentence) const {
        source_.fail_at_line(line_, sentence);
    }

    const MeshSource& source_;
    const char* line_;
    const char* next_ = nullptr;
    std::vector<std::string_view> words_;
    PlyHeader header_{};
};

}  // namespace

uint64_t size_of(PlyType type) {
    constexpr uint64_t kSizes[] = {1, 1, 2, 2, 4, 4, 4, 8};
    return kSizes[static_cast<size_t>(type)];
}

uint64_t PlyElement::min_bytes(PlyFormat format) const {
    uint64_t bytes = 0;
    for (const PlyProperty& property : properties) {
        const PlyType first = property.is_list ? property.count_type : property.type;
        // an ascii value takes at least a digit and a separator
        bytes += format == PlyFormat::ascii ? 2 : size_of(first);
    }
    return bytes;
}

bool looks_like_ply(const std::string& bytes) {
    return bytes.starts_with("ply\n") || bytes.starts_with("ply\r\n");
}

PlyHeader parse_ply_header(const MeshSource& source) {
    return HeaderParser(source).parse();
}

}  // namespace voxelume
