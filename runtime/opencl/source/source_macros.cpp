// SPDX-License-Identifier: Apache-2.0
#include "runtime/opencl/source/source_macros.hpp"

#include <algorithm>
#include <array>
#include <charconv>

#include "runtime/opencl/source/source_parts.hpp"

namespace voxelume {
namespace {

/// An expression depends on what isn't known.
struct Undecided {};

std::vector<std::string> tokens_of(std::string_view text) {
    constexpr std::array<std::string_view, 8> kPairs = {
        "||", "&&", "==", "!=", "<=", ">=", "<<", ">>"};
    std::vector<std::string> tokens;
    while (!text.empty()) {
        size_t size = 0;
        while (size < text.size() && is_of_identifier(text[size])) ++size;
        if (size == 0) size = std::ranges::count(kPairs, text.substr(0, 2)) > 0 ? 2 : 1;
        if (text[0] != ' ' && text[0] != '\t') tokens.emplace_back(text.substr(0, size));
        text.remove_prefix(size);
    }
    return tokens;
}

bool is_identifier(std::string_view token) {
    return is_of_identifier(token[0]) && !is_decimal_digit(token[0]);
}

/// Evaluates tokens by the precedence of C's operators.
class Expression {
  public:
    explicit Expression(const std::vector<std::string>& tokens) : tokens_(tokens) {}

    int64_t value() {
        const int64_t all = choice();
        if (at_ < tokens_.size()) throw Undecided();
        return all;
    }

  private:
    std::string_view next() const {
        return at_ < tokens_.size() ? std::string_view(tokens_[at_]) : std::string_view();
    }

    void skip(std::string_view token) {
        if (next() != token) throw Undecided();
        ++at_;
    }

    int64_t choice() {
        const int64_t condition = binary(0);
        if (next() != "?") return condition;
        skip("?");
        const int64_t yes = choice();
        skip(":");
        const int64_t no = choice();
        return condition != 0 ? yes : no;
    }

    /// Operands of operators that bind more tightly than those of `level`.
    int64_t binary(size_t level) {
        constexpr std::array<std::array<std::string_view, 4>, 10> kOperators = {
            {{"||"},
             {"&&"},
             {"|"},
             {"^"},
             {"&"},
             {"==", "!="},
             {"<", ">", "<=", ">="},
             {"<<", ">>"},
             {"+", "-"},
             {"*"}}};
        if (level == kOperators.size()) return unary();
        int64_t left = binary(level + 1);
        while (!next().empty() && std::ranges::count(kOperators[level], next()) > 0) {
            const std::string_view sign = next();
            ++at_;
            left = checked(apply(sign, left, binary(level + 1)));
        }
        return left;
    }

    /// A number beyond 32 bits has another type than int, or is none.
    static int64_t checked(int64_t value) {
        if (value != int32_t(value)) throw Undecided();
        return value;
    }

    static int64_t apply(std::string_view sign, int64_t a, int64_t b) {
        if (sign == "||") return int64_t(a != 0 || b != 0);
        if (sign == "&&") return int64_t(a != 0 && b != 0);
        if (sign == "|") return a | b;
        if (sign == "^") return a ^ b;
        if (sign == "&") return a & b;
        if (sign == "==") return int64_t(a == b);
        if (sign == "!=") return int64_t(a != b);
        if (sign == "<") return int64_t(a < b);
        if (sign == ">") return int64_t(a > b);
        if (sign == "<=") return int64_t(a <= b);
        if (sign == ">=") return int64_t(a >= b);
        if (sign == "+") return a + b;
        if (sign == "-") return a - b;
        if (sign == "*") return a * b;
        if (b < 0 || b > 31) throw Undecided();
        return sign == "<<" ? a * (int64_t{1} << b) : a >> b;
    }

    int64_t unary() {
        const std::string_view token = next();
        if (token.empty()) throw Undecided();
        ++at_;
        if (token == "!") return int64_t(unary() == 0);
        if (token == "-") return checked(-unary());
        if (token == "~") return ~unary();
        if (token == "(") {
            const int64_t inner = choice();
            skip(")");
            return inner;
        }
        return number(token);
    }

    static int64_t number(std::string_view token) {
        const bool is_hex = token.starts_with("0x") || token.starts_with("0X");
        if (is_hex) token.remove_prefix(2);
        if (!is_hex && token.size() > 1 && token[0] == '0' && is_decimal_digit(token[1]))
            throw Undecided();  // an octal number
        const size_t digits = std::min(token.find_first_of("uUlL"), token.size());
        int32_t value = 0;
        const auto [end, error] =
            std::from_chars(token.data(), token.data() + digits, value, is_hex ? 16 : 10);
        if (error != std::errc() || end != token.data() + digits || digits == 0) throw Undecided();
        return value;
    }

    const std::vector<std::string>& tokens_;
    size_t at_ = 0;
};

/// The arguments of a macro whose opening parenthesis is token `at`, which becomes the closing one.
std::vector<std::vector<std::string>> arguments_of(const std::vector<std::string>& tokens,
                                                   size_t& at) {
    std::vector<std::vector<std::string>> arguments(1);
    int depth = 0;
    for (; at < tokens.size(); ++at) {
        const std::string& token = tokens[at];
        if (token == ")" && --depth == 0) return arguments;
        if (token == "," && depth == 1)
            arguments.emplace_back();
        else if (depth > 0)
            arguments.back().push_back(token);
        if (token == "(") ++depth;
    }
    throw Undecided();
}

/// True if tokens mean the same next to any operator: a single one, or all in parentheses.
bool is_operand(const std::vector<std::string>& tokens) {
    if (tokens.size() == 1) return true;
    if (tokens.front() != "(") return false;
    int depth = 0;
    for (size_t i = 0; i < tokens.size(); ++i) {
        if (tokens[i] == "(") ++depth;
        if (tokens[i] == ")" && --depth == 0) return i + 1 == tokens.size();
    }
    return false;
}

std::string first_word(std::string_view text) {
    const std::vector<std::string_view> words = identifiers(text);
    return words.empty() ? std::string() : std::string(words[0]);
}

}  // namespace

MacroTable::MacroTable(const SourceConstants& constants) {
    for (const auto& [name, value] : constants) macros_[name] = {true, false, {}, tokens_of(value)};
}

std::string MacroTable::define(std::string_view text) {
    const std::string name = first_word(text);
    text.remove_prefix(std::min(text.find(name) + name.size(), text.size()));
    Macro macro;
    if (text.starts_with('(')) {
        const size_t end = std::min(text.find(')'), text.size() - 1);
        macro.has_parameters = true;
        for (const std::string_view parameter : identifiers(text.substr(0, end)))
            macro.parameters.emplace_back(parameter);
        text.remove_prefix(end + 1);
    }
    macro.body = tokens_of(text);
    const auto [before, is_new] = macros_.try_emplace(name, macro);
    changes_ |= !is_new && before->second != macro;
    before->second = std::move(macro);
    return name;
}

void MacroTable::forget(std::string_view text) {
    changes_ |= macros_.erase(first_word(text)) > 0;
}

void MacroTable::doubt(std::string_view text) {
    macros_[first_word(text)].is_known = false;
}

std::optional<bool> MacroTable::is_defined(std::string_view text) const {
    const std::string name = first_word(text);
    const auto found = macros_.find(name);
    if (found != macros_.end()) return found->second.is_known ? std::optional(true) : std::nullopt;
    if (name.starts_with("VXL_") || name == "__cplusplus") return false;
    return std::nullopt;
}

/// Expands the macro whose name is token `at`, which becomes the last token of its call.
MacroTable::Tokens MacroTable::expand_macro(const Macro& macro, const Tokens& tokens,
                                            size_t& at) const {
    if (!macro.is_known) throw Undecided();
    if (!macro.has_parameters) return macro.body;
    if (++at == tokens.size() || tokens[at] != "(") throw Undecided();
    const std::vector<Tokens> arguments = arguments_of(tokens, at);
    if (arguments.size() != macro.parameters.size()) throw Undecided();
    Tokens expanded;
    for (const std::string& token : macro.body) {
        const auto parameter = std::ranges::find(macro.parameters, token);
        if (parameter == macro.parameters.end()) {
            expanded.push_back(token);
            continue;
        }
        const Tokens& argument = arguments[size_t(parameter - macro.parameters.begin())];
        expanded.insert(expanded.end(), argument.begin(), argument.end());
    }
    return expanded;
}

MacroTable::Tokens MacroTable::expand(const Tokens& tokens, Undefined undefined,
                                      const Hidden& hidden) const {
    Tokens expanded;
    for (size_t at = 0; at < tokens.size(); ++at) {
        const std::string& name = tokens[at];
        if (!is_identifier(name)) {
            expanded.push_back(name);
            continue;
        }
        const auto found = macros_.find(name);
        if (found == macros_.end() && undefined == Undefined::is_zero && name.starts_with("VXL_")) {
            expanded.emplace_back("0");
            continue;
        }
        if (found == macros_.end() || hidden.contains(name)) throw Undecided();
        Hidden within = hidden;
        within.insert(name);
        const Tokens body = expand(expand_macro(found->second, tokens, at), undefined, within);
        expanded.insert(expanded.end(), body.begin(), body.end());
    }
    return expanded;
}

std::optional<int64_t> MacroTable::value(std::string_view expression) const {
    try {
        const Tokens tokens = expand(tokens_of(expression), Undefined::is_zero, {});
        return Expression(tokens).value();
    } catch (const Undecided&) {
        return std::nullopt;
    }
}

std::optional<int64_t> MacroTable::value_of_macro(std::string_view name) const {
    const auto found = macros_.find(name);
    if (found == macros_.end() || !found->second.is_known || found->second.has_parameters)
        return std::nullopt;
    const Tokens& body = found->second.body;
    if (std::ranges::none_of(body, is_identifier) || !is_operand(body)) return std::nullopt;
    try {
        const Tokens tokens = expand(body, Undefined::is_unknown, {});
        const bool is_int = std::ranges::none_of(tokens, [](const std::string& token) {
            return token.find_first_of("uUlL") != std::string::npos;
        });
        return is_int ? std::optional(Expression(tokens).value()) : std::nullopt;
    } catch (const Undecided&) {
        return std::nullopt;
    }
}

}  // namespace voxelume
