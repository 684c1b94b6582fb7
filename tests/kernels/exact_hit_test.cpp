// SPDX-License-Identifier: Apache-2.0
// Hits on triangles at and near their edges and corners, against rational numbers.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <random>

#include "runtime/stages/index/index.hpp"
#include "runtime/stages/voxelize/voxelize.hpp"
#include "runtime/verify/stress/device_walks.hpp"
#include "tests/oracles/rational_triangle.hpp"
#include "tests/support/shared_device.hpp"
#include "tests/support/test_meshes.hpp"

namespace voxelume {
namespace {

using glm::dvec3;
using Corners = std::array<oracle::RationalPoint, 3>;

constexpr uint64_t kHitSeed = 20261122;
const glm::ivec3 kHitGrid(43, 37, 29);
constexpr int64_t kOne = int64_t{1} << 22;  // direction 1

TEST(RationalTriangle, IsMetOnItsCornersAndEdgesAndNotNextToThem) {
    const Corners triangle = {oracle::rational_point({1, 1, 5}), oracle::rational_point({4, 1, 5}),
                              oracle::rational_point({1, 3, 8})};
    const auto meets = [&](const dvec3& o, const dvec3& d) {
        return oracle::ray_meets_triangle(oracle::rational_point(o), oracle::rational_point(d),
                                          triangle);
    };
    EXPECT_EQ(meets({1, 1, 0}, {0, 0, 2}), mpq_class(5, 2));  // a corner
    EXPECT_EQ(meets({2, 1, 0}, {0, 0, 1}), mpq_class(5));     // an edge
    EXPECT_EQ(meets({2, 1 - 0x1p-50, 0}, {0, 0, 1}), std::nullopt);
    EXPECT_EQ(meets({2, 2, 9}, {0, 0, -1}), mpq_class(5, 2));  // 6.5, from behind
    EXPECT_EQ(meets({2, 2, 0}, {0, 0, -1}), std::nullopt);     // behind the ray
    EXPECT_EQ(meets({0, 1, 5}, {1, 0, 0}), std::nullopt);      // in its plane
}

/// A wavy ring whose corners lie on quarters of voxels.
Mesh ring_on_quarters() {
    Mesh mesh = wavy_ring(13, 7);
    for (glm::vec3& p : mesh.positions)
        p = glm::round((p * 34.0f + glm::vec3(21.3f, 18.1f, 14.2f)) * 4.0f) / 4.0f;
    return mesh;
}

struct RationalHit {
    mpq_class t;
    dvec3 normal{0};  ///< the triangle's, of unit length
};

class RationalMesh {
  public:
    explicit RationalMesh(const Mesh& mesh) {
        for (const glm::uvec3& t : mesh.triangles) {
            Face face;
            std::array<dvec3, 3> p;
            for (int i = 0; i < 3; ++i) {
                p[size_t(i)] = dvec3(mesh.positions[t[i]]);
                face.corners[size_t(i)] = oracle::rational_point(p[size_t(i)]);
            }
            face.normal = glm::normalize(glm::cross(p[1] - p[0], p[2] - p[0]));
            face.centre = (p[0] + p[1] + p[2]) / 3.0;
            for (const dvec3& corner : p)
                face.radius = std::max(face.radius, glm::distance(corner, face.centre));
            faces_.push_back(face);
        }
    }

    std::optional<RationalHit> first_hit(const oracle::RationalPoint& o,
                                         const oracle::RationalPoint& d) const {
        const dvec3 from(o[0].get_d(), o[1].get_d(), o[2].get_d());
        const dvec3 way = glm::normalize(dvec3(d[0].get_d(), d[1].get_d(), d[2].get_d()));
        std::optional<RationalHit> first;
        for (const Face& face : faces_) {
            if (glm::length(glm::cross(face.centre - from, way)) > face.radius + 0.01) continue;
            const auto t = oracle::ray_meets_triangle(o, d, face.corners);
            if (t && (!first || *t < first->t)) first = {*t, face.normal};
        }
        return first;
    }

  private:
    struct Face {
        Corners corners;
        dvec3 normal{0}, centre{0};
        double radius = 0;
    };
    std::vector<Face> faces_;
};

double largest_of(const dvec3& v) {
    return std::max({std::abs(v.x), std::abs(v.y), std::abs(v.z)});
}

/// A ray from a side of the grid towards a point of the mesh.
struct AimedRay {
    FixedRay ray;
    double t = 0;  ///< of the point aimed at
};

/// A ray exactly through `target`, which lies on eighths of voxels, as its direction consists of
/// quarters.
std::optional<AimedRay> ray_through(const FixedGrid& grid, const dvec3& target,
                                    const glm::ivec3& quarters) {
    if (largest_of(dvec3(quarters)) < 2) return {};
    const dvec3 step = dvec3(quarters) / 4.0;
    AimedRay aimed;
    dvec3 origin = target;
    const auto in_grid = [&](const dvec3& p) {
        return glm::all(glm::greaterThanEqual(p, dvec3(0))) &&
               glm::all(glm::lessThanEqual(p, dvec3(grid.size)));
    };
    while (in_grid(origin - step)) origin -= step, aimed.t += 1;
    for (size_t a = 0; a < 3; ++a) {
        aimed.ray.origin[a] = int64_t(origin[int(a)] * double(grid.unit()));
        aimed.ray.direction[a] = quarters[int(a)] * kOne / 4;
    }
    return aimed;
}

/// A ray from a random point on a side of the grid past `target`, as near as directions of 22 bits
/// allow.
AimedRay ray_towards(const FixedGrid& grid, const dvec3& target, std::mt19937_64& random) {
    AimedRay aimed;
    const size_t face = random() % 3;
    dvec3 way;
    for (size_t a = 0; a < 3; ++a) {
        const int64_t side = grid.size[int(a)] * grid.unit();
        aimed.ray.origin[a] =
            a == face ? int64_t(random() % 2) * side : int64_t(random() % uint64_t(side));
        way[int(a)] = target[int(a)] - double(aimed.ray.origin[a]) / double(grid.unit());
    }
    aimed.t = std::exp2(std::ceil(std::log2(largest_of(way))));
    for (size_t a = 0; a < 3; ++a)
        aimed.ray.direction[a] = std::llround(way[int(a)] / aimed.t * double(kOne));
    return aimed;
}

std::vector<AimedRay> rays_at_edges(const Mesh& mesh, const FixedGrid& grid) {
    std::mt19937_64 random(kHitSeed);
    std::vector<AimedRay> rays;
    while (rays.size() < 3000) {
        const glm::uvec3 t = mesh.triangles[random() % mesh.triangles.size()];
        const dvec3 a(mesh.positions[t.x]), b(mesh.positions[t.y]);
        if (random() % 2 == 0) {  // a corner, or the middle of an edge
            const glm::ivec3 quarters(int(random() % 9) - 4, int(random() % 9) - 4,
                                      int(random() % 9) - 4);
            const auto ray = ray_through(grid, random() % 2 ? a : (a + b) / 2.0, quarters);
            if (ray) rays.push_back(*ray);
        } else {
            const double along = double(random() % 1025) / 1024;
            rays.push_back(ray_towards(grid, glm::mix(a, b, along), random));
        }
    }
    return rays;
}

/// A ray's origin and direction as exact rationals, moved sideways by fractions of voxels.
std::pair<oracle::RationalPoint, oracle::RationalPoint> exact_ray(const FixedGrid& grid,
                                                                  const FixedRay& ray,
                                                                  const dvec3& moved = dvec3(0)) {
    oracle::RationalPoint o = oracle::rational_point(moved), d;
    for (size_t a = 0; a < 3; ++a) {
        o[a] += mpq_class(ray.origin[a]) / mpq_class(grid.unit());
        d[a] = mpq_class(ray.direction[a]) / mpq_class(kOne);
    }
    return {o, d};
}

// This bound is in voxels. The largest measured error of hits' positions over these 3408 was
// 1.1e-5; twice that is allowed. A shear that is rounded twice moves corners up to 43 voxels away
// by 43 * 2 * 2^-24 = 5e-6 on each of two axes; the rounding of the edge functions depends on the
// triangles' shapes.
constexpr double kMaxOffPlane = 2e-5;

// kAside is the distance in voxels by which rays are moved to see whether they pass an outline:
// about a hundred times as much as rounding moves them. A t that then differs by more than
// kOtherPlace belongs to another place, or to a surface that is seen at a slope of less than 1 /
// 50.
constexpr double kAside = 1e-3, kOtherPlace = 0.05;

/// The first hits of rays on the exact surface of a mesh.
std::vector<std::optional<EnteredCell>> hits_on(const Mesh& mesh, const FixedGrid& grid,
                                                const std::vector<FixedRay>& rays) {
    GridFrame frame;
    frame.size = kHitGrid;
    VoxelizeOptions options;
    options.surface = Surface::exact;
    const Pyramid pyramid = build_index(
        shared_device(), voxelize_mesh(shared_device(), mesh, glm::dmat4(1), frame, options));
    DeviceHits device(shared_device(), pyramid);
    device.start(grid, rays);
    return device.hits();
}

/// The distance of a hit from the plane of the triangle that a ray truly meets, in voxels.
double off_plane(const RationalHit& truth, double t, const oracle::RationalPoint& d) {
    const dvec3 way(d[0].get_d(), d[1].get_d(), d[2].get_d());
    return std::abs(mpq_class(truth.t - mpq_class(t)).get_d() * glm::dot(way, truth.normal));
}

TEST(ExactHit, IsTheRationalOneAtEdgesAndCorners) {
    const Mesh mesh = ring_on_quarters();
    const RationalMesh exact(mesh);
    const FixedGrid grid = fixed_grid(kHitGrid);
    std::vector<FixedRay> rays;
    for (const AimedRay& aimed : rays_at_edges(mesh, grid)) rays.push_back(aimed.ray);
    const auto hits = hits_on(mesh, grid, rays);
    int compared = 0;
    for (size_t i = 0; i < rays.size(); ++i) {
        const auto [o, d] = exact_ray(grid, rays[i]);
        const auto truth = exact.first_hit(o, d);
        // At an outline rounding may decide: rays moved slightly aside meet something else there.
        bool outline = !truth;
        for (int side = 0; side < 6 && !outline; ++side) {
            dvec3 moved(0);
            moved[side / 2] = side % 2 ? kAside : -kAside;
            const auto [moved_origin, same] = exact_ray(grid, rays[i], moved);
            const auto t = exact.first_hit(moved_origin, same);
            outline = !t || std::abs(mpq_class(t->t - truth->t).get_d()) > kOtherPlace;
        }
        if (outline) continue;
        ++compared;
        ASSERT_TRUE(hits[i]) << "seed " << kHitSeed << ", ray " << i;
        EXPECT_LT(off_plane(*truth, double(hits[i]->t), d), kMaxOffPlane)
            << "seed " << kHitSeed << ", ray " << i;
    }
    EXPECT_GT(compared, 2400);
}

// These triangles are 12 voxels long and 1/100 wide: their areas are small compared with the
// products whose differences they are. The largest error of the first 94 such rays was 2.1e-6
// voxel; with rounded products it was 1.1e-4. The bound is the rounding of the shear alone on an
// axis.
TEST(ExactHit, OfSliversIsTheRationalOne) {
    const Mesh mesh = ball({21.3, 18.1, 14.2}, 12, 8000, 3);
    const FixedGrid grid = fixed_grid(kHitGrid);
    std::mt19937_64 random(kHitSeed);
    std::vector<FixedRay> rays;
    while (rays.size() < 30) {
        const glm::uvec3 t = mesh.triangles[random() % mesh.triangles.size()];
        const dvec3 a(mesh.positions[t.x]), b(mesh.positions[t.y]), c(mesh.positions[t.z]);
        const double along = double(random() % 1025) / 1024,
                     across = double(random() % 1025) / 1024;
        rays.push_back(ray_towards(grid, glm::mix(glm::mix(a, b, along), c, across), random).ray);
    }
    const auto hits = hits_on(mesh, grid, rays);
    const RationalMesh exact(mesh);
    int compared = 0;
    for (size_t i = 0; i < rays.size(); ++i) {
        const auto [o, d] = exact_ray(grid, rays[i]);
        const auto truth = exact.first_hit(o, d);
        if (!truth) continue;  // it passes the ball's outline
        const dvec3 way(d[0].get_d(), d[1].get_d(), d[2].get_d());
        if (std::abs(glm::dot(glm::normalize(way), truth->normal)) < 0.1) continue;
        ++compared;
        ASSERT_TRUE(hits[i]) << "seed " << kHitSeed << ", ray " << i;
        EXPECT_LT(off_plane(*truth, double(hits[i]->t), d), 5e-6)
            << "seed " << kHitSeed << ", ray " << i;
    }
    EXPECT_GT(compared, 20);
}

}  // namespace
}  // namespace voxelume
