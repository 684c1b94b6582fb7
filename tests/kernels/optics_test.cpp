// SPDX-License-Identifier: Apache-2.0
// lib/light/optics.h against geometrical optics in double precision. Cases O1 to O5: bodies that
// refract rays, the critical angle, Fresnel's reflectance. refraction_test.cpp has whole images of
// them.
#include <gtest/gtest.h>

#include <cmath>
#include <glm/geometric.hpp>
#include <glm/mat3x3.hpp>
#include <numbers>
#include <optional>
#include <random>

#include "tests/kernels/boundaries.hpp"

namespace voxelume {
namespace {

constexpr unsigned kOpticsSeed = 31417;
constexpr double kDegree = std::numbers::pi / 180;
constexpr float kUlpOfOne = 0x1p-23f;

/// Turns the plane of incidence, which is z = 0 in the tests, away from the planes of all axes.
glm::dvec3 askew(const glm::dvec3& v) {
    const glm::dvec3 x = glm::normalize(glm::dvec3(1, 2, -3)),
                     y = glm::normalize(glm::dvec3(3, 0, 1));
    return glm::dmat3(x, y, glm::cross(x, y)) * v;
}

glm::dvec3 at_angle(double angle) {
    return {std::cos(angle), std::sin(angle), 0};
}

double angle_between(const glm::dvec3& a, const glm::dvec3& b) {
    return std::atan2(glm::length(glm::cross(a, b)), glm::dot(a, b));
}

/// The cosine of the refracted ray for light of cosine `c`, or nothing where it is reflected
/// totally; computed from the floats themselves in long double.
std::optional<long double> cosine_behind(float eta, float cosine) {
    const long double e = eta, c = cosine;
    if (e <= 1) return std::sqrt((1 - e) * (1 + e) + e * c * e * c);
    const long double critical = std::sqrt((e - 1) * (e + 1));
    if (e * c < critical) return {};
    return std::sqrt((e * c - critical) * (e * c + critical));
}

TEST(Optics, O1SlabShiftsRaysAndLeavesTheirDirection) {
    constexpr double kThickness = 1;
    std::vector<Boundary> faces;
    faces.reserve(890);
    for (int i = 0; i < 890; ++i)
        faces.push_back({1 / 1.5, askew(at_angle(i * 0.1 * kDegree)), askew({-1, 0, 0})});
    std::vector<Boundary> behind = faces;
    const std::vector<glm::dvec3> within = Boundaries().refracted(faces);
    for (size_t i = 0; i < faces.size(); ++i) behind[i].eta = 1.5, behind[i].direction = within[i];
    const std::vector<glm::dvec3> out = Boundaries().refracted(behind);
    for (size_t i = 0; i < faces.size(); ++i) {
        const glm::dvec3& d = faces[i].direction;
        const double incidence = double(i) * 0.1 * kDegree;
        const double inside = std::asin(std::sin(incidence) / 1.5);
        const glm::dvec3 crossed = within[i] * (kThickness / -glm::dot(within[i], faces[i].normal));
        EXPECT_NEAR(glm::length(glm::cross(crossed, d)),
                    kThickness * std::sin(incidence - inside) / std::cos(inside), 3e-7)
            << incidence / kDegree << " degrees";
        // An error in a float's angle inside grows by n cos(inside) / cos(incidence) at the second
        // face.
        EXPECT_LT(angle_between(out[i], d), 3e-7 / std::cos(incidence))
            << incidence / kDegree << " degrees";
        EXPECT_NEAR(glm::length(out[i]), 1, 4e-7);
    }
}

TEST(Optics, O2BallTurnsRaysByTwiceIncidenceLessRefraction) {
    for (const double ior : {1.33, 1.5, 2.4}) {
        std::vector<Boundary> entries, exits;
        for (int i = 0; i <= 999; ++i) {
            const double b = i * 1e-3;
            entries.push_back({1 / ior, askew({1, 0, 0}), askew({-std::sqrt(1 - b * b), b, 0})});
        }
        const std::vector<glm::dvec3> within = Boundaries().refracted(entries);
        for (size_t i = 0; i < entries.size(); ++i) {
            const glm::dvec3& p = entries[i].normal;  // the ball has radius 1
            const glm::dvec3 d = glm::normalize(within[i]);
            exits.push_back({ior, within[i], -(p - 2 * glm::dot(p, d) * d)});
        }
        const std::vector<glm::dvec3> out = Boundaries().refracted(exits);
        for (size_t i = 0; i < entries.size(); ++i) {
            const double b = double(i) * 1e-3, incidence = std::asin(b);
            EXPECT_NEAR(angle_between(out[i], entries[i].direction),
                        2 * (incidence - std::asin(b / ior)), 4e-7 * ior / std::cos(incidence))
                << "index " << ior << ", " << b << " beside the axis";
        }
    }
}

TEST(Optics, O3PrismDeviatesMinimallyOnTheSymmetricPath) {
    constexpr double kApex = 60 * kDegree;
    for (const double ior : {1.25, 1.5, 1.7}) {
        const double symmetric = std::asin(ior * std::sin(kApex / 2));
        const glm::dvec3 first = at_angle(kApex / 2), second = at_angle(-kApex / 2);
        std::vector<Boundary> entries;
        std::vector<double> incidences;
        for (int i = -100; i <= 100; ++i) {
            incidences.push_back(symmetric + i * 0.05 * kDegree);
            entries.push_back(
                {1 / ior, askew(at_angle(kApex / 2 - incidences.back())), askew(-first)});
        }
        const std::vector<glm::dvec3> within = Boundaries().refracted(entries);
        std::vector<Boundary> exits;
        exits.reserve(within.size());
        for (const glm::dvec3& v : within) exits.push_back({ior, v, askew(-second)});
        const std::vector<glm::dvec3> out = Boundaries().refracted(exits);
        double minimum = 10;
        for (size_t i = 0; i < out.size(); ++i) {
            const double inside = std::asin(std::sin(incidences[i]) / ior);
            const double emergence = std::asin(ior * std::sin(kApex - inside));
            const double deviation = angle_between(out[i], entries[i].direction);
            EXPECT_NEAR(deviation, incidences[i] + emergence - kApex,
                        4e-7 * ior / std::cos(emergence))
                << "index " << ior << ", incidence " << incidences[i] / kDegree;
            minimum = std::min(minimum, deviation);
        }
        // Fraunhofer's formula is n = sin((A + D) / 2) / sin(A / 2).
        EXPECT_NEAR(minimum, 2 * symmetric - kApex, 1e-6) << ior;
        EXPECT_NEAR(std::sin((kApex + minimum) / 2) / std::sin(kApex / 2), ior, 1e-6);
    }
}

TEST(Optics, O4TotalReflectionBeginsAtTheCriticalAngleOfTheFloatsThemselves) {
    std::mt19937 random(kOpticsSeed);
    std::vector<float> etas, cosines;
    for (int i = 0; i < 20000; ++i) {
        const float eta =
            std::uniform_real_distribution<float>(1.0001f, i % 2 ? 1.6f : 9.0f)(random);
        const double critical = std::sqrt((double(eta) - 1) * (double(eta) + 1)) / double(eta);
        for (const double beyond : {1e-3, 1e-4, 1e-5, 1e-6, 1e-7, 0.0})
            for (const double side : {-1, 1}) {
                etas.push_back(eta);
                cosines.push_back(float(critical + side * beyond));
            }
        for (const float side : {0.0f, 2.0f}) {  // the floats beside it
            etas.push_back(eta);
            cosines.push_back(std::nextafter(float(critical), side));
        }
    }
    const std::vector<Met> all = Boundaries().met(etas, cosines);
    size_t totals = 0;
    for (size_t i = 0; i < all.size(); ++i) {
        const std::optional<long double> expected = cosine_behind(etas[i], cosines[i]);
        const auto where = [&] {
            return testing::Message() << std::hexfloat << "seed " << kOpticsSeed << ", eta "
                                      << etas[i] << ", cosine " << cosines[i];
        };
        ASSERT_EQ(all[i].total, !expected.has_value()) << where();
        ASSERT_NEAR(all[i].cosine, double(expected.value_or(0)), 1e-7) << where();
        if (!all[i].total) continue;
        ++totals;
        ASSERT_EQ(all[i].reflected, 1.0f) << where();
        ASSERT_EQ(all[i].refracted, 0.0f) << where();
    }
    EXPECT_GT(totals, all.size() / 3);
    EXPECT_LT(totals, 2 * all.size() / 3);
}

/// Ratios of indices from 0.1 to 10, and cosines from grazing to normal incidence.
std::pair<std::vector<float>, std::vector<float>> all_sorts(uint32_t count) {
    std::mt19937 random(kOpticsSeed + 1);
    std::uniform_real_distribution<float> unit(0, 1);
    std::vector<float> etas(count), cosines(count);
    for (uint32_t i = 0; i < count; ++i) {
        etas[i] = std::pow(10.0f, 2 * unit(random) - 1);
        if (i % 8 == 0) etas[i] = 1 + (unit(random) - 0.5f) * 1e-4f;
        if (i % 64 == 1) etas[i] = 1;
        cosines[i] = unit(random);
        if (i % 4 == 1) cosines[i] = std::pow(10.0f, -6 * unit(random));
        if (i % 4 == 2) cosines[i] = 1 - std::pow(10.0f, -7 * unit(random));
        cosines[i] = std::clamp(cosines[i], 1e-6f, 1.0f);
    }
    for (uint32_t i = 0; i < count; i += 1024) cosines[i] = 1, cosines[i + 1] = 1e-6f;
    return {etas, cosines};
}

TEST(Optics, O5WhatIsReflectedAndWhatIsRefractedMakeOne) {
    const auto [etas, cosines] = all_sorts(1 << 20);
    const std::vector<Met> all = Boundaries().met(etas, cosines);
    for (size_t i = 0; i < all.size(); ++i) {
        const Met& m = all[i];
        ASSERT_NEAR(double(m.reflected) + double(m.refracted), 1, kUlpOfOne / 2)
            << std::hexfloat << "eta " << etas[i] << ", cosine " << cosines[i];
        ASSERT_GE(m.reflected, 0);
        ASSERT_GE(m.refracted, 0);
        if (m.total) continue;
        // The oracle is Fresnel's equations for both polarisations, as fluxes.
        const double e = double(etas[i]), c = double(cosines[i]);
        const double behind = double(*cosine_behind(etas[i], cosines[i]));
        const double rs = (e * c - behind) / (e * c + behind);
        const double rp = (c - e * behind) / (c + e * behind);
        const double ts = 2 * e * c / (e * c + behind), tp = 2 * e * c / (c + e * behind);
        const double refracted = behind / (e * c) * (ts * ts + tp * tp) / 2;
        ASSERT_NEAR(m.reflected, (rs * rs + rp * rp) / 2, 4e-7)
            << std::hexfloat << "eta " << e << ", cosine " << c;
        if (behind <= 1e-3) continue;
        ASSERT_NEAR(m.refracted, refracted, 1e-6 * refracted)
            << std::hexfloat << "eta " << e << ", cosine " << c;
    }
}

TEST(Optics, O6EqualIndicesNeitherBendNorReflect) {
    const auto [etas, cosines] = all_sorts(1 << 12);
    for (const Met& m : Boundaries().met(std::vector<float>(etas.size(), 1), cosines)) {
        EXPECT_FALSE(m.total);
        EXPECT_EQ(m.reflected, 0);
        EXPECT_EQ(m.refracted, 1);
    }
}

TEST(Optics, AlongASurfaceAllIsReflectedUnlessIndicesAreEqual) {
    std::vector<float> etas, cosines;
    for (const float eta : {0.1f, 0.75f, 1 - kUlpOfOne / 2, 1.0f, 1 + kUlpOfOne, 1.5f, 10.0f})
        for (const float c : {0.0f, 1e-40f, 0x1p-126f, 1e-20f, 1e-10f}) {
            etas.push_back(eta);
            cosines.push_back(c);
        }
    const std::vector<Met> all = Boundaries().met(etas, cosines);
    for (size_t i = 0; i < all.size(); ++i) {
        const double reflected = etas[i] == 1 ? 0 : 1;
        EXPECT_EQ(all[i].total, etas[i] > 1) << etas[i] << ' ' << cosines[i];
        EXPECT_NEAR(all[i].reflected, reflected, 1e-5) << etas[i] << ' ' << cosines[i];
        EXPECT_NEAR(all[i].refracted, 1 - reflected, 1e-5) << etas[i] << ' ' << cosines[i];
    }
}

TEST(Optics, HasTheSameBitsForEveryNumberOfLanes) {
    const auto [etas, cosines] = all_sorts(1 << 16);
    const std::vector<Met> expected = Boundaries(1).met(etas, cosines);
    for (const int lanes : in_turn<int>({4, 8, 16}, 0))
        EXPECT_EQ(Boundaries(lanes).met(etas, cosines), expected) << lanes;
}

}  // namespace
}  // namespace voxelume
