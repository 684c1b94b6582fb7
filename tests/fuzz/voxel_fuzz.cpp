// SPDX-License-Identifier: Apache-2.0
// A libFuzzer target: any bytes in a file of voxels give a valid model or an error's sentence. It
// is built once per format. Of a NIfTI pair, the first two bytes of the input say how many bytes
// after them are the header, .hdr; the others are the data, .img.
#include <unistd.h>

#include <algorithm>
#include <fstream>
#include <span>

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

void write_bytes(const std::filesystem::path& file, std::span<const uint8_t> bytes) {
    std::ofstream(file, std::ios::binary)
        .write(reinterpret_cast<const char*>(bytes.data()), std::streamsize(bytes.size()));
}

/// The file, and of a pair the one with its header, too.
void write_input(const std::filesystem::path& file, std::span<const uint8_t> bytes) {
    if (file.extension() != ".img") return write_bytes(file, bytes);
    const size_t wanted = bytes.size() < 2 ? 0 : bytes[0] + 256u * bytes[1];
    const auto parts = bytes.subspan(std::min<size_t>(2, bytes.size()));
    const size_t header = std::min(wanted, parts.size());
    write_bytes(std::filesystem::path(file).replace_extension(".hdr"), parts.first(header));
    write_bytes(file, parts.subspan(header));
}

/// What a refusal begins with: the name of either file of a pair.
std::string name_in_front(const std::filesystem::path& file) {
    return file.extension() == ".img" ? file.parent_path() / file.stem() : file;
}

void check_model(const std::filesystem::path& file, Surface surface, const VoxelValues& values) {
    check_refusal(name_in_front(file), [&] {
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
