// A bench as one HTML file that needs nothing else: plots, slopes, rows.
#pragma once

#include <string>

#include "runtime/verify/bench/bench.hpp"

namespace voxelume {

/// A page without scripts and without anything from elsewhere.
std::string bench_page(const BenchReport& report);

}  // namespace voxelume
