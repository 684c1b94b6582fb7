// SPDX-License-Identifier: Apache-2.0
#include "runtime/stages/light/light_beams.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <bit>
#include <cmath>
#include <numeric>
#include <random>

#include "runtime/stages/index/index.hpp"
#include "runtime/stages/light/light.hpp"
#include "runtime/stages/trace/ray_arrays.hpp"
#include "runtime/stages/trace/trace.hpp"
#include "tests/support/brick_grids.hpp"
#include "tests/support/test_device.hpp"

namespace voxelume {
namespace {

constexpr uint32_t kSeed = 20261123;
constexpr uint32_t kBeamRays = 16 * 301;  // odd: the last packet has none to interleave with
constexpr glm::ivec3 kSize{230, 137,
                           301};  // a dilated occupancy of bricks ends beyond it on all axes

class Random {
  public:
    double uniform() { return double(engine_()) / 0x1p32; }
    glm::dvec3 point(const glm::dvec3& size) {
        const double x = uniform(), y = uniform(), z = uniform();
        return size * glm::dvec3(x, y, z);
    }

  private:
    std::mt19937 engine_{kSeed};
};

std::vector<glm::ivec3> scattered_voxels(int count) {
    Random random;
    std::vector<glm::ivec3> voxels;
    for (int i = 0; i < count; ++i) voxels.emplace_back(random.point(kSize));
    return voxels;
}

Light beam_light(const glm::dvec3& position) {
    Light light;
    light.position = position;
    return light;
}

Light distant_light(const glm::dvec3& direction) {
    Light light;
    light.kind = LightKind::directional;
    light.direction = glm::normalize(direction);
    return light;
}

/// Lights around the world: near, far, and directional.
std::vector<Light> lights_outside() {
    Random random;
    const glm::dvec3 size(kSize), middle = 0.5 * size;
    std::vector<Light> lights;
    for (int axis = 0; axis < 3; ++axis)
        for (const double side : {-1.0, 1.0}) {
            for (const double distance : {0.15, 0.3, 1.0, 1000.0}) {
                glm::dvec3 at = random.point(size);
                at[axis] = middle[axis] + side * (0.5 + distance) * size[axis];
                lights.push_back(beam_light(at));
            }
            glm::dvec3 direction = random.point({1, 1, 1}) - 0.5;
            direction[axis] = -side;
            lights.push_back(distant_light(direction));
        }
    lights.push_back(distant_light({0, 1, 0}));
    lights.push_back(distant_light({1, 1, 1}));
    return lights;
}

/// A world of cubes, and shadow rays from its points to a light.
class ShadowedCubes {
  public:
    ShadowedCubes(const Device& device, int voxels)
        : device_(device),
          voxels_(scattered_voxels(voxels)),
          pyramid_(build_index(device, bare_bricks(frame_of(kSize), voxels_).upload(device))),
          features_(features_of(pyramid_)) {
        features_.shadows = true;
        batch_ = allocate_batch(device, features_, kBeamRays);
        queue_ = allocate_shadow_queue(device, features_, kBeamRays);
        queue_.count.fill(kBeamRays);
        queue_.traced.fill(0);
        std::vector<uint32_t> targets(kBeamRays);
        std::iota(targets.begin(), targets.end(), 0u);
        queue_.targets.write(std::span<const uint32_t>(targets));
        queue_.contributions.fill(1.0f);
    }

    const Pyramid& pyramid() const { return pyramid_; }

    const std::vector<glm::ivec3>& voxels() const { return voxels_; }

    /// Aims rays from random points next to voxels at the light, snapped as in shared/trace.h.
    void aim(const Light& light) {
        Random random;
        const LightRecord record = light_record(light, pyramid_.frame);
        const glm::dvec3 at(record.position.x, record.position.y, record.position.z);
        const double unit = double(shape_of(pyramid_).fixed_point);
        const double step = std::ldexp(1.0, -VXL_DIRECTION_BITS);
        std::vector<float> values(size_t(kBeamRays) * VXL_RAY_COMPONENTS);
        for (uint32_t i = 0; i < kBeamRays; ++i) {
            const glm::dvec3 voxel(voxels_[i % voxels_.size()]), aside = random.point({60, 60, 60});
            const glm::dvec3 place = glm::clamp(voxel + aside - 30.0, {0, 0, 0}, glm::dvec3(kSize));
            const glm::dvec3 from = glm::round(place * unit) / unit;
            const bool distant = light.kind == LightKind::directional;
            const glm::dvec3 to_light = distant ? at : at - from;
            int exponent = 0;
            std::frexp(std::max({std::abs(to_light.x), std::abs(to_light.y), std::abs(to_light.z)}),
                       &exponent);
            for (uint32_t a = 0; a < 3; ++a) {
                values[(VXL_RAY_OX + a) * kBeamRays + i] = float(from[int(a)]);
                values[(VXL_RAY_DX + a) * kBeamRays + i] =
                    float(std::round(std::ldexp(to_light[int(a)], -exponent) / step) * step);
            }
            values[VXL_RAY_END * kBeamRays + i] = distant ? INFINITY : std::ldexp(1.0f, exponent);
        }
        queue_.rays.write(std::span<const float>(values));
    }

    /// For each ray, whether it reaches the light.
    std::vector<float> reached(const LightBeams& beams = {}) {
        TraceStage trace(device_, features_);
        queue_.beams = beams;
        batch_.radiance.fill(0.0f);
        const Surroundings surroundings{
            Buffer<MaterialRecord>(device_, "materials", std::vector<MaterialRecord>(1)),
            Buffer<uint32_t>(device_, "ranks", std::vector<uint32_t>(1))};
        trace.shadows(pyramid_, surroundings, queue_, kBeamRays, batch_);
        return batch_.radiance.read(0, kBeamRays);
    }

    LightBeams send(const BeamGrid& grid, DilationLevel of) {
        LightBeamStage stage(device_, features_, pyramid_,
                             build_dilated_occupancy(device_, pyramid_, of));
        LightBeams beams{grid, stage.send(grid)};
        const std::vector<float> ends = beams.ends.read();
        const auto unsent = std::ranges::count(ends, -INFINITY);
        EXPECT_EQ(stage.sent() + uint64_t(unsent), ends.size());
        return beams;
    }

  private:
    Device device_;
    std::vector<glm::ivec3> voxels_;
    Pyramid pyramid_;
    Features features_;
    RayBatch batch_;
    ShadowQueue queue_;
};

int count_of(const std::vector<float>& values, float value) {
    return int(std::ranges::count(values, value));
}

class LightBeamLanes : public testing::TestWithParam<int> {};
INSTANTIATE_TEST_SUITE_P(Lanes, LightBeamLanes, testing::Values(1, 4, 8, 16));

TEST_P(LightBeamLanes, LeaveEveryShadowAsItIs) {
    const Device device = test_device(GetParam());
    int shadowed = 0, lit = 0, shortened = 0;
    // By default, each number of lanes runs with the densest world and some of the others.
    const size_t own_turn =
        GetParam() == 1 ? 0 : size_t(std::countr_zero(unsigned(GetParam())) - 1);
    size_t turn = 0;
    for (const auto& [voxels, of] : {std::pair(4000, DilationLevel::leaves),
                                     {3, DilationLevel::leaves},
                                     {400, DilationLevel::leaves},
                                     {3, DilationLevel::bricks},
                                     {60, DilationLevel::bricks},
                                     {150, DilationLevel::bricks}}) {
        if (!is_exhaustive() && voxels != 4000 && turn++ % 4 != own_turn) continue;
        ShadowedCubes world(device, voxels);
        for (const Light& light : lights_outside()) {
            const BeamGrid grid = beam_grid(light_record(light, world.pyramid().frame), kSize,
                                            scale_of(of), 1u << 20);
            const auto& at = light.position;
            ASSERT_GT(grid.columns, 0) << at.x << ' ' << at.y << ' ' << at.z;
            const LightBeams beams = world.send(grid, of);
            world.aim(light);
            const std::vector<float> expected = world.reached();
            EXPECT_EQ(world.reached(beams), expected)
                << "seed " << kSeed << ", " << voxels << " voxels, dilated " << int(of)
                << ", light at " << at.x << ' ' << at.y << ' ' << at.z;
            lit += count_of(expected, 1.0f);
            shadowed += count_of(expected, 0.0f);
            for (const float end : beams.ends.read()) shortened += end > -400.0f && end < INFINITY;
        }
    }
    EXPECT_GT(lit, 10000);
    EXPECT_GT(shadowed, 5000);
    EXPECT_GT(shortened, 1000);
}

/// Shows that the test above would find beams that are too narrow for their rays.
TEST(LightBeams, OfSquaresTooWideLetLightThroughVoxels) {
    ShadowedCubes world(test_device(), 4000);
    int wrong = 0;
    for (const Light& light : lights_outside()) {
        BeamGrid grid =
            beam_grid(light_record(light, world.pyramid().frame), kSize, 1.0f, 1u << 20);
        grid.edge *= 4;
        const LightBeams beams = world.send(grid, DilationLevel::leaves);
        world.aim(light);
        const std::vector<float> expected = world.reached(), found = world.reached(beams);
        for (uint32_t i = 0; i < kBeamRays; ++i) wrong += expected[i] != found[i];
    }
    EXPECT_GT(wrong, 100);
}

TEST(LightBeams, EndOneLeafBeforeVoxels) {
    const Device device = test_device();
    const Pyramid pyramid =
        build_index(device, bare_bricks(frame_of(kSize), {{130, 70, 200}}).upload(device));
    LightBeamStage stage(device, features_of(pyramid), pyramid,
                         build_dilated_occupancy(device, pyramid));
    for (const double side : {-1.0, 1.0}) {
        const BeamGrid grid = beam_grid(light_record(distant_light({0, 0, side}), pyramid.frame),
                                        kSize, 1.0f, 1u << 20);
        EXPECT_EQ(grid.axis, 2);
        EXPECT_EQ(grid.columns, 36);  // 33 squares of 7 voxels
        EXPECT_EQ(grid.rows, 20);
        std::vector<float> ends = stage.send(grid).read();
        std::erase(ends, -INFINITY);
        EXPECT_EQ(ends.size(), stage.sent() / (side > 0 ? 2 : 1));
        // The voxel's sector spans 64 x 64 voxels, which are 3 or 4 tiles of 28 along each axis.
        EXPECT_LE(ends.size(), 16u * 16);
        EXPECT_NEAR(*std::ranges::min_element(ends), side > 0 ? 196 : -208, 0.1);
        // Its leaf and the leaves around it, 12 voxels wide, block 2 x 2 or 3 x 3 beams.
        const auto ended = std::ranges::count_if(ends, [](float end) { return end < INFINITY; });
        EXPECT_GE(ended, 1);
        EXPECT_LE(ended, 9);
    }
}

TEST(LightBeams, AreSentToAllVoxels) {
    ShadowedCubes world(test_device(), 40);
    for (const Light& light : lights_outside()) {
        const LightRecord record = light_record(light, world.pyramid().frame);
        const BeamGrid grid = beam_grid(record, kSize, 1.0f, 1u << 20);
        const std::vector<float> ends = world.send(grid, DilationLevel::leaves).ends.read();
        const glm::dvec3 at(record.position.x, record.position.y, record.position.z);
        const int b = grid.axis == 0 ? 1 : 0, c = grid.axis == 2 ? 1 : 2;
        for (const glm::ivec3& voxel : world.voxels()) {
            const glm::dvec3 from = glm::dvec3(voxel) + 0.5;
            const glm::dvec3 way = light.kind == LightKind::directional ? at : at - from;
            const glm::dvec3 met =
                from + way * ((double(grid.far_side) - from[grid.axis]) / way[grid.axis]);
            const int x = int((met[b] - double(grid.low_b)) / double(grid.edge));
            const int y = int((met[c] - double(grid.low_c)) / double(grid.edge));
            ASSERT_TRUE(x >= 0 && x < grid.columns && y >= 0 && y < grid.rows);
            const int tile = y / 4 * (grid.columns / 4) + x / 4;
            EXPECT_GT(ends[size_t(tile * VXL_BEAM_TILE + y % 4 * 4 + x % 4)], -INFINITY);
        }
    }
}

TEST(LightBeams, AreNotSentFromLightsInTheWorldOrTooNear) {
    const GridFrame frame = frame_of(kSize);
    const auto grid_of = [&](const Light& light, uint32_t maximum) {
        return beam_grid(light_record(light, frame), kSize, 1.0f, maximum);
    };
    constexpr uint32_t kMany = 1u << 30;
    EXPECT_EQ(grid_of(beam_light({100, 100, 100}), kMany).columns, 0) << "inside";
    EXPECT_EQ(grid_of(beam_light({100, 137, 100}), kMany).columns, 0) << "on a side";
    EXPECT_EQ(grid_of(beam_light({100, 138, 100}), kMany).columns, 0) << "beams too oblique";
    const BeamGrid grid = grid_of(beam_light({100, 300, 100}), kMany);
    const auto count = uint32_t(grid.columns * grid.rows);
    EXPECT_GT(count, 0u);
    EXPECT_EQ(grid_of(beam_light({100, 300, 100}), count).columns, grid.columns);
    EXPECT_EQ(grid_of(beam_light({100, 300, 100}), count - 1).columns, 0);
    EXPECT_EQ(grid_of(distant_light({0, 0, 0}), kMany).columns, 0) << "no direction";
}

TEST(LightBeams, AreAsManyAsRaysMayPayFor) {
    const GridFrame frame = frame_of({100, 200, 400});
    EXPECT_EQ(light_beams_that_pay(frame, 1u << 20, 1, 1.0), 400u * 200 / 16);
    EXPECT_EQ(light_beams_that_pay(frame, 1u << 20, 4, 2.0), 400u * 200 / 16);
    EXPECT_EQ(light_beams_that_pay(frame, 1600, 1, 1.0), 100u) << "a part of the world is seen";
}

}  // namespace
}  // namespace voxelume
