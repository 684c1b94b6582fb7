// SPDX-License-Identifier: Apache-2.0
// Pairs of solids that pass through each other, against the analytic tracer: whose surface each
// pixel shows, and how far it is off.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <glm/geometric.hpp>
#include <optional>
#include <random>

#include "runtime/grid/grid.hpp"
#include "runtime/render/renderer.hpp"
#include "runtime/scene_file/read_scene.hpp"
#include "runtime/verify/analytic/analytic_tracer.hpp"
#include "tests/oracles/rounded_edges.hpp"
#include "tests/pictures/pair_scenes.hpp"
#include "tests/support/exhaustive.hpp"
#include "tests/support/test_device.hpp"

namespace voxelume {
namespace {

/// What an image shows that the solids' formulas don't.
struct PairErrors {
    size_t shown = 0;    ///< pixels that show a surface
    size_t wrong = 0;    ///< of another object than any that the formulas have within the slack
    size_t rounded = 0;  ///< the same, of a smooth solid's edges, as far as it rounds them
    double rms = 0;      ///< distance from the true surface, in voxels, where the object is right
    double beside = 0;   ///< the same, of pixels whose neighbours show the same object
    double worst_beside = 0;
};

/// The unit in which fields keep distances, in voxels.
constexpr double kStoredStep = 1.0 / kDistanceUnitsPerVoxel;

class Truth {
  public:
    explicit Truth(const Scene& scene) : scene_(scene), tracer_(scene) {
        for (int y = 0; y < kPairSize.y; ++y)
            for (int x = 0; x < kPairSize.x; ++x) seen_.push_back(at({x + 0.5, y + 0.5}));
    }

    const oracle::Seen& at(int x, int y) const { return seen_[size_t(y) * kPairSize.x + x]; }

    oracle::Seen at(const glm::dvec2& pixel) const {
        return tracer_.trace(scene_.observer.position, direction_at(scene_.observer, pixel));
    }

    /// Whether the object, or -1, is seen within `metres` around a pixel, at the distance of what
    /// is seen there or of the world's middle.
    bool sees_near(int x, int y, int object, double metres) const {
        const double t = std::min(at(x, y).t, glm::length(scene_.observer.position));
        const double pixels =
            metres / t / (2 * std::tan(scene_.observer.display.half_angles.x)) * kPairSize.x;
        for (int i = 0; i < 48; ++i) {
            const double angle = i * 6.2831853 / 16, radius = pixels * (1 + i / 16) / 3.0;
            const glm::dvec2 off(radius * std::cos(angle), radius * std::sin(angle));
            if (at(glm::dvec2(x + 0.5, y + 0.5) + off).object == object) return true;
        }
        return false;
    }

    bool is_at_border(int x, int y) const {
        for (int j = std::max(y - 2, 0); j <= std::min(y + 2, kPairSize.y - 1); ++j)
            for (int i = std::max(x - 2, 0); i <= std::min(x + 2, kPairSize.x - 1); ++i)
                if (at(i, j).object != at(x, y).object) return true;
        return false;
    }

  private:
    const Scene& scene_;
    oracle::AnalyticTracer tracer_;
    std::vector<oracle::Seen> seen_;
};

/// Whether a surface that a picture lacks at a pixel is that of an edge, which `smooth` solids
/// round: the distances at the lattice's nodes don't make any field have it.
bool is_rounded(const Scene& scene, const oracle::Seen& seen, const glm::dvec2& pixel) {
    if (seen.object < 0) return false;
    const Object& object = scene.objects[size_t(seen.object)];
    const Model& model = scene.models[size_t(object.model)];
    if (model.surface != Surface::smooth || !oracle::has_convex_edges(model.solid->kind))
        return false;
    const oracle::LatticeDistance field(scene.world, *model.solid, object.world_from_object);
    return field.least_on(scene.observer.position, direction_at(scene.observer, pixel), seen.t) >
           -kStoredStep * scene.world.voxel_size.x;
}

/// `slack`: voxels around a pixel within which a border may be.
PairErrors errors_of(const Scene& scene, double slack) {
    const Truth truth(scene);
    RenderReport report;
    const Image image = render(test_device(), scene, report);
    const double voxel = scene.world.voxel_size.x;
    const Observer& observer = scene.observer;
    PairErrors errors;
    double sum = 0, sum_beside = 0;
    size_t count = 0, count_beside = 0;
    const auto value = [&](const char* name, size_t i) { return double(image.planes.at(name)[i]); };
    for (int y = 0; y < kPairSize.y; ++y)
        for (int x = 0; x < kPairSize.x; ++x) {
            const size_t i = size_t(y) * kPairSize.x + x;
            const int object = int(image.id_planes.at("objectId")[i]) - 1;
            const oracle::Seen& seen = truth.at(x, y);
            errors.shown += object >= 0;
            if (object != seen.object) {
                if (truth.sees_near(x, y, object, slack * voxel)) continue;
                const glm::dvec2 pixel(x + 0.5, y + 0.5);
                ++(is_rounded(scene, seen, pixel) ? errors.rounded : errors.wrong);
                continue;
            }
            if (object < 0) continue;
            const glm::dvec3 p(value("P.X", i), value("P.Y", i), value("P.Z", i));
            const glm::dvec3 n(value("N.X", i), value("N.Y", i), value("N.Z", i));
            const glm::dvec3 d = direction_at(observer, {x + 0.5, y + 0.5});
            const double off = std::abs(glm::dot(p - observer.position, d) - seen.t) *
                               std::abs(glm::dot(n, d)) / voxel;
            sum += off * off, ++count;
            if (truth.is_at_border(x, y)) continue;
            sum_beside += off * off, ++count_beside;
            errors.worst_beside = std::max(errors.worst_beside, off);
        }
    errors.rms = std::sqrt(sum / double(std::max<size_t>(count, 1)));
    errors.beside = std::sqrt(sum_beside / double(std::max<size_t>(count_beside, 1)));
    return errors;
}

PairErrors errors_of(double voxel, const std::string& models, const std::string& objects,
                     double slack) {
    return errors_of(parse_scene(pair_scene(voxel, models, objects), "pair.json", {}), slack);
}

/// Two solids of a name each, of one surface each.
struct Pair {
    const char* name;
    const char *first, *second;        ///< keys of the models
    const char *first_at, *second_at;  ///< keys of the objects
    bool is_smooth;                    ///< no edges but where they meet
};

const std::array kPairs = {
    Pair{"ball in floor", R"("shape": "sphere", "radius": 0.6)",
         R"("shape": "box", "size": [2.2, 0.4, 2.2])", R"("position": [0.03, 0.21, 0.05])",
         R"("position": [0, -0.4, 0])", false},
    Pair{"ring and ball", R"("shape": "torus", "radius": 0.7, "tube": 0.2)",
         R"("shape": "sphere", "radius": 0.6)", R"("turn": [20, 35, 10])",
         R"("position": [0.12, 0.05, 0.2])", true},
    Pair{"cone on plate", R"("shape": "cone", "radius": 0.5, "height": 1.1, "top_radius": 0.15)",
         R"("shape": "cylinder", "radius": 1, "height": 0.3)", R"("position": [0.03, 0.31, 0.05])",
         R"("position": [0, -0.4, 0])", false},
    Pair{"box in box", R"("shape": "box", "size": [1.1, 0.9, 1])",
         R"("shape": "box", "size": [1, 1.2, 0.7])", R"("turn": [10, 20, 30])",
         R"("position": [0.4, 0.1, 0.3])", false},
    Pair{"nested shells", R"("shape": "sphere", "radius": 0.8)",
         R"("shape": "ellipsoid", "radii": [0.83, 0.75, 0.83])", R"("position": [0, 0, 0])",
         R"("position": [0, 0, 0])", true},
    Pair{"capsule in ellipsoid", R"("shape": "capsule", "radius": 0.3, "height": 1.2)",
         R"("shape": "ellipsoid", "radii": [0.9, 0.4, 0.6])", R"("turn": [0, 40, 25])",
         R"("turn": [15, 5, 0])", false}};

std::array<std::string, 2> text_of(const Pair& pair, const char* first, const char* second) {
    return {fmt::format(R"("a": {{{}, "surface": "{}"}}, "b": {{{}, "surface": "{}"}})", pair.first,
                        first, pair.second, second),
            fmt::format(R"({{"model": "a", "placement": "world", {}}},
                           {{"model": "b", "placement": "world", {}}})",
                        pair.first_at, pair.second_at)};
}

TEST(Pairs, ShowTheObjectThatIsThere) {
    for (const Pair& pair : kPairs)
        for (const auto& [first, second] : {std::pair{"smooth", "smooth"},
                                            {"smooth", "exact"},
                                            {"exact", "smooth"},
                                            {"exact", "exact"}}) {
            const auto [models, objects] = text_of(pair, first, second);
            const PairErrors e = errors_of(1 / 32.0, models, objects, 0.5);
            const std::string what = fmt::format(
                "{}, {} and {}: {} pixels, {} wrong, rms {:.2e} voxel, beside borders {:.2e} (at "
                "most {:.2e})",
                pair.name, first, second, e.shown, e.wrong, e.rms, e.beside, e.worst_beside);
            fmt::print("{}\n", what);
            EXPECT_GT(e.shown, 900u) << what;
            EXPECT_EQ(e.wrong, 0u) << what;
            EXPECT_EQ(e.rounded, 0u) << what;
            const bool exact = first == second && std::string(first) == "exact";
            EXPECT_LT(e.rms, exact ? 1e-4 : 0.1) << what;
        }
}

/// Depths can't be better than distances are rounded: half of a stored step.
constexpr double kRounded = kStoredStep / 2;

TEST(Pairs, SmoothOnesConvergeBesideTheirBorders) {
    for (const Pair& pair : kPairs) {
        if (!pair.is_smooth) continue;
        std::optional<double> before;
        for (const double voxel : {1 / 8.0, 1 / 16.0, 1 / 32.0}) {
            const auto [models, objects] = text_of(pair, "smooth", "smooth");
            const double voxels = errors_of(voxel, models, objects, 0.5).beside;
            const double metres = voxels * voxel;
            const double order = before ? std::log2(*before / metres) : INFINITY;
            fmt::print("{}: {:.2e} m, {:.2e} voxels: order {:.2f}\n", pair.name, metres, voxels,
                       order);
            EXPECT_TRUE(order >= 2.9 || voxels <= kRounded) << pair.name << " at " << voxel;
            before = metres;
        }
    }
}

TEST(Pairs, RandomOnesShowTheObjectThatIsThere) {
    constexpr uint32_t kSeed = 20;
    std::mt19937 random(kSeed);
    const int pairs = is_exhaustive() ? 100 : 16;
    double worst = 0;
    size_t rounded = 0, shown = 0;
    for (int i = 0; i < pairs; ++i) {
        const char* second_surface = random() % 3 == 0 ? "exact" : "smooth";
        const auto first = random_solid(random, "smooth");
        const auto second = random_solid(random, second_surface);
        const PairErrors e =
            errors_of(1 / 32.0, fmt::format(R"("a": {}, "b": {})", first[0], second[0]),
                      fmt::format(R"({{"model": "a", "placement": "world", {}}},
                           {{"model": "b", "placement": "world", {}}})",
                                  first[1], second[1]),
                      0.5);
        EXPECT_EQ(e.wrong, 0u) << "seed " << kSeed << ", pair " << i << ", " << second_surface;
        rounded += e.rounded, shown += e.shown;
        EXPECT_LT(e.rms, 0.1) << "seed " << kSeed << ", pair " << i << ", " << second_surface;
        worst = std::max(worst, e.rms);
    }
    fmt::print("{} pairs, rms at most {:.2e} voxel; {} of {} pixels lack an edge\n", pairs, worst,
               rounded, shown);
}

/// How far a surface may be from where its solid is.
struct SurfaceSlack {
    const char* name;
    double border, rms;  ///< voxels
};

constexpr std::array kSurfaceSlacks = {SurfaceSlack{"smooth", 0.5, 0.1},
                                       SurfaceSlack{"exact", 0.5, 1e-4}};

TEST(Pairs, RandomOnesOfBothSurfacesShowTheObjectThatIsThere) {
    constexpr uint32_t kSeed = 21;
    std::mt19937 random(kSeed);
    const int pairs = is_exhaustive() ? 100 : 1;
    size_t rounded = 0, shown = 0;
    for (const SurfaceSlack& a : kSurfaceSlacks)
        for (const SurfaceSlack& b : kSurfaceSlacks)
            for (int i = 0; i < pairs; ++i) {
                const auto first = random_solid(random, a.name);
                const auto second = random_solid(random, b.name);
                const PairErrors e =
                    errors_of(1 / 32.0, fmt::format(R"("a": {}, "b": {})", first[0], second[0]),
                              fmt::format(R"({{"model": "a", "placement": "world", {}}},
                                             {{"model": "b", "placement": "world", {}}})",
                                          first[1], second[1]),
                              std::max(a.border, b.border));
                const std::string what = fmt::format("seed {}, {} and {}, pair {}: rms {:.2e}",
                                                     kSeed, a.name, b.name, i, e.rms);
                EXPECT_EQ(e.wrong, 0u) << what;
                EXPECT_LT(e.rms, std::max(a.rms, b.rms)) << what;
                rounded += e.rounded, shown += e.shown;
            }
    fmt::print("{} pairs of each: {} of {} pixels lack an edge\n", pairs, rounded, shown);
}

}  // namespace
}  // namespace voxelume
