// SPDX-License-Identifier: Apache-2.0
// The maps of glTF textures where rays meet smooth objects: emission against exact bilinear values,
// roughness and metalness against materials of these numbers, and the light of panels that are
// emissive in parts against panels that end there.
#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <glm/gtc/matrix_inverse.hpp>

#include "tests/pictures/textures/mapped_sheet.hpp"

namespace voxelume {
namespace {

oracle::Picture waves() {
    oracle::Picture picture{24, 16, {}};
    for (int y = 0; y < 16; ++y)
        for (int x = 0; x < 24; ++x)
            picture.texels.push_back({uint8_t((x / 4 + y / 3) % 2 ? 210 : 40),
                                      uint8_t(128 + 100 * std::sin(0.5 * x)),
                                      uint8_t((9 * x + 5 * y) % 200)});
    return picture;
}

class SmoothMaps : public MappedSheetTest {
  protected:
    SmoothMaps() : MappedSheetTest("smooth") {}

    /// A slab from -1 to `right` across, from -1 to 1 up, and from z = 0 to 0.5 with texture 0.
    void write(const std::string& name, const std::vector<oracle::Picture>& pictures,
               const Json& material, float right = 1) const {
        GltfWriter writer;
        std::vector<float> corners, places;
        for (const float z : {0.0f, 0.5f})
            for (const auto& [x, y] :
                 {std::pair(-1.0f, -1.0f), {-1.0f, 1.0f}, {right, 1.0f}, {right, -1.0f}}) {
                corners.insert(corners.end(), {x, y, z});
                places.insert(places.end(), {(x + 1) / 2, (1 - y) / 2});
            }
        const int p = writer.accessor(corners, "VEC3", 3);
        const int t = writer.accessor(places, "VEC2", 2);
        const int i = writer.accessor(
            std::vector<uint16_t>{0, 1, 2, 0, 2, 3, 4, 6, 5, 4, 7, 6, 0, 4, 5, 0, 5, 1,
                                  1, 5, 6, 1, 6, 2, 2, 6, 7, 2, 7, 3, 3, 7, 4, 3, 4, 0},
            "SCALAR", 1);
        add_maps(writer, pictures, material);
        writer.show(p, t, i);
        put_bytes(folder / name, writer.gltf());
    }
};

/// True if a place is on the front, and not where the edges are rounded.
bool is_flat(const glm::dvec2& point) {
    return point == glm::clamp(point, 0.15, 0.85);
}

TEST_F(SmoothMaps, OfEmissionAreTheMeanOverAPixel) {
    const oracle::Picture picture = waves();
    write("glow.gltf", {picture},
          {{"emissiveFactor", {1, 1, 1}}, {"emissiveTexture", {{"index", 0}}}});
    const glm::dvec3 factor(0.5, 0.75, 1);
    for (const char* light : {"local", "global"})
        for (const char* placement : {"world", "instance"}) {
            const Scene scene = scene_of(
                "glow.gltf", {{"color", {0, 0, 0}}, {"emission", {0.5, 0.75, 1}}}, light,
                {{"objects",
                  {{{"model", "sheet"}, {"turn", {0, 20, 8}}, {"placement", placement}}}}});
            const Image image = image_of_scene(scene);
            const auto value = [&](double column, double row) -> std::optional<glm::dvec3> {
                const glm::dvec2 at = point_seen(scene, column, row);
                if (!is_flat(at)) return std::nullopt;
                return factor * oracle::bilinear(picture, at);
            };
            EXPECT_LT(rms_of_means(image, 400u, value), 1) << light << placement;
        }
}

TEST_F(SmoothMaps, OfGlossLookLikeMaterialsOfTheirNumbers) {
    write("gloss.gltf", {halves({0, 60, 40}, {90, 200, 230})},
          {{"pbrMetallicRoughness", {{"metallicRoughnessTexture", {{"index", 0}}}}}});
    write("plain.gltf", {}, Json::object());
    const Json lit = {
        {"world", {{"ambient", {0.1, 0.1, 0.1}}, {"background", {0.3, 0.5, 0.8}}}},
        {"lights", {{{"type", "point"}, {"position", {0.6, 0.9, -1.5}}, {"intensity", 3}}}}};
    const Json factors = {{"base_color", {0.9, 0.6, 0.3}}, {"metallic", 0.9}, {"roughness", 0.8}};
    for (const char* light : {"local", "global"}) {
        const Scene scene = scene_of("gloss.gltf", factors, light, lit);
        const Image image = image_of_scene(scene);
        for (const bool is_right : {false, true}) {
            Json material = factors;
            material["metallic"] = 0.9 * (is_right ? 230 : 40) / 255;
            material["roughness"] = 0.8 * (is_right ? 200 : 60) / 255;
            const Image expected = image_of_scene(scene_of("plain.gltf", material, light, lit));
            const auto counts = [&](double column, double row) {
                const glm::dvec2 at = point_seen(scene, column, row);
                return is_flat(at) && (is_right ? at.x >= 0.6 : at.x <= 0.4);
            };
            EXPECT_LT(relative_rms(image, expected, 300u, counts),
                      light == std::string("local") ? 1e-4 : 0.01)
                << light << is_right;
        }
    }
}

TEST_F(SmoothMaps, OfMetalMirrorThingsThatAreOutOfView) {
    write("metal.gltf", {halves({0, 0, 255}, {0, 0, 255})},
          {{"pbrMetallicRoughness", {{"metallicRoughnessTexture", {{"index", 0}}}}}});
    const auto image_of_metal = [&](bool has_post) {
        Json objects = {{{"model", "sheet"}}};
        if (has_post)
            objects.push_back(
                {{"model", "post"}, {"material", "chalk"}, {"position", {1.3, 0, -1.6}}});
        return image_of_scene(scene_of(
            "metal.gltf", {{"base_color", {1, 1, 1}}, {"metallic", 1}, {"roughness", 1}}, "local",
            {{"world", {{"ambient", {0.5, 0.5, 0.5}}, {"voxel_size", 0.025}}},
             {"models",
              {{"post", {{"shape", "box"}, {"size", {0.5, 1.8, 0.5}}, {"surface", "exact"}}}}},
             {"objects", objects},
             {"observer", {{"position", {-1.3, 0, -1.6}}}}}));
    };
    const auto with = image_of_metal(true).planes.at("R"),
               without = image_of_metal(false).planes.at("R");
    int shown = 0;
    for (size_t i = 0; i < with.size(); ++i) shown += with[i] > without[i] + 0.1f;
    EXPECT_GT(shown, 50);
}

TEST_F(SmoothMaps, OfEmissionLightTheWorldFromTheirEmissiveParts) {
    const Json glows = {{"emissiveFactor", {1, 1, 1}}, {"emissiveTexture", {{"index", 0}}}};
    write("part.gltf", {halves({255, 255, 255}, {0, 0, 0})}, glows);
    write("half.gltf", {}, Json::object(), 0);
    const Json material = {{"color", {0, 0, 0}}, {"emission", {2, 2, 2}}};
    for (const char* placement : {"world", "instance"})
        for (const char* light : {"local", "global"}) {
            const Json room = {
                {"world", {{"voxel_size", 0.05}}},  // a slab loses its edges, half a voxel of them
                {"models", {{"sheet", {{"voxel_size", 0.05}}}}},
                {"objects",
                 {{{"model", "sheet"},
                   {"position", {0.213, 1.017, 0.011}},
                   {"turn", {0, 90, 0}},
                   {"spots", 200},
                   {"placement", placement}},
                  {{"model", "floor"}, {"material", "chalk"}, {"position", {0, -1, 0}}}}},
                {"observer",
                 {{"position", {0, 0.5, -0.1}},
                  {"look_at", {-0.4, -1, 0}},
                  {"display", {{"shape", "pyramid"}, {"angles", {40, 40}}}}}},
                {"render",
                 {{"size", {24, 24}},
                  {"samples", light == std::string("local") ? 1 : 64},
                  {"bounces", 1}}}};
            const double half =
                light_on_floor(image_of_scene(scene_of("half.gltf", material, light, room)));
            const double part =
                light_on_floor(image_of_scene(scene_of("part.gltf", material, light, room)));
            EXPECT_GT(half, 0.02) << light << placement;
            EXPECT_NEAR(part / half, 1, 0.03) << light << placement << half;
        }
}

}  // namespace
}  // namespace voxelume
