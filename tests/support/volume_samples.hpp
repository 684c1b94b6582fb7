// SPDX-License-Identifier: Apache-2.0
// Volumetric images for tests: no cube, no symmetry, a turned observer, and every kind of voxel.
#pragma once

#include <cmath>
#include <glm/gtc/matrix_transform.hpp>
#include <random>

#include "runtime/image/volume.hpp"

namespace voxelume {

inline glm::dmat4 turned_observer() {
    glm::dmat4 m = glm::translate(glm::dmat4(1), glm::dvec3(10.5, -3.25, 7.125));
    m = glm::rotate(m, 0.7, glm::normalize(glm::dvec3(0.3, 1.0, -0.2)));
    return m;
}

/// Lists about the fraction `share` of the voxels with random values; objects' depths lie within
/// their steps.
inline void fill_volume(Volume& volume, double share, uint32_t seed) {
    std::mt19937 random(seed);
    std::uniform_real_distribution<float> unit(0.0f, 1.0f);
    const VolumeFrame& frame = volume.frame;
    const auto count = uint64_t(frame.size.x) * uint64_t(frame.size.y) * uint64_t(frame.size.z);
    for (uint64_t index = 0; index < count; ++index) {
        if (unit(random) >= share) continue;
        const auto kind = static_cast<VoxelKind>(random() % 3);
        volume.indices.push_back(index);
        volume.kinds.push_back(kind);
        volume.colors.emplace_back(1.5f * unit(random), unit(random), unit(random));
        const float opacity = 0.1f + 0.9f * unit(random);
        volume.opacities.push_back(kind == VoxelKind::unseen ? 0.0f
                                   : random() % 4 == 0       ? 1.0f
                                                             : opacity);
        volume.objects.push_back(kind == VoxelKind::object ? 1 + uint32_t(random() % 5) : 0);
        const auto k = double(index / (uint64_t(frame.size.x) * uint64_t(frame.size.y)));
        const double step = frame.layout == VolumeLayout::rays ? frame.step : frame.edge.z;
        const double start =
            frame.layout == VolumeLayout::rays ? frame.display.near : frame.origin.z;
        volume.depths.push_back(float(start + step * (k + 0.125 + 0.75 * double(unit(random)))));
    }
    volume.attributes = {{"scene", "room.json"}, {"note", "a\\b c"}};
}

/// 7 x 5 x 3 voxels of 0.5 x 0.25 x 2 m.
inline Volume lattice_volume(glm::ivec3 size = {7, 5, 3}, double share = 0.6, uint32_t seed = 5) {
    Volume volume;
    volume.frame.layout = VolumeLayout::lattice;
    volume.frame.display.shape = DisplayShape::ball;
    volume.frame.display.far = 6;
    volume.frame.display.voxels = size;
    volume.frame.size = size;
    volume.frame.origin = {-1.75, 0.1, 3};
    volume.frame.edge = {0.5, 0.25, 2};
    volume.frame.world_from_observer = turned_observer();
    fill_volume(volume, share, seed);
    return volume;
}

/// 7 x 5 sight rays of 9 steps of 0.3 m.
inline Volume rays_volume(DisplayShape shape = DisplayShape::pyramid, double share = 0.5,
                          uint32_t seed = 9) {
    Volume volume;
    VolumeFrame& frame = volume.frame;
    frame.layout = VolumeLayout::rays;
    frame.size = frame.display.voxels = {7, 5, 9};
    frame.display.shape = shape;
    frame.display.half_angles = {0.5, 0.3};
    if (shape == DisplayShape::sector) frame.display.half_angles = {0.6, 0.6};
    if (shape == DisplayShape::box) frame.display.half_size = {1.5, 0.75};
    frame.display.near = 0.7;
    frame.step = 0.3;
    frame.display.far = 0.7 + 9 * 0.3;
    frame.world_from_observer = turned_observer();
    fill_volume(volume, share, seed);
    return volume;
}

/// Voxel (x, y, z)'s value in a small volume with one voxel listed.
inline Volume single_voxel(glm::ivec3 size, glm::ivec3 cell, glm::vec3 color, float opacity = 1) {
    Volume volume = lattice_volume(size, 0);
    volume.indices = {uint64_t(cell.x + size.x * (cell.y + size.y * cell.z))};
    volume.colors = {color};
    volume.opacities = {opacity};
    volume.depths = {1};
    volume.objects = {1};
    volume.kinds = {VoxelKind::object};
    return volume;
}

inline void expect_same_frame(const VolumeFrame& a, const VolumeFrame& b) {
    EXPECT_EQ(a.layout, b.layout);
    EXPECT_EQ(a.display.shape, b.display.shape);
    EXPECT_EQ(a.display.half_angles, b.display.half_angles);
    EXPECT_EQ(a.display.half_size, b.display.half_size);
    EXPECT_EQ(a.display.near, b.display.near);
    EXPECT_EQ(a.display.far, b.display.far);
    EXPECT_EQ(a.display.voxels, b.display.voxels);
    EXPECT_EQ(a.size, b.size);
    EXPECT_EQ(a.origin, b.origin);
    EXPECT_EQ(a.edge, b.edge);
    EXPECT_EQ(a.step, b.step);
    EXPECT_EQ(a.world_from_observer, b.world_from_observer);
}

/// Expects that every bit of both volumes is equal.
inline void expect_same_volume(const Volume& a, const Volume& b) {
    expect_same_frame(a.frame, b.frame);
    EXPECT_EQ(a.indices, b.indices);
    EXPECT_EQ(a.colors, b.colors);
    EXPECT_EQ(a.opacities, b.opacities);
    EXPECT_EQ(a.depths, b.depths);
    EXPECT_EQ(a.objects, b.objects);
    EXPECT_EQ(a.kinds, b.kinds);
    EXPECT_EQ(a.attributes, b.attributes);
}

}  // namespace voxelume
