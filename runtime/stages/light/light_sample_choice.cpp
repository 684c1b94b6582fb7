// SPDX-License-Identifier: Apache-2.0
#include "runtime/stages/light/light_sample_choice.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <glm/common.hpp>
#include <glm/geometric.hpp>

namespace voxelume {
namespace {

/// The position and the normal of a piece, in metres.
using Coordinates = std::array<double, 6>;

class Division {
  public:
    explicit Division(double metres_per_normal) : metres_per_normal_(metres_per_normal) {}

    void divide(std::span<EmissivePiece> pieces, size_t count,
                std::vector<LightSample>& light_samples) const {
        if (count == 1) return light_samples.push_back(light_sample_of(pieces));
        const size_t axis = widest_axis(pieces);
        std::ranges::stable_sort(pieces, [&](const EmissivePiece& a, const EmissivePiece& b) {
            return coordinates_of(a)[axis] < coordinates_of(b)[axis];
        });
        const size_t low_count = count / 2;
        const size_t cut = cut_at(pieces, double(low_count) / double(count), low_count, count);
        divide(pieces.first(cut), low_count, light_samples);
        divide(pieces.subspan(cut), count - low_count, light_samples);
    }

  private:
    Coordinates coordinates_of(const EmissivePiece& piece) const {
        const glm::dvec3 n = piece.normal * metres_per_normal_;
        return {piece.position.x, piece.position.y, piece.position.z, n.x, n.y, n.z};
    }

    size_t widest_axis(std::span<const EmissivePiece> pieces) const {
        Coordinates low = coordinates_of(pieces[0]), high = low;
        for (const EmissivePiece& piece : pieces) {
            const Coordinates coordinates = coordinates_of(piece);
            for (size_t i = 0; i < coordinates.size(); ++i) {
                low[i] = std::min(low[i], coordinates[i]);
                high[i] = std::max(high[i], coordinates[i]);
            }
        }
        size_t widest = 0;
        for (size_t i = 1; i < low.size(); ++i)
            if (high[i] - low[i] > high[widest] - low[widest]) widest = i;
        return widest;
    }

    /// The number of pieces that have `share` of the area. Each side keeps at least a piece for
    /// every light sample.
    static size_t cut_at(std::span<const EmissivePiece> pieces, double share, size_t low_count,
                         size_t count) {
        double whole = 0, sum = 0;
        for (const EmissivePiece& piece : pieces) whole += piece.area;
        size_t cut = 0;
        while (cut < pieces.size() && sum + pieces[cut].area / 2 <= share * whole)
            sum += pieces[cut++].area;
        return std::clamp(cut, low_count, pieces.size() - (count - low_count));
    }

    LightSample light_sample_of(std::span<const EmissivePiece> pieces) const {
        LightSample light_sample;
        Coordinates mean{};
        for (const EmissivePiece& piece : pieces) {
            const Coordinates coordinates = coordinates_of(piece);
            for (size_t i = 0; i < mean.size(); ++i) mean[i] += coordinates[i] * piece.area;
            light_sample.area += piece.area;
            light_sample.power += piece.emission * piece.area;
        }
        const EmissivePiece* best = nullptr;
        double minimum = INFINITY;
        for (const EmissivePiece& piece : pieces) {
            const Coordinates coordinates = coordinates_of(piece);
            double squared = 0;
            for (size_t i = 0; i < mean.size(); ++i)
                squared += (coordinates[i] - mean[i] / light_sample.area) *
                           (coordinates[i] - mean[i] / light_sample.area);
            const bool is_better = !best || (piece.is_exact && !best->is_exact) ||
                                   (piece.is_exact == best->is_exact && squared < minimum);
            if (!is_better) continue;
            best = &piece;
            minimum = squared;
        }
        light_sample.position = best->position;
        light_sample.normal = best->normal;
        return light_sample;
    }

    double metres_per_normal_;
};

double longest_side(std::span<const EmissivePiece> pieces) {
    glm::dvec3 low = pieces[0].position, high = low;
    for (const EmissivePiece& piece : pieces) {
        low = glm::min(low, piece.position);
        high = glm::max(high, piece.position);
    }
    const glm::dvec3 size = high - low;
    return std::max({size.x, size.y, size.z});
}

}  // namespace

std::vector<LightSample> choose_light_samples(std::span<EmissivePiece> pieces, int count) {
    std::vector<LightSample> light_samples;
    if (pieces.empty() || count < 1) return light_samples;
    const Division division(longest_side(pieces) / 2);
    division.divide(pieces, std::min(pieces.size(), size_t(count)), light_samples);
    return light_samples;
}

}  // namespace voxelume
