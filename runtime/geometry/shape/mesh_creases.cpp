// SPDX-License-Identifier: Apache-2.0
#include "runtime/geometry/shape/mesh_creases.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <limits>
#include <optional>
#include <utility>
#include <vector>

#include "runtime/geometry/shape/edge_turns.hpp"
#include "runtime/geometry/shape/mesh_edges.hpp"

namespace voxelume {
namespace {

/// An edge of the mesh at which the surface turns.
struct SharpEdge {
    std::array<uint32_t, 2> ends{};
    double length = 0;
    EdgeTurn turn;
};

/// Edges that turn less are left out where they may be parts of rounded ones.
constexpr double kFlat = 1;

/// The edges at which the surface turns by kSharpAngle, or does so within `reach` metres.
std::vector<SharpEdge> sharp_edges(const MeshEdges& edges, double reach) {
    std::vector<SharpEdge> sharp;
    for (const MeshEdge& edge : edges.edges()) {
        const double turn = turn_at(edges, edge);
        const bool is_sharp = edge.is_fork || turn >= kSharpAngle;
        if (!is_sharp && (turn < kFlat || reach == 0)) continue;
        const EdgeTurn around = is_sharp ? EdgeTurn{0, 1} : turn_around(edges, edge, reach);
        if (!(around.width <= reach)) continue;
        const std::array ends = {edges.begin(edge.a), edges.begin(next_side(edge.a))};
        const double length = glm::distance(edges.position(ends[0]), edges.position(ends[1]));
        sharp.push_back({{std::min(ends[0], ends[1]), std::max(ends[0], ends[1])}, length, around});
    }
    return sharp;
}

/// Edges that follow each other.
struct Crease {
    double length = 0, share = 0;  ///< metres; and the part of it that counts, see EdgeTurn

    void add(const SharpEdge& edge) {
        length += edge.length;
        share += edge.length * edge.turn.share;
    }
};

/// Follows sharp edges, each time to the one that goes on straightest.
class Creases {
  public:
    Creases(const MeshEdges& mesh, std::vector<SharpEdge> edges)
        : mesh_(mesh), edges_(std::move(edges)), is_used_(edges_.size()) {
        for (uint32_t i = 0; i < edges_.size(); ++i)
            for (const uint32_t end : edges_[i].ends) at_.emplace_back(end, i);
        std::ranges::sort(at_);
    }

    /// The crease that `edge` is part of; its edges are part of no other. 0 if `edge` was part of
    /// an earlier crease.
    Crease through(uint32_t edge) {
        if (is_used_[edge]) return {};
        is_used_[edge] = true;
        Crease sum;
        sum.add(edges_[edge]);
        for (const uint32_t end : edges_[edge].ends) {
            uint32_t last = edge, vertex = end;
            while (const auto next = next_of(last, vertex)) {
                is_used_[*next] = true;
                sum.add(edges_[*next]);
                vertex = other_end(*next, vertex);
                last = *next;
            }
        }
        return sum;
    }

  private:
    uint32_t other_end(uint32_t edge, uint32_t vertex) const {
        const auto& ends = edges_[edge].ends;
        return ends[0] == vertex ? ends[1] : ends[0];
    }

    glm::dvec3 direction(uint32_t from, uint32_t to) const {
        const glm::dvec3 way = mesh_.position(to) - mesh_.position(from);
        return way / glm::length(way);
    }

    /// The unused edge at position `vertex` that continues `edge` with the smallest turn.
    std::optional<uint32_t> next_of(uint32_t edge, uint32_t vertex) const {
        const glm::dvec3 onward = direction(other_end(edge, vertex), vertex);
        std::optional<uint32_t> best;
        double straightest = kStraight;
        auto here = std::ranges::lower_bound(at_, std::pair(vertex, 0u));
        for (; here != at_.end() && here->first == vertex; ++here) {
            const uint32_t candidate = here->second;
            if (is_used_[candidate]) continue;
            const double cosine = glm::dot(onward, direction(vertex, other_end(candidate, vertex)));
            if (cosine < straightest) continue;
            straightest = cosine;
            best = candidate;
        }
        return best;
    }

    /// A crease turns by at most 60 degrees from edge to edge: a hexagon is one crease.
    static constexpr double kStraight = 0.4999;

    const MeshEdges& mesh_;
    std::vector<SharpEdge> edges_;
    std::vector<bool> is_used_;
    std::vector<std::pair<uint32_t, uint32_t>> at_;  ///< position and edge, sorted
};

double longest_side(const Mesh& mesh) {
    glm::dvec3 low(std::numeric_limits<double>::infinity()), high(-low);
    for (const glm::uvec3& triangle : mesh.triangles)
        for (int corner = 0; corner < 3; ++corner) {
            const glm::dvec3 point(mesh.positions[triangle[corner]]);
            low = glm::min(low, point);
            high = glm::max(high, point);
        }
    return std::max({high.x - low.x, high.y - low.y, high.z - low.z});
}

/// The length of the creases of those edges that turn sharply within `width`.
double length_within(const MeshEdges& mesh, const std::vector<SharpEdge>& edges, double width,
                     double shortest) {
    std::vector<SharpEdge> within;
    std::ranges::copy_if(edges, std::back_inserter(within),
                         [&](const SharpEdge& edge) { return edge.turn.width <= width; });
    const auto count = uint32_t(within.size());
    Creases creases(mesh, std::move(within));
    double sum = 0;
    for (uint32_t i = 0; i < count; ++i)
        if (const Crease crease = creases.through(i); crease.length >= shortest)
            sum += crease.share;
    return sum;
}

/// Candidate widths: kRungs per octave, over kOctaves octaves.
constexpr int kRungs = 16, kOctaves = 12;

}  // namespace

MeshCreases creases_of(const Mesh& mesh, double enough) {
    MeshCreases found;
    if (mesh.triangles.empty()) return found;
    const MeshEdges edges(mesh);
    const double longest = longest_side(mesh), shortest = kCreaseShare * longest;
    found.length = length_within(edges, sharp_edges(edges, 0), 0, shortest);
    if (found.length > enough) return found;
    const double reach = kRoundShare * longest;
    const std::vector<SharpEdge> sharp = sharp_edges(edges, reach);
    const auto width_at = [&](int rung) { return reach * std::exp2(-double(rung) / kRungs); };
    const auto length_at = [&](int rung) {
        return length_within(edges, sharp, width_at(rung), shortest);
    };
    if (!(length_at(0) > enough)) return found;
    int rung = -1;
    for (int step = 128; step > 0; step /= 2) {
        const double width = width_at(rung + step);
        const double length = rung + step < kRungs * kOctaves ? length_at(rung + step) : 0;
        if (!(length > enough)) continue;
        rung += step;
        found.round_width = width;
        found.round_length = length;
    }
    return found;
}

}  // namespace voxelume
