// SPDX-License-Identifier: Apache-2.0
// The limits on the difference of images beyond which `diff` fails.
#pragma once

#include <optional>
#include <string>

#include "runtime/voxelume.hpp"

// NOLINTNEXTLINE(readability-identifier-naming): the library's own name
namespace CLI {
class App;
}

namespace voxelume::cli {

struct DiffLimits {
    std::optional<double> rmse;  ///< RMSE of any channel
    std::optional<double> flip;  ///< mean FLIP
    std::string above;           ///< pixels above the threshold: a number, or a percentage
    std::string ids;             ///< pixels of a channel with unequal ids: number or percentage
};

/// Declares --fail, --fail-above, --fail-ids and --fail-flip.
void add_limit_options(CLI::App& app, DiffLimits& limits);

/// Describes the first exceeded limit, as part of a sentence; empty if none is exceeded. Colours
/// that aren't numbers exceed every limit on FLIP. A limit on the RMSE allows no unequal ids,
/// unless `ids` gives their number.
std::optional<std::string> excess_of(const ImageDifference& difference, const DiffLimits& limits);

}  // namespace voxelume::cli
