// SPDX-License-Identifier: Apache-2.0
// The programs and kernels predicted for an image are those that it is made with.
#include "runtime/analysis/image_programs.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <filesystem>
#include <string>
#include <string_view>

#include "runtime/assets/asset_store.hpp"
#include "runtime/memory/plan.hpp"
#include "runtime/opencl/ahead/kernel_compilers.hpp"
#include "runtime/opencl/program_cache.hpp"
#include "runtime/opencl/quirks/pocl_folder.hpp"
#include "runtime/render/renderer.hpp"
#include "runtime/stages/resolve/resolve.hpp"
#include "tests/pictures/small_scene.hpp"
#include "tests/support/test_device.hpp"

namespace voxelume {
namespace {

/// The folders of PoCL that hold a kernel compiled for groups of this many work-items.
size_t folders_of(const std::string& kernel, size_t group) {
    namespace fs = std::filesystem;
    const std::string end = "/" + kernel + "/" + std::to_string(group) + "-1-1";
    size_t found = 0;
    for (const fs::directory_entry& entry :
         fs::recursive_directory_iterator(PoclFolder::instance().path()))
        found +=
            size_t(entry.is_directory() && entry.path().string().find(end) != std::string::npos);
    return found;
}

/// `device` has made the image, and the cache has what it was made by.
void expect_made(const Device& device, const ForeseenProgram& program) {
    const uint64_t built = device.counters().programs_built;
    Program::build_together(device, program.files, program.defines);
    EXPECT_EQ(device.counters().programs_built, built) << "other constants";
    const int started = KernelCompilers::instance().started();
    Program::foresee(Device::open("cpu"), program);
    EXPECT_EQ(KernelCompilers::instance().started(), started) << "other files together";
    for (const ForeseenKernel& kernel : program.kernels) {
        EXPECT_GT(device.counters().launches[kernel.name], 0u) << kernel.name;
        EXPECT_GT(folders_of(kernel.name, kernel.work == WorkItem::heavy ? 1 : 16), 0u)
            << kernel.name << " in other groups";
    }
}

/// Makes an image, and compares what made it with what was foreseen, if anything was. Returns
/// whether it was.
bool expect_foreseen(const Scene& scene) {
    // This device has its own context, all of whose programs were built for this image.
    const Device device = Device::open("cpu");
    AssetStore meshes;
    const ForeseenImage image = plan_scene(scene, meshes, device.info()).foreseen;
    RenderReport report;
    render(device, scene, report);
    keep_compiled_kernels(device.info());
    KernelCompilers::instance().allow(1, "/nowhere");
    if (!image.files.empty())
        expect_made(device,
                    {image.files, resolve_defines(device, image.features, scene.render.channels),
                     image.kernels});
    KernelCompilers::instance().allow(0);
    return !image.files.empty();
}

class ForeseenImages : public testing::TestWithParam<const char*> {};

TEST_P(ForeseenImages, AreMadeByWhatIsForeseen) {
    if (!keeps_pocl_folder(Device::open("cpu").info())) GTEST_SKIP() << "this driver isn't PoCL";
    // Only building the worlds tells whether surfaces of these two share voxels.
    const std::string_view name = GetParam();
    EXPECT_EQ(expect_foreseen(small_scene(GetParam(), {96, 72}, 256)),
              name != "still_life" && name != "voxels");
}

INSTANTIATE_TEST_SUITE_P(Scenes, ForeseenImages,
                         testing::Values("bunny", "cornell", "cubes", "still_life", "voxels",
                                         "whitted"));

TEST(ForeseenImage, OfAnEarlierRunIsMadeReadyWhileTheWorldIsBuilt) {
    const Device first = Device::open("cpu");
    if (!keeps_pocl_folder(first.info())) GTEST_SKIP() << "this driver isn't PoCL";
    const Scene scene = small_scene("bunny", {96, 72}, 256);
    RenderReport report;
    render(first, scene, report);
    keep_compiled_kernels(first.info());
    const Device second = Device::open("cpu");  // has a context of its own
    render(second, scene, report);
    EXPECT_EQ(second.counters().programs_begun, 1u);
    EXPECT_GE(second.counters().programs_from_cache, 1u);
    render(second, scene, report);
    EXPECT_EQ(second.counters().programs_begun, 1u) << "it is ready";
}

TEST(ForeseenImage, WithoutColourIsMadeByWhatIsForeseen) {
    if (!keeps_pocl_folder(Device::open("cpu").info())) GTEST_SKIP() << "this driver isn't PoCL";
    Scene scene = small_scene("bunny", {96, 72}, 256);
    scene.render.channels.color = false;
    EXPECT_TRUE(expect_foreseen(scene));
    scene.render.channels.depth = scene.render.channels.normal = scene.render.channels.object =
        false;
    EXPECT_TRUE(expect_foreseen(scene));
}

TEST(ForeseenImage, IsNoneOfVeryManyObjects) {
    Scene scene = small_scene("bunny", {96, 72}, 64);
    scene.objects.resize(301, scene.objects[0]);
    EXPECT_TRUE(foreseen_image(scene, Pyramid{}).files.empty());
}

}  // namespace
}  // namespace voxelume
