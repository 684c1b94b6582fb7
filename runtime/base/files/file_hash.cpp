// SPDX-License-Identifier: Apache-2.0
#include "runtime/base/files/file_hash.hpp"

#include <fmt/format.h>
#include <xxhash.h>

#include <algorithm>
#include <memory>
#include <vector>

#include "runtime/base/files/input_file.hpp"

namespace voxelume {

std::string hash_of_file(const std::filesystem::path& file) {
    const std::unique_ptr<XXH3_state_t, decltype(&XXH3_freeState)> state(XXH3_createState(),
                                                                         &XXH3_freeState);
    XXH3_128bits_reset(state.get());
    try {
        const InputFile input(file);
        std::vector<char> block(size_t{1} << 20);
        for (uint64_t at = 0; at < input.size(); at += block.size()) {
            block.resize(std::min<uint64_t>(block.size(), input.size() - at));
            input.read(at, block.data(), block.size());
            XXH3_128bits_update(state.get(), block.data(), block.size());
        }
    } catch (const Error&) {
        return {};
    }
    const XXH128_hash_t hash = XXH3_128bits_digest(state.get());
    return fmt::format("{:016x}{:016x}", hash.high64, hash.low64);
}

}  // namespace voxelume
