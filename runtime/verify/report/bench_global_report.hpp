// SPDX-License-Identifier: Apache-2.0
// A bench's rows of global light as text, plot and part of a page. All are empty without rows.
#pragma once

#include <nlohmann/json_fwd.hpp>
#include <string>
#include <vector>

#include "runtime/verify/bench/bench.hpp"
#include "runtime/verify/report/log_plot.hpp"

namespace voxelume {

/// Lines of columns: the rows of each scene, their slopes, and comparisons with other programs.
std::string global_text(const BenchReport& report);

/// A section with plots, rows and slopes.
std::string global_section(const BenchReport& report);

/// For each scene a plot of noise against the picture's time, with a curve for each program.
std::vector<LogPlot> global_plots(const BenchReport& report);

/// Rows, fits and fronts.
nlohmann::ordered_json global_json(const BenchReport& report);

/// A row's values by name, those of other rows among them.
nlohmann::ordered_json json_of(const GlobalRow& row);

}  // namespace voxelume
