// SPDX-License-Identifier: Apache-2.0
#include "runtime/stages/light/shade.hpp"

#include <gtest/gtest.h>

#include <bit>
#include <cmath>
#include <glm/geometric.hpp>

#include "kernels/shared/voxel.h"
#include "tests/support/test_device.hpp"

namespace voxelume {
namespace {

/// One of sixteen rays in a world of 9 x 7 x 5 voxels of 0.5 x 0.25 x 1 m, and what it hit.
class Shaded {
  public:
    Shaded() : device_(test_device()) {
        pyramid.frame = {{0, 0, 0}, {0.5, 0.25, 1}, {9, 7, 5}};
        scene.materials.resize(3);
        scene.materials[2].color = {0.5f, 0.25f, 1};
        scene.materials[2].diffuse = 0.5f;
        scene.materials[2].emission = {0, 0.125f, 0};
        scene.world.ambient = {1, 0.5f, 0.25f};
        scene.world.background = {3, 2, 1};
        hits.assign(16 * VXL_HIT_COMPONENTS, VXL_NO_VOXEL);
        rays.assign(16 * VXL_RAY_COMPONENTS, 0);
        pyramid.attribute = 2u << VXL_MATERIAL_SHIFT | 5u;  // material 2 of object 5
    }

    void set_ray(const glm::vec3& o, const glm::vec3& d) {
        for (uint32_t a = 0; a < 3; ++a) {
            rays[(VXL_RAY_OX + a) * 16] = o[int(a)];
            rays[(VXL_RAY_DX + a) * 16] = d[int(a)];
        }
    }

    void set_hit(float t, const glm::uvec3& cell, uint32_t axis) {
        hits[VXL_HIT_T * 16] = std::bit_cast<uint32_t>(t);
        hits[VXL_HIT_VOXEL * 16] = 0;
        hits[VXL_HIT_CELL * 16] = cell.x | cell.y << 16;
        hits[VXL_HIT_FACE * 16] = cell.z | axis << 16;
        hits[VXL_HIT_PRIMITIVE * 16] = VXL_NO_PRIMITIVE;
    }

    void shade(const Features& features) {
        RayBatch batch;
        batch.stride = 16;
        batch.rays = Buffer<float>(device_, "rays", std::span<const float>(rays));
        batch.hits = Buffer<uint32_t>(device_, "hits", std::span<const uint32_t>(hits));
        batch.positions = Buffer<float>(device_, "positions", 48);
        batch.normals = Buffer<float>(device_, "normals", 48);
        batch.hit_attributes = Buffer<uint32_t>(device_, "hit attributes", 16);
        batch.radiance = Buffer<float>(device_, "radiance", 48);
        ShadeStage(device_, features, scene, pyramid.frame).surface(pyramid, batch, 16);
        word = batch.hit_attributes.read_one(0);
        for (uint32_t a = 0; a < 3; ++a) {
            position[int(a)] = batch.positions.read_one(a * 16);
            normal[int(a)] = batch.normals.read_one(a * 16);
            radiance[int(a)] = batch.radiance.read_one(a * 16);
            missed[int(a)] = batch.radiance.read_one(a * 16 + 1);
        }
    }

    template <class T>
    Buffer<T> buffer(const std::vector<T>& values) {
        return Buffer<T>(device_, "test", std::span<const T>(values));
    }

    Pyramid pyramid;
    Scene scene;
    std::vector<uint32_t> hits;
    std::vector<float> rays;
    glm::vec3 position{0}, normal{0}, radiance{0}, missed{0};
    uint32_t word = 0;

  private:
    Device device_;
};

TEST(Shade, ACubeIsHitExactlyOnTheFaceThatWasCrossed) {
    Shaded s;
    s.set_ray({0.25f, 6.5f, 2.125f}, {0.75f, -0.5f, 0.125f});
    s.set_hit(1.0f, {1, 6, 2}, 0);  // entered cell (1,6,2) across x = 1 at t = 1, where y = 6
    Features features;
    features.cubes = true;
    s.shade(features);
    EXPECT_EQ(s.position, glm::vec3(1, 6, 2.25f));
    EXPECT_EQ(s.normal, glm::vec3(-1, 0, 0));
    EXPECT_EQ(s.word & VXL_OBJECT_MASK, 5u);
    EXPECT_EQ(s.radiance, glm::vec3(0.25f, 0.0625f + 0.125f, 0.125f)) << "ambient and emission";
    EXPECT_EQ(s.missed, glm::vec3(3, 2, 1)) << "the background";
}

TEST(Shade, ACheckerKeepsItsBlocksFarFromTheOrigin) {
    for (const double origin : {0.25, 0.75}) {
        Shaded s;
        s.pyramid.frame.origin = {1e8, 0, 0};
        s.scene.materials[2].checker = Checker{{0, 0, 0}, {1, 0, 0}, {origin, 0, 0}};
        s.set_ray({0.25f, 6.5f, 2.125f}, {0.75f, -0.5f, 0.125f});
        s.set_hit(1.0f, {1, 6, 2}, 0);  // at x = 1e8 + 0.5 metres
        Features features;
        features.cubes = features.checker = true;
        s.shade(features);
        const float ambient = origin < 0.5 ? 0.25f : 0.0f;  // block 1e8 or 1e8 - 1
        EXPECT_EQ(s.radiance, glm::vec3(ambient, ambient / 4 + 0.125f, ambient / 2));
    }
}

TEST(Shade, AFieldsNormalIsItsGradientInMetres) {
    Shaded s;
    s.pyramid.attribute |= VXL_KIND_SMOOTH << VXL_KIND_SHIFT;
    // The field is f = 1000 x + 2000 y - 500 z - 1100 distance units, without bends: pairs at x = 0
    // and 1.
    std::vector<uint32_t> record(8, 0);
    for (uint32_t pair = 0; pair < 4; ++pair) {
        const int base = -1100 + 2000 * int(pair & 1) - 500 * int(pair >> 1);
        record[pair] = (uint32_t(base) & 0xFFFFu) | (uint32_t(base + 1000) & 0xFFFFu) << 16;
    }
    s.pyramid.fields = s.buffer(record);
    s.set_ray({3.5f, 6, 2.5f}, {0, -1, 0});
    s.set_hit(0.5f, {3, 5, 2}, 1);
    Features features;
    features.smooth = true;
    s.shade(features);
    EXPECT_EQ(s.position, glm::vec3(3.5f, 5.5f, 2.5f));
    const glm::vec3 expected = glm::normalize(glm::vec3(1000 / 0.5f, 2000 / 0.25f, -500 / 1.0f));
    EXPECT_LT(glm::length(s.normal - expected), 1e-6f);
}

TEST(Shade, ATrianglesNormalFacesTheRayAndItsWordIsItsOwn) {
    Shaded s;
    s.pyramid.attribute = VXL_KIND_EXACT << VXL_KIND_SHIFT;
    s.pyramid.triangles =
        s.buffer<float>({0, 0, 0, 1, 1, 1, 2, 3, 4,  // triangle 0 is not the one hit
                         3, 5, 2, 5, 5, 2, 3, 9, 4});
    s.pyramid.triangle_attributes =
        s.buffer<uint32_t>({0, VXL_KIND_EXACT << VXL_KIND_SHIFT | 2u << VXL_MATERIAL_SHIFT | 7u});
    s.pyramid.primitives = s.buffer<uint32_t>({0, 1});
    s.set_ray({3.5f, 6, 0}, {0, 0, 1});
    s.set_hit(2.5f, {3, 6, 2}, 2);
    s.hits[VXL_HIT_PRIMITIVE * 16] = 1;
    Features features;
    features.triangles = true;
    s.shade(features);
    EXPECT_EQ(s.position, glm::vec3(3.5f, 6, 2.5f));
    // The edges are (1, 0, 0) and (0, 1, 2) metres, so the normal is (0, -2, 1), turned towards the
    // ray.
    const glm::vec3 expected = glm::normalize(glm::vec3(0, 2, -1));
    EXPECT_LT(glm::length(s.normal - expected), 1e-6f);
    EXPECT_EQ(s.word & VXL_OBJECT_MASK, 7u);
}

}  // namespace
}  // namespace voxelume
