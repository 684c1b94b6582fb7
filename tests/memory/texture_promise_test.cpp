// SPDX-License-Identifier: Apache-2.0
// The memory that `check` promises for textures that meshes wear; copies share it.
#include <gtest/gtest.h>

#include <cmath>

#include "runtime/io/image/png.hpp"
#include "runtime/scene_file/read_scene.hpp"
#include "tests/support/file_fixture.hpp"
#include "tests/support/image_memory.hpp"

namespace voxelume {
namespace {

class TexturePromise : public FileTest {
  protected:
    void SetUp() override {
        FileTest::SetUp();
        put_bytes(folder / "sheet.obj",
                  "mtllib sheet.mtl\nv -1 0 -1\nv 1 0 -1\nv 1 0 1\nv -1 0 1\nvt 0 0\nvt 1 1\n"
                  "usemtl m\nf 1/1 4/2 3/1\nf 1 3 2\n");
        put_bytes(folder / "slab.obj",
                  "mtllib sheet.mtl\nv -1 0 -1\nv 1 0 -1\nv 1 0 1\nv -1 0 1\nv -1 -0.5 -1\n"
                  "v 1 -0.5 -1\nv 1 -0.5 1\nv -1 -0.5 1\nvt 0 0\nvt 1 1\nusemtl m\n"
                  "f 1/1 4/2 3/1 2/2\nf 5/1 6/2 7/1 8/2\nf 1 2 6 5\nf 2 3 7 6\nf 3 4 8 7\n"
                  "f 4 1 5 8\n");
        put_bytes(folder / "sheet.mtl", "newmtl m\nmap_Kd sheet.png\n");
        Image image{1024, 512, {}, {}, {}};
        for (const char* channel : {"R", "G", "B"})
            image.planes[channel] = std::vector<float>(1024 * 512, 0.25f);
        write_png(folder / "sheet.png", image);
    }

    Scene copies(const char* placement, int count, const char* mesh = "sheet",
                 const char* surface = "exact") const {
        std::string objects;
        for (int i = 0; i < count; ++i)
            objects +=
                fmt::format(R"({}{{"model": "sheet", "placement": "{}", "position": [0, {}, 0]}})",
                            i == 0 ? "" : ", ", placement, 0.2 * i);
        return parse_scene(
            fmt::format(
                R"({{"voxelume": 1, "world": {{"voxel_size": 0.05, "bounds": {{"min": [-1.1, -0.1, -1.1], "max": [1.1, 0.9, 1.1]}}}},
"materials": {{"default": {{}}}},
"models": {{"sheet": {{"mesh": "{}.obj", "surface": "{}", "voxel_size": 0.05}}}},
"objects": [{}], "lights": [],
"observer": {{"position": [0.2, 1.5, -2.5], "look_at": [0, 0.2, 0],
             "display": {{"shape": "pyramid", "angles": [50, 40]}}}},
"render": {{"size": [64, 48]}}}})",
                mesh, surface, objects),
            folder / "scene.json", {});
    }
};

TEST_F(TexturePromise, IsKeptForSmoothCopies) {
    for (const char* placement : {"world", "instance"}) {
        const ImageMemoryUse use = memory_of_image(copies(placement, 2, "slab", "smooth"));
        const uint64_t sources = use.device.counters().allocated_bytes.at("source meshes");
        EXPECT_GE(sources, 1024u * 512 * 4);
        EXPECT_LT(sources, 1.5 * 1024 * 512 * 4);
        EXPECT_GE(use.promise, use.fact) << placement;
        EXPECT_LE(use.promise, 1.5 * use.fact) << placement;
    }
}

TEST_F(TexturePromise, IsKeptForCopiesInTheWorldAndAsInstances) {
    for (const char* placement : {"world", "instance"}) {
        double one = 0;
        for (const int count : {1, 4}) {
            const ImageMemoryUse use = memory_of_image(copies(placement, count));
            EXPECT_GE(use.promise, use.fact) << placement << count;
            EXPECT_LE(use.promise, 1.5 * use.fact) << placement << count;
            if (count == 1) one = use.fact;
            const double max = placement == std::string("instance") ? 1.3 * one : INFINITY;
            EXPECT_LT(use.fact, max) << count;
        }
    }
}

}  // namespace
}  // namespace voxelume
