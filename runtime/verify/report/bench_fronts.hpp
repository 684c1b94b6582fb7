// SPDX-License-Identifier: Apache-2.0
// The ranges of errors in which other programs are faster, and those in which they aren't.
#pragma once

#include <string>
#include <utility>
#include <vector>

namespace voxelume {

struct BenchReport;

/// The results of one program that none of its other results beats: errors, descending, and their
/// seconds, ascending.
using ErrorFront = std::vector<std::pair<double, double>>;

/// The front of such pairs, which come in any order. Pairs that aren't positive are left out.
ErrorFront error_front(const std::vector<std::pair<double, double>>& errors_and_seconds);

/// A range of errors in which one program is the quicker one.
struct FrontPiece {
    double coarse = 0, fine = 0;      ///< errors; the piece goes from `coarse` down to `fine`
    double minimum = 0, maximum = 0;  ///< other's seconds over ours; both at least 1, or both at
                                      ///< most 1
};

/// The pieces of two fronts from the error `coarse` down to the finest that both reach. Between
/// their points fronts are straight lines of logarithms. For an error coarser than its front's
/// first point, a program takes that point's time.
std::vector<FrontPiece> compare_fronts(const ErrorFront& ours, const ErrorFront& other,
                                       double coarse);

/// The words for errors in sentences: "from 0.019 m of depth RMS", "to 2.1e-05 m".
struct ErrorWords {
    const char* unit;
    const char* measure;
};
inline constexpr ErrorWords kDepthWords{" m", " of depth RMS"};
inline constexpr ErrorWords kNoiseWords{"", " of relative MSE"};

/// The comparison with another program on one scene.
struct FrontComparison {
    std::string program, scene;
    std::vector<FrontPiece> pieces;             ///< in descending order of errors
    double finest_ours = 0, finest_theirs = 0;  ///< in the unit of errors
    ErrorWords words = kDepthWords;
};

/// The comparisons for each program and scene of the report's peers, in their order: of depth
/// against total time, then of noise against the picture's time. Each starts at the coarsest of the
/// program's rows.
std::vector<FrontComparison> front_comparisons(const BenchReport& report);
std::vector<FrontComparison> noise_comparisons(const BenchReport& report);

/// A sentence such as "sphere: Embree is up to 5.6 times as quick from 0.019 m of depth RMS down to
/// 2.1e-05 m; ..."
std::string sentence_of(const FrontComparison& comparison);

}  // namespace voxelume
