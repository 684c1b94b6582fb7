// SPDX-License-Identifier: Apache-2.0
// Channels of an image -> the parts of an OpenEXR file that hold one layer each.
#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "runtime/io/image/exr_chunks.hpp"

namespace voxelume {

/// A part of a file: its name, and its channels in the order of their names.
struct ExrPart {
    std::string name;  ///< empty for the only part of a file
    std::vector<ExrPlane> planes;
};

/// The name of the layer that a channel is in, by which parts are named: "rgba" for R, G, B and A,
/// "depth" for Z, "N" for N.X, and the channel's own name where it has no other.
std::string exr_layer_of(std::string_view channel);

/// A part for each layer: "rgba" first, then "depth", then the others by name. `planes` are in the
/// order of their names.
std::vector<ExrPart> parts_by_layer(const std::vector<ExrPlane>& planes);

/// The name of the matte, such as "CryptoObject", whose channels are in a layer "CryptoObject00";
/// empty for other layers.
std::string_view matte_of_layer(std::string_view layer);

}  // namespace voxelume
