// SPDX-License-Identifier: Apache-2.0
// The maps of glTF textures where rays meet exact triangles: emission against exact bilinear
// values, roughness and metalness against materials of these numbers, and the light of panels that
// are emissive in parts against panels that end there.
#include <gtest/gtest.h>

#include <cmath>

#include "runtime/batch/render_frames.hpp"
#include "tests/pictures/textures/mapped_sheet.hpp"
#include "tests/support/test_device.hpp"

namespace voxelume {
namespace {

oracle::Picture stripes() {
    oracle::Picture picture{48, 32, {}};
    for (int y = 0; y < 32; ++y)
        for (int x = 0; x < 48; ++x)
            picture.texels.push_back({uint8_t((x / 6 + y / 4) % 2 ? 230 : 20),
                                      uint8_t(128 + 100 * std::sin(0.4 * x)),
                                      uint8_t((7 * x + 5 * y) % 200)});
    return picture;
}

class TextureMaps : public MappedSheetTest {
  protected:
    TextureMaps() : MappedSheetTest("exact") {}

    /// A sheet from -1 to `right` across and from -1 to 1 up, at z = 0, with texture number 0 for
    /// base colours and number 1 for maps.
    void write(const std::string& name, const std::vector<oracle::Picture>& pictures,
               const Json& material, float right = 1) const {
        GltfWriter writer;
        const float u = (right + 1) / 2;
        const int p = writer.accessor(
            std::vector<float>{-1, -1, 0, -1, 1, 0, right, 1, 0, right, -1, 0}, "VEC3", 3);
        const int t = writer.accessor(std::vector<float>{0, 1, 0, 0, u, 0, u, 1}, "VEC2", 2);
        const int i = writer.accessor(std::vector<uint16_t>{0, 1, 2, 0, 2, 3}, "SCALAR", 1);
        add_maps(writer, pictures, material);
        writer.show(p, t, i);
        put_bytes(folder / name, writer.gltf());
    }
};

bool is_on(const glm::dvec2& point) {
    return point.x > 0 && point.x < 1 && point.y > 0 && point.y < 1;
}

TEST_F(TextureMaps, OfEmissionAreTheMeanOverAPixelAtPlacesOfTheirOwn) {
    const oracle::Picture picture = stripes();
    // Both textures are moved; the map's places follow from those of the base colour's.
    write("glow.gltf", {halves({10, 0, 0}, {0, 10, 0}), picture},
          {{"pbrMetallicRoughness",
            {{"baseColorTexture",
              {{"index", 0},
               {"extensions",
                {{"KHR_texture_transform", {{"scale", {0.5, 3}}, {"offset", {0.3, 0}}}}}}}}}},
           {"emissiveFactor", {1, 1, 1}},
           {"emissiveTexture",
            {{"index", 1},
             {"extensions",
              {{"KHR_texture_transform",
                {{"scale", {1.2, 0.8}}, {"offset", {0.1, 0.2}}, {"rotation", 0.4}}}}}}}});
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
                if (!is_on(at)) return std::nullopt;
                const double c = std::cos(0.4), s = std::sin(0.4);
                const glm::dvec2 q = at * glm::dvec2(1.2, 0.8);
                return factor * oracle::bilinear(
                                    picture, {0.1 + c * q.x + s * q.y, 0.2 + c * q.y - s * q.x});
            };
            EXPECT_LT(rms_of_means(image, 500u, value), 1) << light << placement;
        }
}

/// Something changes while a shutter is open, but nothing that is seen: each sample sees as much of
/// a texture as all samples of one moment leave to it.
TEST_F(TextureMaps, LookTheSameAtAllMoments) {
    write("striped.gltf", {stripes()},
          {{"pbrMetallicRoughness", {{"baseColorTexture", {{"index", 0}}}}}});
    const auto image_with = [&](double shutter) {
        const Scene scene = scene_of(
            "striped.gltf", {{"color", {1, 1, 1}}}, "local",
            {{"world", {{"ambient", {1, 1, 1}}}},
             {"observer", {{"shutter", shutter}}},
             {"render", {{"samples", 16}, {"filter", "tent"}}},  // it parts pixels by samples
             {"animation",
              {{"frames", 2},
               {"tracks", Json::array({{{"target", "materials.chalk.diffuse"},
                                        {"keys",
                                         {{{"frame", 1}, {"value", 0}},
                                          {{"frame", 2}, {"value", 1}}}}}})}}}});
        std::shared_ptr<const Image> image;
        render_frames({test_device()}, scene, {}, [&](const FrameResult& result) {
            EXPECT_EQ(result.report.report.moments, shutter > 0 ? 16u : 0u);
            image = result.image;
        });
        return image;
    };
    EXPECT_TRUE(image_with(0.5)->planes == image_with(0)->planes);
}

TEST_F(TextureMaps, OfGlossLookLikeMaterialsOfTheirNumbers) {
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
                return is_on(at) && (is_right ? at.x >= 0.6 : at.x <= 0.4);
            };
            EXPECT_LT(relative_rms(image, expected, 600u, counts),
                      light == std::string("local") ? 1e-4 : 0.01)
                << light << is_right;
        }
    }
}

TEST_F(TextureMaps, OfEmissionLightTheWorldFromTheirEmissiveParts) {
    const Json glows = {{"emissiveFactor", {1, 1, 1}}, {"emissiveTexture", {{"index", 0}}}};
    write("part.gltf", {halves({255, 255, 255}, {0, 0, 0})}, glows);
    write("half.gltf", {}, Json::object(), 0);
    const Json material = {{"color", {0, 0, 0}}, {"emission", {2, 2, 2}}};
    const Json room = {{"objects",
                        {{{"model", "sheet"}, {"position", {0.2, 1, 0}}, {"turn", {0, 90, 0}}},
                         {{"model", "floor"}, {"material", "chalk"}, {"position", {0, -1, 0}}}}},
                       {"observer",
                        {{"position", {0, 0.5, -0.1}},
                         {"look_at", {-0.4, -1, 0}},
                         {"display", {{"shape", "pyramid"}, {"angles", {40, 40}}}}}},
                       {"render", {{"size", {24, 24}}, {"samples", 64}, {"bounces", 1}}}};
    for (const char* light : {"local", "global"})
        for (const char* search : {"both", "paths"}) {
            if (light == std::string("local") && search != std::string("both")) continue;
            Json changes = room;
            if (light == std::string("global"))
                changes["render"]["emitters"] = search;
            else
                changes["render"]["samples"] = 1;
            const double half =
                light_on_floor(image_of_scene(scene_of("half.gltf", material, light, changes)));
            const double part =
                light_on_floor(image_of_scene(scene_of("part.gltf", material, light, changes)));
            EXPECT_GT(half, 0.02) << light;
            EXPECT_NEAR(part / half, 1, search == std::string("both") ? 0.02 : 0.06)
                << light << search << half;
        }
}

TEST_F(TextureMaps, HaveTheSameBitsWithAnyNumberOfLanes) {
    write("all.gltf", {stripes(), stripes()},
          {{"emissiveFactor", {1, 1, 1}},
           {"emissiveTexture", {{"index", 0}}},
           {"pbrMetallicRoughness", {{"metallicRoughnessTexture", {{"index", 1}}}}}});
    const Json material = {{"base_color", {0.9, 0.6, 0.3}},
                           {"metallic", 1},
                           {"roughness", 1},
                           {"emission", {0.2, 0.1, 0.3}}};
    for (const char* light : {"local", "global"}) {
        const Scene scene = scene_of(
            "all.gltf", material, light,
            {{"lights", {{{"type", "point"}, {"position", {0.6, 0.9, -1.5}}, {"intensity", 3}}}},
             {"render", {{"size", {24, 20}}}}});
        const Image one = image_of_scene(scene, test_device(1));
        for (const int lanes : {4, 8, 16})
            EXPECT_EQ(one.planes, image_of_scene(scene, test_device(lanes)).planes) << lanes;
    }
}

}  // namespace
}  // namespace voxelume
