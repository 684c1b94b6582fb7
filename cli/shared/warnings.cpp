// SPDX-License-Identifier: Apache-2.0
#include "cli/shared/warnings.hpp"

#include <fmt/format.h>

#include <filesystem>
#include <utility>

#include "cli/shared/tell.hpp"

namespace voxelume::cli {

std::string harmless_line(std::string text) {
    for (char& c : text)
        if (static_cast<unsigned char>(c) < 0x20 || c == 0x7f) c = '?';
    return text;
}

void print_warning(const Warning& warning) {
    tell("warning: {}\n", harmless_line(fmt::format("{}: {}", warning.where, warning.text)));
}

std::function<void(const Warning&)> warning_printer(bool strict, std::function<void()> before) {
    return [is_said_later = strict, before = std::move(before)](const Warning& warning) mutable {
        if (std::exchange(is_said_later, false)) return;
        before();
        print_warning(warning);
    };
}

void tell_warnings(const std::vector<Warning>& warnings, bool quiet, bool strict) {
    for (size_t i = strict ? 1 : 0; i < warnings.size() && !quiet; ++i) print_warning(warnings[i]);
    if (!strict || warnings.empty()) return;
    const size_t count = warnings.size();
    const std::string more = count > 1 ? fmt::format(" (the first of {} warnings)", count) : "";
    throw Error(ErrorKind::scene,
                fmt::format("{}: {}{}", warnings[0].where, warnings[0].text, more));
}

void tell_unread_bases(bool quiet) {
    if (quiet) return;
    for (const std::filesystem::path& base : user_cache_bases())
        if (const std::string refusal = cache_base_refusal(base); !refusal.empty())
            tell("note: {}\n", harmless_line(fmt::format("{}, a base of the cache, isn't read: {}",
                                                         base.string(), refusal)));
}

}  // namespace voxelume::cli
