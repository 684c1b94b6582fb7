// SPDX-License-Identifier: Apache-2.0
#include "cli/channels.hpp"

#include <algorithm>
#include <array>
#include <utility>

#include "cli/checks.hpp"

namespace voxelume::cli {
namespace {

constexpr std::array<std::pair<const char*, bool Channels::*>, 5> kNames = {
    {{"RGBA", &Channels::color},
     {"Z", &Channels::depth},
     {"P", &Channels::position},
     {"N", &Channels::normal},
     {"objectId", &Channels::object}}};

}  // namespace

Channels parse_channels(const std::string& text, const char* origin) {
    Channels channels{false, false, false, false, false};
    for (const std::string& name : listed({text})) {
        const auto found =
            std::ranges::find_if(kNames, [&](const auto& row) { return name == row.first; });
        if (found == kNames.end())
            fail_usage("{}: \"{}\" is none of Z, P, N, objectId and RGBA", origin, name);
        channels.*found->second = true;
    }
    return channels;
}

std::string channel_names(const Channels& channels) {
    std::string names;
    for (const auto& [name, member] : kNames)
        if (channels.*member) names += (names.empty() ? "" : ",") + std::string(name);
    return names;
}

}  // namespace voxelume::cli
