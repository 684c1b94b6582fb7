// SPDX-License-Identifier: Apache-2.0
#include "runtime/base/files/file_hash.hpp"

#include <fmt/format.h>
#include <xxhash.h>

#include <fstream>
#include <memory>
#include <vector>

namespace voxelume {

std::string hash_of_file(const std::filesystem::path& file) {
    std::error_code error;
    if (!std::filesystem::is_regular_file(file, error)) return {};
    const std::unique_ptr<XXH3_state_t, decltype(&XXH3_freeState)> state(XXH3_createState(),
                                                                         &XXH3_freeState);
    XXH3_128bits_reset(state.get());
    std::ifstream stream(file, std::ios::binary);
    if (!stream) return {};
    std::vector<char> block(size_t{1} << 20);
    while (stream.read(block.data(), std::streamsize(block.size())) || stream.gcount() > 0)
        XXH3_128bits_update(state.get(), block.data(), size_t(stream.gcount()));
    if (stream.bad()) return {};
    const XXH128_hash_t hash = XXH3_128bits_digest(state.get());
    return fmt::format("{:016x}{:016x}", hash.high64, hash.low64);
}

}  // namespace voxelume
