// A bench's rows as plots.
#pragma once

#include <string>
#include <vector>

#include "runtime/verify/bench/bench.hpp"
#include "runtime/verify/report/log_plot.hpp"

namespace voxelume {

/// Depth RMS against total time, of every surface, placement and other program; rings mark the
/// front.
LogPlot time_plot(const BenchReport& report, const std::string& scene);

/// All that there is to see of a scene.
std::vector<LogPlot> plots_of(const BenchReport& report, const std::string& scene);

/// A report's scenes, in its order.
std::vector<std::string> scenes_of(const BenchReport& report);

/// Depth against time as one picture: of the scenes that other programs showed, too, or without any
/// of all but those with light.
std::string bench_picture(const BenchReport& report);

}  // namespace voxelume
