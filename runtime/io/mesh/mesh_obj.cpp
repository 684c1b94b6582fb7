// SPDX-License-Identifier: Apache-2.0
// Wavefront OBJ -> Mesh, in one pass over the text.
#include "runtime/base/decimal.hpp"
#include "runtime/base/utf8.hpp"
#include "runtime/io/mesh/material_library.hpp"
#include "runtime/io/mesh/mesh_obj_colors.hpp"
#include "runtime/io/mesh/mesh_obj_normals.hpp"
#include "runtime/io/mesh/mesh_obj_uvs.hpp"
#include "runtime/io/mesh/mesh_obj_words.hpp"
#include "runtime/io/mesh/mesh_paint.hpp"
#include "runtime/io/mesh/mesh_polygon.hpp"
#include "runtime/io/mesh/mesh_reader.hpp"
#include "runtime/io/mesh/mesh_scan.hpp"

#include <algorithm>
#include <array>
#include <cstring>
#include <unordered_map>

namespace voxelume {
namespace {

class ObjParser {
  public:
    explicit ObjParser(const MeshSource& source) : source_(source), p_(source.begin()) {}

    Mesh parse() {
        if (source_.bytes.starts_with("\xEF\xBB\xBF")) {
            p_ += 3;
        }
        while (p_ != source_.end()) {
            parse_statement();
        }
        colors_.settle(source_, mesh_);
        strokes_.settle(source_, mesh_);
        drop_single_group();
        settle_obj_normals(mesh_);
        settle_obj_uvs(mesh_);
        return std::move(mesh_);
    }

  private:
    void parse_statement() {
        skip_gap();
        const char* const word = p_;
        if (word[0] == 'v' && is_blank(word[1])) {
            parse_vertex();
        } else if (word[0] == 'f' && is_blank(word[1])) {
            parse_face();
        } else if (word[0] == 'v' && word[1] == 'n' && is_blank(word[2])) {
            parse_normal();
        } else if (word[0] == 'v' && word[1] == 't' && is_blank(word[2])) {
            parse_uv();
        } else if ((*word == 'p' || *word == 'l') && is_blank(word[1])) {
            parse_stroke(*word == 'l');
        } else if (at_end_of_statement()) {
            skip_line();
        } else {
            parse_other_statement(
                std::string_view(word, static_cast<size_t>(skip_token(word) - word)));
        }
    }

    void parse_other_statement(std::string_view word) {
        if (word == "v" || word == "f") {
            source_.fail_at_line(p_, fmt::format("'{}' without numbers", word));
        }
        if (word == "usemtl") {
            material_ = utf8_text(name_after_word(p_));
            skip_line();
            group_known_ = false;
        } else if (word == "mtllib") {
            const char* const line = p_;
            skip_statement();
            append_library(name_after_word(line), mesh_.material_libraries);
        } else if (word == "vn" || word == "vt" ||
                   std::ranges::find(kSkippedStatements, word) != std::end(kSkippedStatements)) {
            strokes_.skip(word);
            skip_statement();
        } else {
            source_.fail_at_line(p_, fmt::format("{} is no statement of OBJ", quoted_token(p_)));
        }
    }

    void parse_vertex() {
        std::array<float, 6> numbers;
        size_t count = 0;
        for (++p_, skip_gap(); !at_end_of_statement(); skip_gap()) {
            if (count == numbers.size()) {
                fail_vertex("more than 6");
            }
            numbers[count++] = require_number(source_, p_, '\\');
        }
        if (count < 3 || count == 5) {
            fail_vertex(fmt::format("{}", count));
        }
        mesh_.positions.emplace_back(numbers[0], numbers[1], numbers[2]);
        if (count == 6) {
            colors_.append(source_, p_, {numbers[3], numbers[4], numbers[5]}, mesh_);
        }
    }

    [[noreturn]] void fail_vertex(std::string_view count) const {
        source_.fail_at_line(p_, fmt::format("'v' has {} numbers; it needs x y z, x y z w or x y z "
                                             "red green blue",
                                             count));
    }

    /// Reads a normal. One that isn't three numbers becomes a vector of length 0.
    void parse_normal() {
        glm::vec3 normal(0);
        bool is_whole = true;
        p_ += 2;
        for (int i = 0; i < 3; ++i) {
            skip_gap();
            const Decimal found = scan_decimal(p_);
            is_whole = is_whole && found.status == DecimalStatus::ok;
            p_ = found.end;
            normal[i] = found.value;
        }
        mesh_.normals.push_back(is_whole ? normal : glm::vec3(0));
        skip_statement();
    }

    /// Reads a UV, whose v may be missing.
    void parse_uv() {
        double uv[2] = {0, 0};
        p_ += 2;
        for (double& value : uv) {
            skip_gap();
            const Decimal found = scan_decimal(p_);
            p_ = found.end;
            if (found.status == DecimalStatus::ok) value = double(found.value);
        }
        mesh_.uvs.push_back(upright_uv(uv[0], uv[1]));
        skip_statement();
    }

    void parse_face() {
        corners_.clear();
        normals_.clear();
        uvs_.clear();
        for (++p_, skip_gap(); !at_end_of_statement(); skip_gap()) {
            corners_.push_back(parse_corner());
        }
        if (corners_.size() < 3) {
            source_.fail_at_line(
                p_, fmt::format("'f' has {} corners; it needs at least three", corners_.size()));
        }
        if (has_obj_normals(mesh_, normals_)) {
            mesh_.triangle_normals.resize(mesh_.triangles.size(), glm::uvec3(kNoNormal));
            cutter_.append(source_, corners_, mesh_, normals_);
        } else {
            cutter_.append(source_, corners_, mesh_);
        }
        if (has_obj_uvs(mesh_, uvs_)) append_corner_uvs();
        mesh_.triangle_group.resize(mesh_.triangles.size(), group());
    }

    void append_corner_uvs() {
        const size_t before = mesh_.triangles.size() - cutter_.triangles().size();
        mesh_.triangle_uvs.resize(before, glm::uvec3(kNoUv));
        for (const glm::uvec3& t : cutter_.triangles())
            mesh_.triangle_uvs.emplace_back(uvs_[t.x], uvs_[t.y], uvs_[t.z]);
    }

    /// Parses `7`, `7/3`, `7//4` or `7/3/4`. The first number is the vertex; it counts from 1, or
    /// backwards from -1 for the last vertex.
    uint32_t parse_corner() {
        const Integer vertex = scan_integer(p_);
        const char* end = vertex.end;
        bool valid = end != p_;
        normals_.push_back(kNoNormal);
        uvs_.push_back(kNoUv);
        if (*end == '/') {
            const Integer texture = scan_integer(end + 1);
            uvs_.back() = obj_uv_index(end + 1, texture, mesh_.uvs.size());
            end = texture.end;
            if (*end == '/') {
                const Integer normal = scan_integer(end + 1);
                valid &= normal.end != end + 1;
                end = normal.end;
                normals_.back() = obj_normal_index(normal.value, mesh_.normals.size());
            }
        }
        if (!valid || !(ends_token(*end) || *end == '\\')) {
            source_.fail_at_line(
                p_, fmt::format("{} is no corner of a face; write 7, 7/3, 7//4 or 7/3/4",
                                quoted_token(p_)));
        }
        const auto count = static_cast<int64_t>(mesh_.positions.size());
        const int64_t index = vertex.value < 0 ? count + vertex.value : vertex.value - 1;
        if (index < 0 || index >= count) {
            source_.fail_at_line(p_, fmt::format("the face names vertex {}, and {} vertices are "
                                                 "defined before it",
                                                 vertex.value, count));
        }
        p_ = end;
        return static_cast<uint32_t>(index);
    }

    /// Reads points or a line. Other uses of the words are skipped.
    void parse_stroke(bool is_line) {
        corners_.clear();
        const auto count = static_cast<int64_t>(mesh_.positions.size());
        for (++p_, skip_gap(); !at_end_of_statement(); skip_gap()) {
            const int64_t number = scan_integer(p_).value;
            const int64_t index = number < 0 ? count + number : number - 1;
            if (index < 0 || index >= count) break;
            corners_.push_back(static_cast<uint32_t>(index));
            p_ = skip_token(p_);
        }
        if (mesh_.triangles.empty()) strokes_.append(source_, corners_, is_line);
        skip_statement();
    }

    /// The name after the word on the line, with the spaces within it.
    std::string name_after_word(const char* word) const {
        const char* const begin = skip_blanks(skip_token(word));
        const char* end = after_line(word);
        while (end > begin && (is_blank(end[-1]) || end[-1] == '\n')) {
            --end;
        }
        return {begin, std::max(begin, end)};
    }

    /// Returns the current material's group. A group begins to exist with its first face.
    uint32_t group() {
        if (!group_known_) {
            const auto next = static_cast<uint32_t>(mesh_.group_names.size());
            const auto [entry, is_new] = group_of_name_.try_emplace(material_, next);
            if (is_new) {
                mesh_.group_names.push_back(material_);
            }
            group_ = entry->second;
            group_known_ = true;
        }
        return group_;
    }

    void drop_single_group() {
        if (mesh_.group_names.size() == 1) {
            mesh_.triangle_group = {};
            if (mesh_.group_names[0].empty()) {
                mesh_.group_names = {};
            }
        }
    }

    /// Skips blanks, and a backslash that joins the next line to this one.
    void skip_gap() {
        p_ = skip_blanks(p_);
        while (*p_ == '\\' && ends_line(p_)) {
            p_ = skip_blanks(after_line(p_));
        }
    }

    /// The position after the end of the line that holds `p`.
    const char* after_line(const char* p) const {
        const void* const newline = std::memchr(p, '\n', static_cast<size_t>(source_.end() - p));
        return newline != nullptr ? static_cast<const char*>(newline) + 1 : source_.end();
    }

    bool at_end_of_statement() const { return *p_ == '\n' || *p_ == '\0' || *p_ == '#'; }

    void skip_line() { p_ = after_line(p_); }

    void skip_statement() {
        const char* line = p_;
        do {
            line = p_;
            skip_line();
        } while (p_ != source_.end() && ends_in_backslash(line, p_));
    }

    const MeshSource& source_;
    const char* p_;
    Mesh mesh_;
    ObjColors colors_;
    ObjStrokes strokes_;
    PolygonCutter cutter_;
    std::vector<uint32_t> corners_, normals_, uvs_;  ///< indices of the face's corners
    std::string material_;
    std::unordered_map<std::string, uint32_t> group_of_name_;
    uint32_t group_ = 0;
    bool group_known_ = false;
};

}  // namespace

Mesh parse_obj(const MeshSource& source) {
    if (is_utf16(source.bytes)) {
        const std::string text = utf8_of_utf16(source.bytes);
        return parse_obj({text, source.name});
    }
    source.require_text();
    return ObjParser(source).parse();
}

}  // namespace voxelume
