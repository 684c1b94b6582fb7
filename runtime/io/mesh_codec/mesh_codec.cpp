// SPDX-License-Identifier: Apache-2.0
#include "runtime/io/mesh_codec/mesh_codec.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <atomic>
#include <iterator>

#include "runtime/base/error.hpp"
#include "runtime/base/helper/helper_program.hpp"
#include "runtime/base/helper/helper_wire.hpp"
#include "runtime/base/helper/memory_file.hpp"

namespace voxelume {
namespace {

constexpr uint64_t kMaxElements = uint64_t{1} << 31;
constexpr uint64_t kMaxDecoded = uint64_t{16} << 30;

/// The maximum number of bytes that a byte of data decodes to. meshoptimizer's vertices take at
/// least 2 bits for 16 bytes, its triangles a byte each. Draco's entropy coder has no minimum size,
/// so its limit is a guess; the helper that runs it has a limit of memory.
uint64_t max_decoded_of_byte(MeshCodec codec) {
    return codec == MeshCodec::draco ? 8192 : codec == MeshCodec::meshopt_vertices ? 64 : 12;
}

void check(const std::filesystem::path& file, const CodecJob& job) {
    const CodecTask& task = job.task;
    const SourcePlace place(file.string());
    if (task.count >= kMaxElements || task.indices >= kMaxElements)
        throw Error(ErrorKind::limit,
                    "{}: {}: {} elements and {} indices; fewer than 2^31 are read", place,
                    job.place, task.count, task.indices);
    if (task.decoded_bytes() / max_decoded_of_byte(task.codec) > job.input.size())
        throw Error(ErrorKind::input,
                    "{}: {}: declares {} bytes, more than its {} compressed ones can hold; it is "
                    "damaged",
                    place, job.place, task.decoded_bytes(), job.input.size());
}

CodecArrays receive(WireReceiver& receiver, const CodecTask& task) {
    CodecArrays arrays;
    const auto take = [&](uint64_t min, uint64_t max) {
        arrays.push_back(receiver.values<uint8_t>(max));
        if (arrays.back().size() < min) WireReceiver::fail();
    };
    if (task.codec != MeshCodec::draco) {
        take(task.count * task.stride, task.count * task.stride);
        return arrays;
    }
    take(0, 4 * task.indices);
    for (size_t i = 0; i < task.attribute_count; ++i) {
        const uint64_t bytes = task.count * task.attributes[i].bytes();
        take(bytes, bytes);
    }
    return arrays;
}

/// A range of bytes that inputs of jobs share, or that joins adjacent inputs.
struct Part {
    const uint8_t *begin, *end;
    uint64_t first_byte;  ///< in the request
};

/// The jobs' inputs in their order in memory, with each byte once.
std::vector<Part> parts_of(std::span<const CodecJob> jobs, uint64_t first_byte) {
    std::vector<std::span<const uint8_t>> inputs;
    inputs.reserve(jobs.size());
    for (const CodecJob& job : jobs) inputs.push_back(job.input);
    std::ranges::sort(inputs, {}, [](const auto& input) { return input.data(); });
    std::vector<Part> parts;
    for (const std::span<const uint8_t> input : inputs) {
        const uint8_t* const end = input.data() + input.size();
        if (parts.empty() || input.data() > parts.back().end) {
            if (!parts.empty()) first_byte += uint64_t(parts.back().end - parts.back().begin);
            parts.push_back({input.data(), end, first_byte});
        } else if (end > parts.back().end) {
            parts.back().end = end;
        }
    }
    return parts;
}

std::atomic<bool> decoder_is_allowed = true;

void send(const MemoryFile& request, const CodecRequest& header, std::span<const CodecJob> jobs) {
    request.append(&header, sizeof header);
    const std::vector<Part> parts = parts_of(jobs, sizeof header + jobs.size() * sizeof(CodecTask));
    for (const CodecJob& job : jobs) {
        const Part& part =
            *std::prev(std::ranges::upper_bound(parts, job.input.data(), {}, &Part::begin));
        CodecTask task = job.task;
        task.first_byte = part.first_byte + uint64_t(job.input.data() - part.begin);
        task.bytes = job.input.size();
        request.append(&task, sizeof task);
    }
    for (const Part& part : parts) request.append(part.begin, size_t(part.end - part.begin));
}

std::vector<CodecArrays> ask(const std::filesystem::path& file, const MemoryFile& request,
                             const CodecRequest& header, std::span<const CodecJob> jobs) {
    HelperProcess helper(helper_program(kMeshDecoderName), {VXL_VERSION}, request.descriptor(),
                         2.0 * double(codec_seconds(header)) + 20);
    WireReceiver receiver(helper);
    std::vector<CodecArrays> results;
    for (const CodecJob& job : jobs) {
        const auto answer = receiver.value<CodecAnswer>();
        if (answer == CodecAnswer::refusal)
            throw Error(ErrorKind::input, "{}: {}: {}", SourcePlace(file.string()), job.place,
                        receiver.text(1 << 12));
        if (answer != CodecAnswer::content) WireReceiver::fail();
        results.push_back(receive(receiver, job.task));
    }
    return results;
}

}  // namespace

uint64_t CodecTask::decoded_bytes() const {
    if (codec != MeshCodec::draco) return count * stride;
    uint64_t sum = 4 * indices;
    for (size_t i = 0; i < attribute_count; ++i) sum += count * attributes[i].bytes();
    return sum;
}

void allow_mesh_decoder(bool is_allowed) {
    decoder_is_allowed = is_allowed;
}

std::vector<CodecArrays> decode_meshes(const std::filesystem::path& file,
                                       std::span<const CodecJob> jobs) {
    if (!jobs.empty() && !decoder_is_allowed)
        throw Error(ErrorKind::input,
                    "{}: its meshes are compressed, which only the program {} decodes: set "
                    "isolate_readers of ProcessOptions, so that the library may start it",
                    SourcePlace(file.string()), kMeshDecoderName);
    CodecRequest header{jobs.size(), 0};
    for (const CodecJob& job : jobs) {
        check(file, job);
        header.decoded_bytes += job.task.decoded_bytes();
        if (header.decoded_bytes > kMaxDecoded)
            throw Error(ErrorKind::limit, "{}: its meshes have more than 16 GiB once decoded",
                        SourcePlace(file.string()));
    }
    if (jobs.empty()) return {};
    const MemoryFile request("compressed meshes");
    send(request, header, jobs);
    try {
        return ask(file, request, header, jobs);
    } catch (const HelperFailure& failure) {
        if (failure.cause() == HelperFailure::Cause::missing ||
            failure.cause() == HelperFailure::Cause::killed)
            throw Error(ErrorKind::input, "{}: its compressed meshes can't be read: {}",
                        SourcePlace(file.string()), failure.what());
        throw Error(ErrorKind::input,
                    "{}: its compressed meshes can't be read: {}, so the file is damaged; use "
                    "another copy of it",
                    SourcePlace(file.string()), failure.what());
    }
}

}  // namespace voxelume
