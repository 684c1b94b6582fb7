// SPDX-License-Identifier: Apache-2.0
#include "runtime/geometry/mesh_points.hpp"

#include <algorithm>
#include <glm/common.hpp>
#include <glm/vec3.hpp>
#include <vector>

#include "runtime/geometry/mesh_summary.hpp"

namespace voxelume {
namespace {

/// The voxels that points lie in, as sorted numbers. Voxels of twice the edge are made from them.
class FilledVoxels {
  public:
    FilledVoxels(const Mesh& mesh, const Bounds& box, double edge) {
        voxels_.reserve(mesh.triangles.size());
        for (const glm::uvec3& t : mesh.triangles) {
            const glm::dvec3 position = (glm::dvec3(mesh.positions[t.x]) - box.min) / edge;
            const glm::u64vec3 voxel(glm::min(glm::max(position, 0.0), double(kMask)));
            voxels_.push_back(voxel.x | voxel.y << kBits | voxel.z << 2 * kBits);
        }
        drop_copies();
    }

    void double_edge() {
        for (uint64_t& voxel : voxels_) voxel = (voxel >> 1) & kHalved;
        drop_copies();
    }

    size_t count() const { return voxels_.size(); }

  private:
    static constexpr int kBits = 21;
    static constexpr uint64_t kMask = (uint64_t{1} << kBits) - 1;
    /// All bits of the three coordinates but the highest of each.
    static constexpr uint64_t kHalved = kMask >> 1 | (kMask >> 1) << kBits |
                                        (kMask >> 1) << 2 * kBits;

    void drop_copies() {
        std::sort(voxels_.begin(), voxels_.end());
        voxels_.erase(std::unique(voxels_.begin(), voxels_.end()), voxels_.end());
    }

    std::vector<uint64_t> voxels_;
};

}  // namespace

void show_vertices(Mesh& mesh) {
    mesh.triangles.resize(mesh.positions.size());
    for (size_t i = 0; i < mesh.triangles.size(); ++i)
        mesh.triangles[i] = point_triangle(uint32_t(i));
}

PointCounts count_points(const Mesh& mesh) {
    PointCounts counts;
    for (const glm::uvec3& t : mesh.triangles) {
        if (t.y != t.z) continue;
        ++(t.x == t.y ? counts.points : counts.lines);
    }
    return counts;
}

bool has_points_alone(const Mesh& mesh) {
    return std::ranges::all_of(mesh.triangles, [](const glm::uvec3& t) { return t.y == t.z; });
}

double voxel_edge_of_points(const Mesh& mesh, double finest) {
    if (!has_points_alone(mesh)) return finest;
    if (count_points(mesh).lines > 0) return 2 * finest;
    const Bounds box = mesh_bounds(mesh);
    if (!(longest_side(box) > 0 && finest > 0)) return finest;  // a point, or many at one position
    // Points at one position, as faces of points name them again and again, count once.
    const double points = double(FilledVoxels(mesh, box, longest_side(box) / (1 << 20)).count());
    double edge = finest;
    FilledVoxels voxels(mesh, box, edge);
    while (points < kPointsPerVoxel * double(voxels.count()) &&
           longest_side(box) >= 2 * kFewestVoxels * edge) {
        edge *= 2;
        voxels.double_edge();
    }
    return edge;
}

}  // namespace voxelume
