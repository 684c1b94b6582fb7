// SPDX-License-Identifier: Apache-2.0
#include "runtime/geometry/mesh_topology.hpp"

#include <algorithm>
#include <array>
#include <bit>
#include <glm/geometric.hpp>
#include <map>
#include <utility>
#include <vector>

namespace voxelume {
namespace {

using PointBits = std::array<uint32_t, 3>;

/// The bits of a position, which are equal for equal positions: -0 is 0.
PointBits bits_of(const glm::vec3& p) {
    return {std::bit_cast<uint32_t>(p.x + 0.0f), std::bit_cast<uint32_t>(p.y + 0.0f),
            std::bit_cast<uint32_t>(p.z + 0.0f)};
}

/// The finalizer of MurmurHash3.
uint64_t mixed(uint64_t h) {
    h = (h ^ h >> 33) * 0xFF51AFD7ED558CCDull;
    h = (h ^ h >> 33) * 0xC4CEB9FE1A85EC53ull;
    return h ^ h >> 33;
}

uint64_t hash_of(const PointBits& p) {
    return mixed(mixed(mixed(p[0]) ^ p[1]) ^ p[2]);
}

/// An edge from position to position, turned so that `low` < `high`.
struct DirectedEdge {
    PointBits low, high;
    int direction;  ///< 1 or -1
};

/// An edge by the number of the triangle's corner that it begins at, over all triangles.
struct NumberedEdge {
    uint64_t hash;  ///< hash of both positions, in either order
    uint64_t corner;
    bool is_forward;  ///< from the position whose hash is smaller
};

/// The hash of each position, computed once and not for each of the six triangles that meet there.
std::vector<uint64_t> position_hashes(const Mesh& mesh) {
    std::vector<uint64_t> hashes(mesh.positions.size());
    for (size_t i = 0; i < hashes.size(); ++i) hashes[i] = hash_of(bits_of(mesh.positions[i]));
    return hashes;
}

DirectedEdge edge_from(const Mesh& mesh, uint64_t corner) {
    const glm::uvec3& triangle = mesh.triangles[corner / 3];
    const PointBits from = bits_of(mesh.positions[triangle[int(corner % 3)]]),
                    to = bits_of(mesh.positions[triangle[int((corner + 1) % 3)]]);
    return from < to ? DirectedEdge{from, to, 1} : DirectedEdge{to, from, -1};
}

/// Calls `visit` with each edge that has a length.
template <class Visit>
void for_each_edge(const Mesh& mesh, const std::vector<uint64_t>& of_positions,
                   const Visit& visit) {
    uint64_t corner = 0;
    for (const glm::uvec3& triangle : mesh.triangles) {
        const std::array<uint64_t, 3> hashes = {of_positions[triangle.x], of_positions[triangle.y],
                                                of_positions[triangle.z]};
        for (size_t i = 0; i < 3; ++i, ++corner) {
            const uint64_t from = hashes[i], to = hashes[(i + 1) % 3];
            bool is_forward = from < to;
            if (from == to) {  // one position, or two by a chance in 2^64
                const DirectedEdge edge = edge_from(mesh, corner);
                if (edge.low == edge.high) continue;
                is_forward = edge.direction > 0;
            }
            const uint64_t hash = is_forward ? mixed(from + 3 * to) : mixed(to + 3 * from);
            visit(NumberedEdge{hash, corner, is_forward});
        }
    }
}

/// Edges with the same hash modulo kBuckets share a sum, to which both directions contribute with
/// opposite signs. Where the sum is 0, all edges of the bucket are closed, but for one chance in
/// 2^64.
constexpr size_t kBuckets = size_t(1) << 16;

class EdgeSums {
  public:
    /// The bucket of an edge is given by the bits of its hash from `shift` on.
    explicit EdgeSums(int shift) : shift_(shift), sums_(kBuckets) {}

    void add(const NumberedEdge& edge) {
        sums_[bucket(edge)] += edge.is_forward ? edge.hash : 0 - edge.hash;
    }
    bool may_be_open(const NumberedEdge& edge) const { return sums_[bucket(edge)] != 0; }
    bool are_all_closed() const {
        return std::ranges::all_of(sums_, [](uint64_t sum) { return sum == 0; });
    }

  private:
    size_t bucket(const NumberedEdge& edge) const { return edge.hash >> shift_ & (kBuckets - 1); }

    int shift_;
    std::vector<uint64_t> sums_;
};

/// The edges that may be open. One set of buckets leaves all edges of a bucket that has an open
/// one; a second set leaves a small share of these.
std::vector<DirectedEdge> doubtful_edges_of(const Mesh& mesh) {
    const std::vector<uint64_t> hashes = position_hashes(mesh);
    EdgeSums sums(0);
    for_each_edge(mesh, hashes, [&](const NumberedEdge& edge) { sums.add(edge); });
    if (sums.are_all_closed()) return {};
    EdgeSums others(16);
    std::vector<NumberedEdge> left;
    for_each_edge(mesh, hashes, [&](const NumberedEdge& edge) {
        if (!sums.may_be_open(edge)) return;
        others.add(edge);
        left.push_back(edge);
    });
    std::vector<DirectedEdge> doubtful;
    for (const NumberedEdge& edge : left)
        if (others.may_be_open(edge)) doubtful.push_back(edge_from(mesh, edge.corner));
    return doubtful;
}

/// An edge by which triangles run more often in one direction than in the other.
struct OpenEdge {
    PointBits from, to;
    int count;  ///< how many times more
};

std::vector<OpenEdge> open_edges_of(const Mesh& mesh) {
    std::vector<DirectedEdge> doubtful = doubtful_edges_of(mesh);
    const auto ends = [](const DirectedEdge& edge) { return std::pair(edge.low, edge.high); };
    std::ranges::sort(doubtful, {}, ends);
    std::vector<OpenEdge> open;
    for (size_t i = 0; i < doubtful.size();) {
        const DirectedEdge& first = doubtful[i];
        int sum = 0;
        for (; i < doubtful.size() && ends(doubtful[i]) == ends(first); ++i)
            sum += doubtful[i].direction;
        if (sum > 0) open.push_back({first.low, first.high, sum});
        if (sum < 0) open.push_back({first.high, first.low, -sum});
    }
    return open;
}

glm::dvec3 point_of(const PointBits& p) {
    return {double(std::bit_cast<float>(p[0])), double(std::bit_cast<float>(p[1])),
            double(std::bit_cast<float>(p[2]))};
}

/// The rims of holes: sets of open edges that share positions.
class Rims {
  public:
    explicit Rims(const std::vector<OpenEdge>& edges) {
        for (const OpenEdge& edge : edges) join(number_of(edge.from), number_of(edge.to));
    }

    size_t of(const PointBits& point) { return root(number_of(point)); }

  private:
    size_t number_of(const PointBits& point) {
        const auto [entry, is_new] = numbers_.emplace(point, parents_.size());
        if (is_new) parents_.push_back(entry->second);
        return entry->second;
    }
    size_t root(size_t i) {
        while (parents_[i] != i) i = parents_[i] = parents_[parents_[i]];
        return i;
    }
    void join(size_t a, size_t b) { parents_[root(a)] = root(b); }

    std::map<PointBits, size_t> numbers_;
    std::vector<size_t> parents_;
};

double hole_area_of(const std::vector<OpenEdge>& edges) {
    Rims rims(edges);
    struct Lid {
        glm::dvec3 apex, twice_area{0};
    };
    std::map<size_t, Lid> lids;
    for (const OpenEdge& edge : edges) {
        const glm::dvec3 from = point_of(edge.from), to = point_of(edge.to);
        Lid& lid = lids.try_emplace(rims.of(edge.from), Lid{from}).first->second;
        lid.twice_area += double(edge.count) * glm::cross(from - lid.apex, to - lid.apex);
    }
    double sum = 0;
    for (const auto& [rim, lid] : lids) sum += glm::length(lid.twice_area) / 2;
    return sum;
}

double volume_of(const Mesh& mesh) {
    if (mesh.triangles.empty()) return 0;
    const glm::dvec3 apex(mesh.positions[mesh.triangles[0].x]);  // keeps the terms small
    double six_volumes = 0;
    for (const glm::uvec3& t : mesh.triangles)
        six_volumes += glm::dot(glm::dvec3(mesh.positions[t.x]) - apex,
                                glm::cross(glm::dvec3(mesh.positions[t.y]) - apex,
                                           glm::dvec3(mesh.positions[t.z]) - apex));
    return six_volumes / 6;
}

}  // namespace

MeshTopology mesh_topology(const Mesh& mesh) {
    MeshTopology topology;
    const std::vector<OpenEdge> open = open_edges_of(mesh);
    for (const OpenEdge& edge : open) topology.open_edges += uint64_t(edge.count);
    topology.hole_area = hole_area_of(open);
    topology.volume = volume_of(mesh);
    return topology;
}

}  // namespace voxelume
