// SPDX-License-Identifier: Apache-2.0
// A libFuzzer target: any file of an image or a volumetric image gives a whole one or an error's
// sentence. Raw arrays are a header, .json, and the array, divided by write_pair.
#include "runtime/io/image/exr.hpp"
#include "runtime/io/volume_file.hpp"
#include "tests/fuzz/fuzz_file.hpp"
#include "tests/fuzz/refusals.hpp"

namespace {

using namespace voxelume;

void check_image(const std::filesystem::path& file) {
    check_refusal(file, [&] { read_exr_header(file); });
    check_refusal(file, [&] {
        const Image image = read_exr(file);
        const size_t pixels = size_t(image.width) * size_t(image.height);
        for (const auto& [name, plane] : image.planes)
            if (plane.size() != pixels) fail_fuzzing("a channel with pixels missing", name);
    });
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const uint8_t* data, size_t size) {
    static const std::filesystem::path file = fuzz_file();
    const std::string ending = file.extension();
    if (ending == ".raw")
        write_pair(std::filesystem::path(file).replace_extension(".json"), file, {data, size});
    else
        write_bytes(file, {data, size});
    if (ending == ".exr") check_image(file);
    check_refusal(file.parent_path(), [&] { read_volume(file); });
    return 0;
}
