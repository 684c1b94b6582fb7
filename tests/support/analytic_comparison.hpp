// SPDX-License-Identifier: Apache-2.0
// Rendered images against those of the analytic tracer, except for pixels where rounding may
// decide.
#pragma once

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <string>

#include "runtime/render/renderer.hpp"
#include "tests/oracles/analytic_image.hpp"
#include "tests/support/shared_device.hpp"

namespace voxelume {

/// The errors of an image's colours, channel by channel.
struct ColorError {
    double squares = 0;
    size_t pixels = 0;
    double worst = 0;
    size_t worst_pixel = 0;

    void add(size_t pixel, const glm::dvec3& off) {
        squares += off.x * off.x + off.y * off.y + off.z * off.z;
        ++pixels;
        const double largest = std::max({std::abs(off.x), std::abs(off.y), std::abs(off.z)});
        if (largest > worst) worst = largest, worst_pixel = pixel;
    }
    double rms() const { return std::sqrt(squares / double(3 * std::max(pixels, size_t(1)))); }
};

inline std::string in_words(const char* where, const ColorError& error, int width) {
    return fmt::format("{}: {} pixels, RMS {:.3g}, largest {:.3g} at {},{}", where, error.pixels,
                       error.rms(), error.worst, error.worst_pixel % size_t(width),
                       error.worst_pixel / size_t(width));
}

/// Renders a scene and expects an analytic image: RMS at most `rms`, and no colour off by more than
/// `worst`, over all pixels except those at edges. Also prints the errors with the edges.
inline void expect_image(const Scene& scene, const oracle::AnalyticImage& expected, double rms,
                         double worst) {
    RenderReport report;
    const Image image = render(shared_device(), scene, report);
    const auto &red = image.planes.at("R"), &green = image.planes.at("G"),
               &blue = image.planes.at("B");
    ASSERT_EQ(red.size(), expected.radiance.size());
    ColorError away, all;
    for (size_t i = 0; i < red.size(); ++i) {
        const glm::dvec3 off = glm::dvec3(red[i], green[i], blue[i]) - expected.radiance[i];
        all.add(i, off);
        if (!expected.edge[i]) away.add(i, off);
    }
    const std::string words = in_words("beside edges", away, image.width);
    fmt::print("{}\n{}\n", words, in_words("with edges", all, image.width));
    EXPECT_EQ(report.not_finite, 0u);
    EXPECT_GT(away.pixels, red.size() / 3) << "edges leave too little to compare";
    EXPECT_LE(away.rms(), rms) << words;
    EXPECT_LE(away.worst, worst) << words;
}

/// expect_image for the analytic image of the scene itself, which by default has two thirds of its
/// width and height.
inline void expect_analytic_image(Scene scene, double rms, double worst) {
    if (!is_exhaustive()) resize(scene, scene.render.size * 2 / 3);
    expect_image(scene, oracle::analytic_image(scene), rms, worst);
}

}  // namespace voxelume
