// SPDX-License-Identifier: Apache-2.0
// Surfaces of rough glass, the values that kernels compute for them, and the directions into which
// they scatter paths.
#pragma once

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstring>
#include <glm/vec3.hpp>
#include <span>
#include <vector>

#include "runtime/stages/features.hpp"
#include "runtime/stages/light/tables/albedo_table.hpp"
#include "runtime/stages/light/tables/glass_table.hpp"
#include "tests/support/test_device.hpp"

namespace voxelume {

inline constexpr const char* kGlassSource = R"(
#include "lib/lanes/work_item.h"
#include "lib/light/physical.h"
#include "lib/sampling/sobol.h"
static PhysicalView glass_at(global const float* materials, lane_float cosine, uint inside) {
    const Vector n = {(lane_float)0.36f, (lane_float)0.48f, (lane_float)-0.8f};
    const Frame f = frame_around(n);
    const Vector out = {exact_sqrt(1.0f - cosine * cosine), (lane_float)0.0f, cosine};
    const Colors none = {0, 0, 0, (lane_uint)0};
    return view_physical(materials, (lane_int)-1, (lane_uint)0, (lane_uint)0, none, n,
                         out_of_frame(&f, out), (lane_int)(inside ? -1 : 0));
}
static lane_int glass_light(const PhysicalView* s, Vector way, lane_float* value,
                            lane_float* density) {
    lane_float beyond[3], likely;
    const lane_int above = physical_value(s, way, value, density);
    const lane_int through = physical_through(s, way, beyond, &likely);
    for (int c = 0; c < 3; ++c) value[c] = LANES_SELECT(through, beyond[c], value[c]);
    *density = LANES_SELECT(through, likely, *density);
    return above | through;
}
kernel void value_glass(global const float* materials, uint inside, uint count,
                        global const float* outs, global const float* ins, uint stride,
                        global float* values) {
    const uint first = work_item() * VXL_LANES;
    if (first >= count) return;
    const PhysicalView s = glass_at(materials, LANES_LOAD(outs, first), inside);
    lane_float value[3], density;
    glass_light(&s, out_of_frame(&s.frame, load_vector(ins, stride, first)), value, &density);
    LANES_STORE(value[0], values, first);
    LANES_STORE(value[1], values, stride + first);
    LANES_STORE(density, values, 2u * stride + first);
}
kernel void scatter_glass(global const float* materials, uint inside, uint count, float out,
                          uint seed, uint stride, global float* ways) {
    const uint first = work_item() * VXL_LANES;
    if (first >= count) return;
    const lane_uint number = LANES_AS_UINT(LANES_NUMBERS + (int)first);
    const PhysicalView s = glass_at(materials, (lane_float)out, inside);
    const lane_uint case_number = mixed_number((lane_uint)seed);
    const SquarePoint at = sobol_point(number, decision_seed(case_number, (lane_uint)0));
    const lane_float layer = sobol_point(number, decision_seed(case_number, (lane_uint)1)).x;
    lane_int down;
    const Vector way = physical_direction(&s, at, layer, &down);
    const Vector in_frame = into_frame(&s.frame, way);
    store_vector(in_frame, ways, stride, first);
    lane_float value[3], density;
    const lane_int meant = ~(down ^ LANE_MASK(in_frame.z < 0.0f));
    const lane_int some =
        meant & glass_light(&s, way, value, &density) & LANE_MASK(density > 0.0f);
    const lane_float weight =
        exact_divide(value[0], LANES_SELECT(some, density, (lane_float)1.0f));
    LANES_STORE(LANES_SELECT(some, weight, (lane_float)0.0f), ways, 3u * stride + first);
}
)";

struct GlassSurface {
    double roughness = 0.5, ior = 1.5, share = 1, metallic = 0;
    uint32_t inside = 0;
};

inline void PrintTo(const GlassSurface& s, std::ostream* out) {
    *out << "roughness " << s.roughness << ", ior " << s.ior << ", glass " << s.share
         << (s.inside ? ", from inside" : "");
}

/// A material's record and its tables. Its colour is white, but for half green.
inline std::vector<float> glass_floats(const GlassSurface& s) {
    const double width = width_of(s.roughness);
    const AlbedoTable table = albedo_table(width);
    const GlassTable glass = glass_table(width, s.ior);
    MaterialRecord record{};
    record.color[0] = record.color[2] = 1, record.color[1] = 0.5f;
    record.metallic = float(s.metallic);
    record.width = float(width);
    record.reflectance = float(std::pow((s.ior - 1) / (s.ior + 1), 2));
    record.albedos = VXL_MATERIAL_FLOATS;
    record.missing = float(table.missing);
    record.matt = float((1 - s.metallic) / passed_share(record.reflectance, table));
    record.refraction = float(s.share);
    record.shininess = float(VXL_MATERIAL_FLOATS + table.values.size());
    std::vector<float> floats(VXL_MATERIAL_FLOATS);
    std::memcpy(floats.data(), &record, sizeof record);
    floats.insert(floats.end(), table.values.begin(), table.values.end());
    std::vector<float> block(VXL_GLASS_FLOATS);
    block[VXL_GLASS_IOR] = float(s.ior);
    for (size_t side = 0; side < 2; ++side) {
        block[VXL_GLASS_BACK + side] = float(glass.back[side]);
        block[VXL_GLASS_PER_MISSING + side] = float(1 / glass.missing[side]);
    }
    std::copy(glass.values.begin(), glass.values.end(), block.begin() + VXL_GLASS_TABLE);
    floats.insert(floats.end(), block.begin(), block.end());
    return floats;
}

class RoughGlass : public testing::TestWithParam<GlassSurface> {
  protected:
    struct Value {
        double white, half, density;
    };

    static std::vector<Value> values(const GlassSurface& s, const std::vector<double>& outs,
                                     const std::vector<glm::dvec3>& ins) {
        const Device device = test_device();
        const auto count = uint32_t(outs.size()), stride = (count + 15) / 16 * 16;
        std::vector<float> o(stride, 1.0f), i(3 * size_t(stride), 0.5f);
        for (uint32_t k = 0; k < count; ++k) {
            o[k] = float(outs[k]);
            for (uint32_t c = 0; c < 3; ++c) i[c * stride + k] = float(ins[k][int(c)]);
        }
        Buffer<float> found(device, "values", size_t(stride) * 3);
        program(device)
            .kernel("value_glass")
            .launch_packets(count, materials(device, s), s.inside, count,
                            Buffer<float>(device, "outs", std::span<const float>(o)),
                            Buffer<float>(device, "ins", std::span<const float>(i)), stride, found);
        const std::vector<float> v = found.read();
        std::vector<Value> result(count);
        for (uint32_t k = 0; k < count; ++k) result[k] = {v[k], v[stride + k], v[2 * stride + k]};
        return result;
    }

    /// Four arrays: the directions that paths take, and pi times the weights of their light.
    static std::vector<float> scattered(const GlassSurface& s, double out, uint32_t count,
                                        uint32_t seed, int lanes = 0) {
        const Device device = test_device(lanes);
        Buffer<float> ways(device, "ways", size_t(count) * 4);
        program(device)
            .kernel("scatter_glass")
            .launch_packets(count, materials(device, s), s.inside, count, float(out), seed, count,
                            ways);
        return ways.read();
    }

  private:
    static Program program(const Device& device) {
        Features features;
        features.rough_glass = true;
        return Program::from_text(device, kGlassSource, features.defines(device));
    }
    static Buffer<float> materials(const Device& device, const GlassSurface& s) {
        const std::vector<float> floats = glass_floats(s);
        return {device, "materials", std::span<const float>(floats)};
    }
};

}  // namespace voxelume
