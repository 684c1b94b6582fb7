// SPDX-License-Identifier: Apache-2.0
#include "runtime/geometry/mesh_thickness.hpp"

#include <algorithm>
#include <limits>
#include <vector>

#include "runtime/geometry/mesh_chords.hpp"

namespace voxelume {
namespace {

constexpr int kLines = 64;

/// A chord's thickness, with the area that it stands for.
struct Thickness {
    double value, area;
};

/// The thickness up to which the thinnest chords stand for `area`; the largest number if all chords
/// together stand for less.
double quantile(std::vector<Thickness>& chords, double area) {
    double so_far = 0;
    std::ranges::stable_sort(chords, {}, &Thickness::value);
    for (const Thickness& chord : chords) {
        so_far += chord.area;
        if (so_far >= area) return chord.value;
    }
    return std::numeric_limits<double>::max();
}

}  // namespace

MeshThickness thickness_of(const Mesh& mesh) {
    std::vector<Thickness> chords, of_walls, of_sheets;
    double area = 0;
    const bool has_inside = for_each_chord(mesh, glm::ivec3(kLines), [&](const Chord& chord) {
        chords.push_back({chord.thickness, chord.area});
        if (chord.is_between_walls) of_walls.push_back(chords.back());
        if (chord.is_in_sheet) of_sheets.push_back(chords.back());
        area += chord.area;
    });
    if (!has_inside || chords.empty()) return {};
    return {quantile(chords, kThinShare * area), quantile(chords, kThinPartShare * area),
            quantile(of_walls, kThinHintShare * area), quantile(of_sheets, kThinPartShare * area)};
}

MeshThickness scaled(const MeshThickness& t, double scale) {
    return {scale * t.body, scale * t.part, scale * t.hint, scale * t.sheet};
}

}  // namespace voxelume
