// SPDX-License-Identifier: Apache-2.0
#include "runtime/opencl/source/source_conditions.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <optional>
#include <vector>

#include "runtime/opencl/source/source_parts.hpp"

namespace voxelume {
namespace {

/// `source` without comments, with lines that end in a backslash joined to the next.
std::string without_comments(std::string_view source) {
    std::string text;
    text.reserve(source.size());
    while (!source.empty()) {
        size_t plain = 0;
        while (plain < source.size() && source[plain] != '/' && source[plain] != '\\') ++plain;
        text += source.substr(0, plain);
        source.remove_prefix(plain);
        size_t skipped = 0;
        if (source.starts_with("//"))
            skipped = std::min(source.find('\n'), source.size());
        else if (source.starts_with("/*"))
            skipped = std::min(source.find("*/", 2), source.size() - 2) + 2;
        else if (source.starts_with("\\\n"))
            skipped = 2;
        if (skipped == 0) text += source.substr(0, 1);
        if (source.starts_with("/*")) text += ' ';
        source.remove_prefix(std::min(std::max<size_t>(skipped, 1), source.size()));
    }
    return text;
}

/// A line that begins with `#`: its first word, and what follows.
struct Directive {
    std::string_view word, rest;
    bool opens() const { return word.starts_with("if"); }
    bool closes() const { return word == "endif"; }
    std::string text() const { return fmt::format("#{}{}", word, rest); }
};

std::optional<Directive> directive(std::string_view line) {
    constexpr std::string_view kBlanks = " \t";
    line.remove_prefix(std::min(line.find_first_not_of(kBlanks), line.size()));
    if (!line.starts_with('#')) return std::nullopt;
    line.remove_prefix(1);
    line.remove_prefix(std::min(line.find_first_not_of(kBlanks), line.size()));
    size_t end = 0;
    while (end < line.size() && is_of_identifier(line[end])) ++end;
    return Directive{line.substr(0, end), line.substr(end)};
}

/// Goes through the lines of a source and keeps those that a compiler would see.
class Conditions {
  public:
    explicit Conditions(const SourceConstants& constants) : macros_(constants) {}

    void take(std::string_view line) {
        const std::optional<Directive> found = directive(line);
        if (undecided_depth_ > 0) return take_undecided(line, found);
        if (found && (found->opens() || found->closes() || found->word.starts_with("el")))
            return take_condition(*found);
        if (!is_active() || (found && found->word == "line")) return;
        if (found && found->word == "define") return take_definition(found->rest);
        if (found && found->word == "undef") macros_.forget(found->rest);
        keep(line, found);
    }

    ResolvedSource resolved() && { return {std::move(text_), macros_.changes()}; }

  private:
    /// A condition around the line at hand.
    struct Level {
        bool was_taken;  ///< one of its branches so far, or nothing in it is seen
        bool is_active;
    };

    bool is_active() const {
        return std::ranges::all_of(levels_, [](const Level& level) { return level.is_active; });
    }

    /// A macro that stands for a number is defined as that, so that a text which has it doesn't
    /// depend on the constants that decide it.
    void take_definition(std::string_view rest) {
        const std::string name = macros_.define(rest);
        const std::optional<int64_t> value = macros_.value_of_macro(name);
        if (!value) return keep(fmt::format("#define{}", rest));
        const auto number = *value < 0 ? fmt::format("({})", *value) : fmt::format("{}", *value);
        keep(fmt::format("#define {} {}", name, number));
    }

    /// A directive begins its line.
    void keep(std::string_view line, const std::optional<Directive>& found) {
        if (found)
            keep(found->text());
        else
            keep(line);
    }

    void keep(std::string_view line) { text_.append(line).append("\n"); }

    /// A line of a condition that can't be decided. What it defines may or may not be defined.
    void take_undecided(std::string_view line, const std::optional<Directive>& found) {
        keep(line, found);
        if (!found) return;
        if (found->opens()) ++undecided_depth_;
        if (found->closes()) --undecided_depth_;
        if (found->word == "define" || found->word == "undef") macros_.doubt(found->rest);
    }

    void take_condition(const Directive& found) {
        if (found.opens()) return open(found);
        if (levels_.empty()) return keep(found.text());  // an end without a beginning
        if (found.closes()) return levels_.pop_back();
        Level& level = levels_.back();
        level.is_active = false;
        if (level.was_taken) return;
        if (found.word == "else") {
            level = {true, true};
            return;
        }
        levels_.pop_back();
        decide(macros_.value(found.rest), fmt::format("#if{}", found.rest));
    }

    void open(const Directive& found) {
        if (!is_active()) {
            levels_.push_back({true, false});
            return;
        }
        std::optional<int64_t> value;
        if (found.word == "if")
            value = macros_.value(found.rest);
        else if (const std::optional<bool> is_defined = macros_.is_defined(found.rest))
            value = *is_defined == (found.word == "ifdef");
        decide(value, found.text());
    }

    void decide(const std::optional<int64_t>& value, std::string_view line) {
        if (value) return levels_.push_back({*value != 0, *value != 0});
        undecided_depth_ = 1;
        keep(line);
    }

    MacroTable macros_;
    std::vector<Level> levels_;
    int undecided_depth_ = 0;  ///< conditions around the line that stay
    std::string text_;
};

}  // namespace

ResolvedSource resolve_conditions(std::string_view source, const SourceConstants& constants) {
    const std::string whole = without_comments(source);
    Conditions conditions(constants);
    for (std::string_view left = whole; !left.empty();) {
        const size_t end = std::min(left.find('\n'), left.size());
        conditions.take(left.substr(0, end));
        left.remove_prefix(std::min(end + 1, left.size()));
    }
    return std::move(conditions).resolved();
}

}  // namespace voxelume
