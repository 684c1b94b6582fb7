// SPDX-License-Identifier: Apache-2.0
// The textures of several grids in one array, with equal ones stored once.
#pragma once

#include <cstdint>
#include <map>
#include <utility>

namespace voxelume {

/// The positions of each grid's textures in the array that they are joined to.
class JoinedTextures {
  public:
    /// Adds a grid's textures, which have `words` words, unless equal ones were added before.
    /// Returns true if it did.
    bool add(uint64_t key, uint64_t words) {
        if (words == 0 || !first_words_.try_emplace({key, words}, words_).second) return false;
        words_ += words;
        return true;
    }

    /// The position of textures that were added; 0 for textures without words.
    uint64_t first_word(uint64_t key, uint64_t words) const {
        const auto found = first_words_.find({key, words});
        return found == first_words_.end() ? 0 : found->second;
    }

    /// The number of 32-bit words of all textures.
    uint64_t words() const { return words_; }

  private:
    std::map<std::pair<uint64_t, uint64_t>, uint64_t> first_words_;  ///< by key and number of words
    uint64_t words_ = 0;
};

}  // namespace voxelume
