// SPDX-License-Identifier: Apache-2.0
// Plots of a bench's rows.
#pragma once

#include <string>
#include <vector>

#include "runtime/verify/bench/bench.hpp"
#include "runtime/verify/report/log_plot.hpp"

namespace voxelume {

/// Depth RMS against total time, for every surface, placement and other program. Rings mark the
/// front.
LogPlot time_plot(const BenchReport& report, const std::string& scene);

/// All plots of a scene.
std::vector<LogPlot> plots_of(const BenchReport& report, const std::string& scene);

/// The report's scenes, in its order.
std::vector<std::string> scenes_of(const BenchReport& report);

/// Depth against time as one picture: for the scenes that other programs showed, too. If there are
/// none, for all scenes but those with light.
std::string bench_picture(const BenchReport& report);

}  // namespace voxelume
