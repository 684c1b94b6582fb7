// SPDX-License-Identifier: Apache-2.0
#include "runtime/io/arrays/nrrd_fields.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdlib>

namespace voxelume {
namespace {

constexpr uint64_t kMaxNrrdHeader = uint64_t{1} << 20;

std::string_view trimmed(std::string_view text) {
    const size_t first = text.find_first_not_of(" \t\r");
    if (first == std::string_view::npos) return {};
    return text.substr(first, text.find_last_not_of(" \t\r") - first + 1);
}

double number_of(const std::string& word) {
    char* end = nullptr;
    const double value = std::strtod(word.c_str(), &end);
    return end == word.c_str() || *end != '\0' ? NAN : value;
}

bool is_data_file(std::string_view field) {
    return field == "data file" || field == "datafile";
}

}  // namespace

void NrrdFields::refuse_several(const InputFile& file) {
    file.refuse("its data are in several files; join them to one");
}

NrrdFields::NrrdFields(const InputFile& file) {
    std::string start(std::min(file.size(), kMaxNrrdHeader), '\0');
    file.read(0, start.data(), start.size());
    if (!start.starts_with("NRRD000")) file.refuse("not a NRRD file");
    size_t at = start.find('\n');
    // An empty line ends the header; that of a file without data may end with the file.
    while (at != std::string::npos && at + 1 < start.size()) {
        const size_t line_end = start.find('\n', at + 1);
        const bool is_last = line_end == std::string::npos;
        if (is_last && file.size() > start.size()) break;
        const std::string_view line =
            trimmed(std::string_view(start).substr(at + 1, is_last ? line_end : line_end - at - 1));
        at = is_last ? start.size() : line_end;
        end_ = is_last ? at : at + 1;
        if (line.empty()) return;
        if (line[0] == '#') continue;
        const size_t colon = line.find(':');
        if (colon == std::string_view::npos || colon + 1 >= line.size())
            file.refuse("a line of its header has no value");
        const bool is_key = line[colon + 1] == '=';
        const std::string name(trimmed(line.substr(0, colon))),
            value(trimmed(line.substr(colon + (is_key ? 2 : 1))));
        (is_key ? keys_ : fields_)[name] = value;
        // The lines behind a list are the names of files.
        if (!is_key && is_data_file(name) && value.starts_with("LIST")) refuse_several(file);
    }
    if (end_ < file.size() || fields_.empty())
        file.refuse("its header has no end; it is truncated");
}

std::string NrrdFields::text(std::string_view name) const {
    const auto found = fields_.find(name);
    return found == fields_.end() ? std::string() : found->second;
}

std::vector<std::string> NrrdFields::words(std::string_view name) const {
    std::vector<std::string> words;
    std::string word;
    bool is_quoted = false;
    int depth = 0;
    for (const char c : text(name) + " ") {
        if (c == '"') is_quoted = !is_quoted;
        if (c == '(') ++depth;
        if (c == ')') --depth;
        if (!is_quoted && depth <= 0 && (c == ' ' || c == '\t')) {
            if (!word.empty()) words.push_back(word);
            word.clear();
        } else if (c != '"') {
            word += c;
        }
    }
    return words;
}

std::vector<double> NrrdFields::numbers(std::string_view name) const {
    std::vector<double> numbers;
    for (const std::string& word : words(name)) numbers.push_back(number_of(word));
    return numbers;
}

std::optional<glm::dvec3> NrrdFields::vector(std::string_view word) {
    if (word.size() < 2 || word.front() != '(' || word.back() != ')') return {};
    std::array<std::string, 3> parts;
    size_t part = 0;
    for (const char c : word.substr(1, word.size() - 2)) {
        if (c == ',' && ++part == parts.size()) return {};
        if (c != ',' && c != ' ') parts[part] += c;
    }
    const glm::dvec3 v(number_of(parts[0]), number_of(parts[1]), number_of(parts[2]));
    if (!std::isfinite(v.x + v.y + v.z)) return {};
    return v;
}

}  // namespace voxelume
