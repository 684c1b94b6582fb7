// SPDX-License-Identifier: Apache-2.0
// The density of a medium at points of segments, also where rounding puts these beyond the world.
#include <gtest/gtest.h>

#include <span>
#include <vector>

#include "kernels/shared/medium.h"
#include "kernels/shared/scene.h"
#include "runtime/opencl/program.hpp"
#include "tests/support/test_device.hpp"

namespace voxelume {
namespace {

constexpr const char* kDensitySource = R"(
#include "lib/lanes/work_item.h"
#include "lib/medium/free_path.h"
kernel void densities(PyramidShape shape, VXL_DENSITY_PARAMETERS, global const float* places,
                      uint stride, global float* found) {
    const uint first = work_item() * VXL_LANES;
    if (first >= stride) return;
    const DensityView density = VXL_DENSITY;
    const lane_float zero = (lane_float)0.0f, one = (lane_float)1.0f;
    const Segment s = {{LANES_LOAD(places, first), LANES_LOAD(places, stride + first),
                        LANES_LOAD(places, 2 * stride + first)},
                       {one, zero, zero}, zero, one};
    LANES_STORE(density_at(shape, &density, &s, zero, (lane_int)-1), found, first);
}
)";

constexpr int kBrickSide = 16;  // voxels of the world, which one brick holds

TEST(DensityAt, IsThatOfTheVoxelAtTheBorderForPointsBeyondIt) {
    // Behind the world's brick lie others, whose density is 99.
    std::vector<uint32_t> bricks(16, VXL_DENSITY_CONSTANT | 4u << VXL_DENSITY_SIZE_SHIFT | 4096u);
    bricks[0] = 0;
    std::vector<float> values(4097, 99);
    for (int i = 0; i < kBrickSide * kBrickSide * kBrickSide; ++i)
        values[size_t(i)] = float(i % kBrickSide + i / kBrickSide % kBrickSide * 100 +
                                  i / kBrickSide / kBrickSide * 10000);
    struct Place {
        float x, y, z, expected;
    };
    const std::vector<Place> asked = {{3.5f, 4.5f, 5.5f, 50403},   {16, 4.5f, 5.5f, 50415},
                                      {3.5f, 16, 5.5f, 51503},     {3.5f, 4.5f, 16, 150403},
                                      {-1e-6f, 4.5f, 5.5f, 50400}, {3.5f, -1e-6f, 5.5f, 50003},
                                      {3.5f, 4.5f, -1e-6f, 403},   {16, 16, 16, 151515}};
    for (const int lanes : {1, 4, 8, 16}) {
        const Device device = test_device(lanes);
        const uint32_t stride = 16;
        std::vector<float> places(3 * size_t{stride});
        for (size_t i = 0; i < stride; ++i) {
            const Place& place = asked[i % asked.size()];
            places[i] = place.x, places[stride + i] = place.y, places[2 * stride + i] = place.z;
        }
        PyramidShape shape{};
        shape.size_x = shape.size_y = shape.size_z = kBrickSide;
        DensityShape density{};
        density.bricks_x = density.bricks_y = 1;
        Buffer<float> found(device, "found", stride);
        Program::from_text(device, kDensitySource,
                           {{"VXL_MEDIUM_GRID", 1}, {"VXL_TRANSMISSION", 0}, {"VXL_SCATTERING", 1}})
            .kernel("densities")
            .launch_packets(stride, shape, density,
                            Buffer<uint32_t>(device, "bricks", std::span<const uint32_t>(bricks)),
                            Buffer<float>(device, "values", std::span<const float>(values)),
                            Buffer<float>(device, "places", std::span<const float>(places)), stride,
                            found);
        const std::vector<float> densities = found.read();
        for (size_t i = 0; i < stride; ++i)
            EXPECT_EQ(densities[i], asked[i % asked.size()].expected) << i << ", lanes " << lanes;
    }
}

}  // namespace
}  // namespace voxelume
