// SPDX-License-Identifier: Apache-2.0
// STL -> Mesh: triangles that each have their own corners become triangles that share vertices.
#include "runtime/io/mesh/mesh_paint.hpp"
#include "runtime/io/mesh/mesh_polygon.hpp"
#include "runtime/io/mesh/mesh_reader.hpp"
#include "runtime/io/mesh/mesh_stl_color.hpp"

#include <bit>
#include <cmath>
#include <limits>

namespace voxelume {
namespace {

constexpr size_t kHeaderBytes = 84;  // 80 bytes of any content, then the number of facets
constexpr size_t kFacetBytes = 50;   // normal, three corners (float32 each), a 16-bit attribute

/// Loads a little-endian 32-bit integer.
uint32_t load_word(const char* at) {
    const auto byte = [at](int i) { return uint32_t{static_cast<unsigned char>(at[i])}; };
    return byte(0) | byte(1) << 8 | byte(2) << 16 | byte(3) << 24;
}

uint64_t binary_size(const std::string& bytes) {
    return kHeaderBytes + uint64_t{kFacetBytes} * load_word(bytes.data() + 80);
}

/// Gives corners at the same position one index, by a hash table with open addressing.
class VertexMerger {
  public:
    explicit VertexMerger(std::vector<glm::vec3>& positions) : positions_(positions) {}

    uint32_t index_of(glm::vec3 position) {
        position += 0.0f;  // -0 becomes 0; every other bit pattern stays
        if (2 * positions_.size() >= slots_.size()) {
            grow();
        }
        size_t slot = hash(position) & (slots_.size() - 1);
        while (slots_[slot] != kFree && positions_[slots_[slot]] != position) {
            slot = (slot + 1) & (slots_.size() - 1);
        }
        if (slots_[slot] == kFree) {
            slots_[slot] = static_cast<uint32_t>(positions_.size());
            positions_.push_back(position);
        }
        return slots_[slot];
    }

  private:
    static constexpr uint32_t kFree = std::numeric_limits<uint32_t>::max();

    static size_t hash(const glm::vec3& position) {
        uint64_t mixed = 0;
        for (int i = 0; i < 3; ++i) {
            mixed = (mixed ^ std::bit_cast<uint32_t>(position[i])) * 0x9E3779B97F4A7C15u;
            mixed ^= mixed >> 32;
        }
        return static_cast<size_t>(mixed);
    }

    void grow() {
        slots_.assign(slots_.empty() ? 1024 : 2 * slots_.size(), kFree);
        for (uint32_t i = 0; i < positions_.size(); ++i) {
            size_t slot = hash(positions_[i]) & (slots_.size() - 1);
            while (slots_[slot] != kFree) {
                slot = (slot + 1) & (slots_.size() - 1);
            }
            slots_[slot] = i;
        }
    }

    std::vector<glm::vec3>& positions_;
    std::vector<uint32_t> slots_;
};

Mesh parse_binary(const MeshSource& source) {
    if (source.bytes.size() < kHeaderBytes) {
        source.fail_at_byte(source.end(), "the file ends inside the STL header of 84 bytes");
    }
    const uint32_t facets = load_word(source.begin() + 80);
    const uint64_t expected = binary_size(source.bytes);
    if (source.bytes.size() != expected) {
        source.fail_at_byte(
            source.begin() + 80,
            fmt::format("the STL header promises {} facets, which take {} bytes, but "
                        "the file has {}; it is damaged or incomplete",
                        facets, expected, source.bytes.size()));
    }
    require_triangle_count(source, facets);
    Mesh mesh;
    mesh.triangles.reserve(facets);
    VertexMerger merger(mesh.positions);
    StlColors colors(source.bytes);
    const char* p = source.begin() + kHeaderBytes;
    for (uint32_t facet = 0; facet < facets; ++facet, p += kFacetBytes) {
        glm::uvec3 triangle;
        for (int corner = 0; corner < 3; ++corner) {
            glm::vec3 position;
            for (int i = 0; i < 3; ++i) {
                const char* const at = p + 12 + 12 * corner + 4 * i;
                position[i] = std::bit_cast<float>(load_word(at));
                if (!std::isfinite(position[i])) {
                    source.fail_at_byte(
                        at, fmt::format("facet {} has a vertex that is not finite", facet));
                }
            }
            triangle[corner] = merger.index_of(position);
        }
        mesh.triangles.push_back(triangle);
        colors.add(p + 48, mesh);
    }
    fill_corner_lists(mesh);
    return mesh;
}

class AsciiParser {
  public:
    explicit AsciiParser(const MeshSource& source)
        : source_(source), p_(source.begin()), merger_(mesh_.positions) {}

    Mesh parse() {
        source_.require_text();
        for (skip_space(); *p_ != '\0'; skip_space()) {
            expect("solid");
            skip_line();
            while (!accept("endsolid")) {
                parse_facet();
            }
            skip_line();
        }
        return std::move(mesh_);
    }

  private:
    void parse_facet() {
        expect("facet");
        expect("normal");
        for (int i = 0; i < 3; ++i) {  // skipped: writers put "nan" there for facets without area
            skip_space();
            p_ = skip_token(p_);
        }
        expect("outer");
        expect("loop");
        glm::uvec3 triangle;
        for (int corner = 0; corner < 3; ++corner) {
            expect("vertex");
            glm::vec3 position;
            for (int i = 0; i < 3; ++i) {
                skip_space();
                position[i] = require_number(source_, p_);
            }
            triangle[corner] = merger_.index_of(position);
        }
        expect("endloop");
        expect("endfacet");
        require_triangle_count(source_, mesh_.triangles.size() + 1);
        mesh_.triangles.push_back(triangle);
    }

    void skip_space() {
        while (is_blank(*p_) || *p_ == '\n') {
            ++p_;
        }
    }

    void skip_line() {
        while (*p_ != '\n' && *p_ != '\0') {
            ++p_;
        }
    }

    /// True if the next token is `word`, in upper or lower case; if so, the token is skipped.
    bool accept(std::string_view word) {
        skip_space();
        for (size_t i = 0; i < word.size(); ++i) {
            if ((p_[i] | ' ') != word[i]) {
                return false;
            }
        }
        if (!ends_token(p_[word.size()])) {
            return false;
        }
        p_ += word.size();
        return true;
    }

    void expect(std::string_view word) {
        if (!accept(word)) {
            source_.fail_at_line(
                p_, *p_ == '\0'
                        ? fmt::format("the file ends where '{}' should follow", word)
                        : fmt::format("'{}' should stand where {} does", word, quoted_token(p_)));
        }
    }

    const MeshSource& source_;
    const char* p_;
    Mesh mesh_;
    VertexMerger merger_;
};

bool begins_with_solid(const std::string& bytes) {
    const size_t word = bytes.find_first_not_of(" \t\r\n");
    if (word == std::string::npos || bytes.size() - word < 5) {
        return false;
    }
    std::string first = bytes.substr(word, 5);
    for (char& c : first) {
        c = static_cast<char>(c | ' ');
    }
    return first == "solid" && ends_token(bytes.c_str()[word + 5]);
}

bool has_binary_size(const std::string& bytes) {
    return bytes.size() >= kHeaderBytes && bytes.size() == binary_size(bytes);
}

/// True if the file is binary. A binary header may begin with "solid" too. A damaged binary file
/// still has a zero byte in its header: the count of fewer than 2^24 facets contains one.
bool is_binary(const std::string& bytes) {
    return !begins_with_solid(bytes) || has_binary_size(bytes) || bytes.find('\0') < kHeaderBytes;
}

}  // namespace

bool looks_like_stl(const std::string& bytes) {
    return has_binary_size(bytes) ||
           (begins_with_solid(bytes) && (bytes.find("facet") != std::string::npos ||
                                         bytes.find("endsolid") != std::string::npos));
}

Mesh parse_stl(const MeshSource& source) {
    Mesh mesh = is_binary(source.bytes) ? parse_binary(source) : AsciiParser(source).parse();
    if (mesh.triangles.empty()) {
        source.fail("the mesh has no triangles: no facet in the file");
    }
    return mesh;
}

}  // namespace voxelume
