// SPDX-License-Identifier: Apache-2.0
// Physically based materials in global light: furnaces, lights and emissive objects of one form,
// and bits.
#include <gmock/gmock.h>

#include "tests/oracles/image_hash.hpp"
#include "tests/pictures/golden_hash.hpp"
#include "tests/pictures/light/global_light.hpp"

namespace voxelume {
namespace {

Json physical(double metallic, double roughness) {
    return {{"base_color", {1, 1, 1}}, {"metallic", metallic}, {"roughness", roughness}};
}

/// A material with a coat; its part that isn't metal reflects half as much.
Json coated(double metallic, double roughness, double coat, double coat_roughness) {
    Json material = physical(metallic, roughness);
    material["coat"] = coat;
    material["coat_roughness"] = coat_roughness;
    material["specular"] = 0.5;
    return material;
}

Json ball_of(double radius, const char* surface) {
    Json model = {{"shape", "sphere"}, {"radius", radius}, {"surface", surface}};
    if (std::string(surface) == "cubes") model["set"] = "solid";
    return model;
}

class PhysicalOnEverySurface : public testing::TestWithParam<const char*> {};
INSTANTIATE_TEST_SUITE_P(GlobalLight, PhysicalOnEverySurface,
                         testing::Values("cubes", "smooth", "exact"));

/// Expects that balls of metal, of plastic and of both can't be distinguished from a white sky, to
/// a thousandth with the 4,096 samples that `--all` takes.
void expect_invisible(const char* surface, const Json& metal, const Json& plastic, const Json& half,
                      const std::string& what) {
    Json scene = open_furnace(is_exhaustive() ? 4096 : 64);
    scene["materials"]["metal"] = metal;
    scene["materials"]["plastic"] = plastic;
    scene["materials"]["half metal"] = half;
    add_thing(scene, ball_of(0.2, surface), "metal", {0.25, 0.25, 0.1});
    add_thing(scene, ball_of(0.2, surface), "plastic", {-0.25, 0.25, 0.1});
    add_thing(scene, ball_of(0.2, surface), "half metal", {0.25, -0.25, 0.1});
    send_rays(scene, {0, 0, -0.55}, {0, 0, 1}, 1, 64);
    const Estimate e = estimate_of(channel_of(sense(scene), 1));
    expect_mean(e, 1, what, 1e-3);
    EXPECT_NEAR(e.mean, 1, is_exhaustive() ? 1e-3 : 3e-3);
}

TEST_P(PhysicalOnEverySurface, WhiteOnesAreInvisibleUnderAWhiteSky) {
    // Balls see only the sky and themselves, so they return light after one scattering on `exact`
    // ones, and after several where cubes face each other. By default, each surface has one of the
    // roughnesses that the others don't have.
    const size_t turn = GetParam()[0] == 'c' ? 0 : GetParam()[0] == 's' ? 1 : 3;
    for (const double roughness : in_turn<double>({0.05, 0.2, 0.5, 0.8, 1.0}, turn))
        expect_invisible(GetParam(), physical(1, roughness), physical(0, roughness),
                         physical(0.5, roughness), "roughness " + std::to_string(roughness));
}

TEST_P(PhysicalOnEverySurface, WhiteOnesUnderACoatAreInvisibleUnderAWhiteSky) {
    for (const double roughness : in_turn<double>({0.2, 0.8}, GetParam()[0] == 's'))
        expect_invisible(GetParam(), coated(1, roughness, 1, 0), coated(0, roughness, 0.5, 0.3),
                         coated(0.5, roughness, 1, 0.7), "roughness " + std::to_string(roughness));
}

/// A floor of a material at y = 0, seen from above and aside, and a square above it that shines.
Json shone_on(const Json& material, bool by_light, const char* search) {
    Json scene = open_furnace(256);
    scene["world"]["background"] = {0, 0, 0};
    scene["materials"]["floor"] = material;
    scene["materials"]["lamp"] = {{"color", {0, 0, 0}}, {"emission", {3, 2, 1}}};
    scene["render"]["bounces"] = 1;
    scene["render"]["emitters"] = search;
    add_thing(scene, {{"shape", "box"}, {"size", {1.1, 0.1, 1.1}}, {"surface", "exact"}}, "floor",
              {0, -0.3, 0});
    if (!by_light)
        add_thing(scene, {{"shape", "box"}, {"size", {0.3, 5e-5, 0.2}}, {"surface", "exact"}},
                  "lamp", {0.1, 0.250025, 0.2});
    scene["lights"] = Json::array();
    if (by_light)
        scene["lights"] = {{{"type", "rectangle"},
                            {"position", {0.1, 0.25, 0.2}},
                            {"direction", {0, -1, 0}},
                            {"up", {0, 0, 1}},
                            {"size", {0.3, 0.2}},
                            {"color", {1, 2.0 / 3, 1.0 / 3}},
                            {"intensity", 3 * 0.06 / std::numbers::pi}}};
    send_rays(scene, {0, 0.1, -0.55}, {0, -0.5, 0.75}, 0.3, 24);
    return scene;
}

TEST(PhysicalMaterials, ShowAnEmissiveObjectAndALightOfItsFormAlike) {
    Json brass = {{"base_color", {0.9, 0.7, 0.3}}, {"metallic", 1}, {"roughness", 0.35}};
    Json lacquer = {{"base_color", {0.1, 0.5, 0.9}}, {"roughness", 0.25}, {"ior", 1.8}};
    Json paint = coated(0.7, 0.5, 1, 0.15);
    paint["base_color"] = {0.6, 0.1, 0.05};
    size_t turn = 0;
    for (const Json& material : {brass, lacquer, paint}) {
        const std::vector<SensedRay> expected = sense(shone_on(material, true, "both"));
        for (const char* search : in_turn<const char*>({"both", "paths", "rays"}, turn++)) {
            const std::vector<SensedRay> found = sense(shone_on(material, false, search));
            for (size_t quarter = 0; quarter < 4; ++quarter) {
                std::vector<double> differences, light;
                for (size_t i = quarter * found.size() / 4; i < (quarter + 1) * found.size() / 4;
                     ++i) {
                    differences.push_back(found[i].color[0] - expected[i].color[0]);
                    light.push_back(expected[i].color[0]);
                }
                const Estimate e = estimate_of(differences);
                const double mean = estimate_of(light).mean;
                EXPECT_LE(std::abs(e.mean), 3.5 * e.error + 1e-3 * mean)
                    << search << ", part " << quarter << ": " << e.mean << " of " << mean;
                EXPECT_LT(e.error, 0.04 * mean) << search << quarter;
            }
        }
    }
}

/// A floor, an emissive object, a point light and two balls.
Json still_life(const Json& floor, const Json& balls) {
    Json json = shone_on(floor, false, "both");
    json["materials"]["plastic"] = balls;
    json["lights"] = {{{"type", "point"}, {"position", {-0.3, 0.3, -0.3}}, {"intensity", 0.2}}};
    add_thing(json, ball_of(0.15, "smooth"), "plastic", {-0.2, -0.1, 0.1});
    add_thing(json, ball_of(0.1, "cubes"), "plastic", {0.2, -0.15, 0});
    json["render"]["size"] = {15, 10};
    json["render"]["samples"] = 4;
    json["render"]["bounces"] = 4;
    return json;
}

void expect_bits(const Json& json, const std::string& name) {
    const Scene scene = parse_scene(json.dump(), "physical", {});
    for (const int lanes : lanes_with_all()) {
        RenderReport report;
        const Image image = render(test_device(lanes), scene, report);
        EXPECT_EQ(report.not_finite, 0u);
        expect_golden(name, oracle::image_hash(image));
    }
}

TEST(PhysicalMaterials, HaveTheSameBitsOnAnyNumberOfLanes) {
    const Json brass = {{"base_color", {0.9, 0.7, 0.3}}, {"metallic", 1}, {"roughness", 0.35}};
    const Json plastic = {{"base_color", {0.2, 0.6, 0.3}}, {"roughness", 0.1}};
    expect_bits(still_life(brass, plastic), "global/physical");
    Json paint = coated(0.7, 0.5, 1, 0.15);
    paint["base_color"] = {0.6, 0.1, 0.05};
    expect_bits(still_life(brass, paint), "global/coat");
}

TEST(PhysicalMaterials, ShowABareSurfaceAlikeInASceneWithACoatedOne) {
    const Json brass = {{"base_color", {0.9, 0.7, 0.3}}, {"metallic", 1}, {"roughness", 0.35}};
    const Json plastic = {{"base_color", {0.2, 0.6, 0.3}}, {"roughness", 0.1}};
    Json json = still_life(brass, plastic);
    json["render"]["bounces"] = 0;
    json["materials"]["paint"] = coated(0, 0.5, 1, 0.15);
    const auto hash_of = [&](const char* material) {
        Json scene = json;
        add_thing(scene, ball_of(0.05, "exact"), material, {0.4, 0.4, -0.4});  // out of sight
        RenderReport report;
        return oracle::image_hash(
            render(test_device(4), parse_scene(scene.dump(), "bare", {}), report));
    };
    EXPECT_EQ(hash_of("paint"), hash_of("plastic"));
}

}  // namespace
}  // namespace voxelume
