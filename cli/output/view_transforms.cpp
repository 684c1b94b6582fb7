// SPDX-License-Identifier: Apache-2.0
#include "cli/output/view_transforms.hpp"

#include <algorithm>
#include <array>
#include <utility>

#include "cli/shared/checks.hpp"

namespace voxelume::cli {
namespace {

constexpr std::array kTransforms = {std::pair{std::string_view("srgb"), ViewTransform::srgb},
                                    std::pair{std::string_view("none"), ViewTransform::none},
                                    std::pair{std::string_view("filmic"), ViewTransform::filmic},
                                    std::pair{std::string_view("agx"), ViewTransform::agx}};

}  // namespace

ViewTransform parse_view_transform(const std::string& text, const char* origin) {
    return choose(text, kTransforms, origin);
}

std::string_view name_of(ViewTransform transform) {
    return std::ranges::find(kTransforms, transform, [](const auto& row) { return row.second; })
        ->first;
}

}  // namespace voxelume::cli
