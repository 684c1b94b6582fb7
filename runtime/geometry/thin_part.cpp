// SPDX-License-Identifier: Apache-2.0
#include "runtime/geometry/thin_part.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <unordered_map>
#include <unordered_set>
#include <vector>

#include "runtime/geometry/mesh_chords.hpp"
#include "runtime/geometry/mesh_summary.hpp"

namespace voxelume {
namespace {

constexpr double kLinesPerVoxel = 2;
constexpr double kMaxVoxels = 2048;

/// The edge, in voxels, of the cells in which walls are noted. Triangles in neighbouring cells
/// count, too.
constexpr double kCell = 5;

/// The minimum number of chords for a wall to count, including those in cells that touch its own.
constexpr size_t kMinChords = 12;

/// Cells of a regular lattice, by their coordinates.
class Cells {
  public:
    Cells(const glm::dvec3& low, double edge) : low_(low), edge_(edge) {}

    glm::ivec3 cell_of(const glm::dvec3& p) const {
        return glm::ivec3(glm::floor((p - low_) / edge_)) + 1;
    }
    void add(const glm::dvec3& p) { ++chords_[key_of(cell_of(p))]; }

    /// Keeps the cells of walls with enough chords, and those around them.
    void settle() {
        std::unordered_set<uint64_t> seen;
        for (const auto& [key, count] : chords_)
            if (!seen.contains(key)) settle_wall(key, seen);
    }
    bool is_empty() const { return kept_.empty(); }
    bool holds(const glm::ivec3& cell) const { return kept_.contains(key_of(cell)); }

  private:
    static uint64_t key_of(const glm::ivec3& c) {
        return uint64_t(c.x) | uint64_t(c.y) << 20 | uint64_t(c.z) << 40;
    }
    static std::array<uint64_t, 27> around(uint64_t key) {
        std::array<uint64_t, 27> keys{};
        for (uint64_t i = 0; i < 27; ++i)
            keys[i] = key + i % 3 - 1 + ((i / 3 % 3) << 20) - (1ull << 20) + ((i / 9) << 40) -
                      (1ull << 40);
        return keys;
    }
    void settle_wall(uint64_t first, std::unordered_set<uint64_t>& seen) {
        std::vector<uint64_t> wall = {first};
        seen.insert(first);
        size_t chords = 0;
        for (size_t i = 0; i < wall.size(); ++i) {
            chords += chords_.at(wall[i]);
            for (const uint64_t key : around(wall[i]))
                if (chords_.contains(key) && seen.insert(key).second) wall.push_back(key);
        }
        if (chords < kMinChords) return;
        for (const uint64_t key : wall)
            for (const uint64_t near : around(key)) kept_.insert(near);
    }

    glm::dvec3 low_;
    double edge_;
    std::unordered_map<uint64_t, size_t> chords_;
    std::unordered_set<uint64_t> kept_;
};

using TriangleCorners = std::array<glm::dvec3, 3>;

/// True if a triangle's box lies in some of the cells; large triangles are cut in two.
bool touches(const Cells& cells, const TriangleCorners& t) {
    const glm::ivec3 low = cells.cell_of(glm::min(glm::min(t[0], t[1]), t[2]));
    const glm::ivec3 high = cells.cell_of(glm::max(glm::max(t[0], t[1]), t[2]));
    const glm::ivec3 size = high - low + 1;
    if (std::max({size.x, size.y, size.z}) > 2) {
        size_t from = 0;
        double longest = 0;
        for (size_t i = 0; i < 3; ++i)
            if (const double length = glm::distance(t[i], t[(i + 1) % 3]); length > longest) {
                longest = length;
                from = i;
            }
        const size_t to = (from + 1) % 3;
        TriangleCorners one = t, other = t;
        one[to] = other[from] = 0.5 * (t[from] + t[to]);
        return touches(cells, one) || touches(cells, other);
    }
    for (int z = low.z; z <= high.z; ++z)
        for (int y = low.y; y <= high.y; ++y)
            for (int x = low.x; x <= high.x; ++x)
                if (cells.holds({x, y, z})) return true;
    return false;
}

/// The mesh with the triangles alone for which `keep` is true.
template <class Keep>
Mesh part_of(const Mesh& mesh, const Keep& keep) {
    Mesh part = mesh;
    std::vector<bool> kept(mesh.triangles.size());
    for (size_t i = 0; i < kept.size(); ++i) kept[i] = keep(i);
    const auto filter = [&](auto& values) {
        if (values.size() != mesh.triangles.size()) return;
        size_t count = 0;
        for (size_t i = 0; i < values.size(); ++i)
            if (kept[i]) values[count++] = values[i];
        values.resize(count);
    };
    filter(part.triangles);
    filter(part.triangle_group);
    filter(part.triangle_normals);
    filter(part.triangle_colors);
    filter(part.triangle_uvs);
    return part;
}

}  // namespace

ThinPart thin_part_of(const Mesh& mesh, double voxel_edge) {
    const Bounds box = mesh_bounds(mesh);
    const glm::dvec3 voxels = (box.max - box.min) / voxel_edge;
    ThinPart part;
    if (!(std::max({voxels.x, voxels.y, voxels.z}) <= kMaxVoxels)) return part;
    Cells cells(box.min, kCell * voxel_edge);
    std::vector<glm::dvec3> middles;
    const glm::ivec3 lines =
        glm::max(glm::ivec3(glm::ceil(kLinesPerVoxel * voxels)), glm::ivec3(1));
    const bool has_inside = for_each_chord(mesh, lines, [&](const Chord& chord) {
        if (!chord.is_between_walls || chord.thickness >= kThinVoxels * voxel_edge) return;
        middles.push_back(0.5 * (chord.entry + chord.exit));
        cells.add(middles.back());
    });
    if (!has_inside) return part;
    cells.settle();
    if (cells.is_empty()) return part;
    for (const glm::dvec3& p : middles)
        if (cells.holds(cells.cell_of(p))) part.points.emplace_back(p);
    part.mesh = part_of(mesh, [&](size_t i) {
        const glm::uvec3& t = mesh.triangles[i];
        return touches(cells, {glm::dvec3(mesh.positions[t.x]), glm::dvec3(mesh.positions[t.y]),
                               glm::dvec3(mesh.positions[t.z])});
    });
    return part;
}

}  // namespace voxelume
