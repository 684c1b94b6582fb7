// SPDX-License-Identifier: Apache-2.0
// Distance fields of meshes, against distances in double and exact winding numbers.
#include <gtest/gtest.h>

#include <cmath>

#include "tests/oracles/mesh/triangle_distance.hpp"
#include "tests/support/voxelize_fixture.hpp"

namespace voxelume {
namespace {

using glm::dvec3;
using glm::ivec3;
using glm::vec3;

BrickGrid smooth_grid(const Mesh& mesh, const GridFrame& frame, double band = 2.8,
                      Voxelizer& voxelizer = shared_voxelizer()) {
    VoxelizeOptions options;
    options.surface = Surface::smooth;
    options.band = band;
    return voxelizer.voxelize(mesh, glm::dmat4(1), frame, options);
}

/// A field read back: the distance in voxels at a node.
struct Field {
    explicit Field(const BrickGrid& grid)
        : grid_(grid), slots_(grid.slots.read()), distance_(grid.distance.read()) {}

    int units(const ivec3& node) const {
        const GridSlot at = slot_in(grid_, slots_, node);
        if (at.slot == kBrickOutside) return 32767;
        if (at.slot == kBrickInside) return -32767;
        return distance_.at(size_t(at.slot) * 4096 + at.number);
    }

  private:
    const BrickGrid& grid_;
    std::vector<uint32_t> slots_;
    std::vector<int16_t> distance_;
};

/// The triangles' corners, rounded to the lattice, in units of the shortest edge.
std::vector<std::array<dvec3, 3>> metric_triangles(const Mesh& mesh, const GridFrame& frame) {
    const double shortest = std::min({frame.voxel_edge.x, frame.voxel_edge.y, frame.voxel_edge.z});
    std::vector<std::array<dvec3, 3>> all;
    for (const glm::uvec3& t : mesh.triangles) {
        auto& corners = all.emplace_back();
        for (int i = 0; i < 3; ++i) {
            const dvec3 voxels = (dvec3(mesh.positions[t[i]]) - frame.origin) / frame.voxel_edge;
            corners[i] = glm::roundEven(voxels * 4096.0) / 4096.0 * frame.voxel_edge / shortest;
        }
    }
    return all;
}

/// True if the triangle's bounding box is farther from p than the band. This spares the oracle most
/// of its work.
bool is_beyond(const dvec3& p, const std::array<dvec3, 3>& t, double band) {
    const dvec3 low = glm::min(glm::min(t[0], t[1]), t[2]) - band - 0.001;
    const dvec3 high = glm::max(glm::max(t[0], t[1]), t[2]) + band + 0.001;
    return glm::any(glm::lessThan(p, low)) || glm::any(glm::greaterThan(p, high));
}

/// Checks every node of the frame; `sign` gives -1 for a node inside, 1 outside, 0 where it is
/// unknown.
template <class Sign>
void expect_field(const Mesh& mesh, const GridFrame& frame, double band, Sign sign) {
    const BrickGrid grid = smooth_grid(mesh, frame, band);
    const Field field(grid);
    const auto triangles = metric_triangles(mesh, frame);
    const double shortest = std::min({frame.voxel_edge.x, frame.voxel_edge.y, frame.voxel_edge.z});
    double worst = 0;
    size_t exact = 0, wrong_signs = 0, unsaturated = 0;
    for (int z = 0; z <= frame.size.z; ++z)
        for (int y = 0; y <= frame.size.y; ++y)
            for (int x = 0; x <= frame.size.x; ++x) {
                const dvec3 p = dvec3(x, y, z) * frame.voxel_edge / shortest;
                double distance = 1e9;
                for (const auto& t : triangles) {
                    if (is_beyond(p, t, band)) continue;
                    distance =
                        std::min(distance, oracle::distance_to_triangle(p, t[0], t[1], t[2]));
                }
                const int units = field.units({x, y, z});
                const int expected_sign = sign(ivec3(x, y, z));
                if (expected_sign != 0 && units != 0)
                    wrong_signs += (units < 0) != (expected_sign < 0);
                if (distance > band + 1e-5) {
                    unsaturated += std::abs(units) != 32767;
                } else if (distance < std::min(band - 1e-5, 3.9998)) {
                    worst = std::max(worst, std::abs(std::abs(units) - distance * 8192));
                    ++exact;
                }
            }
    EXPECT_EQ(wrong_signs, 0u);
    EXPECT_EQ(unsaturated, 0u);
    EXPECT_GT(exact, 100u);
    EXPECT_LT(worst, 0.6) << "1/8192 voxel";  // 0.5 comes from rounding, the rest from floats
}

auto winding_sign(const Mesh& mesh) {
    return [triangles = lattice_mesh(mesh)](const ivec3& node) {
        return oracle::winding_number(node * 4096, triangles) > 0 ? -1 : 1;
    };
}

const auto unknown_sign = [](const ivec3&) { return 0; };

TEST(Distance, OfABoxIsItsFacesDistance) {
    const BrickGrid grid =
        smooth_grid(box_mesh({6, 6, 6}, {26, 15.5f, 14}), unit_frame({33, 22, 20}));
    const Field field(grid);
    EXPECT_EQ(field.units({6, 10, 10}), 0);
    EXPECT_EQ(field.units({7, 10, 10}), -8192);
    EXPECT_EQ(field.units({4, 10, 10}), 2 * 8192);
    EXPECT_EQ(field.units({12, 15, 10}), -4096);
    EXPECT_EQ(field.units({5, 5, 5}), 14189);  // sqrt 3
    EXPECT_EQ(field.units({12, 11, 10}), -32767);
    EXPECT_EQ(field.units({1, 10, 10}), 32767);
    EXPECT_EQ(field.units({32, 20, 18}), 32767);
}

TEST(Distance, OfATorusMatchesDoubles) {
    const Mesh mesh = torus_mesh({16.3f, 15.1f, 9.2f}, 9.7f, 4.3f, 31, 17);
    expect_field(mesh, unit_frame({33, 31, 18}), 2.8, winding_sign(mesh));
    expect_field(mesh, unit_frame({33, 31, 18}), 4.0, winding_sign(mesh));
}

TEST(Distance, OfSmallTrianglesMatchesDoubles) {
    const Mesh mesh = ball_mesh({17.3f, 12.1f, 11.2f}, 7.3f, 60, 40);
    expect_field(mesh, unit_frame({35, 25, 23}), 2.8, winding_sign(mesh));
}

TEST(Distance, InVoxelsOfThreeEdgesIsMetric) {
    const Mesh mesh = torus_mesh({1.63f, 1.51f, 0.92f}, 0.97f, 0.43f, 31, 17);
    GridFrame frame;
    frame.voxel_edge = {0.1, 0.07, 0.13};
    frame.size = {33, 43, 15};
    expect_field(mesh, frame, 3.1, unknown_sign);
}

TEST(Distance, OfSliversSegmentsAndPointsMatchesDoubles) {
    for (unsigned seed = 0; seed < 12; ++seed) {
        std::mt19937 random(seed);
        std::uniform_real_distribution<float> at(-1.0f, 1.0f);
        const auto vector = [&](float size) {
            return vec3(at(random), at(random), at(random)) * size;
        };
        const vec3 middle = vec3(17, 13, 11) + vector(3), along = vector(9);
        Mesh mesh = single_triangle(middle - along, middle + along, middle + vector(3e-3f));
        add_triangle(mesh, middle + vec3(1, 2, 1), middle + vec3(3, 2, 4),
                     middle + vec3(2, 2, 2.5f));
        add_triangle(mesh, {3, 4, 5}, {3, 4, 5}, {3, 4, 5});
        add_triangle(mesh, {30, 4, 5}, {33, 9, 5}, {30, 4, 5});
        SCOPED_TRACE(fmt::format("seed {}", seed));
        expect_field(mesh, unit_frame({35, 25, 23}), 2.8, unknown_sign);
    }
}

TEST(Distance, OfGiantTrianglesLosesNoDigit) {
    for (unsigned seed = 0; seed < 6; ++seed) {
        std::mt19937 random(seed);
        std::uniform_real_distribution<float> at(-1.0f, 1.0f);
        const auto vector = [&](float size) {
            return vec3(at(random), at(random), at(random)) * size;
        };
        // The second triangle has an edge near the frame, the third a corner.
        const vec3 middle(17, 13, 11), u = vector(4000), v = vector(4000);
        Mesh mesh = single_triangle(middle + u, middle + v, middle - u - v);
        add_triangle(mesh, middle + u, middle - u * 0.7f, middle + v);
        add_triangle(mesh, middle, middle + v, middle + u);
        SCOPED_TRACE(fmt::format("seed {}", seed));
        expect_field(mesh, unit_frame({35, 25, 23}), 2.8, unknown_sign);
    }
}

TEST(Distance, IsTheSameForEveryNumberOfLanes) {
    const Mesh mesh = torus_mesh({16.3f, 15.1f, 9.2f}, 9.7f, 4.3f, 31, 17);
    std::vector<int16_t> expected;
    for (const int lanes : lanes_to_compare(0)) {
        Voxelizer voxelizer(test_device(lanes));
        const std::vector<int16_t> distance =
            smooth_grid(mesh, unit_frame({33, 31, 18}), 2.8, voxelizer).distance.read();
        if (expected.empty()) expected = distance;
        EXPECT_EQ(distance, expected) << lanes << " lanes";
    }
}

}  // namespace
}  // namespace voxelume
