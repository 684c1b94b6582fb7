// The picture of Whitted 1980 against an analytic tracer in double precision.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <filesystem>

#include "runtime/renderer.hpp"
#include "tests/oracles/analytic_image.hpp"
#include "tests/test_device.hpp"

namespace voxelume {
namespace {

/// Of the colours of an image, channel by channel.
struct ColorError {
    double squares = 0;
    size_t pixels = 0;
    double worst = 0;
    size_t worst_pixel = 0;

    void add(size_t pixel, double r, double g, double b) {
        squares += r * r + g * g + b * b;
        ++pixels;
        const double largest = std::max({std::abs(r), std::abs(g), std::abs(b)});
        if (largest > worst) worst = largest, worst_pixel = pixel;
    }
    double rms() const { return std::sqrt(squares / double(3 * pixels)); }
};

std::string in_words(const char* name, const ColorError& error, int width) {
    return fmt::format("{}: {} pixels, RMS {:.3g}, largest {:.3g} at {},{}", name, error.pixels,
                       error.rms(), error.worst, error.worst_pixel % size_t(width),
                       error.worst_pixel / size_t(width));
}

TEST(Whitted, ThePictureIsTheAnalyticOneBesideEdges) {
    const Scene scene =
        read_scene(std::filesystem::path(VXL_SOURCE_DIR) / "scenes/whitted.json", {});
    RenderReport report;
    const Image image = render(test_device(), scene, report);
    const oracle::AnalyticImage expected = oracle::analytic_image(scene);
    const std::vector<float>&red = image.planes.at("R"), &green = image.planes.at("G"),
          &blue = image.planes.at("B");
    ASSERT_EQ(red.size(), expected.radiance.size());
    ColorError smooth, all;
    for (size_t i = 0; i < red.size(); ++i) {
        const glm::dvec3 off = glm::dvec3(red[i], green[i], blue[i]) - expected.radiance[i];
        all.add(i, off.x, off.y, off.z);
        if (!expected.edge[i]) smooth.add(i, off.x, off.y, off.z);
    }
    const std::string beside = in_words("beside edges", smooth, image.width);
    fmt::print("{}\n{}\n", beside, in_words("with edges", all, image.width));
    EXPECT_EQ(report.not_finite, 0u);
    EXPECT_GT(smooth.pixels, red.size() / 2);
    EXPECT_LE(smooth.rms(), 1e-4) << beside;
    EXPECT_LE(smooth.worst, 1e-2) << beside;
}

}  // namespace
}  // namespace voxelume
