// SPDX-License-Identifier: Apache-2.0
// Lights with an area in mirrors and through glass, which paths run into: as bright as an emissive
// plate in the light's place, whose light is found by other code.
#include <gmock/gmock.h>

#include <functional>
#include <numbers>

#include "tests/oracles/image_hash.hpp"
#include "tests/pictures/golden_hash.hpp"
#include "tests/pictures/light/global_light.hpp"

namespace voxelume {
namespace {

constexpr double kPlateSide = 0.4, kPlateRadiance = 6;
// Rays that are sent to lights go one way further than paths, whose later ways bring 1e-4.
constexpr int kBounces = 16;

/// The objects on a room's floor, and the surroundings.
struct MirrorRoom {
    const char* name;
    std::function<void(Json&)> furnish;
};

void PrintTo(const MirrorRoom& room, std::ostream* out) {
    *out << room.name;
}

/// A grey floor and a black ceiling, close above a plate that shines down. Rays look to the floor.
Json plate_room(int samples) {
    Json scene = open_furnace(samples);
    scene["world"]["background"] = {0, 0, 0};
    scene["materials"]["grey"] = {{"color", {0.5, 0.5, 0.5}}};
    scene["materials"]["frosted"] = {
        {"base_color", {1, 1, 1}}, {"transmission", 1}, {"roughness", 0.3}};
    scene["materials"]["plate"] = {{"color", {0, 0, 0}},
                                   {"emission", std::vector<double>(3, kPlateRadiance)}};
    scene["render"]["shadows"] = true;
    add_thing(scene, {{"shape", "box"}, {"size", {1.1, 0.1, 1.1}}, {"surface", "exact"}}, "grey",
              {0, -0.45, 0});
    scene["materials"]["black"] = {{"color", {0, 0, 0}}};
    add_thing(scene, {{"shape", "box"}, {"size", {1.1, 0.09, 1.1}}, {"surface", "exact"}}, "black",
              {0, 0.547, 0}, {{"priority", 9}});
    send_rays(scene, {0, 0.3, -0.55}, {0, -0.68, 0.6}, 0.5, 24);
    return scene;
}

/// The plate as one of `lights`, or as an emissive object.
Json lit_by(Json scene, bool is_light) {
    const glm::dvec3 middle{0, 0.5, 0.1};
    if (is_light) {
        const double intensity = kPlateRadiance * kPlateSide * kPlateSide / std::numbers::pi;
        scene["lights"] = {{{"type", "rectangle"},
                            {"position", {middle.x, middle.y, middle.z}},
                            {"direction", {0, -1, 0}},
                            {"size", {kPlateSide, kPlateSide}},
                            {"intensity", intensity}}};
    } else {
        constexpr double kThin = 1e-4;
        add_thing(
            scene,
            {{"shape", "box"}, {"size", {kPlateSide, kThin, kPlateSide}}, {"surface", "exact"}},
            "plate", middle + glm::dvec3(0, kThin / 2, 0));
    }
    scene["render"]["bounces"] = kBounces;
    return scene;
}

Json glass_ball(const char* surface) {
    return {{"shape", "sphere"}, {"radius", 0.2}, {"surface", surface}};
}

const std::vector<MirrorRoom> kMirrorRooms = {
    {"a ball of glass",
     [](Json& s) {
         add_thing(s, glass_ball("exact"), "glass", {0, -0.1, 0.1});
     }},
    {"a mirror beside the floor",
     [](Json& s) {
         add_thing(s, {{"shape", "box"}, {"size", {0.02, 0.5, 0.8}}, {"surface", "cubes"}},
                   "mirror", {0.35, -0.1, 0.1});
     }},
    {"a smooth ball that mirrors a part, in an even haze",
     [](Json& s) {
         add_thing(s, glass_ball("smooth"), "lacquer", {0, -0.1, 0.1});
         send_rays(s, {0, 0.38, -0.42}, {0, -0.68, 0.6}, 0.34, 24);  // to where it shows the plate
         s["world"]["medium"] = {{"absorption", {0.2, 0.4, 0.6}}};
     }},
    {"frosted glass as an instance",
     [](Json& s) {
         s["materials"]["frosted"]["absorption"] = {1, 2, 4};
         add_thing(s, {{"shape", "box"}, {"size", {0.5, 0.05, 0.5}}, {"surface", "exact"}},
                   "frosted", {0, 0.05, 0.1}, {{"placement", "instance"}, {"turn", {0, 30, 10}}});
     }},
    {"a plate inside of coloured glass",
     [](Json& s) {
         s["materials"]["glass"]["absorption"] = {0.5, 1, 2};
         add_thing(s, {{"shape", "box"}, {"size", {0.9, 0.2, 0.9}}, {"surface", "exact"}}, "glass",
                   {0, 0.45, 0.1}, {{"priority", 0}});
     }},
    {"a mirror in a medium that scatters",
     [](Json& s) {
         add_thing(s, {{"shape", "box"}, {"size", {0.02, 0.5, 0.8}}, {"surface", "exact"}},
                   "mirror", {0.35, -0.1, 0.1});
         s["world"]["medium"] = {{"absorption", {0.2, 0.3, 0.1}}, {"scattering", {0.8, 0.4, 0.6}}};
     }},
    {"a mirror behind a veil in coloured glass",
     [](Json& s) {
         s["materials"]["glass"]["absorption"] = {0.5, 1, 2};
         add_thing(s, glass_ball("exact"), "glass", {-0.2, -0.1, 0.1});
         add_thing(s, {{"shape", "box"}, {"size", {0.02, 0.5, 0.8}}, {"surface", "exact"}},
                   "mirror", {0.35, -0.1, 0.1});
         add_thing(s, {{"shape", "box"}, {"size", {0.9, 0.02, 0.6}}, {"surface", "exact"}}, "veil",
                   {0, 0.2, 0.1});
     }},
};

/// By default, the fastest case of each kind.
std::vector<MirrorRoom> mirror_rooms_to_try() {
    if (is_exhaustive()) return kMirrorRooms;
    return {kMirrorRooms[0], kMirrorRooms[2], kMirrorRooms[3], kMirrorRooms[4]};
}

class MirrorRooms : public testing::TestWithParam<MirrorRoom> {};
INSTANTIATE_TEST_SUITE_P(MetLights, MirrorRooms, testing::ValuesIn(mirror_rooms_to_try()));

TEST_P(MirrorRooms, AreAsBrightAsByAnEmissivePlate) {
    Json scene = plate_room(is_exhaustive() ? 4096 : 512);
    GetParam().furnish(scene);
    const std::vector<SensedRay> met = sense(lit_by(scene, true)),
                                 found = sense(lit_by(scene, false));
    for (int channel = 0; channel < 3; ++channel)
        for (size_t part = 0; part < 4; ++part) {
            std::vector<double> differences, all;
            for (size_t i = part * met.size() / 4; i < (part + 1) * met.size() / 4; ++i) {
                all.push_back(found[i].color[channel]);
                differences.push_back(met[i].color[channel] - found[i].color[channel]);
            }
            const Estimate e = estimate_of(differences), light = estimate_of(all);
            fmt::print("channel {} part {}: {:+.5f} +- {:.5f} of {:.5f}\n", channel, part, e.mean,
                       e.error, light.mean);
            EXPECT_GT(light.mean, 1e-3);
            // By chance, one of 84 differences of this kind is larger in one of 25 tests. Where
            // both images follow the same paths, sums are rounded in another order.
            EXPECT_LE(std::abs(e.mean), 3.5 * e.error + 1e-5 * light.mean)
                << "channel " << channel << ", " << part;
            EXPECT_LT(e.error, 0.03 * light.mean) << "channel " << channel << ", " << part;
        }
}

TEST(MetLights, AMirrorShowsTheLightsOwnRadiance) {
    // Nothing else in the room returns light.
    Json scene = lit_by(plate_room(1), true);
    scene["objects"] = Json::array();
    add_thing(scene, {{"shape", "box"}, {"size", {1.1, 0.1, 1.1}}, {"surface", "exact"}}, "mirror",
              {0, -0.45, 0});
    send_rays(scene, {0, 0.3, -0.5}, {0, -0.7, 0.26}, 0.02, 8);
    for (const SensedRay& ray : sense(scene))
        for (int channel = 0; channel < 3; ++channel)
            EXPECT_NEAR(ray.color[channel], kPlateRadiance, 1e-5 * kPlateRadiance);
}

TEST(MetLights, AreDirectLightOfAMirrorAlone) {
    const auto light_of = [](const char* material, bool is_filtered = false) {
        Json json = lit_by(plate_room(64), true);
        if (is_filtered) json["render"]["shadow"] = "filtered";
        add_thing(json, glass_ball("exact"), material, {0, -0.1, 0.1});
        send_rays(json, {0, 0.38, -0.42}, {0, -0.68, 0.6}, 0.34, 24);
        Scene scene = parse_scene(json.dump(), "met lights", {});
        scene.render.channels.direct = scene.render.channels.indirect = true;
        RenderReport report;
        const Image image = render(test_device(), scene, report);
        double direct = 0, indirect = 0;
        for (size_t i = 0; i < image.planes.at("R").size(); ++i) {
            const float all = image.planes.at("R")[i], rest = image.planes.at("indirect.R")[i];
            // Sums of 64 samples are rounded, to 1e-6 at most, in another order.
            EXPECT_GE(rest, -1e-5f * all) << material << ", pixel " << i;
            direct = std::max(direct, double(all) - double(rest));
            indirect = std::max(indirect, double(rest));
        }
        return std::pair(direct, indirect);
    };
    const auto [mirrored, around] = light_of("mirror");
    EXPECT_NEAR(mirrored, kPlateRadiance, 0.1);
    EXPECT_LT(around, kPlateRadiance / 2);
    EXPECT_EQ(light_of("mirror", true), std::pair(mirrored, around));
    // Behind the first surface of glass there is a second one.
    const auto [reflected, thrown] = light_of("glass");
    // The brightest pixels of 64 samples are less bright by chance than those of few.
    EXPECT_LT(reflected, kPlateRadiance / 12);
    EXPECT_GT(thrown, kPlateRadiance / 6);
}

TEST(MetLights, AreLeftOutWhereNoPathRunsIntoOne) {
    const auto meetings_of = [](const Json& json) {
        const Scene scene = parse_scene(json.dump(), "met lights", {});
        const Device device = test_device();
        RenderReport report;
        render(device, scene, report);
        return device.counters().launches["meet_area_light"];
    };
    const Json matt = lit_by(plate_room(1), true);
    EXPECT_EQ(meetings_of(matt), 0u);
    for (const char* material : {"mirror", "glass", "frosted"}) {
        Json scene = matt;
        add_thing(scene, glass_ball("exact"), material, {0, -0.1, 0.1});
        EXPECT_GT(meetings_of(scene), 0u) << material;
        scene["render"]["bounces"] = 0;
        EXPECT_EQ(meetings_of(scene), 0u) << material;
        scene["render"]["bounces"] = kBounces;
        scene["render"]["shadows"] = false;
        EXPECT_EQ(meetings_of(scene), 0u) << material;
        scene["render"]["shadows"] = true;
        scene["lights"][0] = {{"type", "point"}, {"position", {0, 0.4, 0}}};
        EXPECT_EQ(meetings_of(scene), 0u) << material;
    }
    Json filtered = matt;
    add_thing(filtered, glass_ball("exact"), "glass", {0, -0.1, 0.1});
    filtered["render"]["shadow"] = "filtered";
    EXPECT_EQ(meetings_of(filtered), 0u);
    // Filtered shadows let nothing through where nothing transmits light.
    filtered["objects"].back()["material"] = "mirror";
    EXPECT_GT(meetings_of(filtered), 0u);
    add_thing(filtered, glass_ball("exact"), "glass", {0, 0.2, 0.1}, {{"visible", false}});
    EXPECT_GT(meetings_of(filtered), 0u);
}

TEST(MetLights, HaveTheSameBitsOnAnyNumberOfLanes) {
    Json json = lit_by(plate_room(4), true);
    kMirrorRooms[3].furnish(json);
    kMirrorRooms[5].furnish(json);
    kMirrorRooms[6].furnish(json);
    json["render"]["size"] = {15, 10};
    const Scene scene = parse_scene(json.dump(), "met lights", {});
    for (const int lanes : lanes_with_all()) {
        RenderReport report;
        const Image image = render(test_device(lanes), scene, report);
        EXPECT_EQ(report.not_finite, 0u);
        expect_golden("global/met_lights", oracle::image_hash(image));
    }
}

}  // namespace
}  // namespace voxelume
