// SPDX-License-Identifier: Apache-2.0
// Normals of objects whose placement mirrors them (the stress case P8), against the meshes' own
// normals under the same maps.
#include <gtest/gtest.h>

#include <array>

#include "runtime/scene_file/read_scene.hpp"
#include "tests/support/file_fixture.hpp"
#include "tests/support/instance_scenes.hpp"
#include "tests/support/test_meshes.hpp"

namespace voxelume {
namespace {

struct Map {
    const char* name;
    glm::dmat4 world_from_object;
};

glm::dmat4 rows(const std::array<double, 12>& m) {
    return glm::transpose(glm::dmat4(m[0], m[1], m[2], m[3], m[4], m[5], m[6], m[7], m[8], m[9],
                                     m[10], m[11], 0, 0, 0, 1));
}

/// The placements. The last one doesn't mirror, for comparison.
const std::array<Map, 4> kMaps = {{
    {"Mirrored", rows({-1, 0, 0, 0.05, 0, 1, 0, -0.03, 0, 0, 1, 0.02})},
    {"Inverted", rows({-1, 0, 0, 0.05, 0, -1, 0, -0.03, 0, 0, -1, 0.02})},
    {"Sheared", rows({-0.9, 0.4, 0.2, 0.05, 0.3, 0.8, -0.4, -0.03, 0.1, 0.5, 0.9, 0.02})},
    {"Plain", rows({0.9, 0.4, 0.2, 0.05, -0.3, 0.8, -0.4, -0.03, -0.1, 0.5, 0.9, 0.02})},
}};

/// A tetrahedron with four different faces that face outwards.
Mesh wedge() {
    Mesh mesh;
    mesh.positions = {
        {-0.31, -0.25, -0.23}, {0.43, -0.21, -0.17}, {-0.05, 0.39, -0.27}, {0.02, 0.03, 0.41}};
    mesh.triangles = {{0, 2, 1}, {0, 1, 3}, {1, 2, 3}, {2, 0, 3}};
    return mesh;
}

struct Ring {
    double radius = 0.33, tube = 0.14;
    Mesh mesh() const {
        return closed_grid(96, 48, [this](double u, double v) {
            const double r = radius + tube * std::cos(v);
            return glm::dvec3(r * std::cos(u), r * std::sin(u), tube * std::sin(v));
        });
    }
    /// The outward direction from the middle of the tube through p.
    glm::dvec3 out(const glm::dvec3& p) const {
        const glm::dvec2 middle = glm::normalize(glm::dvec2(p)) * radius;
        return glm::normalize(p - glm::dvec3(middle, 0));
    }
    double distance(const glm::dvec3& p) const {
        return std::hypot(std::hypot(p.x, p.y) - radius, p.z) - tube;
    }
};

constexpr glm::dvec3 kEye{0.4, 0.9, -1.9};

using Case = std::tuple<Map, const char*>;

/// A mesh under a map, with one of the placements.
class MirroredObjects : public FileTest, public testing::WithParamInterface<Case> {
  protected:
    MirroredObjects() : map(std::get<0>(GetParam()).world_from_object) {}

    Image image_of(const Mesh& mesh, const std::string& surface) {
        return image_of(mesh, surface, map, "{}");
    }

    Image image_of(const Mesh& mesh, const std::string& surface, const glm::dmat4& m,
                   const char* material) {
        write_obj(folder / "mesh.obj", mesh);
        std::string matrix;
        for (int row = 0; row < 3; ++row)
            matrix += fmt::format("{}[{}, {}, {}, {}]", row ? ", " : "", m[0][row], m[1][row],
                                  m[2][row], m[3][row]);
        put_bytes(folder / "scene.json",
                  fmt::format(R"({{"voxelume": 1,
"world": {{"voxel_size": 0.011, "bounds": {{"min": [-0.9, -0.8, -0.9], "max": [0.9, 0.8, 0.9]}},
          "background": [1, 1, 1]}},
"materials": {{"m": {}}},
"models": {{"mesh": {{"mesh": "mesh.obj", "voxel_size": 0.013, "surface": "{}"{}}}}},
"objects": [{{"model": "mesh", "material": "m", "matrix": [{}], "placement": "{}"}}],
"lights": [],
"observer": {{"position": [{}, {}, {}], "look_at": [0, 0, 0],
             "display": {{"shape": "pyramid", "angles": [40, 34]}}}},
"render": {{"size": [160, 130], "depth": 8}}}})",
                              material, surface, surface == "cubes" ? R"(, "set": "solid")" : "",
                              matrix, std::get<1>(GetParam()), kEye.x, kEye.y, kEye.z));
        return image_of_scene(read_scene(folder / "scene.json", {}));
    }

    /// Calls `check(place, normal, way)` for every hit, and checks that normals have length 1 and
    /// face the observer.
    void for_each_hit(const Image& image, const auto& check) {
        size_t hits = 0;
        for (size_t i = 0; i < image.planes.at("Z").size(); ++i) {
            if (image.id_planes.at("objectId")[i] == 0) continue;
            ++hits;
            const glm::dvec3 place = vector_at(image, "P", i), normal = vector_at(image, "N", i);
            const glm::dvec3 way = glm::normalize(place - kEye);
            ASSERT_NEAR(glm::length(normal), 1, 1e-6) << "pixel " << i;
            ASSERT_LT(glm::dot(normal, way), 1e-6) << "pixel " << i;
            check(i, place, normal, way);
            if (HasFatalFailure()) return;
        }
        EXPECT_GT(hits, 1500u);
    }

    /// A normal of the mesh, transformed by the map.
    glm::dvec3 transformed(const glm::dvec3& normal) const {
        return glm::normalize(glm::transpose(glm::inverse(glm::dmat3(map))) * normal);
    }
    glm::dvec3 in_mesh(const glm::dvec3& place) const {
        return glm::dvec3(glm::inverse(map) * glm::dvec4(place, 1));
    }

    glm::dmat4 map;
};

/// A face's outward side is away from the corner that it lacks. Under maps that mirror, corners go
/// the other way round.
TEST_P(MirroredObjects, ExactFacesHaveTheirPlanesNormals) {
    const Mesh mesh = wedge();
    std::array<glm::dvec3, 4> corners, normals;
    for (size_t i = 0; i < 4; ++i)
        corners[i] = glm::dvec3(map * glm::dvec4(glm::dvec3(mesh.positions[i]), 1));
    for (size_t i = 0; i < 4; ++i) {  // of the face without corner i
        const glm::dvec3 a = corners[(i + 1) % 4], b = corners[(i + 2) % 4],
                         c = corners[(i + 3) % 4];
        normals[i] = glm::normalize(glm::cross(b - a, c - a));
        if (glm::dot(normals[i], corners[i] - a) > 0) normals[i] = -normals[i];
    }
    std::array<size_t, 4> seen{};
    for_each_hit(image_of(mesh, "exact"), [&](size_t pixel, const glm::dvec3& place,
                                              const glm::dvec3& normal, const glm::dvec3& way) {
        bool is_right = false;
        for (size_t i = 0; i < 4; ++i) {
            if (std::abs(glm::dot(normals[i], place - corners[(i + 1) % 4])) > 2e-6) continue;
            if (glm::dot(normals[i], way) > 0 || glm::distance(normals[i], normal) > 1e-5) continue;
            is_right = true;
            ++seen[i];
        }
        ASSERT_TRUE(is_right) << "pixel " << pixel << ": normal " << normal.x << ' ' << normal.y
                              << ' ' << normal.z << " at " << place.x << ' ' << place.y << ' '
                              << place.z;
    });
    for (size_t i = 0; i < 4; ++i)
        EXPECT_EQ(seen[i] > 0, glm::dot(normals[i], corners[(i + 1) % 4] - kEye) < 0)
            << "face " << i;
}

TEST_P(MirroredObjects, SmoothSurfacesHaveTheirRingsNormals) {
    const Ring ring;
    double worst = 0, sum = 0;
    size_t count = 0;
    for_each_hit(image_of(ring.mesh(), "smooth"), [&](size_t, const glm::dvec3& place,
                                                      const glm::dvec3& normal, const glm::dvec3&) {
        const glm::dvec3 p = in_mesh(place);
        ASSERT_NEAR(ring.distance(p), 0, 0.002);
        const double degrees =
            glm::degrees(std::acos(std::min(1.0, glm::dot(normal, transformed(ring.out(p))))));
        worst = std::max(worst, degrees);
        sum += degrees;
        ++count;
    });
    fmt::print("{} degrees at most, {} in the mean\n", worst, sum / double(count));
    EXPECT_LT(worst, 5);
    EXPECT_LT(sum / double(count), 1);
}

/// The normals of cubes in the world have the directions of the world's axes, those of instances
/// the directions of the instance's axes.
TEST_P(MirroredObjects, CubesHaveTheirFacesNormals) {
    const Ring ring;
    const bool is_instance = std::string(std::get<1>(GetParam())) == "instance";
    std::array<size_t, 3> seen{};
    for_each_hit(image_of(ring.mesh(), "cubes"),
                 [&](size_t pixel, const glm::dvec3& place, const glm::dvec3& normal,
                     const glm::dvec3& way) {
                     ASSERT_LT(std::abs(ring.distance(in_mesh(place))), 2 * 0.013 * std::sqrt(3.0))
                         << "pixel " << pixel;
                     bool is_right = false;
                     for (int a = 0; a < 3; ++a) {
                         glm::dvec3 axis{0};
                         axis[a] = 1;
                         if (is_instance) axis = transformed(axis);
                         if (glm::dot(axis, way) > 0) axis = -axis;
                         if (glm::distance(axis, normal) > 1e-6) continue;
                         is_right = true;
                         ++seen[size_t(a)];
                     }
                     ASSERT_TRUE(is_right) << "pixel " << pixel << ": normal " << normal.x << ' '
                                           << normal.y << ' ' << normal.z;
                 });
    for (const size_t count : seen) EXPECT_GT(count, 100u);
}

/// The mesh mirrored along x, with its faces turned outwards again.
Mesh mirrored(Mesh mesh) {
    for (glm::vec3& p : mesh.positions) p.x = -p.x;
    for (glm::uvec3& t : mesh.triangles) std::swap(t.y, t.z);
    return mesh;
}

class MirroredGlass : public MirroredObjects {};

/// Light is weakened inside the mesh, so the side that counts as inside has to be right on its
/// whole way.
TEST_P(MirroredGlass, WeakensLightAsAMeshDoesThatIsMirroredInItsFile) {
    constexpr const char* kGlass =
        R"({"diffuse": 0, "refraction": 1, "ior": 1.5, "absorption": [3, 1.5, 0.7]})";
    const glm::dmat4 flip = rows({-1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0});
    const Image image = image_of(wedge(), "exact", map, kGlass);
    const Image same = image_of(mirrored(wedge()), "exact", map * flip, kGlass);
    size_t different = 0, weakened = 0, met = 0;
    for (size_t i = 0; i < image.planes.at("R").size(); ++i) {
        double maximum = 0;
        for (const char* plane : {"R", "G", "B"})
            maximum = std::max(maximum, std::abs(double(image.planes.at(plane)[i]) -
                                                 double(same.planes.at(plane)[i])));
        different += maximum > 1e-4;
        met += image.id_planes.at("objectId")[i] != 0;
        weakened += image.planes.at("R")[i] < 0.99f;
    }
    EXPECT_EQ(different, 0u);
    EXPECT_GT(met, 1500u);
    EXPECT_GT(weakened, met * 9 / 10);
}

INSTANTIATE_TEST_SUITE_P(Maps, MirroredGlass,
                         testing::Combine(testing::ValuesIn(kMaps), testing::Values("world")),
                         [](const auto& tested) { return std::get<0>(tested.param).name; });

INSTANTIATE_TEST_SUITE_P(Maps, MirroredObjects,
                         testing::Combine(testing::ValuesIn(kMaps),
                                          testing::Values("world", "instance")),
                         [](const auto& tested) {
                             return fmt::format("{}{}", std::get<0>(tested.param).name,
                                                std::get<1>(tested.param) == std::string("world")
                                                    ? "InTheWorld"
                                                    : "Instance");
                         });

}  // namespace
}  // namespace voxelume
