// SPDX-License-Identifier: Apache-2.0
// A libFuzzer target: any bytes in a file of voxels give a valid model or an error's sentence. It
// is built once per format.
#include <unistd.h>

#include <fstream>

#include "runtime/assets/voxel_model_file.hpp"
#include "runtime/import/scene_of_file.hpp"
#include "runtime/io/arrays/array_density.hpp"
#include "runtime/io/arrays/array_voxels.hpp"
#include "runtime/io/voxel_file_table.hpp"
#include "runtime/scene_file/read_scene.hpp"
#include "tests/fuzz/refusals.hpp"
#include "tests/support/voxel_invariants.hpp"

namespace {

using namespace voxelume;

/// A file in memory that each input replaces.
std::filesystem::path input_file() {
    const std::filesystem::path shared = "/dev/shm";
    const std::filesystem::path folder =
        std::filesystem::is_directory(shared) ? shared : std::filesystem::temp_directory_path();
    return folder / (std::to_string(getpid()) + "." VXL_FUZZ_NAME);
}

void check_model(const std::filesystem::path& file, Surface surface, const VoxelValues& values) {
    check_refusal(file.string(), [&] {
        const std::string broken = broken_invariant(read_voxel_model(file, surface, 0, values));
        if (!broken.empty()) fail_fuzzing("invalid model", broken);
    });
}

/// What a .vox says of cameras and light gives a scene that can be read, too.
void check_scene(const std::filesystem::path& file) {
    check_refusal(file.string(), [&] {
        AssetStore assets;
        const std::string text = scene_of_file(file, file.filename().string(), {}, assets);
        parse_scene(text, file, {}, [&](const Model& model, bool keeps) {
            return assets.box_of_file(model, keeps);
        });
    });
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const uint8_t* data, size_t size) {
    static const std::filesystem::path file = input_file();
    std::ofstream(file, std::ios::binary)
        .write(reinterpret_cast<const char*>(data), std::streamsize(size));
    VoxelValues above, labels;
    above.iso = 3;
    labels.each_label = true;
    check_model(file, Surface::cubes, {});
    if (file.extension() == ".vox") check_scene(file);
    const VoxelFileFormat* format = voxel_file_format(file);
    if (!format || !format->array) return 0;
    check_model(file, Surface::cubes, labels);
    check_model(file, Surface::smooth, above);
    check_refusal(file.string(), [&] { summary_of_array(format->array(file)); });
    check_refusal(file.string(), [&] { read_array_density(format->array(file), glm::dmat4(1)); });
    return 0;
}
