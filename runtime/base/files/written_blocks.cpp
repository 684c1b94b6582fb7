// SPDX-License-Identifier: Apache-2.0
#include "runtime/base/files/written_blocks.hpp"

#include <xxhash.h>

#include <algorithm>
#include <cstring>

namespace voxelume {

bool WrittenBlocks::put(uint64_t position, const char* data, size_t bytes, const ReadBytes& read) {
    if (bytes == 0) return true;
    const std::vector<char> zeros(size() < position ? kBlock : 0);
    while (size() < position)
        append(zeros.data(), size_t(std::min<uint64_t>(kBlock, position - size())));
    while (bytes > 0 && position < size()) {
        const uint64_t block = position / kBlock;
        const auto offset = size_t(position % kBlock);
        const size_t end = block < hashes_.size() ? kBlock : last_.size();
        const size_t now = std::min(bytes, end - offset);
        if (!patch(block, offset, data, now, read)) return false;
        position += now, data += now, bytes -= now;
    }
    append(data, bytes);
    return true;
}

bool WrittenBlocks::patch(uint64_t block, size_t offset, const char* data, size_t bytes,
                          const ReadBytes& read) {
    if (block == hashes_.size()) {
        std::memcpy(&last_[offset], data, bytes);
        return true;
    }
    std::vector<char> whole(kBlock);
    if (bytes < kBlock) {
        read(block * kBlock, whole.data(), kBlock);
        if (!match(block * kBlock, whole.data(), kBlock)) return false;
    }
    std::memcpy(&whole[offset], data, bytes);
    hashes_[block] = XXH3_64bits(whole.data(), kBlock);
    return true;
}

void WrittenBlocks::append(const char* data, size_t bytes) {
    while (bytes > 0) {
        const size_t now = std::min(bytes, kBlock - last_.size());
        if (now == kBlock) {
            hashes_.push_back(XXH3_64bits(data, kBlock));
        } else {
            last_.insert(last_.end(), data, data + now);
            if (last_.size() == kBlock) {
                hashes_.push_back(XXH3_64bits(last_.data(), kBlock));
                last_.clear();
            }
        }
        data += now, bytes -= now;
    }
}

bool WrittenBlocks::match(uint64_t position, const char* data, size_t bytes) const {
    if (position % kBlock != 0 || position + bytes > size()) return false;
    for (uint64_t block = position / kBlock; bytes > 0; ++block) {
        const bool is_full = block < hashes_.size();
        const size_t now = is_full ? kBlock : last_.size();
        if (bytes < now) return false;
        const bool is_same = is_full ? XXH3_64bits(data, now) == hashes_[block]
                                     : std::memcmp(data, last_.data(), now) == 0;
        if (!is_same) return false;
        data += now, bytes -= now;
    }
    return true;
}

}  // namespace voxelume
