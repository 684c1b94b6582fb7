// SPDX-License-Identifier: Apache-2.0
// Pairs of solids, one or both of which are shown as cubes, compared with the solids' formulas.
//
// Cubes have no exact surface that depths could be compared with, because they stand around their
// solid's surface. So each pixel must lie near the surface of the object that it shows, and nothing
// may be seen through the solids.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <glm/geometric.hpp>
#include <numbers>
#include <optional>
#include <random>
#include <string>
#include <vector>

#include "runtime/render/renderer.hpp"
#include "runtime/scene_file/read_scene.hpp"
#include "runtime/verify/analytic/analytic_crossings.hpp"
#include "tests/pictures/touching/pair_scenes.hpp"
#include "tests/support/exhaustive.hpp"
#include "tests/support/test_device.hpp"

namespace voxelume {
namespace {

constexpr double kPairVoxel = 1 / 32.0;

/// Directions evenly around.
std::vector<glm::dvec3> directions_around(int count) {
    std::vector<glm::dvec3> all;
    for (int i = 0; i < count; ++i) {
        const double y = 1 - (2.0 * i + 1) / count,
                     angle = i * std::numbers::pi * (3 - std::sqrt(5));
        const double radius = std::sqrt(1 - y * y);
        all.emplace_back(radius * std::cos(angle), y, radius * std::sin(angle));
    }
    return all;
}

/// A solid as an object shows it.
struct ShownSolid {
    oracle::PlacedSolid solid;
    std::optional<glm::dvec3> tip;  ///< of a pointed cone
};

ShownSolid shown_solid(const Solid& solid, const glm::dmat4& map) {
    ShownSolid shown{oracle::PlacedSolid(solid, map), {}};
    if (solid.kind == SolidKind::cone && solid.top_radius == 0)
        shown.tip = glm::dvec3(map * glm::dvec4(0, solid.height / 2, 0, 1));
    return shown;
}

/// The direction in which a surface is nearest, of those that were tried.
struct NearestWay {
    double distance = INFINITY;  ///< metres
    glm::dvec3 direction{0};

    void consider(const oracle::PlacedSolid& solid, const oracle::Line& line) {
        const oracle::Crossings met = solid.crossings(line);
        for (int i = 0; i < met.count; ++i) {
            const double t = met.list[size_t(i)].t;
            if (!(std::abs(t) < distance)) continue;
            distance = std::abs(t);
            direction = line.direction;
        }
    }

    /// Tries directions around the best, ever closer to it, as the way to an edge needs.
    void refine(const oracle::PlacedSolid& solid, const glm::dvec3& point) {
        for (double step = 0.25; step > 0.01; step /= 2) {
            const glm::dvec3 middle = direction;
            const glm::dvec3 helper =
                std::abs(middle.x) < 0.6 ? glm::dvec3(1, 0, 0) : glm::dvec3(0, 1, 0);
            const glm::dvec3 u = glm::normalize(glm::cross(middle, helper));
            const glm::dvec3 v = glm::cross(middle, u);
            for (int i = 0; i < 8; ++i) {
                const double angle = i * std::numbers::pi / 4;
                const glm::dvec3 aside = std::cos(angle) * u + std::sin(angle) * v;
                consider(solid, {point, glm::normalize(middle + step * aside)});
            }
        }
    }
};

/// The metres from a point to a solid's surface, hardly too many.
double distance_to(const ShownSolid& shown, const glm::dvec3& point) {
    static const std::vector<glm::dvec3> all = directions_around(48);
    NearestWay nearest;
    for (const glm::dvec3& direction : all) nearest.consider(shown.solid, {point, direction});
    if (nearest.distance < INFINITY) nearest.refine(shown.solid, point);
    // From a point beyond a tip, few directions lead to the cone.
    return shown.tip ? std::min(nearest.distance, glm::distance(point, *shown.tip))
                     : nearest.distance;
}

/// The greatest depth below the solid's surface of a ray's points before `t_end`, in metres, where
/// it is half a voxel or more.
double depth_passed(const ShownSolid& shown, const oracle::Line& ray, double t_end) {
    const oracle::Crossings met = shown.solid.crossings(ray);
    double deepest = 0;
    for (int i = 0; i + 1 < met.count; i += 2) {
        const double first = met.list[size_t(i)].t,
                     last = std::min(met.list[size_t(i) + 1].t, t_end);
        for (int k = 1; k <= 6; ++k) {
            const double t = first + (last - first) * k / 6;
            if (std::min(t - first, met.list[size_t(i) + 1].t - t) < kPairVoxel / 2) continue;
            deepest = std::max(deepest, distance_to(shown, ray.origin + ray.direction * t));
        }
    }
    return deepest;
}

/// In voxels.
struct CubePairErrors {
    double far_of_cubes = 0;   ///< from what is shown to the surface of its object, if cubes
    double far_of_others = 0;  ///< the same of other objects
    double deep = 0;           ///< below a surface, that a ray has passed
};

CubePairErrors cube_pair_errors(const Scene& scene) {
    std::vector<ShownSolid> solids;
    for (const Object& object : scene.objects)
        solids.push_back(
            shown_solid(*scene.models[size_t(object.model)].solid, object.world_from_object));
    RenderReport report;
    const Image image = render(test_device(), scene, report);
    const auto value = [&](const char* name, size_t i) { return double(image.planes.at(name)[i]); };
    CubePairErrors errors;
    for (int y = 0; y < kPairSize.y; ++y)
        for (int x = 0; x < kPairSize.x; ++x) {
            const size_t i = size_t(y) * kPairSize.x + x;
            const oracle::Line ray = {scene.observer.position,
                                      direction_at(scene.observer, {x + 0.5, y + 0.5})};
            const int object = int(image.id_planes.at("objectId")[i]) - 1;
            double t = INFINITY;
            if (object >= 0) {
                const glm::dvec3 p(value("P.X", i), value("P.Y", i), value("P.Z", i));
                t = glm::dot(p - ray.origin, ray.direction);
                const int model = scene.objects[size_t(object)].model;
                double& far = shows_voxels(scene.models[size_t(model)].surface)
                                  ? errors.far_of_cubes
                                  : errors.far_of_others;
                far = std::max(far, distance_to(solids[size_t(object)], p) / kPairVoxel);
            }
            for (const ShownSolid& solid : solids)
                errors.deep = std::max(errors.deep, depth_passed(solid, ray, t) / kPairVoxel);
        }
    return errors;
}

/// In a solid's cubes, the centre of a world voxel lies in a voxel of the model that the surface
/// passes, or within the distance that closes gaps. So no point of a cube is farther from the
/// surface than half a diagonal and, as much as models are stretched, two halves of theirs.
constexpr double kHalfDiagonal = 0.8661;
constexpr double kFarthestCube = kHalfDiagonal + 2 * kMaxMapStretch * kHalfDiagonal;

/// A voxel that the surface passes through is no cube if its centre lies in none of the model's
/// voxels. A ray gets no deeper than the far end of that voxel.
constexpr double kDeepestPoint = 2 * kHalfDiagonal;

constexpr std::array<std::array<const char*, 2>, 5> kCubePairs = {{{"cubes", "cubes"},
                                                                   {"cubes", "smooth"},
                                                                   {"cubes", "exact"},
                                                                   {"smooth", "cubes"},
                                                                   {"exact", "cubes"}}};

/// Expects a pair's errors to be as small as they can be; `worst` becomes the largest of them.
void expect_surfaces(const std::array<std::string, 2>& pair, const std::string& what,
                     CubePairErrors& worst) {
    const std::string text = pair_scene(kPairVoxel, pair[0], pair[1]);
    const CubePairErrors e = cube_pair_errors(parse_scene(text, "pair.json", {}));
    EXPECT_LT(e.far_of_cubes, kFarthestCube) << what << ": " << text;
    EXPECT_LT(e.far_of_others, 0.5) << what << ": " << text;
    EXPECT_LT(e.deep, kDeepestPoint) << what << ": " << text;
    worst.far_of_cubes = std::max(worst.far_of_cubes, e.far_of_cubes);
    worst.far_of_others = std::max(worst.far_of_others, e.far_of_others);
    worst.deep = std::max(worst.deep, e.deep);
}

std::string words_of(const CubePairErrors& worst) {
    return fmt::format(
        "cubes {:.2f} voxels from their surfaces at most, others {:.2f}, passed {:.2f} deep",
        worst.far_of_cubes, worst.far_of_others, worst.deep);
}

TEST(CubePairs, ShowSurfacesAndNothingBehindThem) {
    CubePairErrors worst;
    for (size_t i = 0; i < kSolidPairs.size(); ++i)
        for (const auto& [a, b] :
             in_turn<std::array<const char*, 2>>({kCubePairs.begin(), kCubePairs.end()}, i))
            expect_surfaces(pair_text(kSolidPairs[i], a, b),
                            fmt::format("{}, {} and {}", kSolidPairs[i].name, a, b), worst);
    fmt::print("{}\n", words_of(worst));
}

TEST(CubePairs, OfRandomSolidsShowSurfacesAndNothingBehindThem) {
    std::mt19937 random(22);
    const int pairs = is_exhaustive() ? 100 : 2;
    CubePairErrors worst;
    for (const auto& [a, b] : kCubePairs)
        for (int i = 0; i < pairs; ++i)
            expect_surfaces(random_pair(random, a, b), fmt::format("{} and {}, pair {}", a, b, i),
                            worst);
    fmt::print("{} pairs of each: {}\n", pairs, words_of(worst));
}

/// A wall and a film as pixels' objects show them, each a box.
Image film_before_wall(const std::string& material, const std::string& wall,
                       const std::string& film, const std::string& eye) {
    const std::string text = fmt::format(
        R"({{"voxelume": 1,
"world": {{"voxel_size": 0.1, "bounds": {{"min": [-2, -2, -2], "max": [2, 2, 2]}},
          "background": [1, 0, 1], "ambient": [1, 1, 1]}},
"materials": {{"wall": {{"color": [0, 0, 0]}}, "film": {{{}}}}},
"models": {{"wall": {{{}, "surface": "cubes"}}, "film": {{{}, "surface": "exact"}}}},
"objects": [{{"model": "wall", "material": "wall", "position": [0, 0, 0.05]}},
            {{"model": "film", "material": "film", "position": [0, 0, 0.08], "priority": 1}}],
"lights": [],
"observer": {{"position": {}, "look_at": [0, 0, 0], "display": {{"shape": "pyramid", "angle": 40}}}},
"render": {{"size": [96, 72]}}}})",
        material, wall, film, eye);
    RenderReport report;
    return render(test_device(), parse_scene(text, "film.json", {}), report);
}

// The poster is 2 cm before the wall's solid and in its cubes. Rays that arrive at an angle have
// been in other cubes before.
TEST(CubePairs, ShowAPosterWholeThatIsInCubesOfAWall) {
    const std::string poster = R"("shape": "box", "size": [1, 1, 0.02])";
    const Image both =
        film_before_wall(R"("color": [1, 1, 1])", R"("shape": "box", "size": [2.04, 2.04, 0.02])",
                         poster, "[1.5, 1.4, 2.5]");
    const Image alone =
        film_before_wall(R"("color": [1, 1, 1])", R"("shape": "box", "size": [0.1, 0.1, 0.02])",
                         poster, "[1.5, 1.4, 2.5]");
    int wanted = 0, shown = 0;
    const auto& ids = both.id_planes.at("objectId");
    for (size_t i = 0; i < ids.size(); ++i) {
        if (alone.id_planes.at("objectId")[i] != 2) continue;
        ++wanted;
        shown += ids[i] == 2;
    }
    EXPECT_GT(wanted, 1300);
    EXPECT_GT(shown, wanted * 9 / 10);
}

// Rays that a sheer film lets through meet the cube that the film is in.
TEST(CubePairs, ShowCubesBehindTheSheerSurfacesInThem) {
    const std::string ball = R"("shape": "sphere", "radius": 1.2)";
    const Image image =
        film_before_wall(R"("opacity": 0.1, "color": [0, 1, 0])", ball, ball, "[0.3, 0.4, 4]");
    const auto& ids = image.id_planes.at("objectId");
    int covered = 0;
    for (size_t i = 0; i < ids.size(); ++i) {
        if (ids[i] == 0) continue;
        ++covered;
        ASSERT_LT(image.planes.at("R")[i], 0.01) << "the background is seen through pixel " << i;
    }
    EXPECT_GT(covered, 3000);
}

}  // namespace
}  // namespace voxelume
