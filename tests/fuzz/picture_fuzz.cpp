// SPDX-License-Identifier: Apache-2.0
// A libFuzzer target: any bytes give a whole picture or an error's sentence, and any text of a
// library of materials is read.
#include <cstdio>
#include <cstdlib>

#include "runtime/base/error.hpp"
#include "runtime/io/image/picture.hpp"
#include "runtime/io/mesh/material_library.hpp"

extern "C" int LLVMFuzzerTestOneInput(const uint8_t* data, size_t size) {
    using namespace voxelume;
    const std::filesystem::path name = VXL_FUZZ_NAME;
    if (name.extension() == ".mtl") {
        parse_material_library({reinterpret_cast<const char*>(data), size});
        return 0;
    }
    try {
        const Picture picture = name.extension() == ".png" ? parse_png({data, size}, name, 1 << 20)
                                                           : parse_jpeg({data, size}, name);
        if (picture.pixels.size() != size_t(picture.width) * size_t(picture.height)) std::abort();
    } catch (const Error& error) {
        const std::string sentence = error.what();
        if (!sentence.starts_with(VXL_FUZZ_NAME)) {
            std::fprintf(stderr, "no file in front of: %s\n", sentence.c_str());
            std::abort();
        }
    }
    return 0;
}
