// SPDX-License-Identifier: Apache-2.0
// Macros of a kernel source, and the values of integer expressions with them.
#pragma once

#include <cstdint>
#include <functional>
#include <map>
#include <optional>
#include <set>
#include <string>
#include <string_view>
#include <vector>

namespace voxelume {

/// The constants of a compiler's options, -DNAME=VALUE, by name.
using SourceConstants = std::map<std::string, std::string, std::less<>>;

/// The macros that are defined at a line of a source.
class MacroTable {
  public:
    explicit MacroTable(const SourceConstants& constants);

    /// Takes what follows #define: a name, parameters in parentheses, and a body.
    /// Returns the name.
    std::string define(std::string_view text);
    /// Takes what follows #undef.
    void forget(std::string_view text);
    /// Takes what follows either in a condition that can't be decided.
    void doubt(std::string_view text);

    /// Tells whether a name is defined; nothing if that can't be told.
    std::optional<bool> is_defined(std::string_view text) const;

    /// The value of what follows #if; nothing if it depends on what isn't known.
    std::optional<int64_t> value(std::string_view expression) const;

    /// The value of a macro that stands for an integer expression with other macros, all of type
    /// int. Nothing for others.
    std::optional<int64_t> value_of_macro(std::string_view name) const;

    /// True if a macro was defined in two ways, or forgotten: what a name stands for depends on
    /// where it is used.
    bool changes() const { return changes_; }

  private:
    struct Macro {
        bool is_known = true, has_parameters = false;
        std::vector<std::string> parameters, body;  ///< the body in tokens
        bool operator==(const Macro&) const = default;
    };
    using Tokens = std::vector<std::string>;
    /// The names of macros that are being expanded, which must not be expanded again.
    using Hidden = std::set<std::string, std::less<>>;

    /// What a name of ours stands for that isn't defined: in a condition it is 0; elsewhere it may
    /// be defined before it is used.
    enum class Undefined : uint8_t { is_zero, is_unknown };

    Tokens expand(const Tokens& tokens, Undefined undefined, const Hidden& hidden) const;
    Tokens expand_macro(const Macro& macro, const Tokens& tokens, size_t& at) const;

    std::map<std::string, Macro, std::less<>> macros_;
    bool changes_ = false;
};

}  // namespace voxelume
