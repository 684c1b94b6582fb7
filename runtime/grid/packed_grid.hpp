// SPDX-License-Identifier: Apache-2.0
// What the bytes of grids and of pyramids have in common: a frame, some counts, and then buffers.
#pragma once

#include <array>
#include <optional>
#include <string>
#include <string_view>

#include "runtime/grid/grid_frame.hpp"
#include "runtime/opencl/packed_buffers.hpp"

namespace voxelume {

/// The header before the buffers.
struct PackedHeader {
    GridFrame frame;
    std::array<uint32_t, 5> counts{};  ///< numbers whose meaning the caller knows
};

/// The bytes of a header and of the buffers that `for_each` passes to its argument, with their
/// names; empty if they are more than `max_bytes`. Waits for the device's queue.
template <class ForEach>
std::optional<std::string> packed_bytes(const PackedHeader& header, const ForEach& for_each,
                                        uint64_t max_bytes = UINT64_MAX) {
    PackedWriter writer(max_bytes);
    writer.put(header.frame.origin);  // one by one, since the struct has padding
    writer.put(header.frame.voxel_edge);
    writer.put(header.frame.size);
    writer.put(header.counts);
    for_each([&](const char*, const auto& buffer) { writer.put(buffer); });
    if (writer.is_too_large()) return std::nullopt;
    return writer.take();
}

/// Reads such bytes into the buffers that `for_each` passes; empty if the bytes aren't complete.
/// Throws Error::limit if the device's memory doesn't suffice.
template <class ForEach>
std::optional<PackedHeader> unpack_bytes(const Device& device, std::string_view bytes,
                                         const ForEach& for_each) {
    PackedReader reader(bytes);
    PackedHeader header;
    reader.take(header.frame.origin);
    reader.take(header.frame.voxel_edge);
    reader.take(header.frame.size);
    reader.take(header.counts);
    for_each([&](const char* name, auto& buffer) { reader.take(device, name, buffer); });
    if (!reader.is_done()) return std::nullopt;
    return header;
}

/// The bytes on the device of the buffers that `for_each` passes.
template <class ForEach>
uint64_t buffer_bytes(const ForEach& for_each) {
    uint64_t sum = 0;
    for_each([&]<class T>(const char*, const Buffer<T>& buffer) {
        sum += uint64_t(buffer.size() * sizeof(T));
    });
    return sum;
}

}  // namespace voxelume
