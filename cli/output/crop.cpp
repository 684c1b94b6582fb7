// SPDX-License-Identifier: Apache-2.0
#include "cli/output/crop.hpp"

#include <array>
#include <cstdio>

#include "cli/shared/checks.hpp"

namespace voxelume::cli {

ImagePart part_of(const std::string& text, const Scene& scene) {
    if (text.empty()) return {{0, 0}, scene.size()};
    std::array<int, 4> part{};
    char rest = 0;
    if (std::sscanf(text.c_str(), "%6d,%6d,%6d,%6d%c", &part[0], &part[1], &part[2], &part[3],
                    &rest) != 4)
        fail_usage("render: --crop {}: give X,Y,WIDTH,HEIGHT in pixels, as in 0,0,320,240", text);
    const ImagePart result{{part[0], part[1]}, {part[2], part[3]}};
    try {
        static_cast<void>(scene.with_crop(result.first, result.size));
    } catch (const Error& error) {
        fail_usage("render: --crop {}: {}", text, error.what());
    }
    return result;
}

}  // namespace voxelume::cli
