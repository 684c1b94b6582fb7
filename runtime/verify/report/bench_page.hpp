// SPDX-License-Identifier: Apache-2.0
// A bench as one self-contained HTML file: plots, slopes, rows.
#pragma once

#include <string>

#include "runtime/verify/bench/bench.hpp"

namespace voxelume {

/// The page. It has no scripts and loads nothing from elsewhere.
std::string bench_page(const BenchReport& report);

}  // namespace voxelume
