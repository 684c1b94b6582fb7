// SPDX-License-Identifier: Apache-2.0
// Run time against error: subjects with a known truth, shown by every surface at every voxel size.
#pragma once

#include <cmath>
#include <functional>
#include <glm/vec2.hpp>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "runtime/opencl/device.hpp"
#include "runtime/verify/bench/bench_errors.hpp"
#include "runtime/verify/bench/bench_global.hpp"
#include "runtime/verify/bench/bench_peers.hpp"
#include "runtime/verify/bench/bench_shadow.hpp"
#include "runtime/verify/bench/bench_subject.hpp"
#include "runtime/verify/bench/bench_times.hpp"
#include "runtime/verify/bench/convergence.hpp"

namespace voxelume {

struct BenchOptions {
    std::vector<const BenchEntry*> subjects;
    std::vector<int> resolutions;  ///< voxels per metre, ascending; each subject uses those in its
                                   ///< range
    int finest_with_light = 1024;  ///< maximum resolution of subjects with light
    std::vector<int> samples = {
        1};  ///< rays per pixel, ascending; more than 1 only for subjects with light
    std::vector<BenchPeerRow> peers;         ///< rows of other programs, for the same plots
    std::vector<GlobalScene> global_scenes;  ///< scenes in global light whose noise is measured
    std::vector<int> global_samples;         ///< per pixel, ascending
    std::vector<GlobalRow> global_peers;     ///< rows of other programs
    std::vector<Placement> placements = {Placement::world, Placement::instance};
    glm::ivec2 size{1024, 1024};      ///< pixels
    glm::ivec2 light_size{256, 256};  ///< pixels of scenes with light
    bool measures_shadows = true;     ///< true to measure also the shadow edges that subjects
                                      ///< without light cast
    int repeats = 3;  ///< maximum number of measured renders of each row after an unmeasured one;
                      ///< 0: the first one counts, unless it made kernels
};

/// One subject as one surface, in voxels of one size.
struct BenchRow {
    std::string scene;
    Surface surface = Surface::cubes;
    Placement placement = Placement::world;
    int samples = 1;        ///< rays per pixel; depth, normals and outline are measured with 1
    int resolution = 0;     ///< voxels per metre
    double voxel_size = 0;  ///< metres
    double min_radius = 0;  ///< minimum radius of curvature, metres; 0 for edges, or if unknown
    BenchTimes seconds;     ///< times of the repeat with the smallest total
    uint64_t voxels = 0;
    uint64_t world_bytes = 0;  ///< bytes of the world's pyramid
    uint64_t peak_bytes = 0;   ///< maximum of bytes on the device at once
    BenchErrors errors;
    double volume_error = NAN;      ///< relative; positive: too large; NaN: not measured
    double area_error = NAN;        ///< as volume_error
    ShadowErrors shadow{NAN, NAN};  ///< in pixels; NaN: not measured
    bool fits_depth = true;         ///< true if the row counts for the slope of the depth RMS
    bool fits_normal = true;        ///< true if the row counts for the slope of the normal RMS
    bool is_best = false;  ///< true on the Pareto front of total time and depth RMS in its scene
};

/// The rates at which the errors of one scene and surface decrease with the size of voxels.
struct BenchFit {
    std::string scene;
    Surface surface = Surface::cubes;
    Placement placement = Placement::world;
    SlopeFit depth;        ///< slope of the depth RMS, over the rows that count
    SlopeFit normal;       ///< slope of the normal RMS, over the rows that count
    SlopeFit volume;       ///< slope of the relative error, over all rows
    SlopeFit area;         ///< as volume
    double depth_min = 0;  ///< minimum of the depth RMS over all rows, metres
    double depth_max = 0;
    double depth_max_floats = 0;  ///< depth_max in spacings of floats at the scene's distance
};

struct BenchReport {
    std::string version, device, driver, platform, machine, time;
    int lanes = 0;
    glm::ivec2 size{0};
    glm::ivec2 light_size{0};
    int repeats = 0;
    std::vector<BenchRow> rows;
    std::vector<BenchFit> fits;
    std::vector<BenchPeerRow> peers;
    std::vector<GlobalRow> global_rows;  ///< rows of each scene: Voxelume's, then those of others
    std::vector<GlobalFit> global_fits;
};

std::string_view name_of(Surface surface);
const char* name_of(Placement placement);

/// The errors of a sphere stop decreasing at these measured values, because `smooth` keeps
/// distances in 16 bits.
inline constexpr double kDepthFloor = 5e-5;      // voxels, RMS
inline constexpr double kNormalFloor = 3.75e-3;  // degrees, RMS

/// Rows of `smooth` are fitted if their error exceeds this multiple of the floor, and ...
inline constexpr double kFloorFactor = 3;

/// ... if the solid's minimum radius of curvature is at least this many voxels, because the
/// gradients' stencils are three voxels wide.
inline constexpr double kMinVoxels = 3;

/// Computes everything that follows from the measured rows: marks the rows to fit and those on the
/// front, and fits.
void conclude(BenchReport& report);

/// The number of rows that the options request.
size_t count_rows(const BenchOptions& options);

/// Measures every row. `progress` is called with the number of rows done and of all rows. Throws
/// the Errors of rendering.
BenchReport run_bench(const Device& device, const BenchOptions& options,
                      const std::function<void(size_t done, size_t total)>& progress);

}  // namespace voxelume
