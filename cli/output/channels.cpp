// SPDX-License-Identifier: Apache-2.0
#include "cli/output/channels.hpp"

#include <algorithm>
#include <string>
#include <string_view>
#include <vector>

#include "cli/shared/checks.hpp"

namespace voxelume::cli {

Channels parse_channels(const std::string& text, const char* origin) {
    const auto rows = channel_table();
    Channels channels = kNoChannels;
    for (const std::string& name : listed({text})) {
        const auto found = std::ranges::find(rows, name, &ChannelRow::name);
        if (found == rows.end()) {
            for (const ChannelRow& row : rows)
                if (std::ranges::find(row.planes, std::string_view(name)) != row.planes.end())
                    fail_usage("{}: {} is written together with others; ask for {}", origin,
                               quote(name), row.name);
            std::vector<std::string_view> known;
            std::string names;
            for (const ChannelRow& row : rows) {
                known.push_back(row.name);
                names += (names.empty() ? "" : ", ") + std::string(row.name);
            }
            fail_usage("{}: {} is none of {}{}", origin, quote(name), names, suggest(name, known));
        }
        channels.*found->member = true;
    }
    return channels;
}

std::string channel_names(const Channels& channels) {
    std::string names;
    for (const ChannelRow& row : channel_table())
        if (channels.*row.member) names += (names.empty() ? "" : ",") + std::string(row.name);
    return names;
}

}  // namespace voxelume::cli
