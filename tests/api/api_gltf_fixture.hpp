// SPDX-License-Identifier: Apache-2.0
// Common parts of tests of glTF files in place of scenes: the text of the scene made from a file.
#pragma once

#include <fstream>
#include <string>

#include "tests/api/api_fixture.hpp"
#include "tests/support/writers/gltf_writer.hpp"

namespace voxelume::v1 {

class ApiGltf : public ApiTest {
  protected:
    const CacheOptions no_cache{.enabled = false};

    std::string scene_of(const GltfWriter& writer, const ImportOptions& options = {}) const {
        std::ofstream(folder / "a.glb", std::ios::binary) << writer.glb();
        return import_file(folder / "a.glb", folder, options, {.enabled = false});
    }

    std::string with_material(const nlohmann::json& material) const {
        GltfWriter writer = triangle_gltf();
        writer.json["materials"] = nlohmann::json::array({material});
        writer.json["materials"][0]["name"] = "m";
        writer.json["meshes"][0]["primitives"][0]["material"] = 0;
        return scene_of(writer);
    }
};

}  // namespace voxelume::v1
