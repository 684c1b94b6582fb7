// SPDX-License-Identifier: Apache-2.0
// Z and distance of flat and deep images, against a ray's way to a plane.
#include <ImfDeepFrameBuffer.h>
#include <ImfDeepScanLineInputFile.h>
#include <gtest/gtest.h>

#include <bit>
#include <glm/trigonometric.hpp>

#include "runtime/io/volume_file.hpp"
#include "runtime/render/renderer.hpp"
#include "tests/support/display_fixture.hpp"
#include "tests/support/file_fixture.hpp"

namespace voxelume {
namespace {

constexpr int kWidth = 9, kHeight = 7;
constexpr double kFloor = -0.45;  // y of the plane
constexpr glm::dvec3 kEye{0.2, 0.6, -0.1}, kAhead{0.5, -0.7, 0.3};

struct DepthCase {
    const char* name;
    const char* keys;
    char shape;
    double half_angle = 0;  ///< degrees, of a sector
    bool z_is_distance = false;
};

constexpr std::array kDepthCases = {
    DepthCase{"pyramid", R"("shape": "pyramid", "angles": [70, 50], "near": 0.25, "far": 9)", 'p'},
    DepthCase{"box", R"("shape": "box", "size": [0.9, 0.7, 4], "near": 0.25)", 'b'},
    DepthCase{"sector", R"("shape": "sector", "angle": 130, "near": 0.25, "far": 9)", 's', 65},
    DepthCase{"half", R"("shape": "sector", "angle": 180, "near": 0.25, "far": 9)", 's', 90},
    DepthCase{"wide", R"("shape": "sector", "angle": 230, "far": 9)", 's', 115, true},
    DepthCase{"ball", R"("shape": "ball", "radius": 9)", 'l', 0, true}};

/// A sight ray in (right, up, ahead) as the manual defines it, for x to the right and y up in
/// -1..1.
struct ManualRay {
    glm::dvec3 start{0}, way;
    bool exists = true;
};

ManualRay manual_ray(const DepthCase& c, double x, double y) {
    if (c.shape == 'p')
        return {.way = {x * std::tan(glm::radians(35.0)), y * std::tan(glm::radians(25.0)), 1}};
    if (c.shape == 'b') return {.start = {0.45 * x, 0.35 * y, 0}, .way = {0, 0, 1}};
    if (c.shape == 'l') {
        const double longitude = M_PI * x, latitude = M_PI / 2 * y;
        return {.way = {std::sin(longitude) * std::cos(latitude), std::sin(latitude),
                        std::cos(longitude) * std::cos(latitude)}};
    }
    const double r = std::hypot(x, y), angle = r * glm::radians(c.half_angle);
    const double sine = r > 0 ? std::sin(angle) / r : 0;
    return {.way = {x * sine, y * sine, std::cos(angle)}, .exists = r <= 1};
}

/// What a pixel's ray meets: the plane, or nothing.
struct Met {
    double z = INFINITY, distance = INFINITY;
};

Met met_by(const DepthCase& c, int u, int v) {
    const ManualRay ray = manual_ray(c, (2.0 * u + 1) / kWidth - 1, 1 - (2.0 * v + 1) / kHeight);
    const glm::dvec3 ahead = glm::normalize(kAhead);
    const glm::dvec3 right = -glm::normalize(glm::cross(glm::dvec3(0, 1, 0), ahead));
    const glm::dvec3 up = glm::cross(right, ahead);
    const double start = kEye.y + right.y * ray.start.x + up.y * ray.start.y;
    const double rate = right.y * ray.way.x + up.y * ray.way.y + ahead.y * ray.way.z;
    const double t = (kFloor - start) / rate;
    if (!ray.exists || t <= 0) return {};
    return {t * ray.way.z, t * glm::length(ray.way)};
}

Scene floor_scene(const DepthCase& c) {
    return parsed(R"({"voxelume": 1,
"world": {"voxel_size": 0.1, "bounds": {"min": [-3, -1, -3], "max": [3, 1, 3]},
          "ambient": [1, 1, 1], "medium": {"absorption": [0.05, 0.05, 0.05]}},
"models": {"floor": {"shape": "slab", "thickness": 0.3, "surface": "exact"}},
"objects": [{"model": "floor", "position": [0, -0.6, 0]}],
"observer": {"position": [0.2, 0.6, -0.1], "look_at": [0.7, -0.1, 0.2], "display": {)" +
                  std::string(c.keys) + R"(, "voxels": [9, 7, 50]}},
"render": {"size": [9, 7]}})");
}

/// The floats of one channel of a deep image, and its kinds, pixel by pixel.
std::vector<std::vector<float>> read_channel(const std::filesystem::path& path, const char* name,
                                             Imf::PixelType type = Imf::FLOAT) {
    Imf::DeepScanLineInputFile file(path.c_str());
    std::vector<uint32_t> counts(kWidth * kHeight);
    std::vector<float*> pointers(counts.size());
    Imf::DeepFrameBuffer buffer;
    buffer.insertSampleCountSlice(
        Imf::Slice(Imf::UINT, reinterpret_cast<char*>(counts.data()), 4, 4 * kWidth));
    buffer.insert(name, Imf::DeepSlice(type, reinterpret_cast<char*>(pointers.data()),
                                       sizeof(float*), sizeof(float*) * kWidth, sizeof(float)));
    file.setFrameBuffer(buffer);
    file.readPixelSampleCounts(0, kHeight - 1);
    std::vector<std::vector<float>> values(counts.size());
    for (size_t p = 0; p < counts.size(); ++p) {
        values[p].resize(counts[p]);
        pointers[p] = values[p].data();
    }
    file.readPixels(0, kHeight - 1);
    return values;
}

class DepthChannels : public FileTest {};

TEST_F(DepthChannels, OfFlatImagesAreThoseOfThePlaneInEveryShape) {
    for (const DepthCase& c : kDepthCases) {
        SCOPED_TRACE(c.name);
        Scene scene = floor_scene(c);
        scene.render.channels.distance = true;
        RenderReport report;
        const Image image = render(shared_device(), scene, report);
        int seen = 0;
        for (int i = 0; i < kWidth * kHeight; ++i) {
            const Met met = met_by(c, i % kWidth, i / kWidth);
            const float z = image.planes.at("Z")[size_t(i)];
            const float distance = image.planes.at("distance")[size_t(i)];
            if (std::isinf(z)) {  // the world ends, or the sky is seen
                EXPECT_TRUE(std::isinf(distance));
                EXPECT_GT(met.distance, 2.0) << i;
                continue;
            }
            ++seen;
            EXPECT_NEAR(z, c.z_is_distance ? met.distance : met.z, 1e-5 * met.distance) << i;
            EXPECT_NEAR(distance, met.distance, 1e-5 * met.distance) << i;
        }
        EXPECT_GT(seen, 12);
    }
}

TEST_F(DepthChannels, OfDeepImagesAreThoseOfThePlaneInEveryShape) {
    for (const DepthCase& c : kDepthCases) {
        SCOPED_TRACE(c.name);
        const std::filesystem::path path = folder / "deep.exr";
        write_volume(path, volume_of(floor_scene(c)));
        const auto z = read_channel(path, "Z"), back = read_channel(path, "ZBack");
        const auto distance = read_channel(path, "distance");
        const auto kind = read_channel(path, "voxelKind", Imf::UINT);
        int surfaces = 0;
        for (size_t i = 0; i < z.size(); ++i) {
            const Met met = met_by(c, int(i) % kWidth, int(i) / kWidth);
            const double ratio = c.z_is_distance ? 1 : met.distance / met.z;
            for (size_t n = 0; n < z[i].size(); ++n) {
                const bool is_surface = std::bit_cast<uint32_t>(kind[i][n]) == 1;
                if (is_surface) {
                    ++surfaces;
                    EXPECT_NEAR(z[i][n], c.z_is_distance ? met.distance : met.z,
                                1e-5 * met.distance);
                }
                EXPECT_TRUE(is_surface ? z[i][n] == back[i][n] : z[i][n] < back[i][n]);
                EXPECT_TRUE(n == 0 || z[i][n] >= back[i][n - 1]) << "not front to back";
                if (std::isfinite(ratio)) {
                    EXPECT_NEAR(distance[i][n], z[i][n] * ratio, 1e-5 * distance[i][n]);
                }
            }
        }
        EXPECT_GT(surfaces, 12);
    }
}

}  // namespace
}  // namespace voxelume
