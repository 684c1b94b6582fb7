// SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>

#include <cstring>

#include "tests/kernels/solid_probe.hpp"

namespace voxelume {
namespace {

Hit hit_of(const Solid& solid, const Ray& ray, bool from_solid = false) {
    return probe()(make_solid_program(solid, glm::dmat4(1), GridFrame{}), {ray}, from_solid)[0];
}

TEST(SolidHit, MeetsEveryKindWhereWorkedOutByHand) {
    const glm::dvec3 at(7, 3, 4);
    Solid ball = shape(SolidKind::sphere, at);
    ball.radius = 2;
    Solid ellipsoid = shape(SolidKind::ellipsoid, at);
    ellipsoid.radii = {3, 1, 2};
    Solid box = shape(SolidKind::box, at);
    box.size = {4, 3, 2};
    Solid cylinder = shape(SolidKind::cylinder, at);
    cylinder.radius = 2, cylinder.height = 3;
    Solid cone = shape(SolidKind::cone, at);
    cone.radius = 2, cone.top_radius = 1, cone.height = 4;
    Solid torus = shape(SolidKind::torus, at);
    torus.radius = 3, torus.tube = 1;
    Solid capsule = shape(SolidKind::capsule, at);
    capsule.radius = 1, capsule.height = 2;
    Solid slab = shape(SolidKind::slab, at);
    slab.thickness = 1;
    const struct {
        const Solid& solid;
        Ray ray;
        float t;
        glm::vec3 normal;
    } cases[] = {{ball, {{0, 3, 4}, {1, 0, 0}}, 5, {-1, 0, 0}},
                 {ball, {{7, 8, 4}, {0, -0.5f, 0}}, 6, {0, 1, 0}},
                 {ball, {{7, 3, 4}, {0, 0, 1}}, 2, {0, 0, 1}},  // from within
                 {ellipsoid, {{0, 3, 4}, {1, 0, 0}}, 4, {-1, 0, 0}},
                 {ellipsoid, {{7, 3, 9}, {0, 0, -1}}, 3, {0, 0, 1}},
                 {box, {{0, 3, 4}, {1, 0, 0}}, 5, {-1, 0, 0}},
                 {box, {{7, 0, 4}, {0, 0.75f, 0}}, 2, {0, -1, 0}},
                 {box, {{5, 2, 9}, {0, 0, -1}}, 4, {-1, 0, 0}},  // in the plane of a face
                 {cylinder, {{0, 3, 4}, {1, 0, 0}}, 5, {-1, 0, 0}},
                 {cylinder, {{6, 0, 4}, {0, 1, 0}}, 1.5f, {0, -1, 0}},
                 {cylinder, {{6, 3, 4}, {0, 1, 0}}, 1.5f, {0, 1, 0}},
                 {cone, {{0, 3, 4}, {1, 0, 0}}, 5.5f, {-4, 1, 0}},
                 {cone, {{7, 9, 4}, {0, -1, 0}}, 4, {0, 1, 0}},
                 {torus, {{0, 3, 4}, {1, 0, 0}}, 3, {-1, 0, 0}},
                 {torus, {{4, 3, 4}, {-1, 0, 0}}, 1, {-1, 0, 0}},  // inside: on to the outer side
                 {torus, {{7, 3, 4}, {1, 0, 0}}, 2, {-1, 0, 0}},   // in the hole
                 {capsule, {{7, 9, 4}, {0, -1, 0}}, 4, {0, 1, 0}},
                 {capsule, {{7, 3, 0}, {0, 0, 1}}, 3, {0, 0, -1}},
                 {slab, {{1, 0, 2}, {0.5f, 1, 0.25f}}, 2.5f, {0, -1, 0}}};
    for (size_t i = 0; i < std::size(cases); ++i) {
        const Hit hit = hit_of(cases[i].solid, cases[i].ray);
        EXPECT_EQ(hit.t, cases[i].t) << i;
        EXPECT_LT(glm::length(glm::normalize(hit.normal) - glm::normalize(cases[i].normal)), 1e-6f)
            << i;
    }
    EXPECT_EQ(hit_of(torus, {{7, 0, 4}, {0, 1, 0}}).t, INFINITY);  // through the hole
    EXPECT_EQ(hit_of(ball, {{0, 3, 4}, {-1, 0, 0}}).t, INFINITY);
    EXPECT_EQ(hit_of(box, {{0, 5, 4}, {1, 0, 0}}).t, INFINITY);
}

TEST(SolidHit, SolidsThatShareAFaceAreOneSolid) {
    Solid left = shape(SolidKind::box, {3, 4, 5}), right = shape(SolidKind::box, {7, 4, 5});
    left.size = right.size = {4, 2, 6};  // x from 1 to 5 and from 5 to 9
    const Solid both = combined(SolidKind::union_of, {left, right});
    EXPECT_EQ(hit_of(both, {{0, 4, 5}, {1, 0, 0}}).t, 1);
    EXPECT_EQ(hit_of(both, {{2, 4, 5}, {1, 0, 0}}).t, 7);  // past the shared face to the far end
    EXPECT_EQ(hit_of(both, {{8, 4, 5}, {-1, 0, 0}}).t, 7);
    const Solid none = combined(SolidKind::intersection_of, {left, right});
    EXPECT_EQ(hit_of(none, {{0, 4, 5}, {1, 0, 0}}).t, INFINITY);
    const Solid rest = combined(SolidKind::difference_of, {both, right});
    EXPECT_EQ(hit_of(rest, {{2, 4, 5}, {1, 0, 0}}).t, 3);
    EXPECT_EQ(hit_of(rest, {{10, 4, 5}, {-1, 0, 0}}).t, 5);
    EXPECT_EQ(hit_of(rest, {{10, 4, 5}, {-1, 0, 0}}).normal, glm::vec3(1, 0, 0));
}

TEST(SolidHit, ABoredBoxIsMetAtItsFaceItsBoreAndBehind) {
    Solid box = shape(SolidKind::box, {8, 5, 6}), bore = shape(SolidKind::cylinder, {8, 5, 6});
    box.size = {10, 4, 6};
    bore.radius = 2, bore.height = 4;  // its caps in the box's faces
    const Solid bored = combined(SolidKind::difference_of, {box, bore});
    EXPECT_EQ(hit_of(bored, {{4, 0, 6}, {0, 1, 0}}).t, 3);
    EXPECT_EQ(hit_of(bored, {{8, 0, 6}, {0, 1, 0}}).t, INFINITY);  // through the bore
    EXPECT_EQ(hit_of(bored, {{8, 5, 6}, {1, 0, 0}}).t, 2);         // from within the bore
    EXPECT_EQ(hit_of(bored, {{8, 5, 6}, {1, 0, 0}}).normal, glm::vec3(-2, 0, 0));
    EXPECT_EQ(hit_of(bored, {{11, 5, 6}, {-1, 0, 0}}).t, 1);  // from within the wall
}

TEST(SolidHit, ARayFromTheSurfaceDoesNotMeetItAgain) {
    constexpr unsigned kSeed = 41;
    std::mt19937 random(kSeed);
    std::normal_distribution<float> normal;
    for (const SolidCase& c : shape_cases()) {
        if (c.solid.kind == SolidKind::torus) continue;  // not convex
        const SolidProgram program = make_solid_program(c.solid, grid_from_solid(), GridFrame{});
        const oracle::AnalyticSolid exact(c.solid, grid_from_solid());
        std::vector<Ray> out, in;
        std::vector<Ray> rays = random_rays(kSeed, 20000);
        const std::vector<Hit> hits = probe()(program, rays);
        for (size_t i = 0; i < rays.size(); ++i) {
            const glm::dvec3 p(rays[i].at(hits[i].t));
            if (!(glm::length(p) < 500)) continue;
            glm::vec3 d(normal(random), normal(random), normal(random));
            if (glm::dot(glm::normalize(d), glm::normalize(hits[i].normal)) < 0) d = -d;
            out.push_back({glm::vec3(glm::round(p * 262144.0) / 262144.0), d});
            in.push_back({out.back().origin, -d});
        }
        ASSERT_GT(out.size(), 4000u);
        for (const Hit& hit : probe()(program, out, true)) ASSERT_EQ(hit.t, INFINITY) << c.name;
        const std::vector<Hit> far = probe()(program, in, true);
        for (size_t i = 0; i < in.size(); ++i) {
            if (!std::isfinite(far[i].t)) {  // so flat an angle that it grazes
                ASSERT_LT(std::abs(static_cast<double>(exact.distance(in[i].at(1e-3L)))), 1e-4);
                continue;
            }
            const auto d = static_cast<double>(exact.distance(in[i].at(far[i].t / 2)));
            ASSERT_LT(d, 2e-5) << c.name << ", seed " << kSeed << ", ray " << i;
        }
    }
}

TEST(SolidHit, LanesMayMeetDifferentSolids) {
    Solid ball = shape(SolidKind::sphere, {7, 3, 4}), box = shape(SolidKind::box, {7, 3, 4});
    ball.radius = 2, box.size = {6, 3, 2};
    SolidProgram program = make_solid_program(ball, glm::dmat4(1), GridFrame{});
    const SolidProgram lens = make_solid_program(combined(SolidKind::difference_of, {box, ball}),
                                                 glm::dmat4(1), GridFrame{});
    program.shapes.insert(program.shapes.end(), lens.shapes.begin(), lens.shapes.end());
    const Ray ray{{0, 3, 4}, {1, 0, 0}};
    const std::vector<Hit> hits =
        probe()(program, std::vector<Ray>(5, ray), false, {0, 1, 0, 0, 1});
    EXPECT_EQ(hits[0].t, 5);
    EXPECT_EQ(hits[1].t, 4);
    EXPECT_EQ(hits[3].t, 5);
    EXPECT_EQ(hits[4].t, 4);
}

TEST(SolidHit, HasTheSameBitsForAnyNumberOfLanes) {
    const std::vector<Ray> rays = random_rays(51, 4096);
    std::vector<SolidCase> cases = shape_cases();
    for (const SolidCase& c : combination_cases()) cases.push_back(c);
    std::vector<std::vector<Hit>> expected;
    for (const int lanes : lanes_to_compare(0)) {
        const HitProbe hit(lanes);
        for (size_t i = 0; i < cases.size(); ++i) {
            const auto hits =
                hit(make_solid_program(cases[i].solid, grid_from_solid(), GridFrame{}), rays);
            if (lanes == 1) expected.push_back(hits);
            ASSERT_EQ(0, std::memcmp(expected[i].data(), hits.data(), hits.size() * sizeof(Hit)))
                << cases[i].name << " with " << lanes << " lanes";
        }
    }
}

}  // namespace
}  // namespace voxelume
