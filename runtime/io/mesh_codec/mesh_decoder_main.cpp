// SPDX-License-Identifier: Apache-2.0
// The program voxelume-mesh-decoder: decodes compressed meshes for mesh_codec.cpp, under limits of
// its own. What damaged data do to its memory stays here.
#include <sys/mman.h>

#include <cstdlib>
#include <cstring>
#include <new>
#include <stdexcept>

#include "runtime/base/files/input_file.hpp"
#include "runtime/base/helper/helper_calls.hpp"
#include "runtime/base/helper/helper_limits.hpp"
#include "runtime/base/helper/helper_wire.hpp"
#include "runtime/io/mesh_codec/mesh_decoders.hpp"

namespace voxelume {
namespace {

void refuse(WireSender& sender, const std::string& clause) {
    sender.value(CodecAnswer::refusal);
    sender.text(clause);
}

void answer(WireSender& sender, const CodecTask& task, std::span<const uint8_t> input) {
    const CodecArrays arrays =
        task.codec == MeshCodec::draco ? decode_draco(task, input) : decode_meshopt(task, input);
    sender.value(CodecAnswer::content);
    for (const std::vector<uint8_t>& array : arrays) sender.values(array);
}

/// Answers the request and ends the process. Returns an exit code if it is another version's, or if
/// the limits can't be set.
int serve(int count, char** arguments) {
    if (count != 2 || std::strcmp(arguments[1], VXL_VERSION) != 0) return 2;
    const InputFile file(kMeshDecoderName, kHelperInput);
    CodecRequest request;
    file.read(0, &request, sizeof request);
    const uint64_t memory = codec_memory(request, file.size());
    if (!limit_helper({memory, memory, codec_seconds(request)})) return 3;
    void* const mapped = mmap(nullptr, file.size(), PROT_READ, MAP_PRIVATE, kHelperInput, 0);
    if (mapped == MAP_FAILED) return 4;
    forbid_system_calls();
    const std::span bytes(static_cast<const uint8_t*>(mapped), file.size());
    WireSender sender(kHelperAnswer);
    try {
        for (uint64_t i = 0; i < request.tasks; ++i) {
            CodecTask task;
            std::memcpy(&task, &bytes[sizeof request + i * sizeof task], sizeof task);
            answer(sender, task, bytes.subspan(task.first_byte, task.bytes));
        }
    } catch (const std::bad_alloc&) {
        refuse(sender, "its data declare more than they have; the file is damaged");
    } catch (const std::exception& error) {
        refuse(sender, error.what());
    }
    sender.flush();
    _exit(0);  // skips destructors: the heap may be damaged
}

}  // namespace
}  // namespace voxelume

int main(int count, char** arguments) {
    try {
        return voxelume::serve(count, arguments);
    } catch (const std::exception&) {
        return 5;
    }
}
