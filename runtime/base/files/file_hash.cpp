// SPDX-License-Identifier: Apache-2.0
#include "runtime/base/files/file_hash.hpp"

#include <fmt/format.h>
#include <xxhash.h>

#include <algorithm>
#include <memory>
#include <vector>

namespace voxelume {
namespace {

/// Passes `count` bytes of a file from `first` on to `take`, in order.
template <class Take>
void for_blocks(const InputFile& file, uint64_t first, uint64_t count, const Take& take) {
    std::vector<char> block(size_t(std::min<uint64_t>(count, 1 << 20)));
    for (uint64_t done = 0; done < count; done += block.size()) {
        block.resize(size_t(std::min<uint64_t>(block.size(), count - done)));
        file.read(first + done, block.data(), block.size());
        take(block.data(), block.size());
    }
}

using HashState = std::unique_ptr<XXH3_state_t, decltype(&XXH3_freeState)>;

HashState new_state() {
    return {XXH3_createState(), &XXH3_freeState};
}

}  // namespace

std::string hash_of_file(const std::filesystem::path& file) try {
    const InputFile input(file);
    const HashState state = new_state();
    XXH3_128bits_reset(state.get());
    for_blocks(input, 0, input.size(), [&](const char* bytes, size_t size) {
        XXH3_128bits_update(state.get(), bytes, size);
    });
    const XXH128_hash_t hash = XXH3_128bits_digest(state.get());
    return fmt::format("{:016x}{:016x}", hash.high64, hash.low64);
} catch (const Error&) {
    return {};
}

uint64_t hash_of_bytes(const InputFile& file, uint64_t first, uint64_t count) {
    const HashState state = new_state();
    XXH3_64bits_reset(state.get());
    for_blocks(file, first, count, [&](const char* bytes, size_t size) {
        XXH3_64bits_update(state.get(), bytes, size);
    });
    return XXH3_64bits_digest(state.get());
}

}  // namespace voxelume
