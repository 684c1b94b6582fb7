// SPDX-License-Identifier: Apache-2.0
// The maps of glTF textures where rays meet exact triangles: emission against exact bilinear
// values, roughness and metalness against materials of these numbers, and the light of panels that
// glow in parts against panels that end there.
#include <gtest/gtest.h>

#include <cmath>

#include "runtime/io/image/png.hpp"
#include "tests/pictures/textures/map_pictures.hpp"
#include "tests/support/file_fixture.hpp"
#include "tests/support/writers/gltf_writer.hpp"

namespace voxelume {
namespace {

using Json = nlohmann::json;

oracle::Picture stripes() {
    oracle::Picture picture{48, 32, {}};
    for (int y = 0; y < 32; ++y)
        for (int x = 0; x < 48; ++x)
            picture.texels.push_back({uint8_t((x / 6 + y / 4) % 2 ? 230 : 20),
                                      uint8_t(128 + 100 * std::sin(0.4 * x)),
                                      uint8_t((7 * x + 5 * y) % 200)});
    return picture;
}

std::string data_uri(const oracle::Picture& picture) {
    return "data:image/png;base64," + GltfWriter::base64(png_bytes(image_of(picture), {}));
}

class TextureMaps : public FileTest {
  protected:
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
        for (size_t k = 0; k < pictures.size(); ++k) {
            writer.json["images"].push_back({{"uri", data_uri(pictures[k])}});
            const bool clamps = pictures[k].beyond_u == oracle::Beyond::clamp;
            writer.json["textures"].push_back({{"source", k}, {"sampler", clamps ? 1 : 0}});
        }
        writer.json["samplers"] = {{{"wrapS", 10497}, {"wrapT", 10497}},
                                   {{"wrapS", 33071}, {"wrapT", 33071}}};
        writer.json["materials"] = nlohmann::json::array({material});
        writer.show(p, t, i);
        put_bytes(folder / name, writer.gltf());
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
             {{"sheet", {{"mesh", mesh}, {"surface", "exact"}, {"voxel_size", 0.1}}},
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
};

/// The place on the sheet, from 0 to 1, that a part of a pixel sees; outside of these beside it.
glm::dvec2 place_seen(const Scene& scene, double column, double row) {
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

bool is_on(const glm::dvec2& place) {
    return place.x > 0 && place.x < 1 && place.y > 0 && place.y < 1;
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
                const glm::dvec2 at = place_seen(scene, column, row);
                if (!is_on(at)) return std::nullopt;
                const double c = std::cos(0.4), s = std::sin(0.4);
                const glm::dvec2 q = at * glm::dvec2(1.2, 0.8);
                return factor * oracle::bilinear(
                                    picture, {0.1 + c * q.x + s * q.y, 0.2 + c * q.y - s * q.x});
            };
            EXPECT_LT(rms_of_means(image, 500u, value), 1) << light << placement;
        }
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
                const glm::dvec2 at = place_seen(scene, column, row);
                return is_on(at) && (is_right ? at.x >= 0.6 : at.x <= 0.4);
            };
            EXPECT_LT(relative_rms(image, expected, 600u, counts),
                      light == std::string("local") ? 1e-4 : 0.01)
                << light << is_right;
        }
    }
}

TEST_F(TextureMaps, OfEmissionLightTheWorldFromWhereTheyGlow) {
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
