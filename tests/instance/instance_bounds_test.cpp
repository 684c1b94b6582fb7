// SPDX-License-Identifier: Apache-2.0
// Faces of instances that lie on the world's very bounds are met from outside and from within.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <string>

#include "runtime/render/renderer.hpp"
#include "runtime/scene_file/read_scene.hpp"
#include "tests/support/file_fixture.hpp"
#include "tests/support/instance_scenes.hpp"

namespace voxelume {
namespace {

constexpr double kBoundsVoxel = 0.05;

/// A plate on the middle of each side of the world, whose outer face lies on that side.
constexpr std::array kPlates = {R"("position": [-0.95, 0, 0], "turn": [0, 0, 90])",
                                R"("position": [0.95, 0, 0], "turn": [0, 0, 90])",
                                R"("position": [0, -0.95, 0])",
                                R"("position": [0, 0.95, 0])",
                                R"("position": [0, 0, -0.95], "turn": [0, 90, 0])",
                                R"("position": [0, 0, 0.95], "turn": [0, 90, 0])"};

/// Sheets without thickness on all sides.
constexpr std::array kSheets = {R"("position": [-1, 0, 0], "turn": [0, 0, 90])",
                                R"("position": [1, 0, 0], "turn": [0, 0, 90])",
                                R"("position": [0, -1, 0])",
                                R"("position": [0, 1, 0])",
                                R"("position": [0, 0, -1], "turn": [0, 90, 0])",
                                R"("position": [0, 0, 1], "turn": [0, 90, 0])"};

constexpr std::array kBoundsObservers = {
    R"("position": [0.1, 0.2, 5], "look_at": [0, 0, 0])",
    R"("position": [-4.3, 0.7, -0.4], "look_at": [0, 0, 0])",
    R"("position": [0.3, 4.6, 0.5], "look_at": [0.1, 0, 0])",
    R"("position": [-3, -2.5, -3.5], "look_at": [0, 0, 0])",
    R"("position": [3.1, 2.7, -2.9], "look_at": [0, 0, 0])",
    R"("position": [4.5, 1.01, 0.2], "look_at": [0, 0.95, 0])",  // grazes the upper side
    R"("position": [0.1, -0.2, 0.15], "look_at": [-1, 0.7, 0.4])",
    R"("position": [0, 0.1, 0], "look_at": [0.3, -1, 0.2])"};

class InstanceBounds : public FileTest {
  protected:
    std::string material_ = R"("color": [0.8, 0.6, 0.4])";

    template <size_t N>
    Image picture(const std::string& model, const std::array<const char*, N>& places,
                  const char* placement, const char* observer) const {
        std::string objects;
        for (const char* place : places)
            objects +=
                fmt::format(R"({}{{"model": "plate", "material": "paint", "placement": "{}", {}}})",
                            objects.empty() ? "" : ", ", placement, place);
        return image_of_scene(
            parse_scene(fmt::format(R"({{"voxelume": 1,
"world": {{"voxel_size": {}, "bounds": {{"min": [-1, -1, -1], "max": [1, 1, 1]}}}},
"materials": {{"paint": {{{}}}}}, "models": {{"plate": {{{}}}}}, "objects": [{}],
"lights": [{{"type": "directional", "direction": [0.3, -1, 0.4]}}],
"observer": {{{}, "display": {{"shape": "pyramid", "angle": 45}}}},
"render": {{"size": [96, 72], "shadows": false}}}})",
                                    kBoundsVoxel, material_, model, objects, observer),
                        (folder / "bounds.json").string(), {}));
    }

    /// True for a point that is farther than `rim` from all edges of its plate.
    static bool is_inner(const glm::dvec3& p, double rim) {
        const glm::dvec3 a = glm::abs(p);
        return int(a.x > 0.7 - rim) + int(a.y > 0.7 - rim) + int(a.z > 0.7 - rim) < 2;
    }

    /// Compares the pictures of plates, or sheets, in the world's voxels and as instances: no pixel
    /// may show another object, or the same one elsewhere, except for `outlines` pixels, and pixels
    /// within `rim` of edges.
    template <size_t N>
    void look_alike(const std::string& model, const std::array<const char*, N>& places,
                    size_t outlines, double rim = -1) const {
        for (const char* observer : kBoundsObservers) {
            const Image world = picture(model, places, "world", observer);
            const Image own = picture(model, places, "instance", observer);
            size_t seen = 0, other = 0;
            for (size_t i = 0; i < world.planes.at("Z").size(); ++i) {
                const uint32_t object = world.id_planes.at("objectId")[i];
                if (rim > 0 && (object == 0 || !is_inner(vector_at(world, "P", i), rim))) continue;
                seen += object != 0;
                if (own.id_planes.at("objectId")[i] != object)
                    ++other;
                else if (std::abs(own.planes.at("R")[i] - world.planes.at("R")[i]) > 0.002f)
                    ++other;
                else if (object != 0)
                    other += glm::distance(vector_at(own, "P", i), vector_at(world, "P", i)) >
                                 1e-2 * kBoundsVoxel ||
                             glm::distance(vector_at(own, "N", i), vector_at(world, "N", i)) > 1e-3;
            }
            EXPECT_GT(seen, 500u) << observer;
            EXPECT_LE(other, outlines) << model << observer;
        }
    }
};

TEST_F(InstanceBounds, FacesOfVoxelsOfTheWorldsSizeAreMet) {
    look_alike(R"("shape": "box", "size": [1.4, 0.1, 1.4], "surface": "exact")", kPlates, 0);
}

/// The faces don't lie on sides of the models' voxels.
TEST_F(InstanceBounds, FacesOfVoxelsOfOtherSizesAreMet) {
    look_alike(
        R"("shape": "box", "size": [1.4, 0.1, 1.4], "surface": "exact", "voxel_size": 0.0371)",
        kPlates, 2);
    look_alike(R"("shape": "box", "size": [1.4, 0.1, 1.4], "surface": "exact", "voxel_size": 0.02)",
               kPlates, 2);
}

TEST_F(InstanceBounds, SheetsAreMet) {
    Mesh sheet;
    sheet.positions = {{-0.7, 0, -0.7}, {0.7, 0, -0.7}, {0.7, 0, 0.7}, {-0.7, 0, 0.7}};
    sheet.triangles = {{0, 1, 2}, {0, 2, 3}};
    write_obj(folder / "sheet.obj", sheet);
    look_alike(R"("mesh": "sheet.obj", "surface": "exact")", kSheets, 2);
}

/// The world's fields end at its bounds, so that smooth plates have sharper edges there.
TEST_F(InstanceBounds, SmoothFacesAreMet) {
    look_alike(R"("shape": "box", "size": [1.4, 0.1, 1.4], "surface": "smooth")", kPlates, 0, 0.15);
}

TEST_F(InstanceBounds, FacesOfGlassAreMetOnBothSides) {
    for (const char* material :
         {R"("color": [0.8, 0.6, 0.4], "opacity": 0.4)",
          R"("diffuse": 0, "reflection": 1, "refraction": 1, "ior": 1.4, "fresnel": true)"}) {
        material_ = material;
        look_alike(R"("shape": "box", "size": [1.4, 0.1, 1.4], "surface": "exact")", kPlates, 8);
    }
}

TEST_F(InstanceBounds, CubesOnTheBoundsAreMet) {
    look_alike(R"("shape": "box", "size": [1.4, 0.1, 1.4], "surface": "cubes", "set": "solid")",
               kPlates, 0);
}

}  // namespace
}  // namespace voxelume
