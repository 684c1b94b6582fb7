// SPDX-License-Identifier: Apache-2.0
// The surface of equal values in an array, compared with the sphere that the values describe.
#include <gmock/gmock.h>

#include <cmath>

#include "runtime/assets/voxel_model_file.hpp"
#include "runtime/scene_file/read_scene.hpp"
#include "tests/support/file_fixture.hpp"
#include "tests/support/shared_device.hpp"
#include "tests/support/solid_errors.hpp"
#include "tests/support/writers/array_writer.hpp"

namespace voxelume {

using testing::HasSubstr;

class ValueSurfaceTest : public FileTest {
  protected:
    static constexpr double kRadius = 0.16;

    /// A scan of a ball that is dense in its middle: n cells along its diameter, in millimetres.
    /// The surface lies where the value is 40.
    void put_ball(int n) {
        const double cell = 2 * kRadius / n;
        const int cells = n + 6;
        std::string data;
        for (int z = 0; z < cells; ++z)
            for (int y = 0; y < cells; ++y)
                for (int x = 0; x < cells; ++x) {
                    const glm::dvec3 p = cell * (glm::dvec3(x, y, z) - (cells - 1) / 2.0);
                    const double r = glm::length(p) / kRadius;
                    append_value(data, float(60 * std::exp(-r * r) + 40 - 60 / std::exp(1.0)));
                }
        const double from = -500 * cell * (cells - 1);
        put_bytes(
            folder / "ball.nrrd",
            fmt::format("NRRD0004\ntype: float\ndimension: 3\nspace dimension: 3\n"
                        "sizes: {0} {0} {0}\nspace directions: ({1},0,0) (0,{1},0) (0,0,{1})\n"
                        "space origin: ({2},{2},{2})\nspace units: \"mm\" \"mm\" \"mm\"\n"
                        "endian: little\nencoding: raw\n\n",
                        cells, 1000 * cell, from) +
                data);
    }

    SolidErrors errors(int n, const std::string& place) {
        const auto scene = [&](const std::string& model) {
            return parse_scene(fmt::format(R"({{"voxelume": 1,
"world": {{"voxel_size": {}, "bounds": {{"min": [-0.25, -0.25, -0.25], "max": [0.25, 0.25, 0.25]}}}},
"models": {{"m": {{{}, "surface": "smooth"}}}}, "objects": [{{"model": "m"{}}}],
"observer": {{"position": [0.4, 0.5, -1.1], "look_at": [0, 0, 0],
             "display": {{"shape": "pyramid", "angle": 21}}}},
"render": {{"size": [200, 150], "shadows": false}}}})",
                                           2 * kRadius / n, model, place),
                               folder / "test.json", {});
        };
        put_ball(n);
        RenderReport report;
        const Image image =
            render(shared_device(), scene(R"("voxels": "ball.nrrd", "iso": 40)"), report);
        EXPECT_EQ(report.not_finite, 0u);
        return measure_solid(scene(R"("shape": "sphere", "radius": 0.16)"), image);
    }
};

TEST_F(ValueSurfaceTest, ASphereOfValuesConvergesWithTheThirdOrder) {
    for (const char* place : {"", R"(, "turn": [17, 31, 8])"}) {
        std::optional<SolidErrors> before;
        for (const int n : {8, 16, 32}) {
            const SolidErrors now = errors(n, place);
            EXPECT_GT(now.both, 6000u);
            EXPECT_LE(now.silhouette, n < 20 ? 60u : 20u);
            const double order = before ? std::log2(before->depth_rms / now.depth_rms) : INFINITY;
            fmt::print(
                "{} cells{}: depth {:.3g} m, normal {:.3g} degrees, silhouette {}, order "
                "{:.2f}\n",
                n, place, now.depth_rms, now.normal_rms, now.silhouette, order);
            EXPECT_GT(order, 2.7) << n << place;
            before = now;
        }
    }
}

TEST_F(ValueSurfaceTest, SteepAndClampedValuesLeaveASurfaceWithoutHoles) {
    // A block of 1000 in -1000 that touches an end of the array, where it is closed.
    std::string data;
    for (int z = 0; z < 12; ++z)
        for (int y = 0; y < 10; ++y)
            for (int x = 0; x < 9; ++x) {
                const bool is_in = x >= 3 && x < 7 && y >= 2 && y < 8 && z >= 4;
                append_value(data, int16_t(is_in ? 1000 : -1000 + x));
            }
    put_bytes(folder / "b.nrrd",
              "NRRD0004\ntype: short\ndimension: 3\nsizes: 9 10 12\nspacings: 1 1 2\n"
              "endian: little\nencoding: raw\n\n" +
                  data);
    const VoxelModel model = read_voxel_model(folder / "b.nrrd", Surface::smooth, 0, {.iso = 0.0});
    EXPECT_EQ(model.frame.voxel_edge, glm::dvec3(1, 1, 2));
    // Node (x, y, z) is the middle of a cell, four nodes from the frame's first.
    const auto distance = [&](int x, int y, int z) {
        const glm::ivec3 v(x + 4, y + 4, z + 4), b = v / 16, in = v % 16, n = model.frame.bricks();
        const uint32_t slot = model.slots[size_t(b.x + n.x * (b.y + n.y * b.z))];
        return int(model.distance[slot * 4096 + size_t(in.x + 16 * in.y + 256 * in.z)]);
    };
    EXPECT_EQ(distance(3, 5, 6), -distance(2, 5, 6) * 1000 / 998);
    EXPECT_LT(distance(3, 5, 6), -4000);
    EXPECT_LT(distance(5, 5, 11), 0);
    EXPECT_EQ(distance(5, 5, 12), -distance(5, 5, 11));
    EXPECT_GT(distance(5, 1, 6), 0);
    EXPECT_LT(distance(5, 2, 6), 0);
    const auto refusal = [&](const VoxelValues& values) {
        const Error error =
            error_of([&] { read_voxel_model(folder / "b.nrrd", Surface::smooth, 0, values); });
        return std::string(error.what());
    };
    EXPECT_THAT(refusal({.iso = 2000.0}), HasSubstr("its values go from -1000 to 1000"));
    EXPECT_THAT(refusal({.each_label = true}), HasSubstr("give it \"cubes\" for each"));
}

}  // namespace voxelume
