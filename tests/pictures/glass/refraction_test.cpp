// SPDX-License-Identifier: Apache-2.0
// Images of glass bodies against geometrical optics: where rays meet the wall behind them. Cases
// O1, O2, O3 and O12; optics_test.cpp tests the functions, paths_test.cpp has O6.
#include <fmt/format.h>

#include <numbers>

#include "tests/pictures/light/sensor_room.hpp"

namespace voxelume {
namespace {

constexpr double kDegree = std::numbers::pi / 180;
const glm::dvec3 kEye(0.013, -0.021, -0.47), kAhead(0, 0, 1);

/// The distances between the places that the walls show and those that rays must reach.
struct Misses {
    size_t rays = 0;
    double worst = 0, squares = 0, worst_excess = 0;

    void add(const SensedRay& ray, const WallPoint& expected) {
        const Reading reading = read_color(ray.color, expected);
        const double off = glm::length(reading.position - expected.position);

        ++rays;
        squares += off * off;
        worst = std::max(worst, off);
        worst_excess = std::max(worst_excess, std::abs(reading.excess - 1));
    }
    double rms() const { return std::sqrt(squares / double(rays)); }
    std::string words() const {
        return fmt::format("{} rays, off by {:.2g} m RMS, {:.2g} m at most, light by {:.2g}", rays,
                           rms(), worst, worst_excess);
    }
};

void expect_places(const Misses& misses, double worst, const std::string& what) {
    fmt::print("{}: {}\n", what, misses.words());
    EXPECT_LE(misses.worst, worst) << what << ": " << misses.words();
    EXPECT_LE(misses.worst_excess, 10 * worst) << what << ": " << misses.words();
}

Json slab(const glm::dvec3& size, const char* surface) {
    return {{"shape", "box"}, {"size", {size.x, size.y, size.z}}, {"surface", surface}};
}

TEST(Refraction, O0TheWallsTellWhereRaysMeetThem) {
    Misses misses;
    for (const glm::dvec3& ahead :
         {glm::dvec3(0, 0, 1), glm::dvec3(3, 1, -2), glm::dvec3(-1, -4, 2)}) {
        Json scene = sensor_room();
        send_rays(scene, {0.01, -0.02, 0.03}, ahead, 0.3, 24);
        for (const SensedRay& ray : sense(scene))
            misses.add(ray, wall_behind(ray.origin, ray.direction));
    }
    expect_places(misses, 1e-6, "bare walls");
}

/// The unit vector along which a slab with normal n shifts rays along d.
glm::dvec3 sideways(const glm::dvec3& n, const glm::dvec3& d) {
    return glm::normalize(n - glm::dot(n, d) * d) * (glm::dot(n, d) > 0 ? 1.0 : -1.0);
}

/// O1: slabs at 45 degrees and at a general angle.
Misses slab_misses(const char* surface) {
    Misses misses;
    for (const glm::dvec3& turn : {glm::dvec3(0, 45, 0), glm::dvec3(25, 50, 0)}) {
        Json scene = sensor_room(0.015);
        add_thing(scene, slab({0.7, 0.12, 0.6}, surface), "glass", {0.02, -0.03, 0.04},
                  {{"turn", {turn.x, turn.y, turn.z}}});
        send_rays(scene, kEye, kAhead, 0.1, 24);
        const double psi = turn.x * kDegree, theta = turn.y * kDegree;
        const glm::dvec3 normal(std::sin(psi) * std::sin(theta), std::cos(theta),
                                std::cos(psi) * std::sin(theta));
        const double incidence = std::acos(std::abs(normal.z));
        const double within = std::asin(std::sin(incidence) / 1.5);
        const double shift = 0.12 * std::sin(incidence - within) / std::cos(within);
        for (const SensedRay& ray : sense(scene))
            misses.add(ray, wall_behind(ray.origin + shift * sideways(normal, kAhead), kAhead));
    }
    return misses;
}

TEST(Refraction, O1SlabShiftsRaysSideways) {
    expect_places(slab_misses("exact"), 1e-6, "exact slab");
    // Normals from 16 bits over several voxels are right to 1e-4. With 6 voxels or less from face
    // to face the differences of a slanted slab reach its middle, and a few rays miss by 3e-4.
    expect_places(slab_misses("smooth"), 1e-4, "smooth slab");
}

constexpr double kRadius = 0.2;
const glm::dvec3 kCenter(0.017, -0.028, -0.05);

/// O2: the point where the ray that passes at `b` radii from the axis of a ball of glass leaves the
/// room.
WallPoint behind_ball(const SensedRay& ray, double b) {
    const glm::dvec3 from_center = ray.origin - kCenter;
    const glm::dvec3 across =
        glm::normalize(from_center - glm::dot(from_center, ray.direction) * ray.direction);
    const double incidence = std::asin(b), within = std::asin(b / 1.5);
    const double angle =
        incidence + std::numbers::pi - 2 * within;  // angle around the ball, from the front
    const double turned = 2 * (incidence - within);
    const glm::dvec3 exit =
        kCenter + kRadius * (std::sin(angle) * across - std::cos(angle) * ray.direction);
    return wall_behind(exit, std::cos(turned) * ray.direction - std::sin(turned) * across);
}

/// The misses of rays between `minimum` and `maximum` radii from the axis.
Misses ball_misses(const std::vector<SensedRay>& rays, double minimum, double maximum) {
    Misses misses;
    for (const SensedRay& ray : rays) {
        const double b = glm::length(glm::cross(ray.origin - kCenter, ray.direction)) / kRadius;
        if (b >= minimum && b < maximum) misses.add(ray, behind_ball(ray, b));
    }
    return misses;
}

std::vector<SensedRay> rays_through_ball(const char* surface, double voxel_size) {
    Json scene = sensor_room(voxel_size);
    add_thing(scene, {{"shape", "sphere"}, {"radius", kRadius}, {"surface", surface}}, "glass",
              kCenter);
    send_rays(scene, kEye, kAhead, 2.1 * kRadius, 96);
    return sense(scene);
}

TEST(Refraction, O2BallSendsRaysToWhereTheFormulaSays) {
    const std::vector<SensedRay> rays = rays_through_ball("exact", 0.02);
    expect_places(ball_misses(rays, 0, 0.1), 1e-6, "exact ball near its axis");
    expect_places(ball_misses(rays, 0, 0.9), 3e-6, "exact ball");
    expect_places(ball_misses(rays, 0.9, 0.99), 6e-6, "exact ball, low incidence");
    expect_places(ball_misses(rays, 0.99, 0.999), 2e-5, "exact ball, grazing");
}

TEST(Refraction, O2SmoothBallComesNearWithTheSquareOfTheVoxel) {
    const Misses coarse = ball_misses(rays_through_ball("smooth", 0.02), 0, 0.9);
    const Misses fine = ball_misses(rays_through_ball("smooth", 0.01), 0, 0.9);
    expect_places(fine, 5e-4, "smooth ball");
    EXPECT_GE(std::log2(coarse.rms() / fine.rms()), 1.8) << coarse.words();
}

/// O3: two faces of a prism with an apex of 60 degrees, each 0.05 m from its middle.
Json prism(const char* surface) {
    constexpr double kFace = 0.05 - 0.15;  // middle of a box whose face it is
    Json solid = {{"shape", "intersection"}, {"surface", surface}, {"parts", Json::array()}};
    for (const double psi : {30.0, 150.0})
        solid["parts"].push_back(
            {{"shape", "box"},
             {"size", {0.6, 0.4, 0.3}},
             {"turn", {psi, 0, 0}},
             {"position", {kFace * std::sin(psi * kDegree), 0, kFace * std::cos(psi * kDegree)}}});
    return solid;
}

glm::dvec3 at_elevation(double angle) {
    return {std::sin(angle), 0, std::cos(angle)};
}

/// The point where a line meets the prism's face with the outward normal n.
glm::dvec3 on_face(const glm::dvec3& middle, const glm::dvec3& n, const glm::dvec3& origin,
                   const glm::dvec3& direction) {
    return origin + direction * ((0.05 - glm::dot(origin - middle, n)) / glm::dot(direction, n));
}

Misses prism_misses(const char* surface) {
    const glm::dvec3 middle(0.012, 0.023, -0.1);
    const double apex = 60 * kDegree;
    const double symmetric = std::asin(1.5 * std::sin(apex / 2)) - apex / 2;
    Misses misses;
    for (const double degrees : {-4.0, 0.0, 6.0}) {
        const double elevation = symmetric + degrees * kDegree;
        const glm::dvec3 ahead = at_elevation(elevation);
        const double entry = elevation + apex / 2, inside = std::asin(std::sin(entry) / 1.5);
        const double emergence = std::asin(1.5 * std::sin(apex - inside));
        const double deviation = entry + emergence - apex;
        Json scene = sensor_room();
        add_thing(scene, prism(surface), "glass", middle);
        send_rays(scene, middle - 0.2 * ahead, ahead, 0.03, 24);
        for (const SensedRay& ray : sense(scene)) {
            const glm::dvec3 enters =
                on_face(middle, at_elevation(150 * kDegree), ray.origin, ahead);
            const glm::dvec3 leaves = on_face(middle, at_elevation(30 * kDegree), enters,
                                              at_elevation(elevation - entry + inside));
            misses.add(ray, wall_behind(leaves, at_elevation(elevation - deviation)));
        }
    }
    return misses;
}

TEST(Refraction, O3PrismDeviatesByTheFormulaAroundItsMinimum) {
    expect_places(prism_misses("exact"), 1e-6, "exact prism");
    expect_places(prism_misses("smooth"), 1e-4, "smooth prism");
}

/// O12: a slab of glass inside one of water, in either order and with a priority.
TEST(Refraction, O12GlassInWaterCountsByPriorityThenByItsPlaceInTheList) {
    const Json turn = {25, 40, 0};
    const double psi = 25 * kDegree, theta = 40 * kDegree;
    const glm::dvec3 normal(std::sin(psi) * std::sin(theta), std::cos(theta),
                            std::cos(psi) * std::sin(theta));
    const double incidence = std::acos(normal.z);
    const auto shift = [&](double ior, double thickness) {
        const double within = std::asin(std::sin(incidence) / ior);
        return thickness * std::sin(incidence - within) / std::cos(within);
    };
    for (const bool glass_first : {false, true}) {
        for (const int priority : {-1, 0, 1}) {
            Json scene = sensor_room();
            scene["materials"]["water"] = {{"diffuse", 0}, {"refraction", 1}, {"ior", 1.33}};
            const auto add_glass = [&] {
                add_thing(scene, slab({0.5, 0.06, 0.5}, "exact"), "glass", {0.02, -0.03, 0.04},
                          {{"turn", turn}, {"priority", priority}});
            };
            if (glass_first) add_glass();
            add_thing(scene, slab({0.6, 0.18, 0.6}, "exact"), "water", {0.02, -0.03, 0.04},
                      {{"turn", turn}});
            if (!glass_first) add_glass();
            send_rays(scene, kEye, kAhead, 0.1, 16);
            const bool shows = priority > 0 || (priority == 0 && glass_first);
            const double shifted = shows ? shift(1.33, 0.12) + shift(1.5, 0.06) : shift(1.33, 0.18);
            Misses misses;
            for (const SensedRay& ray : sense(scene))
                misses.add(ray,
                           wall_behind(ray.origin + shifted * sideways(normal, kAhead), kAhead));
            expect_places(misses, 1e-6,
                          fmt::format("glass {} with priority {}", glass_first ? "first" : "second",
                                      priority));
        }
    }
}

}  // namespace
}  // namespace voxelume
