// SPDX-License-Identifier: Apache-2.0
#include "runtime/io/image/exr_layers.hpp"

#include <algorithm>
#include <tuple>

namespace voxelume {
namespace {

// Nuke's names of layers. Their parts come first, since some programs show the first part alone.
constexpr const char* kColor = "rgba";
constexpr const char* kDepth = "depth";

/// The order in which parts are sorted.
auto rank_of(const ExrPart& part) {
    return std::tuple(part.name != kColor, part.name != kDepth, std::string_view(part.name));
}

}  // namespace

std::string exr_layer_of(std::string_view channel) {
    if (channel == "R" || channel == "G" || channel == "B" || channel == "A") return kColor;
    if (channel == "Z") return kDepth;
    return std::string(channel.substr(0, channel.rfind('.')));
}

std::vector<ExrPart> parts_by_layer(const std::vector<ExrPlane>& planes) {
    std::vector<ExrPart> parts;
    for (const ExrPlane& plane : planes) {
        const std::string layer = exr_layer_of(plane.name);
        auto part = std::ranges::find(parts, layer, &ExrPart::name);
        if (part == parts.end()) part = parts.insert(parts.end(), {layer, {}});
        part->planes.push_back(plane);
    }
    std::ranges::sort(parts, {}, rank_of);
    return parts;
}

std::string_view matte_of_layer(std::string_view layer) {
    constexpr size_t kDigits = 2;
    if (!layer.starts_with("Crypto") || layer.size() < kDigits) return {};
    const std::string_view digits = layer.substr(layer.size() - kDigits);
    const bool is_ranked = digits.find_first_not_of("0123456789") == digits.npos;
    return is_ranked ? layer.substr(0, layer.size() - kDigits) : std::string_view{};
}

}  // namespace voxelume
