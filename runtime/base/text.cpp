// SPDX-License-Identifier: Apache-2.0
#include "runtime/base/text.hpp"

#include <algorithm>
#include <cctype>
#include <numeric>
#include <vector>

namespace voxelume {
namespace {

/// Number of letters to add, drop, change or swap with a neighbour, whatever their case (Damerau
/// 1964).
size_t edit_distance(std::string_view a, std::string_view b) {
    const auto same = [](char p, char q) {
        return std::tolower(static_cast<unsigned char>(p)) ==
               std::tolower(static_cast<unsigned char>(q));
    };
    std::vector<size_t> before_last(b.size() + 1), last(b.size() + 1), row(b.size() + 1);
    std::iota(row.begin(), row.end(), size_t{0});
    for (size_t i = 1; i <= a.size(); ++i) {
        before_last.swap(last);
        last.swap(row);
        row[0] = i;
        for (size_t j = 1; j <= b.size(); ++j) {
            const size_t change = last[j - 1] + (same(a[i - 1], b[j - 1]) ? 0 : 1);
            row[j] = std::min({last[j] + 1, row[j - 1] + 1, change});
            if (i > 1 && j > 1 && same(a[i - 1], b[j - 2]) && same(a[i - 2], b[j - 1])) {
                row[j] = std::min(row[j], before_last[j - 2] + 1);
            }
        }
    }
    return row[b.size()];
}

}  // namespace

std::string quote(std::string_view text) {
    constexpr size_t kLongest = 60;
    std::string quoted = "\"";
    for (const char c : text.substr(0, kLongest)) {
        quoted += static_cast<unsigned char>(c) < 0x20 || c == 0x7F ? '?' : c;
    }
    return quoted + (text.size() > kLongest ? "...\"" : "\"");
}

std::string with_article(std::string_view name) {
    const bool is_vowel =
        !name.empty() && std::string_view("aeiouAEIOU").find(name.front()) != name.npos;
    return (is_vowel ? "an " : "a ") + quote(name);
}

std::string ending_of(const std::filesystem::path& file) {
    std::string ending = file.extension().string();
    std::ranges::transform(ending, ending.begin(),
                           [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
    return ending;
}

std::string suggest(std::string_view text, std::span<const std::string_view> names) {
    constexpr size_t kLongest = 60;  // bounds the work for names that are no names
    size_t nearest = text.size() <= kLongest ? std::max<size_t>(2, text.size() / 2) : 0;
    std::string_view best;
    for (const std::string_view name : names) {
        if (text.empty() || name.size() > kLongest) continue;
        const size_t distance = edit_distance(text, name);
        if (distance < nearest) {
            nearest = distance;
            best = name;
        }
    }
    if (!best.empty()) return "; did you mean " + quote(best) + "?";
    constexpr size_t kMaxListed = 14;
    if (names.empty() || names.size() > kMaxListed) return "";
    std::string list;
    for (const std::string_view name : names) list += (list.empty() ? "" : ", ") + quote(name);
    return "; known are " + list;
}

}  // namespace voxelume
