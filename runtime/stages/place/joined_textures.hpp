// SPDX-License-Identifier: Apache-2.0
// The textures of several grids in one array, those of equal grids once.
#pragma once

#include <cstdint>
#include <map>
#include <utility>

namespace voxelume {

/// Where the textures of each grid begin in the array that they are joined to.
class JoinedTextures {
  public:
    /// Adds the textures of a grid, which have `words`, unless equal ones are there; true if it
    /// did.
    bool add(uint64_t key, uint64_t words) {
        if (words == 0 || !places_.try_emplace({key, words}, words_).second) return false;
        words_ += words;
        return true;
    }

    /// Where textures begin that were added; 0 for those of no words.
    uint64_t place(uint64_t key, uint64_t words) const {
        const auto found = places_.find({key, words});
        return found == places_.end() ? 0 : found->second;
    }

    /// The number of 32-bit words that all textures take.
    uint64_t words() const { return words_; }

  private:
    std::map<std::pair<uint64_t, uint64_t>, uint64_t> places_;  ///< by keys and words
    uint64_t words_ = 0;
};

}  // namespace voxelume
