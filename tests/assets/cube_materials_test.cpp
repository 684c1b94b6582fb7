// SPDX-License-Identifier: Apache-2.0
// Materials of scenes become those of MagicaVoxel: the inverse of what the import of a .vox does.
#include <gtest/gtest.h>

#include <cmath>

#include "runtime/assets/cube_materials.hpp"

namespace voxelume {

TEST(CubeMaterials, EmissiveOnesHaveTheirLightAsColourAndPower) {
    Material emissive;
    emissive.emission = {9, 2.25F, 0};
    const CubeMaterial cube = cube_materials({{emissive}}, 0.5).front();
    EXPECT_EQ(cube.vox.kind, VoxMaterialKind::emit);
    EXPECT_FLOAT_EQ(cube.vox.weight, 1);
    EXPECT_FLOAT_EQ(cube.vox.flux, 2);  // (1 + 2)^2 = 9
    EXPECT_EQ(cube.color, 0x89FFu) << "linear 1 and 0.25 in sRGB";
    EXPECT_FALSE(cube.vox.is_flux_cut);
    emissive.emission = {100, 50, 0};
    const CubeMaterial bright = cube_materials({{emissive}}, 0.5).front();
    EXPECT_FLOAT_EQ(bright.vox.flux, 8);
    EXPECT_TRUE(bright.vox.is_flux_cut);
    emissive.emission = {0, 0.25F, 0};
    const CubeMaterial dim = cube_materials({{emissive}}, 0.5).front();
    EXPECT_FLOAT_EQ(dim.vox.weight, 0.25F);
    EXPECT_FLOAT_EQ(dim.vox.flux, 0);
}

TEST(CubeMaterials, GlassHasTheColourOfLightThroughEightVoxels) {
    Material glass;
    glass.refraction = 0.5F;
    glass.ior = 1.4F;
    // In voxels of 0.5 m, 8 of them are 4 m; half of the material is glass.
    glass.absorption = {0, float(std::log(4.0) / 8), 0};
    const CubeMaterial cube = cube_materials({{glass}}, 0.5).front();
    EXPECT_EQ(cube.vox.kind, VoxMaterialKind::glass);
    EXPECT_FLOAT_EQ(cube.vox.weight, 0.5F);
    EXPECT_FLOAT_EQ(cube.vox.ior, 1.4F);
    EXPECT_EQ(cube.color, 0xFF89FFu) << "green 0.25";
}

TEST(CubeMaterials, MetalKeepsItsVoxelsColours) {
    Material metal;
    metal.metallic = 0.75;
    metal.roughness = 0.25;
    const std::vector<CubeMaterial> cubes = cube_materials({{metal, Material()}}, 1);
    EXPECT_EQ(cubes[0].vox.kind, VoxMaterialKind::metal);
    EXPECT_FLOAT_EQ(cubes[0].vox.weight, 0.75F);
    EXPECT_FLOAT_EQ(cubes[0].vox.rough, 0.25F);
    EXPECT_FALSE(cubes[0].color.has_value());
    EXPECT_EQ(cubes[1].vox.kind, VoxMaterialKind::diffuse);
    EXPECT_TRUE(has_more_than_colors(cubes));
    EXPECT_FALSE(has_more_than_colors({{cubes[1]}}));
}

}  // namespace voxelume
