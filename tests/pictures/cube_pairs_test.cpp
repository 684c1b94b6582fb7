// SPDX-License-Identifier: Apache-2.0
// Pairs of solids of which one or both are shown as cubes, against the solids' formulas.
//
// Cubes have no surface of their own that depths could be compared with: they stand around their
// solid's. So what is shown has to be near the surface of the object that it is said to be, and
// nothing may be seen through the solids.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <numbers>
#include <random>
#include <string>
#include <vector>

#include "runtime/render/renderer.hpp"
#include "runtime/scene_file/read_scene.hpp"
#include "runtime/verify/analytic/analytic_crossings.hpp"
#include "tests/pictures/pair_scenes.hpp"
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

/// The metres from a point to a solid's surface, a few per cent too many.
double distance_to(const oracle::PlacedSolid& solid, const glm::dvec3& point) {
    static const std::vector<glm::dvec3> all = directions_around(48);
    double nearest = INFINITY;
    for (const glm::dvec3& direction : all) {
        const oracle::Crossings met = solid.crossings({point, direction});
        for (int i = 0; i < met.count; ++i)
            nearest = std::min(nearest, std::abs(met.list[size_t(i)].t));
    }
    return nearest;
}

/// The greatest depth below the solid's surface of a ray's points before `t_end`, in metres, where
/// it is half a voxel or more.
double depth_passed(const oracle::PlacedSolid& solid, const oracle::Line& ray, double t_end) {
    const oracle::Crossings met = solid.crossings(ray);
    double deepest = 0;
    for (int i = 0; i + 1 < met.count; i += 2) {
        const double first = met.list[size_t(i)].t,
                     last = std::min(met.list[size_t(i) + 1].t, t_end);
        for (int k = 1; k <= 6; ++k) {
            const double t = first + (last - first) * k / 6;
            if (std::min(t - first, met.list[size_t(i) + 1].t - t) < kPairVoxel / 2) continue;
            deepest = std::max(deepest, distance_to(solid, ray.origin + ray.direction * t));
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
    std::vector<oracle::PlacedSolid> solids;
    for (const Object& object : scene.objects)
        solids.emplace_back(*scene.models[size_t(object.model)].solid, object.world_from_object);
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
            for (const oracle::PlacedSolid& solid : solids)
                errors.deep = std::max(errors.deep, depth_passed(solid, ray, t) / kPairVoxel);
        }
    return errors;
}

/// In a solid's cubes, the centre of a world voxel lies in a voxel of the model that the surface
/// passes, or within the distance that closes gaps. So no point of a cube is farther from the
/// surface than half a diagonal and, models being stretched by 1.2 at most, 1.2 whole ones.
constexpr double kHalfDiagonal = 0.8661;
constexpr double kFarthestCube = kHalfDiagonal + 2 * 1.2 * kHalfDiagonal;

/// A voxel that the surface passes is no cube where its centre lies in none of the model's. A ray
/// gets no deeper than to the far end of that voxel.
constexpr double kDeepestPoint = 2 * kHalfDiagonal;

TEST(CubePairs, ShowSurfacesAndNothingBehindThem) {
    std::mt19937 random(22);
    const int pairs = is_exhaustive() ? 100 : 2;
    CubePairErrors worst;
    for (const auto& [a, b] : {std::pair{"cubes", "cubes"},
                               {"cubes", "smooth"},
                               {"cubes", "exact"},
                               {"smooth", "cubes"},
                               {"exact", "cubes"}})
        for (int i = 0; i < pairs; ++i) {
            const auto first = random_solid(random, a), second = random_solid(random, b);
            const std::string text =
                pair_scene(kPairVoxel, fmt::format(R"("a": {}, "b": {})", first[0], second[0]),
                           fmt::format(R"({{"model": "a", "placement": "world", {}}},
                                          {{"model": "b", "placement": "world", {}}})",
                                       first[1], second[1]));
            const CubePairErrors e = cube_pair_errors(parse_scene(text, "pair.json", {}));
            const std::string what = fmt::format("{} and {}, pair {}: {}", a, b, i, text);
            EXPECT_LT(e.far_of_cubes, kFarthestCube) << what;
            EXPECT_LT(e.far_of_others, 0.5) << what;
            EXPECT_LT(e.deep, kDeepestPoint) << what;
            worst.far_of_cubes = std::max(worst.far_of_cubes, e.far_of_cubes);
            worst.far_of_others = std::max(worst.far_of_others, e.far_of_others);
            worst.deep = std::max(worst.deep, e.deep);
        }
    fmt::print(
        "{} pairs of each: cubes {:.2f} voxels from their surfaces at most, others {:.2f}, "
        "passed {:.2f} deep\n",
        pairs, worst.far_of_cubes, worst.far_of_others, worst.deep);
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

// The poster is 2 cm before the wall's solid and in its cubes. Rays that come to it aslant have
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
