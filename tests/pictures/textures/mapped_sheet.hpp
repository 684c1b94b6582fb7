// SPDX-License-Identifier: Apache-2.0
// A sheet or slab with maps, seen at an angle, above a floor that exists only if it is asked for.
#pragma once

#include <glm/mat4x4.hpp>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "runtime/io/image/png.hpp"
#include "runtime/scene_file/read_scene.hpp"
#include "tests/pictures/textures/map_pictures.hpp"
#include "tests/support/file_fixture.hpp"
#include "tests/support/writers/gltf_writer.hpp"

namespace voxelume {

using Json = nlohmann::json;

class MappedSheetTest : public FileTest {
  protected:
    explicit MappedSheetTest(const char* surface) : surface_(surface) {}

    /// Gives the mesh of a file a material with pictures, which repeat unless they are clamped.
    static void add_maps(GltfWriter& writer, const std::vector<oracle::Picture>& pictures,
                         const Json& material) {
        for (size_t k = 0; k < pictures.size(); ++k) {
            const std::string png = GltfWriter::base64(png_bytes(image_of(pictures[k]), {}));
            const bool clamps = pictures[k].beyond_u == oracle::Beyond::clamp;
            writer.json["images"].push_back({{"uri", "data:image/png;base64," + png}});
            writer.json["textures"].push_back({{"source", k}, {"sampler", clamps ? 1 : 0}});
        }
        writer.json["samplers"] = {{{"wrapS", 10497}, {"wrapT", 10497}},
                                   {{"wrapS", 33071}, {"wrapT", 33071}}};
        writer.json["materials"] = nlohmann::json::array({material});
    }

    Scene scene_of(const std::string& mesh, const Json& material, const std::string& light,
                   const Json& changes = {}) const {
        Json scene = {
            {"voxelume", 1},
            {"world",
             {{"voxel_size", 0.1},
              {"ambient", {0, 0, 0}},
              {"bounds", {{"min", {-2, -2, -2}}, {"max", {2, 2, 2}}}}}},
            {"materials", {{"default", material}, {"chalk", {{"color", {0.8, 0.8, 0.8}}}}}},
            {"models",
             {{"sheet", {{"mesh", mesh}, {"surface", surface_}, {"voxel_size", 0.1}}},
              {"floor", {{"shape", "box"}, {"size", {3, 0.2, 3}}, {"surface", "exact"}}}}},
            {"objects", {{{"model", "sheet"}, {"turn", {0, 20, 8}}}}},
            {"lights", Json::array()},
            {"observer",
             {{"position", {0.3, 0.4, -2.4}},
              {"look_at", {0, 0, 0}},
              {"display", {{"shape", "pyramid"}, {"angles", {44, 40}}}}}},
            {"render", {{"size", {48, 40}}, {"samples", 2}, {"light", light}, {"depth", 1}}}};
        scene.merge_patch(changes);
        return parse_scene(scene.dump(), folder / "scene.json", {});
    }

  private:
    const char* surface_;
};

/// The position on the front of the sheet, from 0 to 1, that a part of a pixel sees; values outside
/// this range lie beside the sheet.
inline glm::dvec2 point_seen(const Scene& scene, double column, double row) {
    const Observer& o = scene.observer;
    const glm::dvec2 half = half_extent(o.display);
    const glm::dvec2 part = 2.0 * glm::dvec2(column, row) / glm::dvec2(scene.render.size) - 1.0;
    const glm::dmat4 inverse = glm::inverse(scene.objects[0].world_from_object);
    const glm::dvec3 from(inverse * glm::dvec4(o.position, 1));
    const glm::dvec3 way(inverse *
                         glm::dvec4(o.world_from_observer * glm::dvec3(-part * half, 1), 0));
    const glm::dvec3 at = from - way * (from.z / way.z);
    return {(at.x + 1) / 2, (1 - at.y) / 2};
}

}  // namespace voxelume
