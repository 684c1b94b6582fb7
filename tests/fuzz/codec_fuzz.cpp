// SPDX-License-Identifier: Apache-2.0
// A libFuzzer target: any bytes as compressed meshes give arrays of the declared sizes or a clause
// that says why not. Formats are draco and meshopt. The first byte chooses what is asked for; what
// follows is decoded.
#include <stdexcept>

#include "runtime/io/mesh_codec/mesh_decoders.hpp"
#include "tests/fuzz/fuzz_name.hpp"
#include "tests/fuzz/refusals.hpp"

namespace {

using namespace voxelume;

/// A triangle's three vertices with positions and colours, as in the seeds.
CodecTask draco_task(uint8_t choice) {
    CodecTask task;
    task.count = 3 + choice / 16;
    task.indices = 3 * (1 + choice % 16);
    task.attribute_count = 2;
    task.attributes[0] = {0, 5126, 3};
    task.attributes[1] = {1, choice & 1 ? 5125u : 5121u, 3};
    return task;
}

CodecTask meshopt_task(uint8_t choice) {
    CodecTask task;
    task.codec = MeshCodec(1 + choice % 3);
    task.count = 3 * (1 + choice / 16);
    task.stride = task.codec == MeshCodec::meshopt_vertices ? 8 : choice & 4 ? 4 : 2;
    if (task.codec == MeshCodec::meshopt_vertices) task.filter = MeshoptFilter(choice / 3 % 4);
    return task;
}

void check_sizes(const CodecTask& task, const CodecArrays& arrays) {
    const auto check = [](bool is_right, const char* what) {
        if (!is_right) fail_fuzzing("an array of a wrong size", what);
    };
    if (task.codec != MeshCodec::draco)
        return check(arrays.size() == 1 && arrays[0].size() == task.count * task.stride, "values");
    check(arrays.size() == 1 + task.attribute_count, "arrays");
    check(arrays[0].size() <= 4 * task.indices, "indices");
    for (size_t i = 0; i < task.attribute_count; ++i)
        check(arrays[i + 1].size() == task.count * task.attributes[i].bytes(), "attributes");
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const uint8_t* data, size_t size) {
    if (size == 0) return 0;
    static const bool is_draco = fuzzes("draco");
    const CodecTask task = is_draco ? draco_task(data[0]) : meshopt_task(data[0]);
    const auto decode = is_draco ? decode_draco : decode_meshopt;
    try {
        check_sizes(task, decode(task, std::span(data + 1, size - 1)));
    } catch (const std::runtime_error&) {
    } catch (const std::bad_alloc&) {  // the helper's limit
    }
    return 0;
}
