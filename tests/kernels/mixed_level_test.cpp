// SPDX-License-Identifier: Apache-2.0
// Rays that begin on triangles below the field of their own mesh, and the fields that they meet
// later, in a device function.
#include <gtest/gtest.h>

#include <array>
#include <cstdint>
#include <vector>

#include "kernels/shared/voxel.h"
#include "runtime/opencl/program.hpp"
#include "runtime/stages/features.hpp"
#include "tests/support/test_device.hpp"

namespace voxelume {
namespace {

using FieldWords = std::array<uint32_t, VXL_FIELD_WORDS>;

/// A field whose distance at the height y of its voxel is `low` at 0 and `high` at 1, in voxels.
FieldWords field_of(double low, double high) {
    FieldWords record{};
    for (size_t word = 0; word < 4; ++word) {
        const auto value = uint32_t(int((word & 1 ? high : low) * VXL_DISTANCE_UNITS)) & 0xFFFFu;
        record[word] = value | value << 16;
    }
    return record;
}

/// Where a ray up the middle of a column of voxels that begins at y = 0.45 on a triangle of object
/// 1 meets the last of the fields, of these objects, in the voxels 0, 1 ...
float last_hit(const std::vector<FieldWords>& records, const std::vector<uint32_t>& objects) {
    const Device device = test_device();
    Features features;
    features.smooth = features.triangles = features.field_lists = true;
    features.mixed = features.attributes = features.paths = true;
    const Program program = Program::from_text(device, R"(
#include "lib/packets/packet.h"
#include "lib/packets/sight_rays.h"
kernel void climb(uint count, global const uint* fields, global const uint* attributes,
                  global float* results) {
    PyramidView p;
    p.plane_bound = 1e-6f;
    SurfaceView s;
    s.fields = fields;
    s.attributes = attributes;
    s.constant_attribute = 0u;
    const lane_float middle = (lane_float)0.5f, none = (lane_float)0.0f;
    Walk w = begin_walk(middle, (lane_float)0.45f, middle, none, (lane_float)1.0f, none);
    RayState ray_state = sight_ray_state();
    ray_state.on_surface = (lane_int)-1;
    ray_state.source = (lane_uint)7u;  // a triangle
    ray_state.field_of = (lane_uint)VXL_NO_OBJECT;
    ray_state.triangle_of = (lane_uint)1u;
    SurfaceHit found = no_hit_yet();
    for (uint i = 0u; i < count; ++i) {
        const lane_int beginning = (lane_int)(i == 0u ? -1 : 0);
        w.y = (lane_int)(int)i;
        if (i > 0u) w.t = (lane_float)((float)i - 0.45f), w.axis = (lane_int)1;
        found.t = (lane_float)INFINITY;
        hit_field(&p, &s, &w, (lane_uint)i, (lane_uint)(i + 1u), (lane_int)-1, beginning,
                  &ray_state, &found);
    }
    LANES_STORE(found.t, results, 0u);
}
)",
                                               features.defines(device));
    std::vector<uint32_t> words, attributes;
    for (const FieldWords& record : records)
        words.insert(words.end(), record.begin(), record.end());
    for (const uint32_t object : objects)
        attributes.push_back(VXL_KIND_SMOOTH << VXL_KIND_SHIFT | object);
    Buffer<float> results(device, "results", 16);
    program.kernel("climb").launch(WorkItem::heavy, 1, uint32_t(records.size()),
                                   Buffer<uint32_t>(device, "fields", std::span(words)),
                                   Buffer<uint32_t>(device, "attributes", std::span(attributes)),
                                   results);
    return results.read()[0];
}

// The own field's surface is at 0.55, a tenth of a voxel above the ray's origin, and the other's at
// 1.5, seen from below.
TEST(MixedLevel, LeavesFieldsOfOtherObjectsWhereTheyAre) {
    EXPECT_NEAR(last_hit({field_of(-0.55, 0.45), field_of(0.5, -0.5)}, {1, 2}), 1.05f, 1e-4f);
}

TEST(MixedLevel, LetsRaysOutOfTheirOwnField) {
    EXPECT_TRUE(std::isinf(last_hit({field_of(-0.55, 0.45)}, {1})));
    EXPECT_TRUE(std::isinf(last_hit({field_of(-1.55, -0.55), field_of(-0.55, 0.45)}, {1, 1})));
}

TEST(MixedLevel, EndsWhereARayHasLeftItsOwnField) {
    EXPECT_NEAR(last_hit({field_of(-0.55, 0.45), field_of(0.5, -0.5)}, {1, 1}), 1.05f, 1e-4f);
}

}  // namespace
}  // namespace voxelume
