// SPDX-License-Identifier: Apache-2.0
// Compressed parts of meshes -> arrays, by the helper program voxelume-mesh-decoder.
//
// The helper is started as `voxelume-mesh-decoder VERSION`. Its input is a CodecRequest, that many
// CodecTasks, and the compressed bytes. For each task it answers CodecAnswer::content and the
// arrays, or CodecAnswer::refusal and a sentence, which is the end.
#pragma once

#include <array>
#include <cstdint>
#include <filesystem>
#include <span>
#include <string>
#include <vector>

namespace voxelume {

inline constexpr const char* kMeshDecoderName = "voxelume-mesh-decoder";

enum class MeshCodec : uint32_t { draco, meshopt_vertices, meshopt_triangles, meshopt_indices };

enum class MeshoptFilter : uint32_t { none, octahedral, quaternion, exponential };

enum class CodecAnswer : uint32_t { refusal = 0x4D434401, content = 0x4D434402 };

/// An attribute of vertices in Draco's data, and the form in which it is wanted.
struct DracoAttribute {
    uint32_t id = 0;
    uint32_t component_type = 0;  ///< glTF's number: 5120 to 5126
    uint32_t components = 0;

    uint64_t bytes() const {
        const uint32_t type = component_type;
        return components * uint64_t{type <= 5121 ? 1u : type <= 5123 ? 2u : 4u};
    }
};

inline constexpr size_t kMaxDracoAttributes = 32;

struct CodecTask {
    MeshCodec codec = MeshCodec::draco;
    MeshoptFilter filter = MeshoptFilter::none;
    uint64_t count = 0;    ///< elements; for Draco: vertices
    uint64_t stride = 0;   ///< bytes of an element; for Draco: unused
    uint64_t indices = 0;  ///< maximum number of indices, for Draco
    uint64_t first_byte = 0, bytes = 0;
    uint64_t attribute_count = 0;
    std::array<DracoAttribute, kMaxDracoAttributes> attributes{};

    /// The number of bytes of all arrays that come back.
    uint64_t decoded_bytes() const;
};

struct CodecRequest {
    uint64_t tasks = 0, decoded_bytes = 0;
};

/// The maximum memory of the helper for a request: arrays, and the libraries' own structures, which
/// are at most 8 times as large for Draco.
inline uint64_t codec_memory(const CodecRequest& request, uint64_t request_bytes) {
    return (uint64_t{1} << 28) + 2 * request_bytes + 10 * request.decoded_bytes;
}
inline uint64_t codec_seconds(const CodecRequest& request) {
    return 20 + request.decoded_bytes / 4'000'000;
}

/// A task of decoding. `place` follows the file in messages.
struct CodecJob {
    CodecTask task;
    std::span<const uint8_t> input;
    std::string place;
};

/// The arrays of a task: for meshoptimizer one of exactly the declared size; for Draco the indices
/// (32 bits each, at most as many as declared) and one for each attribute.
using CodecArrays = std::vector<std::vector<uint8_t>>;

/// Lets decode_meshes start its helper, or forbids it. It may until this is called.
void allow_mesh_decoder(bool is_allowed);

/// Decodes all jobs by one run of the helper. Throws Error::input for damaged data and where the
/// helper is forbidden, and
/// Error::limit or Error::input, before memory is taken, for more elements than so few bytes can
/// hold or than meshes may have.
std::vector<CodecArrays> decode_meshes(const std::filesystem::path& file,
                                       std::span<const CodecJob> jobs);

}  // namespace voxelume
