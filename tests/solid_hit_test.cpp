#include <fmt/format.h>
#include <gtest/gtest.h>

#include <cmath>
#include <cstdlib>
#include <cstring>
#include <functional>
#include <random>

#include "runtime/opencl/program.hpp"
#include "runtime/stages/solid_program.hpp"
#include "tests/oracles/analytic_solids.hpp"
#include "tests/solid_cases.hpp"
#include "tests/test_device.hpp"

namespace voxelume {
namespace {

struct Ray {
    glm::vec3 origin, direction;

    oracle::Vector at(long double t) const {
        return oracle::Vector(origin) + oracle::Vector(direction) * t;
    }
};

struct Hit {
    float t = INFINITY;
    glm::vec3 normal{0};
};

/// Runs hit_solids() and solid_normals() with a number of lanes.
class HitProbe {
  public:
    explicit HitProbe(int lanes)
        : device_(test_device(lanes)), code_(Program::from_text(device_, R"(
#include "lib/solid_surface.h"
#include "lib/work_item.h"
kernel void probe(global const SolidShape* solids, global const float* rays, uint count,
                  int from_solid, global const uint* numbers, global float* hits) {
    const uint i = work_item() * VXL_LANES;
    if (i >= count) return;
    SolidRay ray;
    ray.ox = LANES_LOAD(rays, i);
    ray.oy = LANES_LOAD(rays, count + i);
    ray.oz = LANES_LOAD(rays, 2u * count + i);
    ray.dx = LANES_LOAD(rays, 3u * count + i);
    ray.dy = LANES_LOAD(rays, 4u * count + i);
    ray.dz = LANES_LOAD(rays, 5u * count + i);
    lane_float t = (lane_float)INFINITY;
    const lane_uint number = LANES_LOAD(numbers, i);
    const lane_int hit =
        hit_solids(solids, number, &ray, (lane_int)from_solid, (lane_int)-1, &t);
    const SolidPoint n = solid_normals(solids, number, &ray, t, hit);
    LANES_STORE(t, hits, i);
    LANES_STORE(n.x, hits, count + i);
    LANES_STORE(n.y, hits, 2u * count + i);
    LANES_STORE(n.z, hits, 3u * count + i);
}
)")) {}

    std::vector<Hit> operator()(const SolidProgram& program, std::vector<Ray> rays,
                                bool from_solid = false, std::vector<uint32_t> numbers = {}) const {
        const size_t asked = rays.size(), n = (asked + 15) / 16 * 16;
        rays.resize(n, rays.back());
        numbers.resize(n, numbers.empty() ? 0 : numbers.back());
        std::vector<float> columns(6 * n);
        for (size_t i = 0; i < n; ++i)
            for (int axis = 0; axis < 3; ++axis) {
                columns[axis * n + i] = rays[i].origin[axis];
                columns[(3 + axis) * n + i] = rays[i].direction[axis];
            }
        const Buffer<uint32_t> solids(device_, "solids", program.words());
        const Buffer<float> in(device_, "rays", columns), out(device_, "hits", 4 * n);
        const Buffer<uint32_t> which(device_, "numbers", numbers);
        code_.kernel("probe").launch(WorkItem::heavy, n / device_.lanes(), solids, in,
                                     static_cast<uint32_t>(n), from_solid ? -1 : 0, which, out);
        const std::vector<float> result = out.read();
        std::vector<Hit> hits(asked);
        for (size_t i = 0; i < asked; ++i)
            hits[i] = {result[i], {result[n + i], result[2 * n + i], result[3 * n + i]}};
        return hits;
    }

  private:
    Device device_;
    Program code_;
};

const HitProbe& probe() {
    static const HitProbe it(0);
    return it;
}

/// A grid of 64x56x48 voxels of one metre, with the solids' origin inside.
GridFrame ray_frame() {
    GridFrame frame;
    frame.origin = {-31.375, -28.25, -24.5};
    frame.size = {64, 56, 48};
    return frame;
}

glm::dmat4 grid_from_solid() {
    return moved(rational_rotation(1, 2, 3, 4), -ray_frame().origin);
}

/// Rays as the tracer has them: multiples of 2^-18 in the grid, directions of 2^-22.
std::vector<Ray> random_rays(unsigned seed, size_t count) {
    std::mt19937 random(seed);
    std::uniform_real_distribution<double> unit(0, 1);
    std::vector<Ray> rays;
    for (size_t i = 0; i < count; ++i) {
        const glm::dvec3 from(64 * unit(random), 56 * unit(random), 48 * unit(random));
        glm::dvec3 to = -ray_frame().origin;
        for (int axis = 0; axis < 3; ++axis) to[axis] += 26 * unit(random) - 13;
        glm::dvec3 d = to - from;
        d *= (0.5 + 0.5 * unit(random)) / std::max({std::abs(d.x), std::abs(d.y), std::abs(d.z)});
        rays.push_back({glm::vec3(glm::round(from * 262144.0) / 262144.0),
                        glm::vec3(glm::round(d * 4194304.0) / 4194304.0)});
    }
    return rays;
}

Solid shape(SolidKind kind, const glm::dvec3& at) {
    Solid s;
    s.kind = kind;
    s.parent_from_solid = moved(glm::dmat4(1), at);
    return s;
}

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

/// Hits, normals and misses of a case against the oracle; VXL_TEST_RAYS asks for more rays.
void expect_oracle_hits(const SolidCase& c, unsigned seed) {
    const char* asked = std::getenv("VXL_TEST_RAYS");
    const size_t count = asked ? std::strtoul(asked, nullptr, 10) : 4000;
    const std::vector<Ray> rays = random_rays(seed, count);
    const oracle::AnalyticSolid exact(c.solid, grid_from_solid());
    const std::vector<Hit> hits =
        probe()(make_solid_program(c.solid, grid_from_solid(), GridFrame{}), rays);
    size_t met = 0, unsure = 0;
    double largest_error = 0, largest_turn = 0;
    for (size_t i = 0; i < count; ++i) {
        const auto where = [&] { return fmt::format("{}, seed {}, ray {}", c.name, seed, i); };
        const Ray& ray = rays[i];
        const long double speed = glm::length(oracle::Vector(ray.direction));
        const auto truth =
            exact.first_crossing(ray.origin, oracle::Vector(ray.direction) / speed, 0, 1e6L, 1e-5L);
        const bool is_hit = std::isfinite(hits[i].t) && hits[i].t * speed < 1e6L;
        met += is_hit, unsure += !truth.is_certain;
        if (!truth.is_certain) continue;
        ASSERT_EQ(is_hit, truth.is_hit) << where();
        if (!is_hit) continue;
        // How far from the surface, in roundings (2^-24) of the way and the solid's reach.
        const auto off = static_cast<double>(std::abs(exact.distance(ray.at(hits[i].t))));
        const auto way = static_cast<double>(truth.t);
        ASSERT_NEAR(hits[i].t * static_cast<double>(speed), way, 0.02 + way * 1e-4) << where();
        largest_error = std::max(largest_error, std::ldexp(off / (way + 20), 24));
        oracle::Vector gradient;
        for (int axis = 0; axis < 3; ++axis) {
            oracle::Vector step(0);
            step[axis] = 1e-7L;
            const oracle::Vector p = ray.at(truth.t / speed);
            gradient[axis] = exact.distance(p + step) - exact.distance(p - step);
        }
        const auto turn = static_cast<double>(
            glm::length(glm::normalize(gradient) - glm::normalize(oracle::Vector(hits[i].normal))));
        if (way < 1000) largest_turn = std::max(largest_turn, turn);
    }
    EXPECT_GT(met, count / 5) << c.name;
    EXPECT_LT(unsure, count / 100) << c.name;
    EXPECT_LE(largest_error, 4.0) << c.name;
    EXPECT_LE(largest_turn, 1e-4) << c.name;
    ::testing::Test::RecordProperty(c.name,
                                    fmt::format("{} hits of {}, {} unsure, error {:.2f} "
                                                "roundings, normal {:.1e}",
                                                met, count, unsure, largest_error, largest_turn));
}

TEST(SolidHit, AgreesWithTheOracleForEveryKind) {
    for (const SolidCase& c : shape_cases()) expect_oracle_hits(c, 21);
}

TEST(SolidHit, AgreesWithTheOracleForCombinations) {
    for (const SolidCase& c : combination_cases()) expect_oracle_hits(c, 22);
}

TEST(SolidHit, AgreesWithTheOracleForShearedShapes) {
    for (SolidCase c : shape_cases()) {
        glm::dmat4 shear(1);
        shear[1] = {0.5, 1.1, -0.25, 0};
        c.solid.parent_from_solid = c.solid.parent_from_solid * shear;
        expect_oracle_hits(c, 23);
    }
}

/// A point of the surface of a convex case on an edge of it, and the outward normals that meet
/// there.
struct EdgePoint {
    glm::dvec3 at, first, second;
};

void expect_hits_at_edges(const Solid& solid, const std::function<EdgePoint(double)>& edge,
                          unsigned seed) {
    std::mt19937 random(seed);
    std::normal_distribution<double> normal;
    std::uniform_real_distribution<double> unit(0, 1);
    std::vector<Ray> rays;
    std::vector<double> ways;
    while (rays.size() < 20000) {
        const EdgePoint point = edge(unit(random));
        const glm::dvec3 d =
            glm::normalize(glm::dvec3(normal(random), normal(random), normal(random)));
        if (glm::dot(d, point.first) > -0.1 || glm::dot(d, point.second) > -0.1) continue;
        const double way = 2 + 30 * unit(random);
        rays.push_back({glm::vec3(point.at - d * way), glm::vec3(d)});
        ways.push_back(way);
    }
    const std::vector<Hit> hits =
        probe()(make_solid_program(solid, glm::dmat4(1), GridFrame{}), rays);
    for (size_t i = 0; i < rays.size(); ++i)
        ASSERT_NEAR(hits[i].t, ways[i], 2e-4) << "seed " << seed << ", ray " << i;
}

TEST(SolidHit, NoRayPassesBetweenCapAndSide) {
    const glm::dvec3 at(40, 35, 45);
    Solid cylinder = shape(SolidKind::cylinder, at), cone = shape(SolidKind::cone, at);
    cylinder.radius = 7, cylinder.height = 11;
    expect_hits_at_edges(
        cylinder,
        [&](double u) {
            const glm::dvec3 out(std::cos(7 * u), 0, std::sin(7 * u));
            return EdgePoint{at + 7.0 * out + glm::dvec3(0, 5.5, 0), out, {0, 1, 0}};
        },
        31);
    cone.radius = 9, cone.top_radius = 4, cone.height = 6;
    expect_hits_at_edges(
        cone,
        [&](double u) {
            const glm::dvec3 out(std::cos(7 * u), 0, std::sin(7 * u));
            return EdgePoint{at + 9.0 * out - glm::dvec3(0, 3, 0),
                             glm::normalize(6.0 * out + glm::dvec3(0, 5, 0)),
                             {0, -1, 0}};
        },
        32);
    cone.top_radius = 0;
    const glm::dvec3 steeper_than_side(0, 0.17, 0);  // rays that go on inside the cone at its tip
    expect_hits_at_edges(
        cone,
        [&](double) {
            return EdgePoint{at + glm::dvec3(0, 3, 0), steeper_than_side, steeper_than_side};
        },
        33);
}

TEST(SolidHit, NoRayPassesBetweenFacesOrBetweenTheShapesOfACombination) {
    const glm::dvec3 at(40, 35, 45);
    Solid box = shape(SolidKind::box, at), bore = shape(SolidKind::cylinder, at);
    box.size = {14, 10, 18};
    expect_hits_at_edges(
        box,
        [&](double u) {
            return EdgePoint{at + glm::dvec3(7, 5, 18 * u - 9), {1, 0, 0}, {0, 1, 0}};
        },
        34);
    Solid left = shape(SolidKind::sphere, at - glm::dvec3(3, 0, 0));
    Solid right = shape(SolidKind::sphere, at + glm::dvec3(3, 0, 0));
    left.radius = right.radius = 5;  // the lens' edge is a circle of radius 4
    expect_hits_at_edges(
        combined(SolidKind::intersection_of, {left, right}),
        [&](double u) {
            const glm::dvec3 out(0, std::cos(7 * u), std::sin(7 * u));
            return EdgePoint{at + 4.0 * out, glm::normalize(glm::dvec3(3, 0, 0) + 4.0 * out),
                             glm::normalize(glm::dvec3(-3, 0, 0) + 4.0 * out)};
        },
        35);
    bore.radius = 3, bore.height = 30;
    expect_hits_at_edges(
        combined(SolidKind::difference_of, {box, bore}),
        [&](double u) {
            const glm::dvec3 out(std::cos(7 * u), 0, std::sin(7 * u));
            return EdgePoint{at + 3.0 * out + glm::dvec3(0, 5, 0), -out, {0, 1, 0}};
        },
        36);
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
            if (!std::isfinite(far[i].t)) {  // so flat that it grazes
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
    for (const int lanes : {1, 4, 8, 16}) {
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
