// SPDX-License-Identifier: Apache-2.0
#include "runtime/stages/trace/beam.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstring>
#include <random>

#include "runtime/stages/index/index.hpp"
#include "runtime/stages/trace/trace.hpp"
#include "tests/support/brick_grids.hpp"
#include "tests/support/test_device.hpp"

namespace voxelume {
namespace {

constexpr uint32_t kBeamSeed = 20261122;
constexpr uint32_t kTiles = 1501;  // odd: the last packet has none to interleave with

/// Rays in groups of 16 that run next to each other, snapped as in shared/trace.h.
struct RayList {
    std::vector<float> values;
    uint32_t stride;

    explicit RayList(uint32_t count)
        : values(size_t(count) * VXL_RAY_COMPONENTS, -1.0f), stride(count) {}

    void set(uint32_t ray, const glm::dvec3& origin, const glm::dvec3& direction, float unit) {
        const double step = std::ldexp(1.0, -VXL_DIRECTION_BITS);
        int exponent = 0;
        std::frexp(std::max({std::abs(direction.x), std::abs(direction.y), std::abs(direction.z)}),
                   &exponent);
        for (uint32_t a = 0; a < 3; ++a) {
            const double d = std::ldexp(direction[int(a)], -exponent);
            values[(VXL_RAY_OX + a) * stride + ray] =
                float(std::round(origin[int(a)] * unit) / unit);
            values[(VXL_RAY_DX + a) * stride + ray] = float(std::round(d / step) * step);
        }
        values[VXL_RAY_END * stride + ray] = INFINITY;
    }
    RayBatch batch(const Device& device) const {
        RayBatch batch;
        batch.stride = stride;
        batch.rays = Buffer<float>(device, "rays", std::span<const float>(values));
        batch.hits = Buffer<uint32_t>(device, "hits", size_t(stride) * VXL_HIT_COMPONENTS);
        return batch;
    }
};

/// Tiles of rays from random points through random points, narrow and wide; some slots are idle.
RayList random_tiles(const Pyramid& pyramid, uint32_t tiles) {
    std::mt19937 random(kBeamSeed);
    const auto uniform = [&] { return double(random()) / 4294967296.0; };
    const glm::dvec3 size(pyramid.frame.size);
    RayList rays(tiles * VXL_BEAM_RAYS);
    for (uint32_t tile = 0; tile < tiles; ++tile) {
        const double spread = std::ldexp(1.0, -int(tile % 12));  // of the whole direction
        glm::dvec3 origin, target, shift;
        for (int a = 0; a < 3; ++a) {
            origin[a] = uniform() * size[a], target[a] = uniform() * size[a];
            if (tile % 3 == 0) target[a] = origin[a] + (a == int(tile % 7 % 3) ? 1 : 0);
            shift[a] = tile % 2 ? uniform() : 0;  // different origins
        }
        for (uint32_t i = 0; i < VXL_BEAM_RAYS; ++i) {
            if (tile % 5 == 0 && random() % 4 == 0) continue;
            glm::dvec3 direction = target - origin;
            for (int a = 0; a < 3; ++a) direction[a] += spread * (uniform() - 0.5);
            const glm::dvec3 start = glm::clamp(origin + shift * double(i % 4), {0, 0, 0}, size);
            rays.set(tile * VXL_BEAM_RAYS + i, start, direction, shape_of(pyramid).fixed_point);
        }
    }
    return rays;
}

HostBricks scattered_cubes(const glm::ivec3& size, int count) {
    std::mt19937 random(kBeamSeed);
    std::vector<glm::ivec3> voxels;
    for (int i = 0; i < count; ++i)
        voxels.push_back({int(random() % unsigned(size.x)), int(random() % unsigned(size.y)),
                          int(random() % unsigned(size.z))});
    return bare_bricks(frame_of(size), voxels);
}

/// The packed values of the hits. For a miss only its mark counts; the rest is cleared.
std::vector<uint32_t> hits_of(const RayBatch& batch) {
    std::vector<uint32_t> words = batch.hits.read(0, size_t(batch.stride) * VXL_HIT_PRIMITIVE);
    for (uint32_t i = 0; i < batch.stride; ++i)
        if (words[VXL_HIT_VOXEL * batch.stride + i] == VXL_NO_VOXEL)
            for (uint32_t c = 0; c < VXL_HIT_PRIMITIVE; ++c)
                words[c * batch.stride + i] = VXL_NO_VOXEL;
    return words;
}

class BeamLanes : public testing::TestWithParam<int> {};

TEST_P(BeamLanes, LeaveTheHitsAsTheyAre) {
    const Device device = test_device(GetParam());
    for (const auto& [voxels, of] : {std::pair(3, DilationLevel::leaves),
                                     {400, DilationLevel::leaves},
                                     {4000, DilationLevel::leaves},
                                     {3, DilationLevel::bricks},
                                     {60, DilationLevel::bricks},
                                     {400, DilationLevel::bricks}}) {
        const Pyramid pyramid =
            build_index(device, scattered_cubes({230, 137, 301}, voxels).upload(device));
        TraceStage trace(device, features_of(pyramid));
        BeamStage beams(device, features_of(pyramid), pyramid,
                        build_dilated_occupancy(device, pyramid, of));
        const RayList rays = random_tiles(pyramid, kTiles);
        RayBatch batch = rays.batch(device);
        trace.closest(pyramid, batch, batch.stride);
        const std::vector<uint32_t> expected = hits_of(batch);
        batch.hits.fill(0);
        beams.start(batch, batch.stride);
        trace.closest(pyramid, batch, batch.stride);
        const std::vector<uint32_t> hits = hits_of(batch);
        for (uint32_t i = 0; i < batch.stride; ++i)
            for (uint32_t c = 0; c < VXL_HIT_PRIMITIVE; ++c)
                ASSERT_EQ(hits[c * batch.stride + i], expected[c * batch.stride + i])
                    << "seed " << kBeamSeed << ", " << voxels << " voxels, dilated " << int(of)
                    << ", ray " << i << ", component " << c;
        const std::vector<uint32_t> words = batch.beams.read();
        const auto axes = words.begin() + VXL_BEAM_AXIS * VXL_BEAM_SLOTS(batch.stride);
        EXPECT_EQ(beams.sent(), kTiles);
        EXPECT_EQ(beams.cleared(), uint64_t(std::count(axes, axes + kTiles, VXL_BEAM_CLEAR)));
    }
}

INSTANTIATE_TEST_SUITE_P(Lanes, BeamLanes, testing::Values(1, 4, 8, 16));

/// The place where the first beam starts its rays, and the axis along which they run.
struct Start {
    float s;
    uint32_t axis;
};

Start first_start(const Device& device, const Pyramid& pyramid, const RayList& rays,
                  DilationLevel of = DilationLevel::leaves) {
    RayBatch batch = rays.batch(device);
    BeamStage(device, features_of(pyramid), pyramid, build_dilated_occupancy(device, pyramid, of))
        .start(batch, batch.stride);
    const std::vector<uint32_t> words = batch.beams.read();
    Start start{0, words[VXL_BEAM_AXIS * VXL_BEAM_SLOTS(batch.stride)]};
    std::memcpy(&start.s, &words[0], sizeof start.s);
    return start;
}

/// A single voxel at (130, 70, 200), and 4 x 4 rays half a voxel apart.
struct OneVoxel {
    Device device = test_device();
    Pyramid pyramid;
    RayList rays{VXL_BEAM_RAYS};

    explicit OneVoxel(const glm::ivec3& voxel = {130, 70, 200}) {
        const HostBricks bricks = bare_bricks(frame_of({230, 137, 301}), {voxel});
        pyramid = build_index(device, bricks.upload(device));
    }
    void aim(const glm::dvec3& origin, const glm::dvec3& direction, double apart) {
        for (uint32_t i = 0; i < VXL_BEAM_RAYS; ++i)
            rays.set(i, origin + glm::dvec3(i % 4, i / 4, 0) * apart, direction,
                     shape_of(pyramid).fixed_point);
    }
};

TEST(Beam, StartsItsRaysOneLeafBeforeTheFirstThatHoldsVoxels) {
    OneVoxel world;
    world.aim({129.5, 69.5, 0}, {0, 0, 1}, 0.5);
    const Start up = first_start(world.device, world.pyramid, world.rays);
    EXPECT_EQ(up.axis, 2u);
    EXPECT_NEAR(up.s, 196, 0.1);
    world.aim({129.5, 69.5, 301}, {0, 0, -1}, 0.5);
    const Start down = first_start(world.device, world.pyramid, world.rays);
    EXPECT_EQ(down.axis, 2u | VXL_BEAM_DOWN);
    EXPECT_NEAR(down.s, -208, 0.1);
}

TEST(Beam, InAHaloOfBricksStartsItsRaysOneBrickBefore) {
    OneVoxel world;
    world.aim({123, 63, 0}, {0, 0, 1}, 4);
    const Start up = first_start(world.device, world.pyramid, world.rays, DilationLevel::bricks);
    EXPECT_EQ(up.axis, 2u);
    EXPECT_NEAR(up.s, 176, 0.2);
    world.aim({123, 63, 301}, {0, 0, -1}, 4);
    const Start down = first_start(world.device, world.pyramid, world.rays, DilationLevel::bricks);
    EXPECT_EQ(down.axis, 2u | VXL_BEAM_DOWN);
    EXPECT_NEAR(down.s, -224, 0.2);
    world.aim({20, 20, 0}, {0, 0, 1}, 4);
    EXPECT_EQ(first_start(world.device, world.pyramid, world.rays, DilationLevel::bricks).axis,
              uint32_t{VXL_BEAM_CLEAR});
}

TEST(Beam, DilationsFitTheWidthOfPixels) {
    EXPECT_EQ(dilation_for(0.1), DilationLevel::leaves);
    EXPECT_EQ(dilation_for(2.4), DilationLevel::leaves);
    EXPECT_EQ(dilation_for(2.6), DilationLevel::bricks);
    EXPECT_EQ(dilation_for(9.9), DilationLevel::bricks);
    EXPECT_EQ(dilation_for(10.1), std::nullopt);
}

TEST(Beam, ThatSeesNothingBringsItsRaysOutOfTheWorld) {
    OneVoxel world;
    world.aim({20, 20, 0}, {0, 0, 1}, 0.5);
    const Start start = first_start(world.device, world.pyramid, world.rays);
    EXPECT_NEAR(start.s, 301, 0.1);
    EXPECT_EQ(start.axis, uint32_t{VXL_BEAM_CLEAR});
}

TEST(Beam, ThatBeginsInTheLastStepBeforeTheWorldsEndIsNotCalledClear) {
    for (const bool up : {false, true}) {
        OneVoxel world({130, 70, up ? 300 : 0});
        world.aim({130.25, 70.25, up ? 301 - 0x1p-8 : 0x1p-8}, {0, 0, up ? 1 : -1}, 0.125);
        EXPECT_NE(first_start(world.device, world.pyramid, world.rays).axis,
                  uint32_t{VXL_BEAM_CLEAR});
        RayBatch batch = world.rays.batch(world.device);
        TraceStage trace(world.device, features_of(world.pyramid));
        BeamStage(world.device, features_of(world.pyramid), world.pyramid,
                  build_dilated_occupancy(world.device, world.pyramid))
            .start(batch, batch.stride);
        trace.closest(world.pyramid, batch, batch.stride);
        for (uint32_t i = 0; i < VXL_BEAM_RAYS; ++i)
            EXPECT_NE(batch.hits.read_one(VXL_HIT_VOXEL * batch.stride + i), VXL_NO_VOXEL) << i;
    }
}

TEST(Beam, ThatEndsForItsWidthIsNotCalledClear) {
    OneVoxel world({130, 70, 300});
    for (uint32_t i = 0; i < VXL_BEAM_RAYS; ++i)
        world.rays.set(i, {20 + i % 4, 20 + i / 4, 0}, {0.02 * (i % 4), 0.02 * (i / 4), 1},
                       shape_of(world.pyramid).fixed_point);
    const Start start = first_start(world.device, world.pyramid, world.rays);
    EXPECT_LT(start.s, 300);
    EXPECT_EQ(start.axis, 2u);
}

TEST(Beam, EndsWhereItsRaysAreTooFarApart) {
    OneVoxel world;
    world.aim({10, 20, 0}, {0, 0, 1}, 4);
    EXPECT_LE(first_start(world.device, world.pyramid, world.rays).s, 0);
    world.aim({10, 20, 0}, {0, 0, 1}, 16);
    EXPECT_LE(first_start(world.device, world.pyramid, world.rays, DilationLevel::bricks).s, 0);
}

TEST(Beam, OfIdlePlacesIsClearAndOfIdleCornersNone) {
    OneVoxel world;
    EXPECT_EQ(first_start(world.device, world.pyramid, world.rays).axis, uint32_t{VXL_BEAM_CLEAR});
    world.rays.set(5, {20, 20, 0}, {0, 0, 1}, shape_of(world.pyramid).fixed_point);
    EXPECT_EQ(first_start(world.device, world.pyramid, world.rays).axis, uint32_t{VXL_BEAM_NONE});
}

}  // namespace
}  // namespace voxelume
