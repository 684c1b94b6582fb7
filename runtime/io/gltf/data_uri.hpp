// SPDX-License-Identifier: Apache-2.0
// URIs of glTF files: data in base64, or the names of files.
#pragma once

#include <optional>
#include <string>
#include <string_view>

namespace voxelume {

/// The bytes of "data:...;base64,..."; empty for another encoding and for what is no base64.
std::optional<std::string> data_of_uri(std::string_view uri);

/// The name of a file in a URI, whose %20 and the like are decoded.
std::string name_of_uri(std::string_view uri);

}  // namespace voxelume
