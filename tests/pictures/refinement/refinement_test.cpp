// SPDX-License-Identifier: Apache-2.0
// Finer models and finer worlds make no worse pictures, and no map of an object does.
#include <gtest/gtest.h>

#include <array>
#include <map>
#include <queue>
#include <string>

#include "runtime/world/world.hpp"
#include "tests/pictures/refinement/refined_scene.hpp"
#include "tests/place/pyramid_reader.hpp"
#include "tests/support/file_fixture.hpp"
#include "tests/support/test_meshes.hpp"

namespace voxelume {
namespace {

/// refined_scene() of a `smooth` model.
Scene smooth_scene(const std::string& model, const std::string& objects, double voxel,
                   glm::ivec2 size = kRefinedSize, const std::filesystem::path& folder = {}) {
    return refined_scene(model + R"(, "surface": "smooth")", objects, voxel, size, folder);
}

SolidErrors errors_of(const Scene& scene) {
    return measure_solid(scene, refined_image(scene));
}

const std::array<const char*, 2> kSolids = {R"("shape": "sphere", "radius": 0.16)",
                                            R"("shape": "torus", "radius": 0.18, "tube": 0.07)"};

TEST(Refinement, OfAModelInAFixedWorldMakesNoPictureWorse) {
    for (const char* solid : kSolids) {
        std::optional<SolidErrors> before;
        for (const int resolution : doubled_up_to(8, 128, 1024)) {
            const SolidErrors now = errors_of(smooth_scene(
                fmt::format(R"({}, "resolution": {})", solid, resolution), kRefinedPlace, 0.02));
            if (before) expect_no_worse(now, *before, fmt::format("{} at {}", solid, resolution));
            before = now;
        }
    }
}

TEST(Refinement, OfAWorldMakesNoPictureOfAModelWorse) {
    for (const char* solid : kSolids)
        for (const char* size : {"", R"(, "resolution": 1024)"}) {
            std::optional<SolidErrors> before;
            for (const int voxels : doubled_up_to(16, 128, 512)) {
                const SolidErrors now = errors_of(
                    smooth_scene(std::string(solid) + size, kRefinedPlace, 0.32 / voxels));
                if (before)
                    expect_no_worse(now, *before, fmt::format("{}{} at {}", solid, size, voxels));
                before = now;
            }
        }
}

TEST(Refinement, OfAWorldLeavesACoarserModelAsAccurateAsItsVoxels) {
    constexpr int kResolution = 48;
    const std::array<double, 2> voxels = {0.32 / kResolution, 0.5 / kResolution};
    for (size_t i = 0; i < kSolids.size(); ++i)
        for (const int world : doubled_up_to(64, 128, 512)) {
            const SolidErrors errors = errors_of(
                smooth_scene(fmt::format(R"({}, "resolution": {})", kSolids[i], kResolution),
                             kRefinedPlace, 0.32 / world));
            EXPECT_LT(errors.depth_rms, 0.001 * voxels[i]) << kSolids[i] << " at " << world;
            EXPECT_LT(errors.normal_rms, 0.06) << kSolids[i] << " at " << world;
            EXPECT_LE(errors.silhouette, 3u) << kSolids[i] << " at " << world;
        }
}

TEST(Refinement, LeavesASphereOfAnyResolutionASphere) {
    constexpr double kVoxel = 0.02;
    for (const char* placement : {"auto", "world"}) {
        std::optional<SolidErrors> before;
        for (const int resolution : {16, 32, 64, 128, 256, 512, 1024}) {
            const SolidErrors errors = errors_of(smooth_scene(
                fmt::format(R"("shape": "sphere", "radius": 0.16, "resolution": {})", resolution),
                fmt::format(R"({{"model": "m", "placement": "{}"}})", placement), kVoxel));
            EXPECT_GT(errors.both, 7000u) << resolution;
            EXPECT_LT(errors.depth_rms, 0.01 * kVoxel) << resolution;
            EXPECT_LT(errors.depth_max, 0.2 * kVoxel) << resolution;
            EXPECT_LT(errors.normal_rms, 0.3) << resolution;
            EXPECT_LE(errors.silhouette, 3u) << resolution;
            if (before) expect_no_worse(errors, *before, fmt::format("{}", resolution));
            before = errors;
        }
    }
}

/// Maps of the kinds that scenes can have: each would be wrong in another way.
const std::map<std::string, std::string> kMaps = {
    {"turned", R"("turn": [17, 31, 8])"},
    {"small", R"("turn": [17, 31, 8], "scale": 0.31)"},
    {"large", R"("turn": [17, 31, 8], "scale": 1.3)"},
    {"mirrored", R"("turn": [17, 31, 8], "scale": [-1, 1, 1])"},
    {"uneven", R"("turn": [17, 31, 8], "scale": [1.3, 0.45, 0.8])"},
    {"sheared", R"("matrix": [[1, 0.4, 0, 0.01], [0, 0.9, 0.2, 0], [0.1, 0, 1.1, 0]])"},
    {"sheared and mirrored",
     R"("matrix": [[1, 0.4, 0, 0.01], [0, -0.9, 0.2, 0], [0.1, 0, 1.1, 0]])"}};

TEST(Refinement, IsNotNeededByAnyMapOfASolid) {
    constexpr double kVoxel = 0.01;
    for (const auto& [name, map] : kMaps)
        for (const char* solid : kSolids) {
            const SolidErrors errors =
                errors_of(smooth_scene(solid, R"({"model": "m", )" + map + "}", kVoxel));
            const std::string what = fmt::format("{}, {}", name, solid);
            EXPECT_GT(errors.both, 1000u) << what;
            EXPECT_LT(errors.depth_rms, 0.05 * kVoxel) << what;
            EXPECT_LT(errors.normal_rms, 1.5) << what;
            EXPECT_LE(errors.silhouette, 12u) << what;
        }
}

class MappedMeshes : public FileTest {
  protected:
    void SetUp() override {
        FileTest::SetUp();
        mesh = wavy_ring(160, 72);
        for (glm::vec3& p : mesh.positions) p *= 0.55f;
        write_obj(folder / "ring.obj", mesh);
    }

    /// The mesh as an object shows it.
    oracle::MeshTree mapped(const glm::dmat4& map) const {
        std::vector<oracle::Triangle> triangles = triangles_of(mesh);
        for (oracle::Triangle& triangle : triangles)
            for (glm::dvec3& p : triangle) p = glm::dvec3(map * glm::dvec4(p, 1));
        return oracle::MeshTree(std::move(triangles));
    }

    SurfaceErrors errors_of(const std::string& keys, const std::string& objects, double voxel) {
        const Scene scene =
            smooth_scene(R"("mesh": "ring.obj")" + keys, objects, voxel, {160, 120}, folder);
        return measure_surface(scene, refined_image(scene),
                               mapped(scene.objects[0].world_from_object));
    }

    Mesh mesh;
};

TEST_F(MappedMeshes, LieWhereTheMapPutsThemAndFaceOutwards) {
    for (const auto& [name, map] : kMaps)
        for (const char* size : {"", R"(, "resolution": 300)"}) {
            const SurfaceErrors errors = errors_of(size, R"({"model": "m", )" + map + "}", 0.008);
            EXPECT_GT(errors.both, 500u) << name;
            EXPECT_LT(errors.distance_rms, 0.05) << name << size;
            EXPECT_LT(errors.distance_max, 0.8) << name << size;
            EXPECT_LE(errors.mask_differs, 8u) << name << size;
        }
}

/// Other objects of a model, out of view.
std::string copies_behind(int count) {
    std::string objects;
    for (int i = 0; i < count; ++i)
        objects += R"(, {"model": "m", "position": [0.3, 0.35, -0.35], "scale": 0.05})";
    return objects;
}

TEST_F(MappedMeshes, AreAsAccurateWithManyCopies) {
    for (const char* map : {R"("turn": [17, 31, 8])", R"("turn": [40, 11, 8], "scale": 0.83)"}) {
        const std::string object = fmt::format(R"({{"model": "m", {}}})", map);
        const SurfaceErrors alone = errors_of("", object, 0.006);
        const SurfaceErrors among = errors_of("", object + copies_behind(40), 0.006);
        EXPECT_LT(alone.distance_rms, 0.015) << map;
        EXPECT_LT(among.distance_rms, 0.03) << map;
        EXPECT_LE(among.mask_differs, alone.mask_differs + 8) << map;
    }
}

/// The voxels of a world that are connected by faces, edges or corners: the sizes of such sets.
std::vector<size_t> component_sizes(const HostPyramid& host) {
    std::map<std::array<int, 3>, bool> seen;
    int log2 = 0;
    for (glm::ivec3 v{0}; v.z < host.frame.size.z; ++v.z)
        for (v.y = 0; v.y < host.frame.size.y; ++v.y)
            for (v.x = 0; v.x < host.frame.size.x; ++v.x)
                if (host.find(v, log2)) seen[{v.x, v.y, v.z}] = false;
    std::vector<size_t> sizes;
    for (auto& [start, is_seen] : seen) {
        if (is_seen) continue;
        is_seen = true;
        sizes.push_back(0);
        std::queue<std::array<int, 3>> next({start});
        for (; !next.empty(); next.pop()) {
            ++sizes.back();
            const std::array<int, 3> at = next.front();
            for (int i = 0; i < 27; ++i) {
                const auto found =
                    seen.find({at[0] + i % 3 - 1, at[1] + i / 3 % 3 - 1, at[2] + i / 9 - 1});
                if (found == seen.end() || found->second) continue;
                found->second = true;
                next.push(found->first);
            }
        }
    }
    return sizes;
}

TEST_F(MappedMeshes, OfAFineResolutionMadeSmallHaveNoCrumbs) {
    for (const char* scale : {"0.5", "[0.5, -0.4, 0.45]"}) {
        const Scene scene = smooth_scene(
            R"("mesh": "ring.obj", "resolution": 256)",
            fmt::format(R"({{"model": "m", "turn": [17, 31, 8], "scale": {}}})", scale), 0.005,
            {8, 8}, folder);
        WorldReport report;
        const HostPyramid host(build_world(shared_device(), scene, report));
        EXPECT_EQ(component_sizes(host).size(), 1u) << scale << ": the ring is in one piece";
        const oracle::MeshTree tree = mapped(scene.objects[0].world_from_object);
        int log2 = 0;
        size_t far = 0;
        for (glm::ivec3 v{0}; v.z < host.frame.size.z; ++v.z)
            for (v.y = 0; v.y < host.frame.size.y; ++v.y)
                for (v.x = 0; v.x < host.frame.size.x; ++v.x) {
                    if (!host.find(v, log2)) continue;
                    const glm::dvec3 middle =
                        host.frame.origin + host.frame.voxel_edge * (glm::dvec3(v) + 0.5);
                    far += oracle::distance_to_mesh(tree, middle) > 0.005;
                }
        EXPECT_EQ(far, 0u) << scale << ": voxels of the surface are near the mesh";
    }
}

}  // namespace
}  // namespace voxelume
