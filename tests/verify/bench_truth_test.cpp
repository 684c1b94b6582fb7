// SPDX-License-Identifier: Apache-2.0
// The truth of `voxelume bench`: where its rays meet solids, against exact values.
#include <gtest/gtest.h>

#include <glm/geometric.hpp>
#include <random>

#include "runtime/scene/parts/scene_affine.hpp"
#include "runtime/verify/bench/bench.hpp"

namespace voxelume {
namespace {

constexpr uint64_t kSeed = 20261121;

Solid torus_solid(double radius, double tube) {
    Solid solid;
    solid.kind = SolidKind::torus;
    solid.radius = radius;
    solid.tube = tube;
    return solid;
}

TEST(AnalyticRay, MeetsASphereWherePythagorasSays) {
    Solid sphere;
    sphere.radius = 5;
    const auto hit = analytic_hit(sphere, affine_from_factors({1, 2, 3}, {0, 0, 0}, {1, 1, 1}),
                                  {4, 2, -17}, {0, 0, 1});
    ASSERT_TRUE(hit);
    EXPECT_NEAR(hit->t, 16, 1e-14);
    EXPECT_NEAR(glm::distance(hit->normal, glm::dvec3(0.6, 0, -0.8)), 0, 1e-15);
}

TEST(AnalyticRay, MeetsTheFaceOfATurnedBox) {
    Solid box;
    box.kind = SolidKind::box;
    box.size = {2, 4, 6};
    // A quarter turn about Y puts the edges of 6 along X.
    const glm::dmat4 placement = affine_from_factors({10, 0, 0}, {90, 0, 0}, {1, 1, 1});
    const auto hit = analytic_hit(box, placement, {0, 1.9, 0.9}, {1, 0, 0});
    ASSERT_TRUE(hit);
    EXPECT_DOUBLE_EQ(hit->t, 7);
    EXPECT_EQ(hit->normal, glm::dvec3(-1, 0, 0));
    EXPECT_FALSE(analytic_hit(box, placement, {0, 1.9, 1.1}, {1, 0, 0}));
    EXPECT_FALSE(analytic_hit(box, placement, {0, 2.1, 0.9}, {1, 0, 0}));
}

TEST(AnalyticRay, MeetsATorusAlongItsDiameterAndPassesItsHole) {
    const Solid torus = torus_solid(3, 1);
    const glm::dmat4 here(1);
    const auto hit = analytic_hit(torus, here, {-10, 0.6, 0}, {1, 0, 0});
    ASSERT_TRUE(hit);
    EXPECT_NEAR(hit->t, 10 - 3.8, 1e-14);
    EXPECT_NEAR(glm::distance(hit->normal, glm::dvec3(-0.8, 0.6, 0)), 0, 1e-14);
    EXPECT_FALSE(analytic_hit(torus, here, {0.5, 9, -0.5}, {0, -1, 0}));
    const auto inside = analytic_hit(torus, here, {2.4, 9, 0}, {0, -1, 0});
    ASSERT_TRUE(inside);
    EXPECT_NEAR(inside->t, 9 - 0.8, 1e-14);
}

TEST(AnalyticRay, HitsLieOnTheSurfaceAndNothingLiesBeforeThem) {
    std::mt19937_64 random(kSeed);
    std::uniform_real_distribution<double> uniform(-1, 1);
    int hits = 0;
    for (int i = 0; i < 3000; ++i) {
        const BenchSolid& solid = bench_solids()[size_t(i) % 3];
        const auto vector = [&] {
            return glm::dvec3(uniform(random), uniform(random), uniform(random));
        };
        const glm::dvec3 origin = 3.0 * glm::normalize(vector());
        const glm::dvec3 direction = glm::normalize(0.5 * vector() - origin);
        const auto hit = analytic_hit(solid.solid, solid.world_from_solid, origin, direction);
        // Steps that are no longer than the distance can't pass through a surface.
        const glm::dmat4 back = glm::inverse(solid.world_from_solid);
        const auto distance = [&](double t) {
            const glm::dvec3 p(back * glm::dvec4(origin + t * direction, 1));
            if (solid.solid.kind == SolidKind::sphere) return glm::length(p) - solid.solid.radius;
            if (solid.solid.kind == SolidKind::torus)
                return glm::length(glm::dvec2(
                           glm::length(glm::dvec2(p.x, p.z)) - solid.solid.radius, p.y)) -
                       solid.solid.tube;
            const glm::dvec3 q = glm::abs(p) - solid.solid.size / 2.0;
            return glm::length(glm::max(q, 0.0)) + std::min(std::max({q.x, q.y, q.z}), 0.0);
        };
        double t = 0;
        for (int step = 0; step < 10000 && t < 6 && distance(t) > 1e-9; ++step) t += distance(t);
        ASSERT_EQ(t < 6, hit.has_value()) << solid.name << " ray " << i << " seed " << kSeed;
        if (!hit) continue;
        ++hits;
        ASSERT_NEAR(distance(hit->t), 0, 1e-13) << solid.name << " ray " << i;
        ASSERT_LE(t, hit->t + 1e-13) << solid.name << " ray " << i;
        ASSERT_NEAR(glm::length(hit->normal), 1, 1e-14);
        ASSERT_LT(glm::dot(hit->normal, direction), 0) << solid.name << " ray " << i;
    }
    EXPECT_GT(hits, 1000);
}

TEST(BenchScene, EveryScenesSilhouetteHasOnlyAirBehind) {
    for (const BenchSolid& solid : bench_solids()) {
        const BenchTruth truth = bench_truth(subject_of(solid), {96, 80});
        for (size_t i = 1; i < truth.hits.size(); ++i) {
            if (i % 96 == 0 || !truth.hits[i] || !truth.hits[i - 1]) continue;
            ASSERT_LT(std::abs(truth.hits[i]->t - truth.hits[i - 1]->t), 0.12)
                << solid.name << " pixel " << i;
        }
    }
}

}  // namespace
}  // namespace voxelume
