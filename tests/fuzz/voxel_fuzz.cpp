// SPDX-License-Identifier: Apache-2.0
// A libFuzzer target: any bytes in a file of voxels give a valid model or an error's sentence. A
// NIfTI pair is the header, .hdr, and the data, .img, divided by write_pair; an NRRD header, .nhdr,
// may name what follows it, "data".
#include <algorithm>

#include "runtime/assets/voxel_model_file.hpp"
#include "runtime/import/scene_of_file.hpp"
#include "runtime/io/arrays/array_density.hpp"
#include "runtime/io/arrays/array_voxels.hpp"
#include "runtime/io/voxel_file_table.hpp"
#include "runtime/scene_file/read_scene.hpp"
#include "tests/fuzz/fuzz_file.hpp"
#include "tests/fuzz/refusals.hpp"
#include "tests/support/voxel_invariants.hpp"

namespace {

using namespace voxelume;

/// The file, and of a pair the one with its header or with its data, too.
void write_input(const std::filesystem::path& file, std::span<const uint8_t> bytes) {
    const std::string ending = file.extension();
    if (ending == ".img")
        write_pair(std::filesystem::path(file).replace_extension(".hdr"), file, bytes);
    else if (ending == ".nhdr")
        write_pair(file, file.parent_path() / "data", bytes);
    else
        write_bytes(file, bytes);
}

/// The beginning of a refusal: the name of either file of a pair.
std::string name_in_front(const std::filesystem::path& file) {
    if (file.extension() == ".nhdr") return file.parent_path();
    return file.extension() == ".img" ? file.parent_path() / file.stem() : file;
}

void check_model(const std::filesystem::path& file, Surface surface, const VoxelValues& values) {
    check_refusal(name_in_front(file), [&] {
        const std::string broken = broken_invariant(read_voxel_model(file, surface, 0, values));
        if (!broken.empty()) fail_fuzzing("invalid model", broken);
    });
}

/// The cameras and light in a .vox also give a scene that can be read.
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
    static const std::filesystem::path file = fuzz_file();
    write_input(file, {data, size});
    VoxelValues above, labels;
    above.iso = 3;
    labels.each_label = true;
    check_model(file, Surface::cubes, {});
    if (file.extension() == ".vox") check_scene(file);
    const VoxelFileFormat* format = voxel_file_format(file);
    if (!format || !format->array) return 0;
    const std::string front = name_in_front(file);
    check_model(file, Surface::cubes, labels);
    check_model(file, Surface::smooth, above);
    check_refusal(front, [&] { summary_of_array(format->array(file)); });
    check_refusal(front, [&] { read_array_density(format->array(file), glm::dmat4(1)); });
    return 0;
}
