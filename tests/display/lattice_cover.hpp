// SPDX-License-Identifier: Apache-2.0
// Compares the coverage of a lattice's voxels, laid over one another along the lattice's axes, with
// the coverage in the flat picture of the same objects.
#pragma once

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <glm/vec2.hpp>
#include <string>
#include <vector>

#include "runtime/image/volume_geometry.hpp"
#include "runtime/render/renderer.hpp"
#include "tests/support/display_fixture.hpp"

namespace voxelume {

inline constexpr double kOpacity = 0.4, kOtherOpacity = 0.7;

/// Objects around the origin. SURFACE and PLACEMENT in the texts are replaced by the tested ones.
struct CoverCase {
    const char* name;
    const char* models;
    const char* objects;  ///< of the materials `veil` and `lace`
};

/// The text with every occurrence of `name` replaced.
inline std::string filled(std::string text, const std::string& name, const std::string& by) {
    for (size_t at = text.find(name); at != std::string::npos; at = text.find(name, at))
        text.replace(at, name.size(), by);
    return text;
}

/// How the objects of a case are tested.
struct CoverKind {
    const char* surface;
    const char* placement = "world";
};

/// The objects before an observer. `display` has the display's keys.
inline Scene cover_scene(const CoverCase& c, const CoverKind& kind, const std::string& observer,
                         const std::string& display, glm::ivec2 size) {
    const std::string text = fmt::format(R"({{"voxelume": 1,
"world": {{"voxel_size": 0.05, "bounds": {{"min": [-1, -0.9, -0.95], "max": [1.1, 1, 0.9]}},
          "ambient": [1, 1, 1]}},
"materials": {{"veil": {{"color": [0.5, 0.7, 0.9], "opacity": {}}},
              "lace": {{"color": [0.9, 0.7, 0.5], "opacity": {}}}}},
"models": {{{}}},
"objects": [{}],
"observer": {{{}, "display": {{{}}}}},
"render": {{"size": [{}, {}], "samples": 64, "depth": 1}}}})",
                                         kOpacity, kOtherOpacity, c.models, c.objects, observer,
                                         display, size.x, size.y);
    return parsed(filled(filled(text, "SURFACE", kind.surface), "PLACEMENT", kind.placement));
}

/// The lattice of a scene, whose opacities need no samples of light.
inline Volume cover_volume(Scene scene) {
    scene.render.samples = 1;
    return volume_of(scene);
}

/// The difference between the coverage of the voxels and that of the flat picture's pixels.
struct CoverDifference {
    double sum = 0, largest_inside = 0;  ///< inside: where no outline is
    int pixels = 0, far = 0;             ///< far: by more than 0.02

    void add(double voxels, double picture, bool is_inside) {
        sum += voxels - picture;
        ++pixels;
        far += std::abs(voxels - picture) > 0.02;
        if (is_inside) largest_inside = std::max(largest_inside, std::abs(voxels - picture));
    }
    double mean() const { return std::abs(sum) / pixels; }
    double far_share() const { return double(far) / pixels; }
};

/// True if the pixel and all its neighbours have equal opacity, so that no outline runs through it.
inline bool is_even(const Image& picture, int u, int v) {
    const auto& alpha = picture.planes.at("A");
    for (int y = std::max(v - 1, 0); y <= std::min(v + 1, picture.height - 1); ++y)
        for (int x = std::max(u - 1, 0); x <= std::min(u + 1, picture.width - 1); ++x)
            if (std::abs(alpha[size_t(y * picture.width + x)] -
                         alpha[size_t(v * picture.width + u)]) > 1e-3f)
                return false;
    return true;
}

/// The opacity of each voxel of a lattice.
inline std::vector<float> dense_opacities(const Volume& volume) {
    std::vector<float> dense(voxel_count(volume.frame), 0.0f);
    for (size_t i = 0; i < volume.indices.size(); ++i)
        dense[volume.indices[i]] = volume.opacities[i];
    return dense;
}

/// The coverage of a lattice along lines through the middles of its columns along `axis`.
inline double cover_of_column(const VolumeFrame& frame, const std::vector<float>& dense,
                              glm::ivec3 cell, int axis) {
    double clear = 1;
    for (cell[axis] = 0; cell[axis] < frame.size[axis]; ++cell[axis])
        clear *=
            1 - double(dense[size_t(cell.x + frame.size.x * (cell.y + frame.size.y * cell.z))]);
    return 1 - clear;
}

inline constexpr glm::ivec3 kSize{76, 72, 74};
inline constexpr glm::dvec3 kEdges{1.9, 1.8, 1.85};  // edges of the box around the origin

/// Observers that look along x, y and z of the world, with boxes around the same space.
inline constexpr std::array kLookingAlong = {R"("position": [-1.25, 0, 0], "turn": [90, 0, 0])",
                                             R"("position": [0, -1.2, 0], "turn": [0, -90, 0])",
                                             R"("position": [0, 0, -1.225], "turn": [0, 0, 0])"};

inline std::string box_keys(int axis, const std::string& more) {
    const glm::dvec3 size = axis == 0   ? glm::dvec3(kEdges.z, kEdges.y, kEdges.x)
                            : axis == 1 ? glm::dvec3(kEdges.x, kEdges.z, kEdges.y)
                                        : kEdges;
    return fmt::format(R"("shape": "box", "size": [{}, {}, {}], "near": 0.3{})", size.x, size.y,
                       size.z, more);
}

/// The coverage of a lattice along an axis, for each pixel of a picture along that axis.
inline std::vector<double> covers_along(const CoverCase& c, const CoverKind& kind, int axis) {
    const std::array names = {"x", "y", "z"};
    const std::string lattice = fmt::format(
        R"(, "voxels": [{}, {}, {}], "layout": "lattice", "visibility": "all", "seen_along": "{}")",
        kSize.x, kSize.y, kSize.z, names[size_t(axis)]);
    const Volume volume =
        cover_volume(cover_scene(c, kind, kLookingAlong[2], box_keys(2, lattice), {8, 8}));
    const std::vector<float> dense = dense_opacities(volume);
    const int right = axis == 0 ? 2 : 0, down = axis == 1 ? 2 : 1;
    const glm::ivec2 size(kSize[right], kSize[down]);
    std::vector<double> covers;
    for (int v = 0; v < size.y; ++v)
        for (int u = 0; u < size.x; ++u) {
            // Image right is -X_E, which is +Z for the first observer and -X for the others; down
            // is -Y_E, which is +Z for the second and -Y for the others.
            glm::ivec3 cell(0);
            cell[right] = axis == 0 ? u : size.x - 1 - u;
            cell[down] = axis == 1 ? v : size.y - 1 - v;
            covers.push_back(cover_of_column(volume.frame, dense, cell, axis));
        }
    return covers;
}

/// The flat picture along an axis.
inline Image picture_along(const CoverCase& c, const CoverKind& kind, int axis, int samples) {
    const int right = axis == 0 ? 2 : 0, down = axis == 1 ? 2 : 1;
    Scene scene = cover_scene(c, kind, kLookingAlong[size_t(axis)], box_keys(axis, ""),
                              {kSize[right], kSize[down]});
    scene.render.samples = samples;
    RenderReport report;
    return render(shared_device(), scene, report);
}

/// The difference of opacities from those of a picture.
inline CoverDifference difference_of(const std::vector<double>& covers, const Image& picture) {
    CoverDifference result;
    for (int v = 0; v < picture.height; ++v)
        for (int u = 0; u < picture.width; ++u) {
            const size_t i = size_t(v) * size_t(picture.width) + size_t(u);
            const double alpha = double(picture.planes.at("A")[i]);
            if (alpha > 0 || covers[i] > 0)
                result.add(covers[i], alpha, alpha > 0 && is_even(picture, u, v));
        }
    return result;
}

inline CoverDifference compare_along(const CoverCase& c, const CoverKind& kind, int axis) {
    return difference_of(covers_along(c, kind, axis), picture_along(c, kind, axis, 64));
}

}  // namespace voxelume
