// SPDX-License-Identifier: Apache-2.0
#include "runtime/image/image.hpp"

#include <charconv>

namespace voxelume {

double pixel_aspect_in(const std::map<std::string, std::string>& attributes) {
    const auto found = attributes.find(kPixelAspect);
    double aspect = 1;
    if (found == attributes.end()) return aspect;
    const std::string& text = found->second;
    std::from_chars(text.data(), text.data() + text.size(), aspect);
    return aspect;
}

}  // namespace voxelume
