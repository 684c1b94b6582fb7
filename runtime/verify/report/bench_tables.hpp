// SPDX-License-Identifier: Apache-2.0
// A bench's rows as text for people, spreadsheets and programs.
#pragma once

#include <nlohmann/json_fwd.hpp>
#include <string>
#include <vector>

#include "runtime/verify/bench/bench.hpp"

namespace voxelume {

struct FrontComparison;

/// Lines of columns: first the rows, then the fitted slopes, light, other programs, and global
/// light.
std::string bench_text(const BenchReport& report);

/// A table after RFC 4180: a line of names with units, then one line per row, also of global light.
/// What a row doesn't have is empty.
std::string bench_csv(const BenchReport& report);

/// Everything in the report. An interval without bounds is null.
nlohmann::ordered_json bench_json(const BenchReport& report);

/// Parts of it: a slope, times by stage, and comparisons of fronts, whose errors are called
/// `error`: "depth_rms_metres".
nlohmann::ordered_json json_of(const SlopeFit& fit);
nlohmann::ordered_json json_of(const BenchTimes& times);
nlohmann::ordered_json json_of(const std::vector<FrontComparison>& comparisons,
                               const std::string& error);

/// A slope as text: "2.98 +- 0.03 (5 rows)", "2.98 (2 rows)" without an interval, "- (1 rows)"
/// without a slope.
std::string slope_text(const SlopeFit& fit);

/// The level of errors of `exact`, which don't decrease with the size of voxels: "9.2e-08 to
/// 3.4e-07 m, at most 1.4 floats". The last number is in spacings of floats at the scene's
/// distance. Empty for other surfaces.
std::string level_text(const BenchFit& fit);

/// The slopes that theory promises, as text for people; empty where it promises nothing.
struct ExpectedSlopes {
    const char* depth = "";
    const char* normal = "";
};
ExpectedSlopes expected_slopes(const std::string& scene, Surface surface);

}  // namespace voxelume
