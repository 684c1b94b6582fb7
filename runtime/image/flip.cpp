// SPDX-License-Identifier: Apache-2.0
#include "runtime/image/flip.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <glm/exponential.hpp>
#include <glm/geometric.hpp>
#include <glm/glm.hpp>
#include <numbers>

namespace voxelume {
namespace {

// The paper's names for these values are q_c, q_f, p_c, p_t and w.
constexpr double kColorPower = 0.7, kFeaturePower = 0.5;
constexpr double kKneeShare = 0.4, kKneeValue = 0.95;
constexpr double kFeatureDegrees = 0.082;

/// The matrix from linear Rec. 709 to CIE XYZ, D65.
const glm::dmat3 kXyzFromRgb(0.4123907993, 0.2126390059, 0.0193308187,  //
                             0.3575843394, 0.7151686788, 0.1191947798,  //
                             0.1804807884, 0.0721923154, 0.9505321522);

glm::dvec3 white() {
    return kXyzFromRgb * glm::dvec3(1);
}

/// The opponent colour Y C_x C_z: CIELAB without its cube roots. The eye's filters are linear in
/// it.
glm::dvec3 opponent_from_rgb(const glm::dvec3& rgb) {
    const glm::dvec3 t = kXyzFromRgb * rgb / white();
    return {116 * t.y - 16, 500 * (t.x - t.y), 200 * (t.y - t.z)};
}

glm::dvec3 rgb_from_opponent(const glm::dvec3& c) {
    const double y = (c.x + 16) / 116;
    const glm::dvec3 t(y + c.y / 500, y, y - c.z / 200);
    static const glm::dmat3 rgb_from_xyz = glm::inverse(kXyzFromRgb);
    return rgb_from_xyz * (t * white());
}

/// The CIELAB colour with a chroma that grows with lightness (Hunt's effect).
glm::dvec3 hunt_lab(const glm::dvec3& rgb) {
    const auto root = [](double t) {
        constexpr double kDelta = 6.0 / 29;
        return t > kDelta * kDelta * kDelta ? std::cbrt(t) : t / (3 * kDelta * kDelta) + 4.0 / 29;
    };
    const glm::dvec3 t = kXyzFromRgb * rgb / white();
    const double lightness = 116 * root(t.y) - 16;
    return {lightness, 0.01 * lightness * 500 * (root(t.x) - root(t.y)),
            0.01 * lightness * 200 * (root(t.y) - root(t.z))};
}

double hyab(const glm::dvec3& a, const glm::dvec3& b) {
    return std::abs(a.x - b.x) + std::hypot(a.y - b.y, a.z - b.z);
}

struct ColorPlane {
    int width, height;
    std::vector<double> values;

    double* row(int y) { return values.data() + size_t(y) * size_t(width); }
    const double* row(int y) const { return values.data() + size_t(y) * size_t(width); }
};

/// The weights of the offsets -radius .. radius.
using Weights = std::vector<double>;

Weights weights(int radius, const auto& value) {
    Weights all;
    for (int i = -radius; i <= radius; ++i) all.push_back(value(double(i)));
    return all;
}

ColorPlane filtered_rows(const ColorPlane& plane, const Weights& weights_of_columns) {
    const size_t width = size_t(plane.width), count = weights_of_columns.size();
    ColorPlane result{plane.width, plane.height, std::vector<double>(plane.values.size(), 0.0)};
    std::vector<double> padded(width + count - 1);
    for (int y = 0; y < plane.height; ++y) {
        const double* from = plane.row(y);
        for (size_t x = 0; x < padded.size(); ++x)
            padded[x] = from[std::min(x < count / 2 ? 0 : x - count / 2, width - 1)];
        double* to = result.row(y);
        for (size_t i = 0; i < count; ++i)
            for (size_t x = 0; x < width; ++x) to[x] += weights_of_columns[i] * padded[x + i];
    }
    return result;
}

ColorPlane filtered_columns(const ColorPlane& plane, const Weights& weights_of_rows) {
    const int radius = int(weights_of_rows.size() / 2);
    ColorPlane result{plane.width, plane.height, std::vector<double>(plane.values.size(), 0.0)};
    for (int y = 0; y < plane.height; ++y)
        for (int i = -radius; i <= radius; ++i) {
            const double weight = weights_of_rows[size_t(i) + size_t(radius)];
            const double* from = plane.row(std::clamp(y + i, 0, plane.height - 1));
            double* to = result.row(y);
            for (int x = 0; x < plane.width; ++x) to[x] += weight * from[x];
        }
    return result;
}

/// Sums the values around each pixel, times the weights of their column and of their row. The
/// values at the plane's edge continue beyond it.
ColorPlane filtered(const ColorPlane& plane, const Weights& columns, const Weights& rows) {
    return filtered_columns(filtered_rows(plane, columns), rows);
}

double sum_of(const Weights& all) {
    double sum = 0;
    for (const double weight : all) sum += weight;
    return sum;
}

/// One Gaussian of a contrast sensitivity in the frequency domain: a exp(-b f^2).
struct Sensitivity {
    double a, b;
};

/// The opponent channel as the eye sees it: filtered by two Gaussians of the eye's sensitivity.
ColorPlane seen(const ColorPlane& plane, std::array<Sensitivity, 2> both,
                double pixels_per_degree) {
    constexpr double kPi = std::numbers::pi, kWidest = 0.04;
    const int radius = int(std::ceil(3 * std::sqrt(kWidest / (2 * kPi * kPi)) * pixels_per_degree));
    ColorPlane result = plane;
    std::ranges::fill(result.values, 0.0);
    double total = 0;
    for (const Sensitivity& s : both) {
        if (s.a == 0) continue;
        const Weights gauss = weights(radius, [&](double i) {
            const double degrees = i / pixels_per_degree;
            return std::exp(-kPi * kPi * degrees * degrees / s.b);
        });
        const double height = s.a * std::sqrt(kPi / s.b);
        const ColorPlane part = filtered(plane, gauss, gauss);
        for (size_t i = 0; i < part.values.size(); ++i) result.values[i] += height * part.values[i];
        total += height * sum_of(gauss) * sum_of(gauss);
    }
    for (double& value : result.values) value /= total;
    return result;
}

using Opponents = std::array<ColorPlane, 3>;

Opponents opponents_of(const Image& image) {
    Opponents planes;
    planes.fill({image.width, image.height, {}});
    const auto &r = image.planes.at("R"), &g = image.planes.at("G"), &b = image.planes.at("B");
    for (size_t i = 0; i < r.size(); ++i) {
        const glm::dvec3 c = opponent_from_rgb(glm::clamp(glm::dvec3(r[i], g[i], b[i]), 0.0, 1.0));
        for (int channel = 0; channel < 3; ++channel)
            planes[size_t(channel)].values.push_back(c[channel]);
    }
    return planes;
}

std::vector<glm::dvec3> perceived(const Opponents& planes, double pixels_per_degree) {
    const ColorPlane y = seen(planes[0], {{{1, 0.0047}, {0, 1e-5}}}, pixels_per_degree);
    const ColorPlane x = seen(planes[1], {{{1, 0.0053}, {0, 1e-5}}}, pixels_per_degree);
    const ColorPlane z = seen(planes[2], {{{34.1, 0.04}, {13.5, 0.025}}}, pixels_per_degree);
    std::vector<glm::dvec3> colors;
    for (size_t i = 0; i < y.values.size(); ++i) {
        const glm::dvec3 rgb = rgb_from_opponent({y.values[i], x.values[i], z.values[i]});
        colors.push_back(hunt_lab(glm::clamp(rgb, 0.0, 1.0)));
    }
    return colors;
}

/// Scales the positive weights of a derivative to a sum of 1, and the negative ones to -1.
Weights balanced(Weights all) {
    double positive = 0, negative = 0;
    for (const double weight : all) (weight > 0 ? positive : negative) += weight;
    for (double& weight : all) weight /= weight > 0 ? positive : -negative;
    return all;
}

/// The strength with which each pixel belongs to an edge, or a point, in any direction.
struct ImageFeatures {
    std::vector<double> edges, points;
};

ImageFeatures image_features(const ColorPlane& opponent, double pixels_per_degree) {
    ColorPlane lightness = opponent;
    for (double& value : lightness.values) value = (value + 16) / 116;
    const double deviation = 0.5 * kFeatureDegrees * pixels_per_degree;
    const int radius = int(std::ceil(3 * deviation));
    const auto gauss = [&](double i) { return std::exp(-i * i / (2 * deviation * deviation)); };
    Weights smooth = weights(radius, gauss);
    const double sum = sum_of(smooth);
    for (double& weight : smooth) weight /= sum;
    const auto strength = [&](const Weights& derivative) {
        const ColorPlane x = filtered(lightness, derivative, smooth);
        const ColorPlane y = filtered(lightness, smooth, derivative);
        std::vector<double> norms;
        norms.reserve(x.values.size());
        for (size_t i = 0; i < x.values.size(); ++i)
            norms.push_back(std::hypot(x.values[i], y.values[i]));
        return norms;
    };
    const Weights first = balanced(weights(radius, [&](double i) { return -i * gauss(i); }));
    const Weights second = balanced(weights(
        radius, [&](double i) { return (i * i / (deviation * deviation) - 1) * gauss(i); }));
    return {strength(first), strength(second)};
}

/// A colour distance on the scale 0..1. Distances up to the knee take most of the scale, the larger
/// ones the rest.
double color_difference(const glm::dvec3& a, const glm::dvec3& b) {
    static const double largest =
        std::pow(hyab(hunt_lab({0, 1, 0}), hunt_lab({0, 0, 1})), kColorPower);
    const double distance = std::pow(hyab(a, b), kColorPower), knee = kKneeShare * largest;
    if (distance < knee) return kKneeValue / knee * distance;
    return kKneeValue + (distance - knee) / (largest - knee) * (1 - kKneeValue);
}

}  // namespace

std::vector<float> flip_map(const Image& image, const Image& reference, double pixels_per_degree) {
    const Opponents a = opponents_of(image), b = opponents_of(reference);
    const auto seen_a = perceived(a, pixels_per_degree), seen_b = perceived(b, pixels_per_degree);
    const ImageFeatures of_a = image_features(a[0], pixels_per_degree);
    const ImageFeatures of_b = image_features(b[0], pixels_per_degree);
    std::vector<float> map;
    for (size_t i = 0; i < seen_a.size(); ++i) {
        const double color = color_difference(seen_a[i], seen_b[i]);
        const double feature = std::pow(std::max(std::abs(of_a.edges[i] - of_b.edges[i]),
                                                 std::abs(of_a.points[i] - of_b.points[i])) /
                                            std::numbers::sqrt2,
                                        kFeaturePower);
        map.push_back(float(std::clamp(std::pow(color, 1 - feature), 0.0, 1.0)));
    }
    return map;
}

double mean_flip(const Image& image, const Image& reference, double pixels_per_degree) {
    const std::vector<float> map = flip_map(image, reference, pixels_per_degree);
    double sum = 0;
    for (const float value : map) sum += double(value);
    return map.empty() ? 0 : sum / double(map.size());
}

}  // namespace voxelume
