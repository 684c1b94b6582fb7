// SPDX-License-Identifier: Apache-2.0
// The ways in which light paths find emissive objects agree: by rays to them, by running into them,
// by both.
#include <gmock/gmock.h>

#include <functional>

#include "tests/oracles/image_hash.hpp"
#include "tests/pictures/golden_hash.hpp"
#include "tests/pictures/light/global_light.hpp"

namespace voxelume {
namespace {

struct EmitterRoom {
    const char* name;
    std::function<void(Json&)> furnish;
};

void PrintTo(const EmitterRoom& room, std::ostream* out) {
    *out << room.name;
}

/// A room with a floor, a back wall and a ball, lit by emissive objects alone, seen from its front.
Json dark_room(int samples) {
    Json scene = open_furnace(samples);
    scene["world"]["background"] = {0, 0, 0};
    scene["materials"]["lamp"] = {{"color", {0, 0, 0}}, {"emission", {6, 4, 2}}};
    scene["materials"]["lit"] = {{"color", {0.5, 0.4, 0.3}}, {"emission", {0.2, 0.2, 0.6}}};
    scene["materials"]["clay"] = {{"color", {0.7, 0.6, 0.5}}};
    scene["render"]["bounces"] = 3;
    add_thing(scene, {{"shape", "box"}, {"size", {1.1, 0.1, 1.1}}, {"surface", "exact"}}, "clay",
              {0, -0.4, 0});
    add_thing(scene,
              {{"shape", "box"}, {"size", {1.1, 1.1, 0.1}}, {"surface", "cubes"}, {"set", "solid"}},
              "clay", {0, 0, 0.5});
    add_thing(scene, {{"shape", "sphere"}, {"radius", 0.15}, {"surface", "smooth"}}, "clay",
              {-0.2, -0.15, 0.1});
    send_rays(scene, {0, 0, -0.55}, {0, 0, 1}, 1, 24);
    return scene;
}

Json small_box(const char* surface) {
    Json box = {{"shape", "box"}, {"size", {0.1, 0.06, 0.14}}, {"surface", surface}};
    if (std::string(surface) == "cubes") box["set"] = "solid";
    return box;
}

const std::vector<EmitterRoom> kRooms = {
    {"cubes",
     [](Json& s) {
         add_thing(s, small_box("cubes"), "lamp", {0.15, 0.2, 0.1});
     }},
    {"exact",
     [](Json& s) {
         add_thing(s, small_box("exact"), "lamp", {0.15, 0.2, 0.1});
     }},
    {"smooth ball",
     [](Json& s) {
         add_thing(s, {{"shape", "sphere"}, {"radius", 0.07}, {"surface", "smooth"}}, "lamp",
                   {0.15, 0.1, 0.1});
     }},
    {"exact ring",
     [](Json& s) {
         add_thing(s, {{"shape", "torus"}, {"radius", 0.12}, {"tube", 0.03}, {"surface", "exact"}},
                   "lamp", {0.1, 0.15, 0.1});
     }},
    {"turned instances of every kind",
     [](Json& s) {
         int i = 0;
         for (const char* surface : {"cubes", "smooth", "exact"}) {
             Json box = small_box(surface);
             box["voxel_size"] = 0.015;
             const double x = 0.3 * ++i - 0.6;
             add_thing(s, box, "lamp", {x, 0.25, 0.05},
                       {{"placement", "instance"}, {"turn", {20, 30, 10}}, {"scale", 1.25}});
         }
     }},
    {"bright and dim emitters that reflect",
     [](Json& s) {
         add_thing(s, small_box("cubes"), "lamp", {0.3, 0.3, 0.2});
         add_thing(s, {{"shape", "sphere"}, {"radius", 0.2}, {"surface", "exact"}}, "lit",
                   {0.25, -0.15, 0.15});
     }},
    {"emitters behind a veil and glass",
     [](Json& s) {
         add_thing(s, small_box("exact"), "lamp", {0.2, 0.3, 0.1});
         add_thing(s, {{"shape", "box"}, {"size", {0.6, 0.02, 0.6}}, {"surface", "exact"}}, "veil",
                   {0.2, 0.15, 0.1});
         add_thing(s, {{"shape", "sphere"}, {"radius", 0.1}, {"surface", "exact"}}, "glass",
                   {0.2, -0.2, 0});
     }},
    {"an emitter behind an instanced veil",
     [](Json& s) {
         add_thing(s, small_box("exact"), "lamp", {0.15, 0, 0.1});
         add_thing(s, {{"shape", "box"}, {"size", {0.6, 0.02, 0.6}}, {"surface", "exact"}}, "veil",
                   {0.15, -0.06, 0.1}, {{"placement", "instance"}});
     }},
    {"an emitter in a coloured medium", [](Json& s) {
         s["world"]["medium"] = {{"absorption", {0.5, 1, 2}}, {"color", {0.1, 0.2, 0.3}}};
         add_thing(s, small_box("exact"), "lamp", {0.15, 0.2, 0.1});
     }}};

/// By default, the cases of instances, and of glass and veils, which have the features of most
/// others.
std::vector<EmitterRoom> rooms_to_try() {
    if (is_exhaustive()) return kRooms;
    return {kRooms[4], kRooms[6]};
}

class EmitterRooms : public testing::TestWithParam<EmitterRoom> {};
INSTANTIATE_TEST_SUITE_P(Emitters, EmitterRooms, testing::ValuesIn(rooms_to_try()));

std::vector<SensedRay> sensed_by(Json scene, const char* search) {
    scene["render"]["emitters"] = search;
    return sense(scene);
}

/// Fails if two images differ, in any of four rows of regions, by more than chance explains.
void expect_agreement(const std::vector<SensedRay>& a, const std::vector<SensedRay>& b,
                      const std::string& what) {
    ASSERT_EQ(a.size(), b.size());
    for (int channel = 0; channel < 3; ++channel)
        for (size_t part = 0; part < 4; ++part) {
            std::vector<double> differences;

            for (size_t i = part * a.size() / 4; i < (part + 1) * a.size() / 4; ++i)
                differences.push_back(a[i].color[channel] - b[i].color[channel]);
            const Estimate e = estimate_of(differences);
            // Among 192 such differences, one of 3.5 errors is likely.
            EXPECT_LE(std::abs(e.mean), 3.5 * e.error + 1e-6)
                << what << ", channel " << channel << ", part " << part;
        }
}

TEST_P(EmitterRooms, LookTheSameHoweverEmittersAreFound) {
    Json scene = dark_room(is_exhaustive() ? 256 : 96);
    GetParam().furnish(scene);
    const std::vector<SensedRay> both = sensed_by(scene, "both");
    const std::vector<SensedRay> paths = sensed_by(scene, "paths");
    const std::vector<SensedRay> rays = sensed_by(scene, "rays");
    double light = 0;
    for (const SensedRay& ray : both) light += ray.color[1] / double(both.size());
    EXPECT_GT(light, 0.01);
    expect_agreement(both, paths, "both ways and paths");
    expect_agreement(both, rays, "both ways and rays");
}

/// The root mean square of a region's pixels around their means, over that mean.
double noise_of(const Json& scene, const char* search) {
    const Estimate e = estimate_of(channel_of(sensed_by(scene, search), 1));
    return e.error / e.mean;
}

TEST(Emitters, RaysToASmallEmitterTakeItsNoiseAway) {
    // A plane seen from the emitter's side, evenly lit: what is left of a pixel's difference is
    // noise.
    Json scene = dark_room(16);
    add_thing(scene, small_box("cubes"), "lamp", {0, 0.3, -0.3});
    send_rays(scene, {0, 0.2, -0.55}, {0, 0, 1}, 0.05, 32);
    const double by_paths = noise_of(scene, "paths"), by_both = noise_of(scene, "both");
    fmt::print("noise by paths {:.4f}, by both {:.4f}\n", by_paths, by_both);
    EXPECT_LT(by_both, by_paths / 4);
}

TEST(Emitters, HaveTheSameBitsOnAnyNumberOfLanes) {
    Json json = dark_room(4);
    for (const EmitterRoom& room : kRooms) room.furnish(json);
    json["render"]["size"] = {15, 10};
    const Scene scene = parse_scene(json.dump(), "emitters", {});
    for (const int lanes : lanes_with_all()) {
        RenderReport report;
        const Image image = render(test_device(lanes), scene, report);
        EXPECT_EQ(report.not_finite, 0u);
        expect_golden("global/emissive_objects", oracle::image_hash(image));
    }
}

}  // namespace
}  // namespace voxelume
