// SPDX-License-Identifier: Apache-2.0
#include <fmt/format.h>
#include <meshoptimizer.h>

#include <stdexcept>

#include "runtime/io/mesh_codec/mesh_decoders.hpp"

namespace voxelume {
namespace {

/// The first byte of a stream names its codec and its version.
void check_version(MeshCodec codec, std::span<const uint8_t> input) {
    const bool is_vertices = codec == MeshCodec::meshopt_vertices;
    const uint8_t max_version = is_vertices ? 0 : 1, first = input.empty() ? 0 : input[0];
    const uint8_t kind = is_vertices ? 0xA0 : codec == MeshCodec::meshopt_triangles ? 0xE0 : 0xD0;
    if ((first & 0xF0) != kind)
        throw std::runtime_error("its data aren't those of its mode; the file is damaged");
    if ((first & 0x0F) > max_version)
        throw std::runtime_error(
            fmt::format("its data are of version {} of the codec, and {} is the last that is read; "
                        "export it for EXT_meshopt_compression",
                        first & 0x0F, max_version));
}

bool decode(const CodecTask& task, std::span<const uint8_t> input, uint8_t* data) {
    const uint8_t* const from = input.data();
    switch (task.codec) {
        case MeshCodec::meshopt_vertices:
            return !meshopt_decodeVertexBuffer(data, task.count, task.stride, from, input.size());
        case MeshCodec::meshopt_triangles:
            return !meshopt_decodeIndexBuffer(data, task.count, task.stride, from, input.size());
        default:
            return !meshopt_decodeIndexSequence(data, task.count, task.stride, from, input.size());
    }
}

void filter(const CodecTask& task, uint8_t* data) {
    switch (task.filter) {
        case MeshoptFilter::none:
            return;
        case MeshoptFilter::octahedral:
            return meshopt_decodeFilterOct(data, task.count, task.stride);
        case MeshoptFilter::quaternion:
            return meshopt_decodeFilterQuat(data, task.count, task.stride);
        case MeshoptFilter::exponential:
            return meshopt_decodeFilterExp(data, task.count, task.stride);
    }
}

}  // namespace

CodecArrays decode_meshopt(const CodecTask& task, std::span<const uint8_t> input) {
    check_version(task.codec, input);
    CodecArrays arrays(1);
    arrays[0].resize(task.count * task.stride);
    uint8_t* const data = arrays[0].data();
    if (!decode(task, input, data))
        throw std::runtime_error("its data can't be decoded; the file is damaged");
    filter(task, data);
    return arrays;
}

}  // namespace voxelume
