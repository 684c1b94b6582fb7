// SPDX-License-Identifier: Apache-2.0
// Textures of smooth objects where rays meet them: against 256 exact bilinear values a pixel on a
// slab, and on a ball of facets against the values at closest points that are found in double.
#include <gtest/gtest.h>

#include <array>
#include <limits>
#include <numbers>

#include "runtime/io/image/png.hpp"
#include "tests/pictures/textures/seen_sheet.hpp"
#include "tests/support/file_fixture.hpp"
#include "tests/support/instance_scenes.hpp"

namespace voxelume {
namespace {

constexpr int kAround = 20, kUp = 9;  // facets of the ball

/// A ball of radius 1 m of flat facets, each corner with its place on a map of the globe.
struct Ball {
    std::vector<glm::dvec3> corners;
    std::vector<glm::dvec2> places;  ///< in picture widths from the upper left
    std::vector<glm::ivec3> triangles;

    Ball() {
        for (int row = 0; row <= kUp; ++row)
            for (int column = 0; column <= kAround; ++column) {
                const double up = std::numbers::pi * row / kUp;
                const double around = 2 * std::numbers::pi * (column % kAround) / kAround;
                corners.emplace_back(std::sin(up) * std::cos(around), std::cos(up),
                                     std::sin(up) * std::sin(around));
                places.emplace_back(double(column) / kAround, double(row) / kUp);
            }
        for (int row = 0; row < kUp; ++row)
            for (int column = 0; column < kAround; ++column) {
                const int a = row * (kAround + 1) + column, b = a + kAround + 1;
                if (row > 0) triangles.emplace_back(a, a + 1, b + 1);
                if (row < kUp - 1) triangles.emplace_back(a, b + 1, b);
            }
    }

    std::string obj(const std::string& name) const {
        std::string text = fmt::format("mtllib {}.mtl\nusemtl m\n", name);
        for (const glm::dvec3& p : corners) text += fmt::format("v {} {} {}\n", p.x, p.y, p.z);
        for (const glm::dvec2& t : places) text += fmt::format("vt {} {}\n", t.x, 1 - t.y);
        for (const glm::ivec3& t : triangles)
            text += fmt::format("f {0}/{0} {1}/{1} {2}/{2}\n", t.x + 1, t.y + 1, t.z + 1);
        return text;
    }
};

/// A point of a triangle, by the shares of its corners.
struct Closest {
    double distance = std::numeric_limits<double>::infinity();
    glm::dvec3 shares{0};
};

void take(const glm::dvec3& p, const std::array<glm::dvec3, 3>& t, const glm::dvec3& shares,
          Closest& best) {
    const double distance = glm::distance(p, t[0] * shares.x + t[1] * shares.y + t[2] * shares.z);
    if (distance < best.distance) best = {distance, shares};
}

Closest closest_of(const glm::dvec3& p, const std::array<glm::dvec3, 3>& t) {
    Closest best;
    for (int i = 0; i < 3; ++i) {
        const glm::dvec3 a = t[size_t(i)], side = t[size_t((i + 1) % 3)] - a;
        const double part = std::clamp(glm::dot(p - a, side) / glm::dot(side, side), 0.0, 1.0);
        glm::dvec3 shares(0);
        shares[i] = 1 - part;
        shares[(i + 1) % 3] = part;
        take(p, t, shares, best);
    }
    // In the plane the shares solve a linear system.
    const glm::dvec3 u = t[1] - t[0], v = t[2] - t[0], n = glm::cross(u, v);
    const glm::dvec3 solved = glm::inverse(glm::dmat3(u, v, n)) * (p - t[0]);
    if (solved.x >= 0 && solved.y >= 0 && solved.x + solved.y <= 1)
        take(p, t, {1 - solved.x - solved.y, solved.x, solved.y}, best);
    return best;
}

/// The picture's colours at the closest points of the ball; several where it is nearly the same
/// distance from several triangles.
std::vector<glm::dvec3> colors_at(const Ball& ball, const oracle::Picture& picture,
                                  const glm::dvec3& p, double& distance) {
    std::vector<Closest> found;
    distance = std::numeric_limits<double>::infinity();
    for (const glm::ivec3& t : ball.triangles) {
        found.push_back(closest_of(
            p, {ball.corners[size_t(t.x)], ball.corners[size_t(t.y)], ball.corners[size_t(t.z)]}));
        distance = std::min(distance, found.back().distance);
    }
    std::vector<glm::dvec3> colors;
    for (size_t i = 0; i < found.size(); ++i) {
        if (found[i].distance > distance + 1e-5) continue;
        const glm::ivec3& t = ball.triangles[i];
        const glm::dvec3& s = found[i].shares;
        colors.push_back(oracle::bilinear(picture, ball.places[size_t(t.x)] * s.x +
                                                       ball.places[size_t(t.y)] * s.y +
                                                       ball.places[size_t(t.z)] * s.z));
    }
    return colors;
}

class SmoothTexture : public FileTest {
  protected:
    void SetUp() override {
        FileTest::SetUp();
        write_slab("slab", {1, 1, {{255, 0, 0}}});
        write_ball("ball", {1, 1, {{0, 255, 0}}});
    }

    /// A slab 0.8 m thick below a rectangle of 8 x 6 m, with the rectangle's places on a texture.
    void write_slab(const std::string& name, const oracle::Picture& picture) const {
        put_bytes(folder / (name + ".obj"),
                  fmt::format("mtllib {}.mtl\nv -4 0 -3\nv 4 0 -3\nv 4 0 3\nv -4 0 3\n"
                              "v -4 -0.8 -3\nv 4 -0.8 -3\nv 4 -0.8 3\nv -4 -0.8 3\n"
                              "vt 0 0\nvt 3 0\nvt 3 2\nvt 0 2\nusemtl m\n"
                              "f 1/1 4/4 3/3 2/2\nf 5/1 6/2 7/3 8/4\nf 1/1 2/2 6/2 5/1\n"
                              "f 2/2 3/3 7/3 6/2\nf 3/3 4/4 8/4 7/3\nf 4/4 1/1 5/1 8/4\n",
                              name));
        write_material(name, picture);
    }

    void write_ball(const std::string& name, const oracle::Picture& picture) const {
        put_bytes(folder / (name + ".obj"), Ball().obj(name));
        write_material(name, picture);
    }

    void write_material(const std::string& name, const oracle::Picture& picture) const {
        put_bytes(folder / (name + ".mtl"), fmt::format("newmtl m\nmap_Kd {}.png\n", name));
        write_png(folder / (name + ".png"), image_of(picture));
    }

    Scene scene_of(const std::string& objects, const std::string& sight, int samples = 1,
                   const std::string& surface = "smooth", double voxel = 0.1) const {
        Scene scene = parse_scene(fmt::format(R"({{"voxelume": 1,
"world": {{"voxel_size": {4}, "bounds": {{"min": [-6, -4, -6], "max": [6, 4, 6]}},
          "ambient": [1, 1, 1]}},
"materials": {{"default": {{"color": [1, 1, 1], "diffuse": 1}}}},
"models": {{"slab": {{"mesh": "slab.obj", "surface": "{3}", "voxel_size": {4}}},
           "ball": {{"mesh": "ball.obj", "surface": "{3}", "voxel_size": {4}}},
           "plain": {{"shape": "box", "size": [1, 1, 1], "surface": "smooth"}}}},
"objects": [{0}], "lights": [],
"observer": {{{1}}},
"render": {{"size": [64, 48], "samples": {2}, "depth": 1}}}})",
                                              objects, sight, samples, surface, voxel),
                                  folder / "scene.json", {});
        scene.render.channels.position = scene.render.channels.object = true;
        return scene;
    }
};

constexpr const char* kAbove = R"("position": [0.4, 0.9, -3.4], "look_at": [0, 0, 0.3],
"display": {"shape": "pyramid", "angles": [60, 44], "near": 0.01, "far": 50})";

TEST_F(SmoothTexture, IsTheMeanOverAPixelUnderAnyMapInTheWorldAndAsInstances) {
    const oracle::Picture picture = picture_of(256, 160);
    write_slab("slab", picture);
    for (const char* placement : {"world", "instance"})
        for (const char* map :
             {R"("position": [0, 0.03, 0])", R"("position": [0, -0.2, 0.3], "turn": [21, 4, -6])",
              R"("matrix": [[-1, 0.4, 0.2, 0], [0, 1, -0.1, 0], [0.2, 0, 1.2, 0.5]])"})
            for (const int samples : {1, 4}) {
                const Scene scene = scene_of(
                    fmt::format(R"({{"model": "slab", "placement": "{}", {}}})", placement, map),
                    kAbove, samples);
                const Difference d = compare(image_of_scene(scene), scene, picture, {}, 0.4);
                EXPECT_GT(d.pixels, 600u) << placement << map;
                EXPECT_LT(d.codes(), 1) << placement << map << samples << " " << d.largest;
            }
}

TEST_F(SmoothTexture, IsThatOfTheClosestPointOfTheMesh) {
    const Ball ball;
    const oracle::Picture picture = picture_of(32, 16);
    write_ball("ball", picture);
    double farthest = 0;
    for (const char* placement : {"world", "instance"})
        for (const char* from : {"[0.3, 0.2, -3]", "[3, 0.4, 0.1]", "[0.2, 3, -0.3]"}) {
            const Scene scene = scene_of(
                fmt::format(R"({{"model": "ball", "placement": "{}"}})", placement),
                fmt::format(R"("position": {}, "look_at": [0.1, 0.2, 0], "up": [0.1, 0.2, 1],
"display": {{"shape": "pyramid", "angles": [9, 7]}})",
                            from),
                1, "smooth", 0.17);
            const Image image = image_of_scene(scene);
            size_t compared = 0, ambiguous = 0;
            double squares = 0, largest = 0;
            for (size_t pixel = 0; pixel < image.planes.at("R").size(); ++pixel) {
                const glm::dvec3 p(image.planes.at("P.X")[pixel], image.planes.at("P.Y")[pixel],
                                   image.planes.at("P.Z")[pixel]);
                const glm::dvec3 seen(image.planes.at("R")[pixel], image.planes.at("G")[pixel],
                                      image.planes.at("B")[pixel]);
                double distance = 0;
                const std::vector<glm::dvec3> colors = colors_at(ball, picture, p, distance);
                farthest = std::max(farthest, distance);
                ambiguous += colors.size() > 1 ? 1 : 0;
                double least = std::numeric_limits<double>::infinity();
                for (const glm::dvec3& color : colors)
                    least = std::min(least, glm::length(seen - color));
                squares += least * least;
                largest = std::max(largest, least);
                ++compared;
            }
            EXPECT_LT(ambiguous, compared / 4) << placement << from;
            EXPECT_LT(255 * std::sqrt(squares / double(3 * compared)), 1)
                << placement << from << largest;
        }
    EXPECT_GT(farthest, 0.002);  // the surface isn't the mesh itself
}

TEST_F(SmoothTexture, LooksLikeThatOfExactTrianglesWhereVoxelsAreSmall) {
    write_ball("ball", picture_of(64, 40));
    const char* sight = R"("position": [1, 1.5, -4], "look_at": [0, 0, 0],
"display": {"shape": "pyramid", "angles": [22, 17]})";
    const Image smooth = image_of_scene(scene_of(R"({"model": "ball"})", sight, 4, "smooth", 0.03));
    const Image exact = image_of_scene(scene_of(R"({"model": "ball"})", sight, 4, "exact", 0.03));
    double squares = 0;
    for (const char* channel : {"R", "G", "B"})
        for (size_t i = 0; i < smooth.planes.at(channel).size(); ++i) {
            const double d = smooth.planes.at(channel)[i] - exact.planes.at(channel)[i];
            squares += d * d / double(3 * smooth.planes.at(channel).size());
        }
    EXPECT_LT(255 * std::sqrt(squares), 1.5);
}

TEST_F(SmoothTexture, OfObjectsThatTouchStaysWithItsObject) {
    for (const char* placement : {"world", "instance"}) {
        const Scene scene = scene_of(fmt::format(R"({{"model": "slab", "placement": "{0}"}},
{{"model": "ball", "placement": "{0}", "position": [0, 0.4, 0.5]}},
{{"model": "ball", "placement": "world", "position": [-1.4, 0.2, 0.9]}},
{{"model": "plain", "placement": "world", "position": [1.2, 0, 1]}})",
                                                 placement),
                                     kAbove);
        const Image image = image_of_scene(scene);
        std::array<size_t, 5> seen{};
        for (size_t i = 0; i < image.planes.at("R").size(); ++i) {
            const size_t object = image.id_planes.at("objectId")[i] - size_t{1};
            const glm::vec3 color(image.planes.at("R")[i], image.planes.at("G")[i],
                                  image.planes.at("B")[i]);
            const std::array<glm::vec3, 4> own = {glm::vec3(1, 0, 0), glm::vec3(0, 1, 0),
                                                  glm::vec3(0, 1, 0), glm::vec3(1)};
            if (object >= own.size()) continue;
            ++seen[object];
            EXPECT_LT(glm::distance(color, own[object]), 1e-6f) << placement << object;
        }
        for (size_t object = 0; object < 4; ++object) EXPECT_GT(seen[object], 30u) << object;
    }
}

TEST_F(SmoothTexture, FollowsItsObjectIntoLaterFramesAndIsUploadedOnce) {
    write_slab("slab", picture_of(64, 40));
    const auto frame = [&](double x, double turn) {
        return scene_of(fmt::format(R"({{"model": "slab", "turn": [{}, 0, 0]}},
{{"model": "slab", "placement": "instance", "position": [{}, 0.9, 0.5], "scale": 0.3}})",
                                    turn, x),
                        kAbove);
    };
    const Device device = test_device();
    WorldBuilder builder(device);
    Renderer renderer(device);
    uint64_t uploaded = 0;
    for (const auto& [x, turn] : {std::pair(0.0, 0.0), {0.4, 0.0}, {0.4, 12.0}}) {
        const Scene scene = frame(x, turn);
        RenderReport report;
        const BuiltWorld world = builder.build(scene, report.world);
        const auto image = renderer.image(scene, world, report);
        EXPECT_EQ(image->planes, image_of_scene(scene).planes) << x << " " << turn;
        const uint64_t bytes = device.counters().allocated_bytes.at("source meshes");
        if (uploaded == 0) uploaded = bytes;
        EXPECT_EQ(bytes, uploaded);
    }
}

TEST_F(SmoothTexture, HasTheSameBitsWithAnyNumberOfLanes) {
    write_slab("slab", picture_of(64, 40));
    write_ball("ball", picture_of(32, 16));
    const Scene scene = scene_of(
        R"({"model": "slab"}, {"model": "ball", "position": [0, 0.4, 0.5], "placement": "instance"},
{"model": "ball", "position": [-1.4, 0.2, 0.9], "turn": [20, 10, 0]})",
        kAbove);
    const Image one = image_of_scene(scene, test_device(1));
    for (const int lanes : {4, 8, 16})
        EXPECT_EQ(one.planes, image_of_scene(scene, test_device(lanes)).planes) << lanes;
}

}  // namespace
}  // namespace voxelume
