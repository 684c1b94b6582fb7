// SPDX-License-Identifier: Apache-2.0
#include <xxhash.h>

#include <algorithm>
#include <memory>
#include <vector>

#include "runtime/base/files/stamp.hpp"
#include "runtime/io/volume/volume_exr.hpp"

namespace voxelume::volume_exr {

uint64_t find_checksum(const InputFile& file) {
    constexpr uint64_t kLongestHeader = uint64_t{1} << 20;
    std::string start(std::min(file.size(), kLongestHeader), '\0');
    file.read(0, start.data(), start.size());
    // An attribute consists of its name and its type, each followed by a zero byte, its length and
    // its value.
    const std::string head = std::string(kChecksumKey) + '\0' + "string" + '\0' +
                             char(kChecksumDigits) + std::string(3, '\0');
    const size_t found = start.find(head);
    if (found == std::string::npos || found + head.size() + kChecksumDigits > start.size())
        return 0;
    return found + head.size();
}

std::string compute_checksum(const InputFile& file, uint64_t offset) {
    const std::unique_ptr<XXH3_state_t, decltype(&XXH3_freeState)> state(XXH3_createState(),
                                                                         XXH3_freeState);
    XXH3_64bits_reset(state.get());
    std::vector<char> block(std::min<uint64_t>(file.size(), 1 << 20));
    for (uint64_t position = 0; position < file.size(); position += block.size()) {
        const uint64_t size = std::min<uint64_t>(block.size(), file.size() - position);
        file.read(position, block.data(), size);
        for (uint64_t i = offset; i < offset + kChecksumDigits; ++i)
            if (i >= position && i < position + size) block[i - position] = '0';
        if (position == 0)
            if (const auto check = stamp_check_offset({block.data(), size}))
                std::fill_n(block.data() + *check, kStampCheckDigits, '0');
        XXH3_64bits_update(state.get(), block.data(), size);
    }
    return fmt::format("{:016x}", XXH3_64bits_digest(state.get()));
}

}  // namespace voxelume::volume_exr
