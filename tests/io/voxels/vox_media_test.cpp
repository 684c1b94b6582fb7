// SPDX-License-Identifier: Apache-2.0
// The light through a block of one medium in a MagicaVoxel file, which doesn't depend on the
// block's voxels.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "tests/support/instance_scenes.hpp"
#include "tests/support/vox_fixture.hpp"

namespace voxelume {

class VoxMediaTest : public VoxFileTest {};

TEST_F(VoxMediaTest, ScatteringOnesHaveNoFacesInside) {
    constexpr int kDepth = 5;
    VoxWriter writer;
    std::vector<VoxWriter::Voxel> voxels;
    for (int x = 0; x < 7; ++x)
        for (int y = 0; y < kDepth; ++y)
            for (int z = 0; z < 4; ++z) voxels.push_back({uint8_t(x), uint8_t(y), uint8_t(z), 1});
    writer.model({7, kDepth, 4}, voxels);
    std::array<uint32_t, 256> palette = odd_palette();
    palette[1] = 0xFFFF4080u;  // red 128, green 64, blue 255
    writer.palette(palette);
    writer.material(1, {{"_type", "_media"}, {"_d", "0.25"}, {"_media_type", "_scatter"}});
    AssetStore assets;
    const Scene imported = scene_of(put(writer.bytes()), assets);
    const Material m = *std::ranges::find(imported.materials, "media 1", &Material::name);
    const Scene scene = parse_scene(fmt::format(R"({{"voxelume": 1,
"world": {{"voxel_size": 1, "background": [0.75, 0.5, 0.25], "ambient": [0.5, 0.5, 0.5],
          "bounds": {{"min": [-6, -6, -6], "max": [6, 6, 6]}}}},
"materials": {{"m": {{"color": [1, 1, 1], "diffuse": {}, "refraction": {}, "opacity": {}, "ior": {},
                    "absorption": [{}, {}, {}]}}}},
"models": {{"block": {{"voxels": "a.vox"}}}},
"objects": [{{"model": "block", "materials": {{"media 1": "m"}}}}],
"lights": [],
"observer": {{"position": [0.5, 2, 9], "look_at": [0.5, 2, 0],
             "display": {{"shape": "box", "size": [6.8, 3.8, 18]}}}},
"render": {{"size": [68, 38], "samples": 1}}}})",
                                                m.diffuse, m.refraction, m.opacity, m.ior,
                                                m.absorption.r, m.absorption.g, m.absorption.b),
                                    folder / "s.json", {});
    const Image image = image_of_scene(scene);
    const double linear[3] = {0.21586, 0.05127, 1}, behind[3] = {0.75, 0.5, 0.25};
    const char* const planes[] = {"R", "G", "B"};
    for (int c = 0; c < 3; ++c) {
        // The front and the back are matt to a part, and 5 m lie between them.
        const double matt = 0.4 * linear[c] * 0.5;
        const double left = std::exp(-kDepth * double(m.absorption[c]));
        const double expected = matt + 0.6 * left * (matt + 0.6 * behind[c]);
        for (const float value : image.planes.at(planes[c]))
            EXPECT_NEAR(value, expected, 1e-4) << c;
    }
}

}  // namespace voxelume
