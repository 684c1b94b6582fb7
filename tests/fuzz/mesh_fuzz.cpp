// SPDX-License-Identifier: Apache-2.0
// A libFuzzer target: any bytes under a mesh's name give a valid Mesh or an error's sentence.
#include "runtime/io/gltf/gltf_mesh.hpp"
#include "runtime/io/gltf/gltf_motion.hpp"
#include "runtime/io/mesh/mesh_reader.hpp"
#include "tests/fuzz/fuzz_name.hpp"
#include "tests/fuzz/refusals.hpp"
#include "tests/support/mesh_invariants.hpp"

namespace {

voxelume::Mesh mesh_of(const std::string& bytes) {
    using namespace voxelume;
    if (!is_gltf_file(fuzz_name())) return parse_mesh(bytes, fuzz_name());
    const GltfFile file(bytes, fuzz_name());
    for (size_t clip = 0; clip < file.root().size("animations"); ++clip)
        GltfMotion(file, gltf_clip(file, clip));
    return gltf_mesh(file, 0);
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const uint8_t* data, size_t size) {
    using namespace voxelume;
    const std::string bytes(reinterpret_cast<const char*>(data), size);
    check_refusal(fuzz_name(), [&] {
        const std::string broken = broken_invariant(mesh_of(bytes));
        if (!broken.empty()) fail_fuzzing("invalid mesh", broken);
    });
    return 0;
}
