// SPDX-License-Identifier: Apache-2.0
// The choices that a model makes about its voxels.
#pragma once

#include <array>
#include <cstdint>
#include <string_view>

namespace voxelume {

/// The representation of the surface inside a voxel; the numbers are those of shared/voxel.h.
enum class Surface : uint8_t {
    cubes = 0,   ///< the voxel itself
    smooth = 1,  ///< the zero of a distance field
    exact = 2,   ///< the source's own triangles or solid
};

/// The properties of a kind of surface. A new kind needs a row of kSurfaceKinds, code that fills
/// its voxels (stages/voxelize, stages/place) and code that intersects rays (kernels/lib/surface).
/// CONTRIBUTING.md lists the other places.
struct SurfaceKind {
    Surface surface;
    std::string_view name;  ///< in scene files, options and .vxm files
    bool stores_distances;  ///< grids hold distances at nodes; other kinds hold occupied voxels
    bool lists_primitives;  ///< each voxel lists the triangles or shapes that pass through it
    bool shows_voxels;  ///< rays end on the voxel's own faces, and a VoxelSet selects the voxels
};

/// The rows in the order of the enumeration.
inline constexpr std::array<SurfaceKind, 3> kSurfaceKinds = {{
    // surface        name      distances primitives voxels
    {Surface::cubes, "cubes", false, false, true},
    {Surface::smooth, "smooth", true, false, false},
    {Surface::exact, "exact", false, true, false},
}};

constexpr const SurfaceKind& kind_of(Surface surface) {
    return kSurfaceKinds[size_t(surface)];
}
constexpr bool stores_distances(Surface surface) {
    return kind_of(surface).stores_distances;
}
constexpr bool lists_primitives(Surface surface) {
    return kind_of(surface).lists_primitives;
}
constexpr bool shows_voxels(Surface surface) {
    return kind_of(surface).shows_voxels;
}

/// The set of voxels of an object made of cubes; the definitions are those of Cohen-Or & Kaufman
/// 1995 and Laine 2013.
enum class VoxelSet : uint8_t {
    supercover,  ///< every voxel that the surface touches: no ray passes, even through corners
    thin,        ///< 6-separating: a path of voxels that share faces can't pass
    solid,       ///< every voxel whose centre is inside
};

/// The normals by which light falls on cubes.
enum class CubeNormals : uint8_t {
    faces,    ///< normals of the cubes' own faces
    surface,  ///< normals of the surface that the cubes represent
};

}  // namespace voxelume
