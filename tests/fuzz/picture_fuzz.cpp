// SPDX-License-Identifier: Apache-2.0
// A libFuzzer target: any bytes give a whole picture or an error's sentence, and any text of a
// library of materials is read.
#include "runtime/io/image/picture.hpp"
#include "runtime/io/image/radiance_picture.hpp"
#include "runtime/io/mesh/material_library.hpp"
#include "tests/fuzz/fuzz_name.hpp"
#include "tests/fuzz/refusals.hpp"

extern "C" int LLVMFuzzerTestOneInput(const uint8_t* data, size_t size) {
    using namespace voxelume;
    static const std::filesystem::path name = fuzz_name();
    if (name.extension() == ".mtl") {
        parse_material_library({reinterpret_cast<const char*>(data), size});
        return 0;
    }
    check_refusal(name, [&] {
        if (name.extension() == ".hdr") {
            const ColorPicture colors = parse_radiance({data, size}, name, 1 << 20);
            if (colors.values.size() != 3 * size_t(colors.width) * size_t(colors.height))
                fail_fuzzing("a picture with colours missing", name.string());
            return;
        }
        const Picture picture = name.extension() == ".png" ? parse_png({data, size}, name, 1 << 20)
                                                           : parse_jpeg({data, size}, name);
        if (picture.pixels.size() != size_t(picture.width) * size_t(picture.height))
            fail_fuzzing("a picture with pixels missing", name.string());
    });
    return 0;
}
