// SPDX-License-Identifier: Apache-2.0
// The decoders of voxelume-mesh-decoder. Data that can't be decoded throw std::runtime_error with a
// clause that says why.
#pragma once

#include "runtime/io/mesh_codec/mesh_codec.hpp"

namespace voxelume {

CodecArrays decode_draco(const CodecTask& task, std::span<const uint8_t> input);
CodecArrays decode_meshopt(const CodecTask& task, std::span<const uint8_t> input);

}  // namespace voxelume
