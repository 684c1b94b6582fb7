// SPDX-License-Identifier: Apache-2.0
#include "runtime/opencl/source/source_parts.hpp"

#include <algorithm>
#include <utility>

namespace voxelume {

bool is_decimal_digit(char c) {
    return c >= '0' && c <= '9';
}

bool is_of_identifier(char c) {
    return is_decimal_digit(c) || c == '_' || (c >= 'A' && c <= 'Z') || (c >= 'a' && c <= 'z');
}

namespace {

bool is_space(char c) {
    return c == ' ' || (c >= '\t' && c <= '\r');
}

/// A directive that isn't one of a condition.
SourcePart plain_directive(std::string line) {
    const std::vector<std::string_view> words = identifiers(line);
    SourcePart part;
    if (words.size() > 1 && words[0] == "define") {
        part.names.emplace_back(words[1]);
        part.is_macro = true;
        const auto end = size_t(words[1].data() + words[1].size() - line.data());
        part.is_called = end < line.size() && line[end] == '(';
    }
    part.text = std::move(line);
    return part;
}

/// A condition that can't be decided. Macros alone are needed where one of them is.
SourcePart condition(std::string text) {
    SourcePart part;
    bool has_others = false;
    for (std::string_view left = text; !left.empty();) {
        const std::string_view line = left.substr(0, left.find('\n'));
        left.remove_prefix(std::min(line.size() + 1, left.size()));
        const std::vector<std::string_view> words = identifiers(line);
        if (line.starts_with("#define") && words.size() > 1) part.names.emplace_back(words[1]);
        has_others |= !line.starts_with('#') && !words.empty();
    }
    if (has_others) part.names.clear();
    part.is_macro = true;
    part.text = std::move(text);
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

/// The names that a type or a constant has: its own, that behind `struct`, and for an enumeration
/// whatever it names. Empty for declarations of several names or none.
std::vector<std::string> names_of_declaration(std::string_view text, std::string_view outer) {
    const std::vector<std::string_view> all = identifiers(text);
    if (std::ranges::find(all, "enum") != all.end()) {
        std::vector<std::string> every(all.begin(), all.end());
        std::erase_if(every, [](const auto& word) { return word == "enum" || word == "typedef"; });
        return every;
    }
    const std::vector<std::string_view> words =
        identifiers(outer.substr(0, outer.find_first_of("[=")));
    if (words.size() < 2 || outer.find(',') != std::string_view::npos) return {};
    const bool has_value = outer.find('=') != std::string_view::npos;
    if (words[0] != "typedef" && !has_value) return {};
    std::vector<std::string> names = {std::string(words.back())};
    for (size_t i = 0; i + 2 < words.size(); ++i)
        if (words[i] == "struct" || words[i] == "union") names.emplace_back(words[i + 1]);
    return names;
}

bool is_macro_call(std::string_view outer) {
    const size_t mark = std::min(outer.find('('), outer.size());
    return mark < outer.size() && identifiers(outer.substr(0, mark)).size() == 1;
}

SourcePart declaration(std::string text) {
    SourcePart part;
    const std::string outer = outline(text);
    if (is_function(outer)) {
        const std::vector<std::string_view> words =
            identifiers(std::string_view(outer).substr(0, outer.find('(')));
        part.names.emplace_back(words.back());
        part.is_kernel = std::ranges::find(words, "kernel") != words.end();
        part.is_called = true;
    } else if (auto names = names_of_declaration(text, outer); !names.empty()) {
        part.names = std::move(names);
    } else if (const auto words = identifiers(text); words.size() > 1 && is_macro_call(outer)) {
        part.macro = words[0];
        part.argument = words[1];
    }
    part.text = std::move(text);
    return part;
}

/// True if a declaration ends after `text`, whose last character is `last` outside of parentheses
/// and braces.
bool is_whole(std::string_view text, char last) {
    return last == ';' || (last == '}' && is_function(outline(text)));
}

/// Divides the lines of a source into parts.
class PartReader {
  public:
    void take(std::string_view line) {
        const bool is_directive = line.starts_with('#');
        if (conditions_ > 0 || (text_.empty() && line.starts_with("#if"))) {
            take_condition(line);
        } else if (is_directive && text_.empty()) {
            parts_.push_back(plain_directive(std::string(line)));
        } else if (is_directive) {
            text_.append(line).append("\n");  // the line is inside a declaration
        } else {
            for (const char c : line) take(c);
            take('\n');
        }
    }

    std::vector<SourcePart> parts() && {
        if (!text_.empty()) parts_.push_back(declaration(std::move(text_)));
        return std::move(parts_);
    }

  private:
    void take_condition(std::string_view line) {
        text_.append(line);
        if (line.starts_with("#if")) ++conditions_;
        if (line.starts_with("#endif")) --conditions_;
        if (conditions_ == 0)
            parts_.push_back(condition(std::exchange(text_, {})));
        else
            text_ += '\n';
    }

    void take(char c) {
        if (text_.empty() && is_space(c)) return;
        text_ += c;
        if (c == '(' || c == '{') ++depth_;
        if (c == ')' || c == '}') --depth_;
        if (depth_ == 0 && is_whole(text_, c))
            parts_.push_back(declaration(std::exchange(text_, {})));
    }

    std::vector<SourcePart> parts_;
    std::string text_;    ///< of the part that has begun
    int depth_ = 0;       ///< parentheses and braces that are open
    int conditions_ = 0;  ///< conditions that are open outside of declarations
};

/// True if an identifier that stands behind `before` is a variable that is declared there: a type
/// is before it, or a pointer's mark that clings to a type.
bool follows_type(std::string_view before) {
    size_t end = before.size();
    while (end > 0 && is_space(before[end - 1])) --end;
    if (end == before.size() || end == 0) return false;
    if (before[end - 1] == '*') return end > 1 && is_of_identifier(before[end - 2]);
    if (!is_of_identifier(before[end - 1])) return false;
    size_t start = end;
    while (start > 0 && is_of_identifier(before[start - 1])) --start;
    const std::string_view word = before.substr(start, end - start);
    constexpr std::string_view kNoTypes[] = {"return", "else", "case", "goto", "sizeof", "define"};
    return !is_decimal_digit(word[0]) && std::ranges::find(kNoTypes, word) == std::end(kNoTypes);
}

}  // namespace

std::vector<SourcePart> source_parts(std::string_view resolved) {
    PartReader reader;
    for (std::string_view left = resolved; !left.empty();) {
        const size_t end = std::min(left.find('\n'), left.size());
        reader.take(left.substr(0, end));
        left.remove_prefix(std::min(end + 1, left.size()));
    }
    return std::move(reader).parts();
}

std::vector<Mention> mentions(std::string_view text) {
    std::vector<Mention> found;
    for (const std::string_view word : identifiers(text)) {
        const auto start = size_t(word.data() - text.data());
        const std::string_view before = text.substr(0, start);
        size_t next = start + word.size();
        while (next < text.size() && is_space(text[next])) ++next;
        const std::string_view behind = text.substr(next);
        const bool is_listed =
            before.ends_with(", ") && (behind.starts_with("= ") || behind.starts_with(';'));
        found.push_back({word, before.ends_with('.') || before.ends_with("->"),
                         behind.starts_with('('), is_listed || follows_type(before)});
    }
    return found;
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
