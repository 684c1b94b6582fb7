// SPDX-License-Identifier: Apache-2.0
// How far images may be apart before `diff` fails.
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
    std::optional<double> rmse;  ///< of a channel
    std::optional<double> flip;  ///< mean FLIP
    std::string above;           ///< pixels above the threshold: a number, or a percentage
    std::string ids;             ///< pixels of a channel with unequal ids, likewise
};

/// Declares --fail, --fail-above, --fail-ids and --fail-flip.
void add_limit_options(CLI::App& app, DiffLimits& limits);

/// Describes the first limit that is exceeded, as part of a sentence; nothing where none is.
/// Colours that aren't numbers exceed each limit of FLIP. A limit of the RMSE allows no unequal
/// ids, unless `ids` says how many.
std::optional<std::string> excess_of(const ImageDifference& difference, const DiffLimits& limits);

}  // namespace voxelume::cli
