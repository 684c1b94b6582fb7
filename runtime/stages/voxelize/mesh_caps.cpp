// SPDX-License-Identifier: Apache-2.0
// The open outlines of a mesh, and the triangles that close them.
#include <algorithm>
#include <cstdlib>
#include <map>
#include <numeric>
#include <tuple>

#include "runtime/stages/voxelize/mesh_lattice.hpp"

namespace voxelume {
namespace {

/// A directed edge of a triangle.
struct Edge {
    uint32_t from, to;
};

/// The edges that triangles use more often in one direction than in the other: one copy for each
/// use in excess.
///
/// The edges are sorted into buckets by their lower vertex, in linear time, since every model
/// passes through here.
std::vector<Edge> unpaired_edges(const std::vector<Edge>& edges, size_t vertex_count) {
    std::vector<uint32_t> first(vertex_count + 1, 0);
    for (const Edge& e : edges) ++first[std::min(e.from, e.to) + 1];
    std::partial_sum(first.begin(), first.end(), first.begin());
    std::vector<Edge> sorted(edges.size());
    std::vector<uint32_t> cursor(first.begin(), first.end() - 1);
    for (const Edge& e : edges) sorted[cursor[std::min(e.from, e.to)]++] = e;
    std::vector<Edge> unpaired;
    for (size_t v = 0; v < vertex_count; ++v) {
        const auto begin = sorted.begin() + first[v], end = sorted.begin() + first[v + 1];
        const auto other = [](const Edge& e) { return std::max(e.from, e.to); };
        std::sort(begin, end, [&](const Edge& a, const Edge& b) { return other(a) < other(b); });
        for (auto run = begin; run != end;) {
            const uint32_t low = static_cast<uint32_t>(v), high = other(*run);
            int64_t upward = 0;
            for (; run != end && other(*run) == high; ++run) upward += run->from == low ? 1 : -1;
            if (high == low) continue;
            const Edge left = upward > 0 ? Edge{low, high} : Edge{high, low};
            unpaired.insert(unpaired.end(), static_cast<size_t>(std::abs(upward)), left);
        }
    }
    return unpaired;
}

std::vector<Edge> edges_of(const MeshLattice& mesh) {
    std::vector<Edge> edges;
    edges.reserve(3 * mesh.triangles.size());
    for (const glm::uvec3& t : mesh.triangles)
        edges.insert(edges.end(), {{t.x, t.y}, {t.y, t.z}, {t.z, t.x}});
    return edges;
}

struct PointLess {
    bool operator()(const glm::ivec3& a, const glm::ivec3& b) const {
        return std::tie(a.x, a.y, a.z) < std::tie(b.x, b.y, b.z);
    }
};

/// Gives all vertices at one lattice point the same number.
void merge_points(std::vector<Edge>& edges, const std::vector<glm::ivec3>& vertices) {
    std::map<glm::ivec3, uint32_t, PointLess> vertex_at;
    const auto merged = [&](uint32_t v) { return vertex_at.emplace(vertices[v], v).first->second; };
    for (Edge& e : edges) e = {merged(e.from), merged(e.to)};
}

/// The sets of vertices that edges connect.
class Outlines {
  public:
    explicit Outlines(const std::vector<Edge>& edges) {
        for (const Edge& e : edges) root_of_[find(e.from)] = find(e.to);
    }
    uint32_t find(uint32_t v) {
        const auto at = root_of_.emplace(v, v).first;
        return at->second == v ? v : at->second = find(at->second);
    }

  private:
    std::map<uint32_t, uint32_t> root_of_;
};

/// The offset, in lattice units, from an outline's middle to the point where its caps meet. Winding
/// numbers don't depend on that point. Away from the middle, centres of voxels seldom lie on edges
/// between caps, where neither cap has an angle.
constexpr glm::i64vec3 kAside(37, 53, 71);

/// The sum and number of an outline's corners, and the vertex at their middle.
struct Middle {
    glm::i64vec3 sum{0};
    int64_t count = 0;
    uint32_t vertex = 0;
};

}  // namespace

void cap_open_outlines(MeshLattice& mesh) {
    std::vector<Edge> open = unpaired_edges(edges_of(mesh), mesh.vertices.size());
    if (open.empty()) return;
    merge_points(open, mesh.vertices);
    open = unpaired_edges(open, mesh.vertices.size());
    Outlines outlines(open);
    std::map<uint32_t, Middle> middles;
    for (const Edge& e : open) {
        Middle& m = middles[outlines.find(e.from)];
        m.sum += glm::i64vec3(mesh.vertices[e.from]);
        ++m.count;
    }
    for (auto& [root, m] : middles) {
        m.vertex = static_cast<uint32_t>(mesh.vertices.size());
        mesh.vertices.emplace_back(m.sum / m.count + kAside);
    }
    for (const Edge& e : open)
        mesh.triangles.emplace_back(e.to, e.from, middles[outlines.find(e.from)].vertex);
}

}  // namespace voxelume
