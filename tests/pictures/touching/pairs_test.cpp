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
#include "tests/pictures/touching/pair_scenes.hpp"
#include "tests/support/exhaustive.hpp"
#include "tests/support/test_device.hpp"

namespace voxelume {
namespace {

/// The differences between an image and the solids' formulas.
struct PairErrors {
    size_t shown = 0;      ///< pixels that show a surface
    size_t wrong = 0;      ///< of another object than any that the formulas have within the slack
    size_t rounded = 0;    ///< the same, of a smooth solid's edges, as far as it rounds them
    double rms = 0;        ///< distance from the true surface, in voxels, where the object is right
    double at_border = 0;  ///< the same, of pixels within two of such that show another object
    double away_from_border = 0;  ///< the same, of all others
    double worst_away = 0;
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

    /// True if the object, or -1, is seen within `metres` around a pixel, at the distance of what
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

/// True if a surface that a picture lacks at a pixel belongs to an edge that `smooth` solids round:
/// the distances at the lattice's nodes let no field have this edge.
bool is_rounded(const Scene& scene, const oracle::Seen& seen, const glm::dvec2& pixel) {
    if (seen.object < 0) return false;
    const Object& object = scene.objects[size_t(seen.object)];
    const Model& model = scene.models[size_t(object.model)];
    if (model.surface != Surface::smooth || !oracle::has_convex_edges(model.solid->kind))
        return false;
    const oracle::LatticeDistance field(scene.world, *model.solid, object.world_from_object);
    return field.min_on(scene.observer.position, direction_at(scene.observer, pixel), seen.t) >
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
    double sum = 0, sum_away = 0;
    size_t count = 0, count_away = 0;
    const auto rms = [](double squares, size_t pixels) {
        return std::sqrt(squares / double(std::max<size_t>(pixels, 1)));
    };
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
            sum_away += off * off, ++count_away;
            errors.worst_away = std::max(errors.worst_away, off);
        }
    errors.rms = rms(sum, count);
    errors.away_from_border = rms(sum_away, count_away);
    errors.at_border = rms(sum - sum_away, count - count_away);
    return errors;
}

PairErrors errors_of(double voxel, const std::string& models, const std::string& objects,
                     double slack) {
    return errors_of(parse_scene(pair_scene(voxel, models, objects), "pair.json", {}), slack);
}

TEST(Pairs, ShowTheObjectThatIsThere) {
    for (const SolidPair& pair : kSolidPairs)
        for (const auto& [first, second] : {std::pair{"smooth", "smooth"},
                                            {"smooth", "exact"},
                                            {"exact", "smooth"},
                                            {"exact", "exact"}}) {
            const auto [models, objects] = pair_text(pair, first, second);
            const PairErrors e = errors_of(1 / 32.0, models, objects, 0.5);
            const std::string what = fmt::format(
                "{}, {} and {}: {} pixels, {} wrong, rms {:.2e} voxel, {:.2e} at borders, {:.2e} "
                "beside them (at most {:.2e})",
                pair.name, first, second, e.shown, e.wrong, e.rms, e.at_border, e.away_from_border,
                e.worst_away);
            fmt::print("{}\n", what);
            EXPECT_GT(e.shown, 900u) << what;
            EXPECT_EQ(e.wrong, 0u) << what;
            EXPECT_EQ(e.rounded, 0u) << what;
            const bool exact = first == second && std::string(first) == "exact";
            EXPECT_LT(e.rms, exact ? 1e-4 : 0.1) << what;
            EXPECT_LT(e.at_border, exact ? 1e-4 : 0.1) << what;
        }
}

/// Depths can't be better than distances are rounded: half of a stored step.
constexpr double kRounded = kStoredStep / 2;

TEST(Pairs, SmoothOnesConvergeAwayFromTheirBorders) {
    for (const SolidPair& pair : kSolidPairs) {
        if (!pair.is_smooth) continue;
        std::optional<double> before;
        for (const double voxel : {1 / 8.0, 1 / 16.0, 1 / 32.0}) {
            const auto [models, objects] = pair_text(pair, "smooth", "smooth");
            const double voxels = errors_of(voxel, models, objects, 0.5).away_from_border;
            const double metres = voxels * voxel;
            const double order = before ? std::log2(*before / metres) : INFINITY;
            fmt::print("{}: {:.2e} m, {:.2e} voxels: order {:.2f}\n", pair.name, metres, voxels,
                       order);
            EXPECT_TRUE(order >= 2.9 || voxels <= kRounded) << pair.name << " at " << voxel;
            before = metres;
        }
    }
}

/// The largest errors of random pairs.
struct WorstPair {
    size_t rounded = 0, shown = 0;  ///< pixels of all
    double rms = 0, at_border = 0;  ///< voxels

    /// Expects of a pair what all pairs have to be like.
    void take(const PairErrors& e, double slack, const std::string& what) {
        EXPECT_EQ(e.wrong, 0u) << what;
        EXPECT_LT(e.rms, slack) << what;
        EXPECT_LT(e.at_border, slack) << what;
        rounded += e.rounded, shown += e.shown;
        rms = std::max(rms, e.rms), at_border = std::max(at_border, e.at_border);
    }
    std::string words() const {
        return fmt::format(
            "rms at most {:.2e} voxel, at borders {:.2e}; {} of {} pixels lack an edge", rms,
            at_border, rounded, shown);
    }
};

TEST(Pairs, RandomOnesShowTheObjectThatIsThere) {
    constexpr uint32_t kSeed = 20;
    std::mt19937 random(kSeed);
    const int pairs = is_exhaustive() ? 100 : 16;
    WorstPair worst;
    for (int i = 0; i < pairs; ++i) {
        const char* second_surface = random() % 3 == 0 ? "exact" : "smooth";
        const auto [models, objects] = random_pair(random, "smooth", second_surface);
        worst.take(errors_of(1 / 32.0, models, objects, 0.5), 0.1,
                   fmt::format("seed {}, pair {}, {}", kSeed, i, second_surface));
    }
    fmt::print("{} pairs: {}\n", pairs, worst.words());
}

/// The maximum distance of a surface from its solid.
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
    for (const SurfaceSlack& a : kSurfaceSlacks)
        for (const SurfaceSlack& b : kSurfaceSlacks) {
            WorstPair worst;
            for (int i = 0; i < pairs; ++i) {
                const auto [models, objects] = random_pair(random, a.name, b.name);
                worst.take(errors_of(1 / 32.0, models, objects, std::max(a.border, b.border)),
                           std::max(a.rms, b.rms),
                           fmt::format("seed {}, {} and {}, pair {}", kSeed, a.name, b.name, i));
            }
            fmt::print("{} pairs, {} and {}: {}\n", pairs, a.name, b.name, worst.words());
        }
}

}  // namespace
}  // namespace voxelume
