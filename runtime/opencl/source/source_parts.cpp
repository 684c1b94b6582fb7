// SPDX-License-Identifier: Apache-2.0
#include "runtime/opencl/source/source_parts.hpp"

#include <algorithm>
#include <utility>

namespace voxelume {
namespace {

bool is_decimal_digit(char c) {
    return c >= '0' && c <= '9';
}

bool is_of_identifier(char c) {
    return is_decimal_digit(c) || c == '_' || (c >= 'A' && c <= 'Z') || (c >= 'a' && c <= 'z');
}

bool is_space(char c) {
    return c == ' ' || (c >= '\t' && c <= '\r');
}

/// The words after `#` of a directive.
SourcePart directive(std::string line) {
    const std::vector<std::string_view> words = identifiers(line);
    const std::string_view word = words.empty() ? std::string_view() : words[0];
    SourcePart part;
    if (word == "endif") part.kind = SourcePart::Kind::condition_end;
    if (word.starts_with("if")) part.kind = SourcePart::Kind::condition;
    if (word.starts_with("el")) part.kind = SourcePart::Kind::branch;
    if (word == "define" && words.size() > 1) part.name = words[1];
    part.text = std::move(line);
    return part;
}

/// `text` with blanks instead of the content of parentheses and braces, and of the words of
/// attributes.
std::string outline(std::string_view text) {
    std::string outer;
    int depth = 0;
    for (const char c : text) {
        if (c == ')' || c == '}') --depth;
        outer += depth == 0 ? c : ' ';
        if (c == '(' || c == '{') ++depth;
    }
    constexpr std::string_view kAttribute = "__attribute__";
    for (size_t at = outer.find(kAttribute); at != std::string::npos; at = outer.find(kAttribute)) {
        const size_t end = outer.find(')', at);
        std::fill(outer.begin() + std::ptrdiff_t(at),
                  end == std::string::npos ? outer.end() : outer.begin() + std::ptrdiff_t(end) + 1,
                  ' ');
    }
    return outer;
}

/// True if the outline of a declaration is that of a function, whose name then is the last word
/// before its parameters. A macro call at the top has no type before its name, so it isn't a
/// function.
bool is_function(std::string_view outer) {
    const size_t mark = outer.find_first_of("({=;");
    if (mark == std::string_view::npos || outer[mark] != '(') return false;
    const std::vector<std::string_view> words = identifiers(outer.substr(0, mark));
    return words.size() > 1 && words[0] != "typedef";
}

/// The name of a type or a constant; empty for declarations of several names or none.
std::string name_of_declaration(std::string_view outer) {
    const std::vector<std::string_view> words =
        identifiers(outer.substr(0, outer.find_first_of("[=")));
    if (words.size() < 2 || outer.find(',') != std::string_view::npos) return {};
    const bool has_value = outer.find('=') != std::string_view::npos;
    return words[0] == "typedef" || has_value ? std::string(words.back()) : std::string();
}

SourcePart declaration(std::string text) {
    SourcePart part;
    const std::string outer = outline(text);
    if (is_function(outer)) {
        const std::vector<std::string_view> words =
            identifiers(std::string_view(outer).substr(0, outer.find('(')));
        part.name = words.back();
        part.is_kernel = std::ranges::find(words, "kernel") != words.end();
    } else {
        part.name = name_of_declaration(outer);
    }
    part.text = std::move(text);
    return part;
}

/// True if a declaration ends after `text`, whose last character is `last` outside of parentheses
/// and braces.
bool is_whole(std::string_view text, char last) {
    return last == ';' || (last == '}' && is_function(outline(text)));
}

/// `source` without comments, with lines that end in a backslash joined to the next.
std::string without_comments(std::string_view source) {
    std::string text;
    text.reserve(source.size());
    while (!source.empty()) {
        size_t skipped = 0;
        if (source.starts_with("//"))
            skipped = std::min(source.find('\n'), source.size());
        else if (source.starts_with("/*"))
            skipped = std::min(source.find("*/", 2), source.size() - 2) + 2;
        else if (source.starts_with("\\\n"))
            skipped = 2;
        if (skipped == 0) text += source[0];
        source.remove_prefix(std::max<size_t>(skipped, 1));
    }
    return text;
}

/// `source` without code under `#ifdef __cplusplus`.
std::string without_cplusplus(std::string_view source) {
    std::string text;
    int skipped_depth = 0;  // conditions around a line that is for C++
    while (!source.empty()) {
        const size_t end = std::min(source.find('\n'), source.size() - 1) + 1;
        const std::string_view line = source.substr(0, end);
        source.remove_prefix(end);
        if (skipped_depth > 0 && line.starts_with("#endif")) --skipped_depth;
        if (skipped_depth == 0 && line.starts_with("#ifdef __cplusplus")) {
            text += "#if 1\n";
            skipped_depth = 1;
        } else if (skipped_depth == 0) {
            text += line;
        } else if (line.starts_with("#else") && skipped_depth == 1) {
            skipped_depth = 0;
        } else if (line.starts_with("#if")) {
            ++skipped_depth;
        }
    }
    return text;
}

}  // namespace

std::vector<SourcePart> source_parts(std::string_view whole) {
    const std::string own = without_cplusplus(without_comments(whole));
    std::string_view source = own;
    std::vector<SourcePart> parts;
    std::string text;
    int depth = 0;
    bool at_line_start = true;
    while (!source.empty()) {
        const char c = source[0];
        if (at_line_start && c == '#') {
            const size_t end = std::min(source.find('\n'), source.size());
            const std::string_view line = source.substr(0, end);
            source.remove_prefix(end);
            if (line.starts_with("#line")) continue;
            if (text.empty())
                parts.push_back(directive(std::string(line)));
            else
                text += line;  // the line is inside a declaration
            continue;
        }
        source.remove_prefix(1);
        at_line_start = c == '\n' || (at_line_start && is_space(c));
        if (text.empty() && is_space(c)) continue;
        text += c;
        if (c == '(' || c == '{') ++depth;
        if (c == ')' || c == '}') --depth;
        if (depth > 0 || !is_whole(text, c)) continue;
        parts.push_back(declaration(std::exchange(text, {})));
    }
    if (!text.empty()) parts.push_back(declaration(std::move(text)));
    return parts;
}

std::vector<std::string_view> identifiers(std::string_view text) {
    std::vector<std::string_view> found;
    for (size_t at = 0; at < text.size();) {
        const size_t start = at;
        while (at < text.size() && is_of_identifier(text[at])) ++at;
        if (at > start && !is_decimal_digit(text[start]))
            found.push_back(text.substr(start, at - start));
        if (at == start) ++at;
    }
    return found;
}

}  // namespace voxelume
