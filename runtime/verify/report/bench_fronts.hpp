// Where other programs are quicker at equal error, and where they aren't.
#pragma once

#include <string>
#include <utility>
#include <vector>

namespace voxelume {

struct BenchReport;

/// What nothing of the same program beats: errors (metres) and the seconds that they take, errors
/// falling and seconds growing.
using ErrorFront = std::vector<std::pair<double, double>>;

/// The front of such pairs in any order; those that aren't positive are left out.
ErrorFront error_front(const std::vector<std::pair<double, double>>& errors_and_seconds);

/// Errors between which one program is the quicker one.
struct FrontPiece {
    double coarse = 0, fine = 0;      ///< metres; the piece goes from the one down to the other
    double minimum = 0, maximum = 0;  ///< other's seconds over ours: both above 1, or both below
};

/// The pieces of two fronts from the error `coarse` down to the finest that both reach. Between
/// their points fronts are straight lines of logarithms, and a program takes no longer for a
/// coarser image than its front has.
std::vector<FrontPiece> compare_fronts(const ErrorFront& ours, const ErrorFront& other,
                                       double coarse);

/// Another program on one scene.
struct FrontComparison {
    std::string program, scene;
    std::vector<FrontPiece> pieces;             ///< errors falling
    double finest_ours = 0, finest_theirs = 0;  ///< metres
};

/// For each program and scene of the report's peers, in their order, from the coarsest of the
/// program's rows on.
std::vector<FrontComparison> front_comparisons(const BenchReport& report);

/// "sphere: Embree is up to 5.6 times as quick from 0.019 m of depth RMS down to 2.1e-05 m; ..."
std::string sentence_of(const FrontComparison& comparison);

}  // namespace voxelume
