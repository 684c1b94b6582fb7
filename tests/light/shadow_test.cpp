// SPDX-License-Identifier: Apache-2.0
// Lit surfaces don't shadow themselves however low the light stands, and surfaces that face away
// from it are dark. Cases O9 and O10.
#include <gtest/gtest.h>

#include <numbers>

#include "tests/support/accuracy_fixture.hpp"
#include "tests/support/file_fixture.hpp"
#include "tests/support/test_device.hpp"
#include "tests/support/test_meshes.hpp"

namespace voxelume {
namespace {

constexpr double kEdge = 0.0091, kRadius = 0.21,
                 kFloor = 0.0137;             // no multiples of the voxel's edge
const glm::dvec3 kCenter(0.03, 0.31, -0.02);  // of the ball, metres

enum Part : uint32_t { kNothing = 0, kBall = 1, kGround = 2 };

/// A ball above a ground that ends outside the world, so that no rounded edge shadows it. The light
/// stands `elevation` radians above the horizon.
class Shadows : public FileTest, public testing::WithParamInterface<Surface> {
  protected:
    void SetUp() override {
        FileTest::SetUp();
        write_obj(folder / "ball.obj", ball(kCenter, kRadius, 128, 64));
        write_obj(folder / "ground.obj", box({-1.5f, -0.03f, -1.3f}, {1.5f, float(kFloor), 1.3f}));
    }

    Scene scene(double elevation) const {
        Scene s;
        s.world.voxel_size = glm::dvec3(kEdge);
        s.world.bounds.min = {-0.77, -0.1, -0.67};
        s.world.voxels = {170, 78, 148};
        s.world.bounds.max = s.world.bounds.min + kEdge * glm::dvec3(s.world.voxels);
        s.materials.emplace_back();
        for (const char* name : {"ball.obj", "ground.obj"}) {
            Model model;
            model.mesh = folder / name;
            model.voxel_size = glm::dvec3(kEdge);
            model.surface = GetParam();
            model.set = VoxelSet::solid;
            model.extent = s.world.bounds;
            s.models.push_back(model);
            s.objects.emplace_back();
            s.objects.back().model = int(s.objects.size() - 1);
        }
        Light light;
        light.kind = LightKind::directional;
        light.direction = -to_light(elevation);
        s.lights.push_back(light);
        s.render.size = {240, 180};
        s.observer = observer_at({0.4, 1.1, 1.3}, {0, 0.1, 0}, 0.75, s.render.size);
        return s;
    }

    static glm::dvec3 to_light(double elevation) {
        return glm::normalize(
            glm::dvec3(0.8 * std::cos(elevation), std::sin(elevation), 0.6 * std::cos(elevation)));
    }

    /// Expects that no pixel that faces the light by a cosine above 1e-3, and that `is_free` says
    /// is clear of cast shadows, is darker with shadows than without.
    template <class Free>
    void expect_no_acne(double elevation, const Free& is_free, size_t minimum) const {
        Scene s = scene(elevation);
        RenderReport report;
        s.render.shadows = false;
        const Image bare = render(test_device(), s, report);
        s.render.shadows = true;
        const Image shadowed = render(test_device(), s, report);
        const glm::dvec3 l = to_light(elevation);
        size_t lit = 0, acne = 0;
        for (size_t i = 0; i < bare.planes.at("R").size(); ++i) {
            const auto vector = [&](const char* x, const char* y, const char* z) {
                return glm::dvec3(bare.planes.at(x)[i], bare.planes.at(y)[i], bare.planes.at(z)[i]);
            };
            const glm::dvec3 p = vector("P.X", "P.Y", "P.Z");
            const auto part = Part(bare.id_planes.at("objectId")[i]);
            const double cosine = glm::dot(vector("N.X", "N.Y", "N.Z"), l);
            if (part == kNothing || cosine <= 1e-3 || !is_free(part, p, l)) continue;
            ++lit;
            if (shadowed.planes.at("R")[i] == bare.planes.at("R")[i]) continue;
            if (++acne <= 5)
                ADD_FAILURE() << "pixel " << i << " of object " << part << " at " << p.x << ' '
                              << p.y << ' ' << p.z << " with cosine " << cosine;
        }
        EXPECT_GT(lit, minimum);
        EXPECT_EQ(acne, 0u) << "of " << lit;
    }
};

/// True if a point of the ground is clear of the shadow at the world's bounds. The ground ends
/// there, and the rim of a smooth surface stands up to a quarter of a voxel above it.
bool clear_of_rim(const glm::dvec3& p, const glm::dvec3& l, const Bounds& world) {
    const glm::dvec3 at_rim = p + l * (0.25 * kEdge / l.y);
    return at_rim.x < world.max.x - 3 * kEdge && at_rim.z < world.max.z - 3 * kEdge;
}

/// True if a point of the ground is clear of the ball's shadow by two voxels.
bool clear_of_ball(const glm::dvec3& p, const glm::dvec3& l) {
    return glm::length(glm::cross(kCenter - p, l)) > kRadius + 0.02 || glm::dot(kCenter - p, l) < 0;
}

TEST_P(Shadows, O9FlatGroundUnderALowLightIsLit) {
    const Bounds bounds = scene(0.3).world.bounds;
    for (const double elevation : {0.1 * std::numbers::pi / 180, 0.02, 0.3})
        expect_no_acne(
            elevation,
            [&](Part part, const glm::dvec3& p, const glm::dvec3& l) {
                return part == kGround && p.y > kFloor - 0.01 && clear_of_ball(p, l) &&
                       clear_of_rim(p, l, bounds);
            },
            1000);
}

TEST_P(Shadows, O9TheLitSideOfABallIsLit) {
    if (GetParam() == Surface::cubes) GTEST_SKIP() << "stairs of cubes do shadow one another";
    for (const double elevation : {0.02, 0.9})
        expect_no_acne(
            elevation,
            [](Part part, const glm::dvec3&, const glm::dvec3&) { return part == kBall; }, 800);
}

INSTANTIATE_TEST_SUITE_P(Surfaces, Shadows,
                         testing::Values(Surface::cubes, Surface::smooth, Surface::exact));

}  // namespace
}  // namespace voxelume
