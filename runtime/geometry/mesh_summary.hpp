// SPDX-License-Identifier: Apache-2.0
// mesh -> what planning and messages need to know of it, so that a mesh in the model cache isn't
// read.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "runtime/geometry/mesh.hpp"
#include "runtime/geometry/mesh_topology.hpp"
#include "runtime/geometry/surface_extent.hpp"
#include "runtime/scene/scene.hpp"

namespace voxelume {

/// The amounts of a mesh's colours and textures.
struct MeshPaint {
    uint64_t colors = 0;             ///< number of linear colours
    bool has_corner_colors = false;  ///< corners index colours; otherwise vertices have one each
    uint64_t texels = 0;             ///< number of texels of all levels of all textures
    uint64_t textures = 0;
    uint64_t uvs = 0;             ///< number of positions on textures, if there are textures
    bool has_corner_uvs = false;  ///< corners have indices of such positions
    bool has_alpha = false;       ///< the alpha of some texture counts
    uint64_t mapped = 0;          ///< textures that have maps

    bool is_there() const { return colors > 0 || texels > 0; }
};

struct MeshSummary {
    uint64_t triangles = 0;
    uint64_t strokes = 0;  ///< number of those that are points or lines
    Bounds surface;        ///< the box around the triangles, metres
    Bounds vertices;       ///< box around all positions, those that no triangle uses included
    SurfaceArea area;      ///< in the mesh's own space
    SurfaceArea min_area;  ///< area with coinciding triangles counted once
    MeshPaint paint;
    bool has_normals = false;
    double longest_edge = 0;  ///< metres
    std::vector<std::string> group_names;
    uint64_t corners = 0;  ///< positions that triangles share
    MeshTopology topology;
    std::vector<std::string> material_libraries, missing_materials, library_faults;  ///< as in Mesh
    std::string texture;                                                             ///< likewise
    std::vector<std::string> notes;                                                  ///< likewise
};

MeshSummary summary_of(const Mesh& mesh);

MeshPaint paint_of(const Mesh& mesh);
/// The share of a mesh's area from which its holes matter. Smaller holes are closed by the winding
/// number, as those of the scanned bunny are.
inline constexpr double kOpenShare = 0.03;

/// True if a mesh has triangles that aren't points or lines.
bool has_area(const MeshSummary& mesh);

/// True if a mesh's holes are so large that nothing is inside of it.
bool is_open(const MeshSummary& mesh);

/// The box around the triangles of a mesh.
Bounds mesh_bounds(const Mesh& mesh);

}  // namespace voxelume
