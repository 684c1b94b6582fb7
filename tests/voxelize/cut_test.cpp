// SPDX-License-Identifier: Apache-2.0
// The parts of meshes that solids leave: volumes, voxels, closed surfaces, labels, and cuts that
// move.
#include "runtime/stages/voxelize/cut.hpp"
#include "runtime/scene_file/read_scene.hpp"

#include <gmock/gmock.h>

#include <array>
#include <cmath>
#include <glm/geometric.hpp>
#include <glm/gtc/matrix_transform.hpp>
#include <numbers>
#include <queue>
#include <random>

#include "runtime/render/renderer.hpp"
#include "runtime/scene/scene_animation.hpp"
#include "tests/oracles/image_hash.hpp"
#include "tests/support/brick_grids.hpp"
#include "tests/support/file_fixture.hpp"
#include "tests/support/shared_device.hpp"
#include "tests/support/test_meshes.hpp"

namespace voxelume {
namespace {

/// A scene with one object, whose model is "mesh.obj" with `keys`.
Scene cut_scene(const std::filesystem::path& folder, const std::string& keys,
                const std::string& tracks = "") {
    return parse_scene(fmt::format(R"({{"voxelume": 1,
"world": {{"voxel_size": 0.0625, "bounds": {{"min": [-1.5, -1.25, -1], "max": [1.5, 1.25, 1]}},
          "background": [0.2, 0.3, 0.5], "ambient": [0.3, 0.3, 0.3]}},
"materials": {{"red": {{"color": [0.9, 0.3, 0.1]}}}},
"models": {{"cut": {{"mesh": "mesh.obj", {}}}}},
"objects": [{{"name": "o", "model": "cut", "material": "red", "placement": "world"}}],
"lights": [{{"type": "point", "position": [2, 3, -2], "intensity": 20}}],
"observer": {{"position": [1.5, 2, -3], "look_at": [0, 0, 0],
             "display": {{"shape": "pyramid", "angle": 50}}}},
"animation": {{"frames": 5, "tracks": [{}]}},
"render": {{"size": [48, 40]}}}})",
                                   keys, tracks),
                       folder / "test.json", {});
}

class Cut : public FileTest {
  protected:
    void SetUp() override {
        FileTest::SetUp();
        write_obj(folder / "mesh.obj", box({-0.7f, -0.5f, -0.45f}, {0.6f, 0.55f, 0.4f}));
    }
    std::shared_ptr<const BrickGrid> grid_of(const std::string& keys) {
        const Scene scene = cut_scene(folder, keys);
        AssetStore meshes;
        GridCache grids(shared_device(), meshes);
        return grids.own_grid_of(scene.models[0], false);
    }
    ReadBricks bricks_of(const std::string& keys) { return ReadBricks(*grid_of(keys)); }
    /// The mesh's own distances, and those to what a cut leaves.
    std::array<ReadBricks, 2> fields_of(const std::string& keys) {
        const std::shared_ptr<const BrickGrid> grid = grid_of(keys);
        EXPECT_EQ(grid->parts.size(), 1u);
        EXPECT_EQ(grid->parts.at(0).place.link, FieldLink::maximum);
        return {ReadBricks(*grid), ReadBricks(*grid->parts.at(0).grid)};
    }
};

glm::dvec3 point_at(const GridFrame& frame, const glm::dvec3& voxels) {
    return frame.origin + frame.voxel_edge * voxels;
}

constexpr const char* kBall =
    R"("cut": [{"shape": "sphere", "radius": 0.5, "position": [0.5, 0.4, -0.3], "scale": [1, 1.25, 1]}])";

/// The distance beyond the ball, in units that differ by axis.
double beyond_ball(const glm::dvec3& p) {
    return glm::length((p - glm::dvec3(0.5, 0.4, -0.3)) / glm::dvec3(1, 1.25, 1)) - 0.5;
}

TEST_F(Cut, SolidCubesAreTheMeshsOutsideOfTheSolid) {
    const std::string keys = R"("surface": "cubes", "set": "solid", "resolution": 41)";
    const ReadBricks whole = bricks_of(keys), left = bricks_of(keys + ", " + kBall);
    const GridFrame& frame = left.host.frame;
    size_t cut = 0;
    for (glm::ivec3 v(0); v.z < frame.size.z; ++v.z)
        for (v.y = 0; v.y < frame.size.y; ++v.y)
            for (v.x = 0; v.x < frame.size.x; ++v.x) {
                const bool outside = beyond_ball(point_at(frame, glm::dvec3(v) + 0.5)) > 0;
                ASSERT_EQ(left.is_set(v), whole.is_set(v) && outside)
                    << v.x << " " << v.y << " " << v.z;
                cut += whole.is_set(v) && !outside;
            }
    EXPECT_GT(cut, 1000u);
}

TEST_F(Cut, ASmoothBallWithoutACapHasTheVolumeOfItsFormula) {
    write_obj(folder / "mesh.obj", ball({0.1, 0, 0}, 1, 192, 96));
    const auto [mesh, rest] = fields_of(
        R"("resolution": 96, "cut": [{"shape": "slab", "thickness": 4, "position": [0, 2.4, 0]}])");
    const GridFrame& frame = mesh.host.frame;
    // The volume below a surface that crosses a node's cell is taken from the node's distance.
    double cells = 0;
    for (glm::ivec3 v(0); v.z < frame.size.z; ++v.z)
        for (v.y = 0; v.y < frame.size.y; ++v.y)
            for (v.x = 0; v.x < frame.size.x; ++v.x)
                cells += std::clamp(
                    0.5 - std::max(mesh.distance_at(v), rest.distance_at(v)) / 8192.0, 0.0, 1.0);
    const double edge = frame.voxel_edge.x, height = 1.4;  // the height of what is left of the ball
    const double volume = std::numbers::pi * height * height * (3 - height) / 3;
    EXPECT_NEAR(cells * edge * edge * edge, volume, 0.002 * volume);
}

TEST_F(Cut, ASmoothFieldIsTheGreaterDistance) {
    const std::string keys = R"("resolution": 41)";
    const ReadBricks whole = bricks_of(keys);
    const auto [mesh, rest] = fields_of(
        keys + R"(, "cut": [{"shape": "box", "size": [0.4, 2, 0.3], "position": [0.1, 0, 0.05]}])");
    const GridFrame& frame = mesh.host.frame;
    for (glm::ivec3 v(0); v.z < frame.size.z; ++v.z)
        for (v.y = 0; v.y < frame.size.y; ++v.y)
            for (v.x = 0; v.x < frame.size.x; ++v.x) {
                const glm::dvec3 p = point_at(frame, v);
                const double x = std::abs(p.x - 0.1) - 0.2, z = std::abs(p.z - 0.05) - 0.15;
                const double box = (std::hypot(std::max(x, 0.0), std::max(z, 0.0)) +
                                    std::min(std::max(x, z), 0.0)) /
                                   frame.voxel_edge.x;
                const double expected = std::max(whole.distance_at(v) / 8192.0, -box);
                if (std::abs(expected) > 2.7) continue;
                const int left = std::max(mesh.distance_at(v), rest.distance_at(v));
                ASSERT_NEAR(left / 8192.0, expected, 3e-4) << v.x << " " << v.y << " " << v.z;
            }
}

/// True if a walk through faces gets from the frame's corner to `inside` without entering a set
/// voxel.
bool leaks(const ReadBricks& grid, const glm::ivec3& inside) {
    const glm::ivec3 size = grid.host.frame.size;
    const auto number = [&](const glm::ivec3& v) {
        return size_t(v.x) + size_t(size.x) * (size_t(v.y) + size_t(size.y) * size_t(v.z));
    };
    std::vector<bool> seen(number(size - 1) + 1);
    std::queue<glm::ivec3> open({glm::ivec3(0)});
    seen[0] = true;
    while (!open.empty()) {
        const glm::ivec3 at = open.front();
        open.pop();
        if (at == inside) return true;
        for (int axis = 0; axis < 3; ++axis)
            for (const int step : {-1, 1}) {
                glm::ivec3 next = at;
                next[axis] += step;
                if (next[axis] < 0 || next[axis] >= size[axis] || seen[number(next)] ||
                    grid.is_set(next))
                    continue;
                seen[number(next)] = true;
                open.push(next);
            }
    }
    return false;
}

TEST_F(Cut, ShellsAreClosedWhereTheyWereCut) {
    for (const char* set : {"supercover", "thin"}) {
        const ReadBricks grid = bricks_of(
            fmt::format(R"("surface": "cubes", "set": "{}", "resolution": 41, {})", set, kBall));
        const GridFrame& frame = grid.host.frame;
        const auto voxel_at = [&](const glm::dvec3& p) {
            return glm::ivec3(glm::floor((p - frame.origin) / frame.voxel_edge));
        };
        EXPECT_FALSE(leaks(grid, voxel_at({-0.5, -0.3, 0.1}))) << set;
        EXPECT_TRUE(leaks(grid, voxel_at({0.5, 0.4, -0.3}))) << "the ball was taken away";
    }
}

TEST_F(Cut, ASupercoverHasEveryVoxelThatTheSurfaceTouches) {
    const ReadBricks grid =
        bricks_of(std::string(R"("surface": "cubes", "resolution": 41, )") + kBall);
    const GridFrame& frame = grid.host.frame;
    const glm::dvec3 low(-0.7f, -0.5f, -0.45f), high(0.6f, 0.55f, 0.4f);
    std::mt19937 random(89);
    std::normal_distribution<double> normal;
    std::uniform_real_distribution<double> share(0, 1);
    std::uniform_int_distribution<int> face(0, 5);
    size_t seen = 0;
    for (int i = 0; i < 20'000; ++i) {
        glm::dvec3 p;
        if (i % 2 == 0) {  // on the ball, in the box
            const glm::dvec3 n =
                glm::normalize(glm::dvec3(normal(random), normal(random), normal(random)));
            p = glm::dvec3(0.5, 0.4, -0.3) + 0.5 * n * glm::dvec3(1, 1.25, 1);
            if (glm::any(glm::lessThan(p, low)) || glm::any(glm::greaterThan(p, high))) continue;
        } else {  // on the box, beyond the ball
            p = glm::mix(low, high, glm::dvec3(share(random), share(random), share(random)));
            const int f = face(random);
            p[f / 2] = f % 2 ? low[f / 2] : high[f / 2];
            if (beyond_ball(p) < 0) continue;
        }
        const glm::dvec3 voxel = (p - frame.origin) / frame.voxel_edge;
        const glm::dvec3 inner = glm::abs(glm::fract(voxel) - 0.5);
        if (std::max({inner.x, inner.y, inner.z}) > 0.5 - 1e-3) continue;  // rounding decides here
        ++seen;
        ASSERT_TRUE(grid.is_set(glm::ivec3(voxel))) << "point " << i << ", seed 89";
    }
    EXPECT_GT(seen, 5'000u);
}

TEST_F(Cut, VoxelsKeepTheirGroupsAndTheCutsFacesHaveTheFirst) {
    Mesh mesh = box({-0.7f, -0.5f, -0.45f}, {0.6f, 0.55f, 0.4f});
    std::ofstream file(folder / "mesh.obj");
    for (const glm::vec3& p : mesh.positions) file << fmt::format("v {} {} {}\n", p.x, p.y, p.z);
    for (size_t i = 0; i < mesh.triangles.size(); ++i)
        file << fmt::format("g {}\nf {} {} {}\n", i < 4 ? "ends" : "sides", mesh.triangles[i].x + 1,
                            mesh.triangles[i].y + 1, mesh.triangles[i].z + 1);
    file.close();
    const std::string keys = R"("surface": "cubes", "set": "solid", "resolution": 41)";
    const ReadBricks whole = bricks_of(keys), left = bricks_of(keys + ", " + kBall);
    const VoxelMap before = whole.voxels(), after = left.voxels();
    ASSERT_GT(after.size(), 10'000u);
    for (const auto& [voxel, word] : after)
        ASSERT_EQ(word, before.at(voxel)) << voxel.x << " " << voxel.y << " " << voxel.z;
}

TEST_F(Cut, AnExactMeshIsRefused) {
    try {
        cut_scene(folder, std::string(R"("surface": "exact", )") + kBall);
        ADD_FAILURE() << "read";
    } catch (const Error& error) {
        EXPECT_EQ(error.kind(), ErrorKind::scene);
        EXPECT_THAT(error.what(), testing::HasSubstr("can't be cut"));
    }
}

TEST_F(Cut, OneThatMovesIsVoxelizedAloneAndLooksAsFromScratch) {
    for (const char* surface : {R"("surface": "smooth", )", R"("surface": "cubes", )"}) {
        const Scene scene = cut_scene(folder, std::string(surface) + kBall,
                                      R"({"target": "models.cut.cut[0].position",
                "keys": [{"frame": 1, "value": [0.5, 0.4, -0.3]}, {"frame": 4, "value": [-0.6, 0.1, 0]}]})");
        WorldBuilder builder(shared_device());
        Renderer renderer(shared_device());
        uint64_t before = 0;
        for (int frame = 1; frame <= 5; ++frame) {
            const Scene now = scene_at(scene, frame);
            RenderReport report, alone;
            const BuiltWorld world = builder.build(now, report.world);
            const uint64_t hash = oracle::image_hash(*renderer.image(now, world, report));
            EXPECT_EQ(hash, oracle::image_hash(render(shared_device(), now, alone)))
                << surface << frame;
            EXPECT_EQ(hash != before, frame < 5) << surface << frame;
            if (frame > 1) {
                EXPECT_EQ(report.world.voxelized, frame < 5 ? 1u : 0u) << surface << frame;
            }
            before = hash;
        }
    }
}

}  // namespace
}  // namespace voxelume
