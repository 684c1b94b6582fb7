// SPDX-License-Identifier: Apache-2.0
// Parses glTF files that a test's writer makes.
#pragma once

#include <string>

#include "runtime/io/gltf/gltf_mesh.hpp"
#include "tests/support/file_fixture.hpp"
#include "tests/support/writers/gltf_writer.hpp"

namespace voxelume {

inline GltfFile parsed_gltf(const GltfWriter& writer) {
    return {writer.gltf(), "a.gltf"};
}

/// The reader's message about a file whose mesh it refuses.
inline std::string refusal_of_gltf(const GltfWriter& writer) {
    return error_of([&] { gltf_mesh(parsed_gltf(writer), 0); }).what();
}

}  // namespace voxelume
