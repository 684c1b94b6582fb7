// SPDX-License-Identifier: Apache-2.0
// Lights with an area as physically based surfaces show them: rays that are sent to the lights and
// paths that run into them share their light.
#include <gmock/gmock.h>

#include <functional>
#include <numbers>

#include "tests/oracles/image_hash.hpp"
#include "tests/pictures/golden_hash.hpp"
#include "tests/pictures/light/global_light.hpp"

namespace voxelume {
namespace {

/// The contents of a room apart from its floor, wall and lights.
struct ShinyRoom {
    const char* name;
    std::function<void(Json&)> furnish;
};

void PrintTo(const ShinyRoom& room, std::ostream* out) {
    *out << room.name;
}

/// A room with a glossy floor, lit by a disk and a rectangle.
Json shiny_room(int samples) {
    Json scene = open_furnace(samples);
    Json& materials = scene["materials"];
    materials["metal"] = {{"base_color", {0.9, 0.7, 0.5}}, {"metallic", 1}, {"roughness", 0.25}};
    materials["plastic"] = {{"base_color", {0.2, 0.5, 0.8}}, {"roughness", 0.3}};
    materials["coated"] = {{"base_color", {0.8, 0.3, 0.2}},
                           {"roughness", 0.6},
                           {"coat", 0.7},
                           {"coat_roughness", 0.25}};
    materials["frosted"] = {{"base_color", {1, 1, 1}}, {"transmission", 1}, {"roughness", 0.3}};
    scene["world"]["background"] = {0, 0, 0};
    scene["render"]["bounces"] = 3;
    scene["render"]["shadows"] = true;
    scene["lights"] = {{{"type", "disk"},
                        {"position", {0.2, 0.35, 0.1}},
                        {"direction", {-0.3, -1, 0.1}},
                        {"radius", 0.1},
                        {"intensity", 0.3}},
                       {{"type", "rectangle"},
                        {"position", {-0.25, 0.3, -0.1}},
                        {"direction", {0.2, -1, 0.3}},
                        {"size", {0.3, 0.15}},
                        {"color", {1, 0.5, 0.2}},
                        {"intensity", 0.4}}};
    add_thing(scene, {{"shape", "box"}, {"size", {1.1, 0.1, 1.1}}, {"surface", "exact"}}, "metal",
              {0, -0.4, 0});
    add_thing(scene, {{"shape", "box"}, {"size", {1.1, 1.1, 0.1}}, {"surface", "exact"}}, "plastic",
              {0, 0, 0.5});
    send_rays(scene, {0, 0, -0.55}, {0, -0.3, 1}, 0.9, 24);
    return scene;
}

Json ball(const char* surface) {
    return {{"shape", "sphere"}, {"radius", 0.15}, {"surface", surface}};
}

/// A pane across the way from the floor to both lights, which lets three fourths of it through.
void add_pane(Json& scene, const Json& more) {
    scene["materials"]["pane"] = {{"base_color", {1, 1, 1}}, {"roughness", 0.3}, {"opacity", 0.25}};
    add_thing(scene, {{"shape", "box"}, {"size", {0.9, 0.02, 0.6}}, {"surface", "exact"}}, "pane",
              {0, 0.1, 0}, more);
}

const std::vector<ShinyRoom> kShinyRooms = {
    {"balls of every surface",
     [](Json& s) {
         add_thing(s, ball("cubes"), "metal", {-0.3, -0.2, 0.1});
         add_thing(s, ball("smooth"), "plastic", {0, -0.2, 0});
         add_thing(s, ball("exact"), "coated", {0.3, -0.2, 0.1});
     }},
    {"turned instances",
     [](Json& s) {
         for (const double x : {-0.25, 0.25})
             add_thing(s, {{"shape", "box"}, {"size", {0.2, 0.3, 0.2}}, {"surface", "smooth"}},
                       "coated", {x, -0.2, 0.1},
                       {{"placement", "instance"}, {"turn", {20, 30, 10}}});
     }},
    {"a pane", [](Json& s) { add_pane(s, Json::object()); }},
    {"an instanced pane",
     [](Json& s) {
         add_pane(s, {{"placement", "instance"}});
     }},
    {"soft cubes in grazing light",
     [](Json& s) {
         s["objects"] = Json::array();
         add_thing(s,
                   {{"shape", "box"},
                    {"size", {0.6, 0.1, 0.5}},
                    {"surface", "cubes"},
                    {"normals", "surface"}},
                   "metal", {0, -0.1, 0}, {{"turn", {0, 0, 15}}});
         s["lights"] = {{{"type", "rectangle"},
                         {"position", {1.25, 0.45, 0}},
                         {"look_at", {0, -0.1, 0}},
                         {"size", {0.75, 0.4}},
                         {"intensity", 1.5}}};
         send_rays(s, {-0.55, 0.03, 0}, {1, -0.23, 0}, 0.2, 24);
     }},
    {"frosted glass, and metal in coloured glass",
     [](Json& s) {
         s["materials"]["frosted"]["absorption"] = {0.5, 1, 2};
         s["materials"]["glass"]["absorption"] = {3, 1, 2};
         add_thing(s, ball("exact"), "frosted", {-0.15, -0.2, 0});
         add_thing(s, ball("exact"), "glass", {0.2, -0.2, 0}, {{"priority", 0}});
         add_thing(s, {{"shape", "sphere"}, {"radius", 0.08}, {"surface", "exact"}}, "metal",
                   {0.2, -0.2, 0}, {{"priority", 1}});
     }},
    {"emissive objects and a sky",
     [](Json& s) {
         s["materials"]["lamp"] = {{"color", {0, 0, 0}}, {"emission", {6, 4, 2}}};
         add_thing(s, {{"shape", "box"}, {"size", {0.1, 0.1, 0.1}}, {"surface", "cubes"}}, "lamp",
                   {0.3, -0.2, 0});
         s["world"]["sky"] = {{"kind", "gradient"}, {"zenith", {0.1, 0.2, 0.4}}};
     }},
    {"one bounce", [](Json& s) { s["render"]["bounces"] = 1; }},
};

/// The scene as it is where physically based surfaces find lights by rays to these alone.
Json by_rays_alone(Json scene) {
    scene["render"]["emitters"] = "rays";
    return scene;
}

/// By default, the cases whose kernels have the features of most others.
std::vector<ShinyRoom> shiny_rooms_to_try() {
    if (is_exhaustive()) return kShinyRooms;
    return {kShinyRooms[0], kShinyRooms[3], kShinyRooms[4], kShinyRooms[7]};
}

class ShinyRooms : public testing::TestWithParam<ShinyRoom> {};
INSTANTIATE_TEST_SUITE_P(AreaShares, ShinyRooms, testing::ValuesIn(shiny_rooms_to_try()));

TEST_P(ShinyRooms, AreAsBrightAsByRaysAlone) {
    Json scene = shiny_room(is_exhaustive() ? 1024 : 320);
    GetParam().furnish(scene);
    const std::vector<SensedRay> shared = sense(scene), sent = sense(by_rays_alone(scene));
    for (int channel = 0; channel < 3; ++channel)
        for (size_t part = 0; part < 4; ++part) {
            std::vector<double> differences, all;
            for (size_t i = part * sent.size() / 4; i < (part + 1) * sent.size() / 4; ++i) {
                all.push_back(sent[i].color[channel]);
                differences.push_back(shared[i].color[channel] - sent[i].color[channel]);
            }
            const Estimate e = estimate_of(differences), light = estimate_of(all);
            fmt::print("channel {} part {}: {:+.5f} +- {:.5f} of {:.5f}\n", channel, part, e.mean,
                       e.error, light.mean);
            EXPECT_GT(light.mean, 1e-3);
            // By chance, one of 96 differences of this kind is larger in one of twenty tests.
            EXPECT_LE(std::abs(e.mean), 3.5 * e.error) << "channel " << channel << ", " << part;
            EXPECT_LT(e.error, 0.02 * light.mean) << "channel " << channel << ", " << part;
        }
}

/// A metal floor that mirrors a light straight above it, seen from next to that light.
Json mirrored_light(double roughness, int samples) {
    Json scene = open_furnace(samples);
    scene["world"]["background"] = {0, 0, 0};
    scene["materials"]["mirror"] = {
        {"base_color", {1, 1, 1}}, {"metallic", 1}, {"roughness", roughness}};
    scene["render"]["bounces"] = 2;
    scene["lights"] = {{{"type", "rectangle"},
                        {"position", {0, 0.2, 0.2}},
                        {"direction", {0, -1, 0}},
                        {"up", {0, 0, 1}},
                        {"size", {0.4, 0.3}},
                        {"intensity", 0.5}}};
    add_thing(scene, {{"shape", "box"}, {"size", {1.1, 0.1, 1.1}}, {"surface", "exact"}}, "mirror",
              {0, -0.05, 0});
    // Rays that come down at 45 degrees to the middle, which mirrors the light's middle.
    send_rays(scene, {0, 0.2, -0.2}, {0, -1, 1}, 0.02, 16);
    return scene;
}

TEST(AreaShares, APolishedMirrorShowsTheLightsOwnRadiance) {
    // The highlight of this roughness lies within the light, whose radiance is that of its
    // intensity over its area, and pi by the convention of intensities. One in some thousands of
    // its paths goes past the light.
    const Estimate e = estimate_of(channel_of(sense(mirrored_light(0.03, 16)), 0));
    expect_mean(e, std::numbers::pi * 0.5 / 0.12, "mirrored light", 1e-3);
    EXPECT_LT(e.error / e.mean, 2e-3);
}

TEST(AreaShares, PathsTakeTheNoiseOfPolishedSurfacesAway) {
    const Json scene = mirrored_light(0.05, 16);
    const auto noise_of = [](const Json& of) {
        const Estimate e = estimate_of(channel_of(sense(of), 0));
        return e.error / e.mean;
    };
    const double shared = noise_of(scene), sent = noise_of(by_rays_alone(scene));
    fmt::print("noise by rays alone {:.4f}, shared {:.5f}\n", sent, shared);
    EXPECT_LT(shared, sent / 20);
}

// Behind veils the two go on by chance, and only their means are such.
TEST(AreaShares, DirectLightIsAPartOfAllLight) {
    Json json = shiny_room(16);
    kShinyRooms[0].furnish(json);
    Scene scene = parse_scene(json.dump(), "area shares", {});
    scene.render.channels.direct = scene.render.channels.indirect = true;
    RenderReport report;
    const Image image = render(test_device(), scene, report);
    double direct = 0, indirect = 0;
    for (const char* color : {"R", "G", "B"}) {
        const Plane<float>& all = image.planes.at(color);
        const Plane<float>& rest = image.planes.at(std::string("indirect.") + color);
        for (size_t i = 0; i < rest.size(); ++i) {
            // Sums of 16 samples are rounded, to 1e-6 at most, in another order.
            EXPECT_GE(rest[i], -1e-5f * all[i]) << color << " of pixel " << i;
            indirect += double(rest[i]);
            direct += double(all[i]) - double(rest[i]);
        }
    }
    fmt::print("direct {:.1f}, indirect {:.1f}\n", direct, indirect);
    EXPECT_GT(indirect, 0.05 * direct);
    EXPECT_GT(direct, indirect);
}

TEST(AreaShares, AreLeftOutWhereNoPathRunsIntoALight) {
    const auto meetings_of = [](const Json& json) {
        const Scene scene = parse_scene(json.dump(), "area shares", {});
        const Device device = test_device();
        RenderReport report;
        render(device, scene, report);
        return device.counters().launches["meet_area_light"];
    };
    Json scene = shiny_room(1);
    EXPECT_GT(meetings_of(scene), 0u);
    EXPECT_EQ(meetings_of(by_rays_alone(scene)), 0u);
    scene["render"]["bounces"] = 0;
    EXPECT_EQ(meetings_of(scene), 0u);
    scene["render"]["bounces"] = 3;
    scene["render"]["shadows"] = false;
    EXPECT_EQ(meetings_of(scene), 0u);
    scene["render"]["shadows"] = true;
    for (const char* material : {"metal", "plastic"})
        scene["materials"][material] = {{"color", {0.5, 0.5, 0.5}}};
    EXPECT_EQ(meetings_of(scene), 0u);
}

TEST(AreaShares, HaveTheSameBitsOnAnyNumberOfLanes) {
    Json json = shiny_room(4);
    kShinyRooms[0].furnish(json);
    kShinyRooms[3].furnish(json);
    json["render"]["size"] = {15, 10};
    const Scene scene = parse_scene(json.dump(), "area shares", {});
    for (const int lanes : lanes_with_all()) {
        RenderReport report;
        const Image image = render(test_device(lanes), scene, report);
        EXPECT_EQ(report.not_finite, 0u);
        expect_golden("global/area_shares", oracle::image_hash(image));
    }
}

}  // namespace
}  // namespace voxelume
