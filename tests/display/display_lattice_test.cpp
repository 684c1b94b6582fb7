// SPDX-License-Identifier: Apache-2.0
// The voxels that a Cartesian display shows, against what an observer sees by geometry alone.
#include <gtest/gtest.h>

#include <algorithm>
#include <set>

#include "runtime/base/error.hpp"
#include "runtime/image/volume_geometry.hpp"
#include "tests/support/display_fixture.hpp"

namespace voxelume {
namespace {

/// A lattice by its documented rules, in double precision.
struct LatticeOracle {
    const VolumeFrame& frame;
    const Observer& observer;

    glm::dvec3 world(const glm::dvec3& lattice) const {
        return observer.position +
               observer.world_from_observer * (frame.origin + frame.edge * lattice);
    }
    glm::dvec3 lattice(const glm::dvec3& p) const {
        const glm::dvec3 q = glm::transpose(observer.world_from_observer) * (p - observer.position);
        return (q - frame.origin) / frame.edge;
    }
    /// A measure of how far a voxel's middle is inside the display's shape. Only its sign is exact.
    double inside(const glm::dvec3& middle) const {
        const glm::dvec3 q = frame.origin + frame.edge * middle;
        const Display& d = frame.display;
        const double r = glm::length(q);
        const glm::dvec3 c = middle / glm::dvec3(frame.size) * 2.0 - 1.0;
        double minimum = d.cylinder ? 1 - std::hypot(c.x, c.z) : 1;
        switch (d.shape) {
            case DisplayShape::pyramid:
                return std::min({minimum, q.z * std::tan(d.half_angles.x) - std::abs(q.x),
                                 q.z * std::tan(d.half_angles.y) - std::abs(q.y)});
            case DisplayShape::sector:
                return std::min({minimum, d.far - r, r - d.near,
                                 d.half_angles.x - std::acos(std::clamp(q.z / r, -1.0, 1.0))});
            case DisplayShape::ball:
                return std::min(minimum, d.far - r);
            case DisplayShape::box:
                break;
        }
        return minimum;
    }
    /// The point from which the observer sees a point: E, or for a box display the nearest point of
    /// the box's plane.
    glm::dvec3 eye(const glm::dvec3& p) const {
        if (frame.display.shape != DisplayShape::box) return observer.position;
        const glm::dvec3& ahead = observer.world_from_observer[2];
        return p - ahead * glm::dot(p - observer.position, ahead);
    }
    uint64_t index_of(const glm::ivec3& v) const {
        return uint64_t(v.x) +
               uint64_t(frame.size.x) * (uint64_t(v.y) + uint64_t(frame.size.y) * uint64_t(v.z));
    }
    glm::ivec3 voxel(uint64_t index) const {
        return {int(index % uint64_t(frame.size.x)),
                int(index / uint64_t(frame.size.x) % uint64_t(frame.size.y)),
                int(index / (uint64_t(frame.size.x) * uint64_t(frame.size.y)))};
    }
};

/// Visits the voxels that contain a point or lie within `margin` voxels of it.
template <class Visit>
void for_each_voxel_near(const glm::dvec3& p, double margin, const Visit& visit) {
    const glm::ivec3 low(glm::floor(p - margin)), high(glm::floor(p + margin));
    for (int z = low.z; z <= high.z; ++z)
        for (int y = low.y; y <= high.y; ++y)
            for (int x = low.x; x <= high.x; ++x) visit(glm::ivec3(x, y, z));
}

class Lattice : public testing::TestWithParam<DisplayCase> {};

/// Whether a point can be seen for certain, or within rounding, from E or along the directions from
/// outside that the manual names.
struct Sightings {
    bool surely = false, maybe = false;
};

Sightings sightings_of(const LatticeOracle& lattice, const oracle::SimpleScene& solids,
                       const glm::dvec3& p, double edge) {
    Sightings result;
    const Visibility visibility = lattice.frame.display.visibility;
    if (visibility == Visibility::all) return {true, true};
    const auto look_from = [&](const glm::dvec3& eye) {
        result.surely |= solids.is_seen(eye, p, 1e-9);
        result.maybe |= solids.is_seen(eye, p, edge);
    };
    if (visibility == Visibility::observer) {
        look_from(lattice.eye(p));
        return result;
    }
    for (int i = 0; i < 27 && !result.surely; ++i) {
        const glm::dvec3 way(i % 3 - 1, i / 3 % 3 - 1, i / 9 - 1);
        if (i != 13) look_from(p + 10.0 * glm::normalize(way));
    }
    return result;
}

/// The voxels that hold visible surface points: `must` for certain, `may` within rounding.
struct ExpectedVoxels {
    std::set<uint64_t> must, may;
};

ExpectedVoxels expected_voxels(const LatticeOracle& lattice) {
    const oracle::SimpleScene solids = display_solids();
    const VolumeFrame& frame = lattice.frame;
    const double edge = std::min({frame.edge.x, frame.edge.y, frame.edge.z});
    ExpectedVoxels expected;
    for (const oracle::SimpleSolid& solid : solids.solids)
        for (const glm::dvec3& p : solid.surface_points(0.08 * edge)) {
            const auto seen = sightings_of(lattice, solids, p, edge);
            if (!seen.maybe) continue;
            const glm::dvec3 q = lattice.lattice(p);
            for_each_voxel_near(q, 0.09, [&](const glm::ivec3& v) {
                if (glm::any(glm::lessThan(v, glm::ivec3(0))) ||
                    glm::any(glm::greaterThanEqual(v, frame.size)))
                    return;
                const double inside = lattice.inside(glm::dvec3(v) + 0.5);
                if (inside < -1e-5) return;
                expected.may.insert(lattice.index_of(v));
                const glm::dvec3 within = q - glm::dvec3(v);
                const double depth = std::min(
                    {within.x, within.y, within.z, 1 - within.x, 1 - within.y, 1 - within.z});
                if (seen.surely && depth > 0.04 && inside > 1e-5)
                    expected.must.insert(lattice.index_of(v));
            });
        }
    return expected;
}

void expect_exactly_the_visible(const Scene& scene) {
    const Volume volume = volume_of(scene);
    const auto [must, may] = expected_voxels({volume.frame, scene.observer});
    const std::set<uint64_t> shown(volume.indices.begin(), volume.indices.end());
    size_t holes = 0, extras = 0;
    for (const uint64_t index : must) holes += !shown.contains(index);
    for (const uint64_t index : shown) extras += !may.contains(index);
    EXPECT_EQ(holes, 0u) << "of " << must.size();
    EXPECT_EQ(extras, 0u) << "of " << shown.size();
    EXPECT_GT(must.size(), may.size() / 2);
    EXPECT_GT(must.size(), 150u);
}

TEST_P(Lattice, ShowsExactlyTheVoxelsOfVisibleSurface) {
    expect_exactly_the_visible(parsed(display_scene(
        std::string(GetParam().keys) + R"(, "layout": "lattice", "voxels": [61, 53, 47])")));
}

TEST_P(Lattice, ShowsExactlyTheVoxelsThatOutsideOrNobodySees) {
    Scene scene = parsed(display_scene(std::string(GetParam().keys) +
                                       R"(, "layout": "lattice", "voxels": [43, 37, 31])"));
    for (const Visibility visibility : {Visibility::outside, Visibility::all}) {
        SCOPED_TRACE(int(visibility));
        scene.observer.display.visibility = visibility;
        expect_exactly_the_visible(scene);
    }
}

TEST(LatticeOfCoarseVoxels, ReachesFarBeyondTheWorld) {
    Scene scene = parsed(display_scene(R"("shape": "box", "size": [91, 60.2, 73], "near": 0,
                                          "layout": "lattice", "voxels": [700, 700, 730])"));
    const Volume far = volume_of(scene);
    // Only lines that meet the world are scanned: about 3 m in steps of 0.04 m in each direction,
    // on three sides.
    RenderReport report;
    render_volume(test_device(), scene, report);
    EXPECT_LT(report.sight_rays, 120'000u);
    // A display that ends around the world shows the same voxels.
    scene.observer.display.voxels = {70, 70, 73};
    scene.observer.display.half_size = {4.55, 3.01};
    scene.observer.display.far = 7.3;
    const Volume near = volume_of(scene);
    ASSERT_GT(near.indices.size(), 100u);
    ASSERT_EQ(far.indices.size(), near.indices.size());
    for (size_t i = 0; i < near.indices.size(); ++i) {
        const glm::ivec3 v = cell_of(near.frame, near.indices[i]);
        EXPECT_EQ(cell_of(far.frame, far.indices[i]), v + glm::ivec3(315, 315, 0));
        EXPECT_NEAR(far.depths[i], near.depths[i], 2e-3);
    }
}

/// Worlds with much room around their objects, along each axis in turn.
TEST(LatticeOfEmptySpace, IsScannedWhereObjectsAreWithTheSameBits) {
    constexpr const char* kText = R"({{"voxelume": 1,
        "world": {{"voxel_size": 0.05, "bounds": {{"min": [-1, -1, -1], "max": [{}, {}, {}]}}}},
        "models": {{"ball": {{"shape": "sphere", "radius": 0.3, "surface": "smooth"}},
                   "box": {{"shape": "box", "size": [0.3, 0.4, 0.5], "surface": "exact"}}}},
        "objects": [{{"model": "ball", "position": [-0.4, -0.5, -0.3]}},
                    {{"model": "box", "turn": [20, 30, 40], "position": [0.2, 0.4, 0.1]}}],
        "lights": [], "observer": {{"position": [3, 2.5, -3], "look_at": [0.9, 0.7, 0.8],
            "display": {{"shape": "box", "size": [9, 8, 11], "near": 0, "layout": "lattice",
                        "voxels": [120, 110, 130]}}}}}})";
    for (const glm::dvec3& high : {glm::dvec3(8, 1, 1), glm::dvec3(1, 8, 1), glm::dvec3(1, 1, 8)}) {
        const Scene scene = parsed(fmt::format(kText, high.x, high.y, high.z));
        RenderReport report, whole;
        BuiltWorld world = WorldBuilder(test_device(), false).build(scene, report.world);
        const Volume volume = render_volume(test_device(), scene, world, report);
        world.pyramid.object_boxes.clear();  // not known: the whole world is scanned
        const Volume expected = render_volume(test_device(), scene, world, whole);
        EXPECT_GT(volume.indices.size(), 200u);
        EXPECT_EQ(volume.indices, expected.indices);
        EXPECT_EQ(volume.colors, expected.colors);
        EXPECT_EQ(volume.depths, expected.depths);
        EXPECT_EQ(volume.objects, expected.objects);
        EXPECT_LT(report.sight_rays, whole.sight_rays * 3 / 4);
    }
}

/// Rays that look ahead for a display's voxels begin as lit rays do, whatever was in their memory.
/// Rays that meet a ball where the world cuts it off aren't taken to begin on it.
TEST(LatticeOfMirrors, ShowsTheVoxelsOfDullSurfaces) {
    constexpr const char* kText = R"({{"voxelume": 1,
        "world": {{"voxel_size": 0.04, "bounds": {{"min": [-0.4, -0.4, -0.4], "max": [0.4, 0.4, 0.4]}}}},
        "models": {{"ball": {{"shape": "sphere", "radius": 0.5, "surface": "{}"}}}},
        "materials": {{"mirror": {{"reflection": {}}}}},
        "objects": [{{"model": "ball", "material": "mirror"}}],
        "lights": [], "observer": {{"position": [0.6, 0.9, -1.5], "look_at": [0, 0, 0],
            "display": {{"shape": "pyramid", "angles": [50, 50], "layout": "lattice",
                        "voxels": [41, 37, 33]}}}},
        "render": {{"depth": 2}}}})";
    for (const char* surface : {"cubes", "smooth", "exact"}) {
        const Volume dull = volume_of(parsed(fmt::format(kText, surface, 0)));
        const Volume mirror = volume_of(parsed(fmt::format(kText, surface, 0.6)));
        EXPECT_GT(dull.indices.size(), 100u) << surface;
        EXPECT_EQ(mirror.indices, dull.indices) << surface;
        EXPECT_EQ(mirror.depths, dull.depths) << surface;
        EXPECT_EQ(mirror.objects, dull.objects) << surface;
    }
}

TEST(LatticeOfManyVoxels, WithMoreLinesThanCanBeNumberedIsRefused) {
    Scene scene = parsed(display_scene(R"("shape": "box", "size": [2, 2, 2], "near": 1.5,
                                          "layout": "lattice", "voxels": [65536, 65536, 1])"));
    try {
        volume_of(scene);
        FAIL() << "not refused";
    } catch (const Error& error) {
        EXPECT_EQ(error.kind(), ErrorKind::limit);
    }
}

TEST(LatticeCylinder, ClipsWhatLiesNextToIt) {
    for (const char* keys :
         {R"("shape": "box", "size": [1.6, 2.3, 2.1], "near": 1.5)",
          R"("shape": "pyramid", "angles": [27, 30], "near": 1.2, "far": 3.5)"}) {
        Scene scene = parsed(display_scene(std::string(keys) + R"(, "layout": "lattice",
                                           "visibility": "all", "voxels": [41, 37, 33])"));
        const size_t whole = volume_of(scene).indices.size();
        scene.observer.display.cylinder = true;
        expect_exactly_the_visible(scene);
        EXPECT_LT(volume_of(scene).indices.size(), whole - 20);
    }
}

TEST_P(Lattice, EveryVoxelIsWithinHalfItsDiagonalOfTheSurface) {
    const Scene scene = parsed(display_scene(std::string(GetParam().keys) +
                                             R"(, "layout": "lattice", "voxels": [41, 33, 37])"));
    for (const char* visibility : {"observer", "outside", "all"}) {
        Scene s = scene;
        s.observer.display.visibility = std::string(visibility) == "observer" ? Visibility::observer
                                        : std::string(visibility) == "all"    ? Visibility::all
                                                                              : Visibility::outside;
        const Volume volume = volume_of(s);
        const LatticeOracle lattice{volume.frame, s.observer};
        const double half_diagonal = glm::length(volume.frame.edge) / 2;
        ASSERT_GT(volume.indices.size(), 100u);
        ASSERT_TRUE(std::ranges::is_sorted(volume.indices));
        for (size_t i = 0; i < volume.indices.size(); ++i) {
            const glm::dvec3 middle = glm::dvec3(lattice.voxel(volume.indices[i])) + 0.5;
            ASSERT_LE(display_solids().distance(lattice.world(middle)), half_diagonal + 1e-5)
                << visibility << " " << volume.indices[i];
            ASSERT_EQ(volume.opacities[i], 1.0f);
            ASSERT_EQ(volume.kinds[i], VoxelKind::object)
                << visibility << " " << middle.x << " " << middle.y << " " << middle.z;
            ASSERT_TRUE(volume.objects[i] == 1 || volume.objects[i] == 2);
        }
    }
}

INSTANTIATE_TEST_SUITE_P(Shapes, Lattice, testing::ValuesIn(kDisplayCases),
                         [](const auto& shape) { return shape.param.name; });

}  // namespace
}  // namespace voxelume
