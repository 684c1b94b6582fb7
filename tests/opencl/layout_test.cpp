// SPDX-License-Identifier: Apache-2.0
// Every struct that host and kernels share is passed once: the host writes it, a kernel reads it
// field by field.
#include <gtest/gtest.h>

#include <array>
#include <bit>
#include <type_traits>

#include "kernels/shared/display.h"
#include "kernels/shared/emitters.h"
#include "kernels/shared/footprint.h"
#include "kernels/shared/instance.h"
#include "kernels/shared/light_tree.h"
#include "kernels/shared/medium.h"
#include "kernels/shared/paths.h"
#include "kernels/shared/scene.h"
#include "kernels/shared/sky.h"
#include "kernels/shared/solid.h"
#include "runtime/opencl/program.hpp"
#include "tests/support/test_device.hpp"

// The lists name the fields of each struct: F is a float, V a float4, I an int, and FA and IA
// arrays with a length. The kernel gets a list as text, the host expands it as a macro.
// clang-format off
#define PYRAMID_SHAPE_FIELDS \
    V(edge) V(inverse_edge) I(size_x) I(size_y) I(size_z) I(sectors_x) I(sectors_y) \
    F(plane_bound) F(fixed_point) F(origin_offset)
#define CAMERA_FIELDS \
    V(origin) V(origin_low) V(axis_x) V(axis_y) V(axis_z) F(half_x) F(half_y) F(near_plane) \
    F(far_plane) I(width) I(height) I(samples) I(shape) F(sample_weight) F(lead) \
    I(first_column) I(first_row) I(frame_width) I(frame_height) F(lens_radius) F(lens_slope) \
    I(first_sample) I(blades) I(earlier_samples) F(earlier_weight) I(is_last) IA(unused, 3)
#define MATERIAL_RECORD_FIELDS \
    FA(color, 3) F(diffuse) FA(absorption, 3) F(ior) FA(emission, 3) F(specular) F(shininess) \
    F(reflection) F(refraction) F(opacity) F(fresnel) FA(checker_color, 3) \
    FA(checker_scale, 3) FA(checker_shift, 3) F(metallic) F(width) F(reflectance) \
    F(albedos) F(missing) F(matt)
#define LIGHT_RECORD_FIELDS \
    V(position) V(direction) V(intensity) F(inner_cosine) F(outer_cosine) I(kind) F(spread)
#define ENVIRONMENT_FIELDS V(background) V(ambient) V(absorption) V(color)
#define DISPLAY_STEPS_FIELDS F(step) F(inverse_step) I(count) F(absorption)
#define DISPLAY_LATTICE_FIELDS \
    V(origin) V(axis_x) V(axis_y) V(axis_z) V(row_x) V(row_y) V(row_z) V(corner) V(edge) I(size_x) \
    I(size_y) I(size_z) I(shape) F(slope_x) F(slope_y) F(near_depth) F(far_depth) I(cylinder) \
    FA(unused, 3)
#define SOLID_SHAPE_FIELDS \
    I(kind) I(operations) I(shape_count) I(attribute) IA(cell, 3) FA(fraction, 3) \
    FA(shape_from_grid, 9) FA(size, 4) FA(rounding, 2) FA(derived, 5) F(reach) F(unused)
#define PATH_SAMPLING_FIELDS I(first_tile) I(tiles_x) I(samples) I(bounces) I(first_column) \
    I(first_row) I(first_sample)
#define LIGHT_AREA_RECORD_FIELDS V(axis_x) V(axis_y)
#define LIGHT_NODE_FIELDS \
    FA(middle, 3) F(radius) FA(axis, 3) F(cosine) F(power) FA(unused, 3)
#define FOOTPRINT_FIELDS \
    V(middle) V(across) V(down) V(ahead) F(half_columns) F(half_rows) F(spread) F(width) I(shape) \
    IA(unused, 3)
#define SKY_RECORD_FIELDS \
    V(zenith) V(horizon) V(ground) V(sun_direction) V(sun_radiance) V(luminance) \
    V(chromaticity_x) V(chromaticity_y) V(last) V(base)
#define SKY_MAP_RECORD_FIELDS \
    I(width) I(height) I(columns) I(rows) F(turn) F(strength) F(chance) I(unused)
#define DENSITY_SHAPE_FIELDS \
    I(bricks_x) I(bricks_y) I(shift_x) I(shift_y) I(shift_z) IA(unused, 3)
#define INSTANCE_RECORD_FIELDS \
    FA(object_from_world, 9) FA(center, 3) FA(image, 3) FA(low, 3) FA(high, 3) F(near_squared) \
    F(plane_bound) F(fixed_point) IA(size, 3) I(sectors_x) I(sectors_y) I(first_sector) I(aligned) \
    F(bounds_rounding) I(object) I(first_material) I(material_count) I(padding)
#define INSTANCE_NODE_FIELDS \
    F(low[0][0]) F(low[0][1]) F(low[0][2]) F(low[1][0]) F(low[1][1]) F(low[1][2]) F(high[0][0]) \
    F(high[0][1]) F(high[0][2]) F(high[1][0]) F(high[1][1]) F(high[1][2]) IA(child, 2) IA(unused, 2)
#define EMITTER_RECORD_FIELDS \
    FA(corner, 3) I(instance) I(voxel) I(sides) F(probability) F(own_share) I(alias) I(unused)
#define EMITTER_FRAME_FIELDS \
    FA(object_from_world, 9) FA(world_from_object, 9) FA(center, 3) FA(image, 3) F(volume) \
    F(width) FA(unused, 6)
// clang-format on

#define TEXT_OF(fields) TEXT_OF_(fields)
#define TEXT_OF_(fields) #fields

namespace voxelume {
namespace {

constexpr const char* kPyramidShapeText = TEXT_OF(PYRAMID_SHAPE_FIELDS);
constexpr const char* kCameraText = TEXT_OF(CAMERA_FIELDS);
constexpr const char* kMaterialRecordText = TEXT_OF(MATERIAL_RECORD_FIELDS);
constexpr const char* kLightRecordText = TEXT_OF(LIGHT_RECORD_FIELDS);
constexpr const char* kEnvironmentText = TEXT_OF(ENVIRONMENT_FIELDS);
constexpr const char* kDisplayStepsText = TEXT_OF(DISPLAY_STEPS_FIELDS);
constexpr const char* kDisplayLatticeText = TEXT_OF(DISPLAY_LATTICE_FIELDS);
constexpr const char* kSolidShapeText = TEXT_OF(SOLID_SHAPE_FIELDS);
constexpr const char* kDensityShapeText = TEXT_OF(DENSITY_SHAPE_FIELDS);

constexpr const char* kPathSamplingText = TEXT_OF(PATH_SAMPLING_FIELDS);
constexpr const char* kLightAreaRecordText = TEXT_OF(LIGHT_AREA_RECORD_FIELDS);
constexpr const char* kLightNodeText = TEXT_OF(LIGHT_NODE_FIELDS);
constexpr const char* kFootprintText = TEXT_OF(FOOTPRINT_FIELDS);
constexpr const char* kSkyRecordText = TEXT_OF(SKY_RECORD_FIELDS);
constexpr const char* kSkyMapRecordText = TEXT_OF(SKY_MAP_RECORD_FIELDS);
constexpr const char* kInstanceRecordText = TEXT_OF(INSTANCE_RECORD_FIELDS);
constexpr const char* kEmitterRecordText = TEXT_OF(EMITTER_RECORD_FIELDS);
constexpr const char* kEmitterFrameText = TEXT_OF(EMITTER_FRAME_FIELDS);
constexpr const char* kInstanceNodeText = TEXT_OF(INSTANCE_NODE_FIELDS);

using Words = std::vector<uint32_t>;

/// A value whose 32-bit parts are all different floats between 1 and 2.
template <class T>
T numbered_words() {
    std::array<uint32_t, sizeof(T) / 4> words;
    for (uint32_t i = 0; i < words.size(); ++i) words[i] = 0x3F800000u + 7919u * (i + 1);
    return std::bit_cast<T>(words);
}

/// The values that a kernel reads from the fields of its argument.
template <class T>
Words read_by_kernel(const T& value, const std::string& type, const std::string& fields) {
    const Device device = test_device();
    const std::string source = R"(
#include "lib/lanes/work_item.h"
#include "shared/medium.h"
#include "shared/scene.h"
#include "shared/display.h"
#include "shared/emitters.h"
#include "shared/instance.h"
#include "shared/paths.h"
#include "shared/light_tree.h"
#include "shared/footprint.h"
#include "shared/sky.h"
#include "shared/solid.h"
#define F(n) *words++ = as_uint(value.n);
#define V(n) F(n.x) F(n.y) F(n.z) F(n.w)
#define I(n) *words++ = (uint)value.n;
#define FA(n, count) for (int i = 0; i < count; ++i) F(n[i])
#define IA(n, count) for (int i = 0; i < count; ++i) I(n[i])
kernel void read_fields()" + type +
                               R"( value, global uint* words) {
    if (work_item() > 0) return;
)" + fields + "\n}\n";
    Buffer<uint32_t> words(device, "words", sizeof(T) / 4);
    words.fill(0);
    Program::from_text(device, source)
        .kernel("read_fields")
        .launch(WorkItem::light, 1, value, words);
    return words.read();
}

uint32_t bits(float v) {
    return std::bit_cast<uint32_t>(v);
}

#define F(n) words.push_back(bits(value.n));
#define V(n) F(n.x) F(n.y) F(n.z) F(n.w)
#define I(n) words.push_back(static_cast<uint32_t>(value.n));
#define FA(n, count)                                            \
    static_assert(std::extent_v<decltype(value.n)> == (count)); \
    for (int i = 0; i < count; ++i) F(n[i])
#define IA(n, count)                                            \
    static_assert(std::extent_v<decltype(value.n)> == (count)); \
    for (int i = 0; i < count; ++i) I(n[i])
#define CROSSES(type, fields, text)                           \
    TEST(Layout, type##CrossesWithEveryField) {               \
        const auto value = numbered_words<type>();            \
        Words words;                                          \
        fields ASSERT_EQ(words.size(), sizeof(type) / 4);     \
        EXPECT_EQ(read_by_kernel(value, #type, text), words); \
    }

CROSSES(PyramidShape, PYRAMID_SHAPE_FIELDS, kPyramidShapeText)
CROSSES(Camera, CAMERA_FIELDS, kCameraText)
CROSSES(MaterialRecord, MATERIAL_RECORD_FIELDS, kMaterialRecordText)
CROSSES(LightRecord, LIGHT_RECORD_FIELDS, kLightRecordText)
CROSSES(Environment, ENVIRONMENT_FIELDS, kEnvironmentText)
CROSSES(DisplaySteps, DISPLAY_STEPS_FIELDS, kDisplayStepsText)
CROSSES(DisplayLattice, DISPLAY_LATTICE_FIELDS, kDisplayLatticeText)
CROSSES(SolidShape, SOLID_SHAPE_FIELDS, kSolidShapeText)
CROSSES(PathSampling, PATH_SAMPLING_FIELDS, kPathSamplingText)
CROSSES(LightAreaRecord, LIGHT_AREA_RECORD_FIELDS, kLightAreaRecordText)
CROSSES(LightNode, LIGHT_NODE_FIELDS, kLightNodeText)
CROSSES(Footprint, FOOTPRINT_FIELDS, kFootprintText)
CROSSES(SkyRecord, SKY_RECORD_FIELDS, kSkyRecordText)
CROSSES(SkyMapRecord, SKY_MAP_RECORD_FIELDS, kSkyMapRecordText)
CROSSES(InstanceRecord, INSTANCE_RECORD_FIELDS, kInstanceRecordText)
CROSSES(EmitterRecord, EMITTER_RECORD_FIELDS, kEmitterRecordText)
CROSSES(EmitterFrame, EMITTER_FRAME_FIELDS, kEmitterFrameText)
CROSSES(InstanceNode, INSTANCE_NODE_FIELDS, kInstanceNodeText)
CROSSES(DensityShape, DENSITY_SHAPE_FIELDS, kDensityShapeText)

}  // namespace
}  // namespace voxelume
