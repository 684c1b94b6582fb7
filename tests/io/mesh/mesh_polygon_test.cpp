// SPDX-License-Identifier: Apache-2.0
#include "runtime/io/mesh/mesh_polygon.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <numeric>
#include <random>

namespace voxelume {
namespace {

using testing::ElementsAre;

struct Outline {
    std::vector<glm::dvec2> corners;

    double area() const {
        double twice = 0.0;
        for (size_t i = 0; i < corners.size(); ++i) {
            const glm::dvec2& a = corners[i];
            const glm::dvec2& b = corners[(i + 1) % corners.size()];
            twice += a.x * b.y - a.y * b.x;
        }
        return twice / 2;
    }
};

/// The triangles of the outline in the plane z = 2, or in the plane that `x` and `y` span.
Mesh cut(const Outline& outline, glm::vec3 x = {1, 0, 0}, glm::vec3 y = {0, 1, 0}) {
    Mesh mesh;
    std::vector<uint32_t> corners(outline.corners.size());
    std::iota(corners.begin(), corners.end(), 0u);
    for (const glm::dvec2& corner : outline.corners) {
        mesh.positions.push_back(static_cast<float>(corner.x) * x +
                                 static_cast<float>(corner.y) * y + glm::vec3(0, 0, 2));
    }
    const std::string no_bytes;
    PolygonCutter().append({no_bytes, "test"}, corners, mesh);
    return mesh;
}

/// The triangles' areas, negative for those that are turned over; `outline` is in the xy plane.
std::vector<double> signed_areas(const Outline& outline, const Mesh& mesh) {
    std::vector<double> areas;
    for (const glm::uvec3& t : mesh.triangles) {
        areas.push_back(
            Outline{{outline.corners[t.x], outline.corners[t.y], outline.corners[t.z]}}.area());
    }
    return areas;
}

const Outline kArrow{{{0, 0}, {4, 1}, {7, 5}, {1, 2}}};
const Outline kL{{{5, 0}, {5, 1}, {1, 1}, {1, 3}, {0, 3}, {0, 0}}};

}  // namespace

TEST(PolygonCutter, AConvexPolygonIsAFanFromItsFirstCorner) {
    const Mesh mesh = cut({{{0, 0}, {5, 0}, {6, 2}, {3, 4}, {0, 3}}});
    EXPECT_THAT(mesh.triangles,
                ElementsAre(glm::uvec3(0, 1, 2), glm::uvec3(0, 2, 3), glm::uvec3(0, 3, 4)));
}

TEST(PolygonCutter, AConcaveQuadrangleIsCutAtItsReflexCorner) {
    // A fan from corner 0 would leave the arrow; only the diagonal 1-3 lies inside it.
    const Outline arrow{{{0, 0}, {4, 3}, {8, 0}, {4, 7}}};
    const Mesh mesh = cut(arrow);
    ASSERT_EQ(mesh.triangles.size(), 2u);
    for (const double area : signed_areas(arrow, mesh)) {
        EXPECT_EQ(area, 8.0);
    }
}

TEST(PolygonCutter, AConcavePolygonIsCoveredOnceInEveryPlaneAndSense) {
    const glm::vec3 axes[3][2] = {
        {{1, 0, 0}, {0, 1, 0}}, {{0, 2, 0}, {0, 0, 3}}, {{0, 1, 5}, {7, 0, 0}}};
    for (const Outline& outline : {kArrow, kL}) {
        for (const auto& [x, y] : axes) {
            for (const bool reversed : {false, true}) {
                Outline turned = outline;
                if (reversed) {
                    std::reverse(turned.corners.begin(), turned.corners.end());
                }
                const std::vector<double> areas = signed_areas(turned, cut(turned, x, y));
                ASSERT_EQ(areas.size(), outline.corners.size() - 2);
                for (const double area : areas) {
                    EXPECT_EQ(area < 0.0, reversed && area != 0.0);
                }
                EXPECT_EQ(std::accumulate(areas.begin(), areas.end(), 0.0), turned.area());
            }
        }
    }
}

TEST(PolygonCutter, AHoleJoinedToTheOutlineStaysOpen) {
    const Outline frame{
        {{0, 0}, {7, 0}, {7, 5}, {0, 5}, {0, 0}, {2, 1}, {2, 3}, {5, 3}, {5, 1}, {2, 1}}};
    const std::vector<double> areas = signed_areas(frame, cut(frame));
    EXPECT_EQ(areas.size(), 8u);
    for (const double area : areas) {
        EXPECT_GE(area, 0.0);
    }
    EXPECT_EQ(std::accumulate(areas.begin(), areas.end(), 0.0), 7.0 * 5.0 - 3.0 * 2.0);
}

TEST(PolygonCutter, RandomStarsAreCoveredOnce) {
    constexpr unsigned kSeed = 1980;
    std::mt19937 random(kSeed);
    for (int star = 0; star < 2000; ++star) {
        const size_t count = 4 + random() % 40;
        Outline outline;
        for (size_t i = 0; i < count; ++i) {
            const double angle =
                2 * std::numbers::pi * static_cast<double>(i) / static_cast<double>(count);
            const double radius = 1.0 + static_cast<double>(random() % 1000) / 50.0;
            outline.corners.emplace_back(static_cast<float>(radius * std::cos(angle)),
                                         static_cast<float>(radius * std::sin(angle)));
        }
        const std::vector<double> areas = signed_areas(outline, cut(outline));
        ASSERT_EQ(areas.size(), count - 2);
        for (const double area : areas) {
            ASSERT_GE(area, 0.0) << "seed " << kSeed << ", star " << star;
        }
        ASSERT_NEAR(std::accumulate(areas.begin(), areas.end(), 0.0), outline.area(), 1e-9)
            << "seed " << kSeed << ", star " << star;
    }
}

TEST(PolygonCutter, PolygonsWithoutSenseStillUseEveryCorner) {
    const Outline bow_tie{{{0, 0}, {5, 3}, {5, 0}, {0, 3}}};
    const Outline point{{{1, 1}, {1, 1}, {1, 1}, {1, 1}, {1, 1}}};
    const Outline back_and_forth{{{0, 0}, {3, 0}, {1, 0}, {7, 0}, {2, 0}}};
    for (const Outline& outline : {bow_tie, point, back_and_forth}) {
        const Mesh mesh = cut(outline);
        EXPECT_EQ(mesh.triangles.size(), outline.corners.size() - 2);
        std::vector<bool> used(outline.corners.size());
        for (const glm::uvec3& t : mesh.triangles) {
            used[t.x] = used[t.y] = used[t.z] = true;
        }
        EXPECT_THAT(used, testing::Each(true));
    }
}

TEST(PolygonCutter, ALargeConcaveFaceIsALimit) {
    Outline comb;
    for (size_t i = 0; i < kMaxConcaveCorners; ++i) {
        comb.corners.emplace_back(static_cast<double>(i), i % 2 == 0 ? 0.0 : 5.0);
    }
    EXPECT_EQ(cut(comb).triangles.size(), kMaxConcaveCorners - 2);
    comb.corners.emplace_back(0.0, 9.0);
    try {
        cut(comb);
        FAIL() << "the face was accepted";
    } catch (const Error& error) {
        EXPECT_EQ(error.kind(), ErrorKind::limit);
    }
}

TEST(PolygonCutter, AMeshOfMoreThan2To31IndicesIsALimit) {
    const std::string no_bytes;
    const MeshSource source{no_bytes, "big.ply"};
    EXPECT_NO_THROW(require_triangle_count(source, 715827882));
    try {
        require_triangle_count(source, 715827883);
        FAIL() << "the mesh was accepted";
    } catch (const Error& error) {
        EXPECT_EQ(error.kind(), ErrorKind::limit);
    }
}

}  // namespace voxelume
