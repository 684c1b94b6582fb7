// SPDX-License-Identifier: Apache-2.0
#include "cli/render/render_tally.hpp"

#include "cli/shared/tell.hpp"
#include "cli/shared/warnings.hpp"

namespace voxelume::cli {

void print_tally(const Tally& tally, double seconds) {
    constexpr size_t kMaxNames = 20;
    std::string names;
    for (size_t i = 0; i < tally.failed.size() && i < kMaxNames; ++i)
        names += (i == 0 ? "; failed: " : ", ") + tally.failed[i];
    if (tally.failed.size() > kMaxNames)
        names += fmt::format(" and {} more", tally.failed.size() - kMaxNames);
    tell("{} of {} rendered in {:.1f} s{}\n", tally.done, tally.done + tally.failed.size(), seconds,
         harmless_line(names));
}

}  // namespace voxelume::cli
