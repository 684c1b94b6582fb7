// SPDX-License-Identifier: Apache-2.0
// The lattice of a scene that leaves it out is found from its objects.
#include "runtime/scene/fitted.hpp"

#include <fmt/format.h>
#include <gmock/gmock.h>

#include <cmath>
#include <glm/common.hpp>
#include <numbers>
#include <random>
#include <string>
#include <vector>

#include "tests/scene/fitted_scenes.hpp"

namespace voxelume {
namespace {

using testing::HasSubstr;

/// Expects that the world's bounds leave 4 to 5 voxels around a box whose sides are known to be
/// within `tolerance` of these.
void expect_fitted(const World& world, const Bounds& box, double tolerance) {
    for (int axis = 0; axis < 3; ++axis) {
        const double edge = world.voxel_size[axis];
        for (const double gap :
             {box.min[axis] - world.bounds.min[axis], world.bounds.max[axis] - box.max[axis]}) {
            EXPECT_GE(gap, 4 * edge - tolerance) << "axis " << axis;
            EXPECT_LE(gap, 5 * edge + tolerance) << "axis " << axis;
        }
    }
}

}  // namespace

TEST(FittedWorld, SurroundsABallWithAMarginInWholeVoxels) {
    const World world = parse_members(kBall).world;
    EXPECT_EQ(world.voxel_size, glm::dvec3(0.003907));  // 1 / 256 = 0.00390625, rounded up
    // 0.5 / 0.003907 = 127.98 and so on: 4 voxels more on every side.
    EXPECT_EQ(world.bounds.min, glm::dvec3(0.480561, -2.516108, 2.480945));
    EXPECT_EQ(world.bounds.max, glm::dvec3(1.515916, -1.480753, 3.516300));
    EXPECT_EQ(world.voxels, glm::ivec3(265));
}

TEST(FittedWorld, HasTheAskedResolutionOrVoxelSize) {
    const World coarse =
        parse_members(fmt::format(R"("world": {{"resolution": 20}}, {})", kBall)).world;
    EXPECT_EQ(coarse.voxel_size, glm::dvec3(0.05));
    EXPECT_EQ(coarse.bounds.min, glm::dvec3(0.3, -2.7, 2.3));
    EXPECT_EQ(coarse.bounds.max, glm::dvec3(1.7, -1.3, 3.7));
    EXPECT_EQ(coarse.voxels, glm::ivec3(28));
    const World sized =
        parse_members(fmt::format(R"("world": {{"voxel_size": [0.1, 0.25, 0.5]}}, {})", kBall))
            .world;
    EXPECT_EQ(sized.bounds.min, glm::dvec3(0.1, -3.5, 0.5));
    EXPECT_EQ(sized.bounds.max, glm::dvec3(1.9, -0.5, 5.5));
    EXPECT_EQ(sized.voxels, glm::ivec3(18, 12, 10));
}

TEST(FittedWorld, DividesGivenBoundsByTheResolution) {
    const std::string bounds = R"("bounds": {"min": [-1, -2, 0], "max": [1, 1, 2]})";
    const World world =
        parse_members(fmt::format(R"("world": {{"resolution": 30, {}}}, {})", bounds, kBall)).world;
    EXPECT_EQ(world.voxel_size, glm::dvec3(0.1));
    EXPECT_EQ(world.bounds, (Bounds{{-1, -2, 0}, {1, 1, 2}}));
    EXPECT_EQ(world.voxels, glm::ivec3(20, 30, 20));
    const World by_default =
        parse_members(fmt::format(R"("world": {{{}}}, {})", bounds, kBall)).world;
    EXPECT_EQ(by_default.voxel_size, glm::dvec3(3.0 / 256));
}

namespace {

/// Points on the surface of a solid in its own space, dense enough for its box.
struct Sampled {
    std::string text;
    std::vector<glm::dvec3> points;
};

constexpr int kSamples = 720;

/// A ring of points around Y.
void add_ring(double radius, double y, std::vector<glm::dvec3>& points) {
    for (int i = 0; i < kSamples; ++i) {
        const double angle = 2 * std::numbers::pi * i / kSamples;
        points.emplace_back(radius * std::cos(angle), y, radius * std::sin(angle));
    }
}

std::vector<Sampled> sampled_solids() {
    constexpr double pi = std::numbers::pi;
    std::vector<Sampled> solids = {
        {R"("shape": "sphere", "radius": 0.7)", {}},
        {R"("shape": "ellipsoid", "radii": [0.3, 0.9, 0.5])", {}},
        {R"("shape": "torus", "radius": 0.8, "tube": 0.25)", {}},
        {R"("shape": "capsule", "radius": 0.3, "height": 1.1)", {}},
        {R"("shape": "cylinder", "radius": 0.4, "height": 1.3)", {}},
        {R"("shape": "cone", "radius": 0.6, "height": 0.9, "top_radius": 0.2)", {}},
        {R"("shape": "box", "size": [0.5, 1.1, 0.8])", {}}};
    for (int i = 0; i <= kSamples; ++i) {
        const double angle = pi * i / kSamples, sine = std::sin(angle), cosine = std::cos(angle);
        add_ring(0.7 * sine, 0.7 * cosine, solids[0].points);
        add_ring(sine, cosine, solids[1].points);
        add_ring(0.8 + 0.25 * std::cos(2 * angle), 0.25 * std::sin(2 * angle), solids[2].points);
        add_ring(0.3 * sine, 0.3 * cosine + (cosine > 0 ? 0.55 : -0.55), solids[3].points);
    }
    for (glm::dvec3& p : solids[1].points) p *= glm::dvec3(0.3, 0.9, 0.5);
    for (const double y : {-0.65, 0.65}) add_ring(0.4, y, solids[4].points);
    add_ring(0.6, -0.45, solids[5].points);
    add_ring(0.2, 0.45, solids[5].points);
    for (int i = 0; i < 8; ++i)
        solids[6].points.emplace_back(i & 1 ? 0.25 : -0.25, i & 2 ? 0.55 : -0.55,
                                      i & 4 ? 0.4 : -0.4);
    return solids;
}

}  // namespace

TEST(FittedWorld, FitsSolidsUnderAffineMapsExactly) {
    const std::vector<Sampled> solids = sampled_solids();
    std::mt19937 random(20);
    std::uniform_real_distribution<double> number(-2, 2);
    for (int i = 0; i < 60; ++i) {
        const Sampled& solid = solids[size_t(i) % solids.size()];
        glm::dmat4 map(1);
        std::string rows;
        for (int row = 0; row < 3; ++row) {
            for (int column = 0; column < 4; ++column) map[column][row] = number(random);
            rows += fmt::format("{}[{}, {}, {}, {}]", row == 0 ? "" : ", ", map[0][row],
                                map[1][row], map[2][row], map[3][row]);
        }
        SCOPED_TRACE(fmt::format("seed 20, case {}: {} under {}", i, solid.text, rows));
        Bounds box{glm::dvec3(INFINITY), glm::dvec3(-INFINITY)};
        for (const glm::dvec3& p : solid.points) {
            const glm::dvec3 q(map * glm::dvec4(p, 1));
            box = {glm::min(box.min, q), glm::max(box.max, q)};
        }
        const World world =
            parse_members(
                fmt::format(
                    R"("models": {{"m": {{{}}}}}, "objects": [{{"model": "m", "matrix": [{}]}}])",
                    solid.text, rows))
                .world;
        expect_fitted(world, box, 1e-4);
    }
}

TEST(FittedWorld, HoldsTheObjectsOfAllFrames) {
    constexpr const char* kMoving =
        R"("models": {{"ball": {{"shape": "sphere", "radius": 0.5, "surface": "smooth"}},
"egg": {{"shape": "ellipsoid", "radii": [1, 2, 1], "surface": "smooth"}}}},
"objects": [{{"name": "a", "model": "ball"}}, {{"name": "b", "model": "ball", "visible": false}}],
"world": {{"voxel_size": 0.0625}}, "animation": {{"frames": {}, "tracks": [
 {{"target": "objects.a.position", "keys": [{{"frame": 1, "value": [0, 0, 0]}},
                                          {{"frame": 3, "value": [4, -2, 0]}}]}},
 {{"target": "objects.b.visible", "keys": [{{"frame": 1, "value": false}},
                                         {{"frame": 5, "value": true}}]}},
 {{"target": "objects.b.model", "keys": [{{"frame": 1, "value": "ball"}},
                                       {{"frame": 6, "value": "egg"}}]}},
 {{"target": "models.egg.radii", "keys": [{{"frame": 6, "value": [1, 2, 1]}},
                                        {{"frame": 7, "value": [1, 3, 1]}}]}}]}})";
    const auto bounds_of = [&](int frames) {
        return parse_members(fmt::format(kMoving, frames)).world.bounds;
    };
    const glm::dvec3 margin(0.25);
    EXPECT_EQ(bounds_of(1), (Bounds{-glm::dvec3(0.5) - margin, glm::dvec3(0.5) + margin}));
    EXPECT_EQ(bounds_of(2),
              (Bounds{glm::dvec3(-0.5, -1.5, -0.5) - margin, glm::dvec3(2.5, 0.5, 0.5) + margin}));
    EXPECT_EQ(bounds_of(5),
              (Bounds{glm::dvec3(-0.5, -2.5, -0.5) - margin, glm::dvec3(4.5, 0.5, 0.5) + margin}));
    EXPECT_EQ(bounds_of(6),
              (Bounds{glm::dvec3(-1, -2.5, -1) - margin, glm::dvec3(4.5, 2, 1) + margin}));
    EXPECT_EQ(bounds_of(7),
              (Bounds{glm::dvec3(-1, -3, -1) - margin, glm::dvec3(4.5, 3, 1) + margin}));
}

TEST(FittedWorld, LeavesOutWhatIsInfiniteOrInvisible) {
    const std::string alone = fmt::format(R"({}, "lights": [])", kBall);
    std::string more = alone;
    more.insert(more.find("\"objects\": [") + 12,
                R"({"model": "floor"}, {"model": "far", "visible": false}, {"model": "none"}, )");
    more.insert(more.find("\"models\": {") + 11,
                R"("floor": {"shape": "slab", "thickness": 0.1, "surface": "smooth"},
        "far": {"shape": "sphere", "radius": 100, "surface": "smooth"},
        "none": {"shape": "intersection", "parts": [{"shape": "sphere", "radius": 1},
            {"shape": "sphere", "radius": 1, "position": [5, 0, 0]}], "surface": "smooth"}, )");
    EXPECT_EQ(parse_members(alone).world.bounds, parse_members(more).world.bounds);
}

TEST(FittedWorld, SaysWhatToDoWhereNothingCanBeFitted) {
    const std::string advice =
        "so nothing tells how large the world is; give it \"bounds\": {\"min\": [x, y, z], "
        "\"max\": [x, y, z]}";
    EXPECT_EQ(message_about("\"objects\": []"),
              "s.json:1:1: world: there are no objects, " + advice);
    EXPECT_EQ(message_about("\"world\": {\"voxel_size\": 1}"),
              "s.json:2:10: world: there are no objects, " + advice);
    const std::string floor =
        R"("models": {"floor": {"shape": "slab", "thickness": 0.1, "surface": "smooth"}},
"objects": [{"model": "floor")";
    EXPECT_EQ(message_about(floor + "}]"),
              "s.json:1:1: world: all visible objects are infinite, such as a slab, " + advice);
    EXPECT_EQ(message_about(floor + R"(, "visible": false}])"),
              "s.json:1:1: world: no object is visible in any frame, " + advice);
    EXPECT_THAT(
        message_about(R"("models": {"b": {"shape": "sphere", "radius": 9e8, "surface": "smooth"}},
"objects": [{"model": "b", "position": [0, 5e8, 0]}])"),
        HasSubstr("its objects reach 1.43e+09 m from the origin along y, farther than 1e+09 m"));
    const Error many = error_of(
        [&] { parse_members(fmt::format(R"("world": {{"voxel_size": 1e-6}}, {})", kBall)); });
    EXPECT_EQ(many.kind(), ErrorKind::limit);
    EXPECT_THAT(many.what(), HasSubstr("voxels along x are more than 65536; use voxels of at"));
    EXPECT_THAT(
        message_about(fmt::format(R"("world": {{"voxel_size": 1, "resolution": 9}}, {})", kBall)),
        HasSubstr("\"voxel_size\" and \"resolution\" say the same thing"));
}

TEST(FittedWorld, NeedsNoBoundsOfObjectsWhereItsOwnAreGiven) {
    const Scene scene =
        parse_members(R"("world": {"bounds": {"min": [-1, -2, -3], "max": [1, 2, 3]}})");
    EXPECT_EQ(scene.world.bounds, (Bounds{{-1, -2, -3}, {1, 2, 3}}));
    EXPECT_EQ(scene.fitted.shown, lattice_bounds(scene.world))
        << "an observer without objects to see sees the world";
}

TEST(FittedWorld, GivesModelsItsVoxelSize) {
    const Scene scene = parse_members(R"("world": {"resolution": 10}, "models": {
 "a": {"shape": "sphere", "radius": 1, "surface": "smooth"}, "b": {"shape": "sphere", "radius": 1, "voxel_size": 0.3, "surface": "smooth"},
 "c": {"shape": "sphere", "radius": 1, "resolution": 7, "surface": "smooth"}}, "objects": [{"model": "a"}])");
    EXPECT_EQ(scene.models[0].voxel_size, glm::dvec3(0.2));
    EXPECT_EQ(scene.models[1].voxel_size, glm::dvec3(0.3));
    EXPECT_EQ(scene.models[2].voxel_size, glm::dvec3(0));
    EXPECT_EQ(scene.models[2].resolution, 7);
    EXPECT_GT(scene.models[0].extent.max.x, 1) << "extents follow the fitted bounds";
}

}  // namespace voxelume
