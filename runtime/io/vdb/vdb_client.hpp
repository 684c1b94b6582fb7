// SPDX-License-Identifier: Apache-2.0
// The protocol between the module for OpenVDB and its helper program.
//
// The module starts `voxelume-vdb-reader VERSION PATH QUESTION...`. The
// questions are `summary`, `density GRID`, `model SURFACE` (its number) and `volume`. The answer is
// ReaderAnswer::content, what vdb_client.cpp receives, and ReaderAnswer::end; or a refusal and its
// sentence.
#pragma once

#include <cstdint>

namespace voxelume::vdb {

inline constexpr const char* kReaderName = "voxelume-vdb-reader";

enum class ReaderAnswer : uint32_t {
    refusal = 0x56444201,
    content = 0x56444202,
    end = 0x56444203,
};

/// The limits of a reader.
struct ReaderLimits {
    uint64_t reading_bytes = 0;  ///< bytes of address space, while OpenVDB reads
    uint64_t model_bytes = 0;    ///< while the voxels of a model are listed
    uint64_t computing_seconds = 0;
    double seconds = 0;  ///< by the clock, which includes waiting for a slow disk or a busy machine
};

/// The limits for a file of `bytes`. A tree in memory takes at most 40 times its bytes in a file,
/// where its nodes' masks aren't compressed, and the largest model 3 GB more. A damaged file that
/// declares more is refused in the half second that clearing 0.5 GB takes.
inline ReaderLimits reader_limits(uint64_t bytes) {
    const uint64_t seconds = 20 + bytes / 4'000'000, reading = (uint64_t{1} << 29) + 64 * bytes;
    return {reading, reading + (uint64_t{4} << 30), seconds, 40 + 3.0 * double(seconds)};
}

}  // namespace voxelume::vdb
