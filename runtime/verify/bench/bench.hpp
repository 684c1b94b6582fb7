// Run time against error: what has a known truth, shown by every surface at every voxel size.
#pragma once

#include <cmath>
#include <functional>
#include <glm/vec2.hpp>
#include <span>
#include <string>
#include <vector>

#include "runtime/opencl/device.hpp"
#include "runtime/verify/bench/bench_errors.hpp"
#include "runtime/verify/bench/bench_peers.hpp"
#include "runtime/verify/bench/bench_shadow.hpp"
#include "runtime/verify/bench/bench_subject.hpp"
#include "runtime/verify/bench/convergence.hpp"

namespace voxelume {

struct BenchOptions {
    std::vector<const BenchEntry*> subjects;
    std::vector<int> resolutions;  ///< voxels a metre, ascending; each subject takes its part
    int finest_with_light = 1024;  ///< of subjects with light: no more than that
    std::vector<int> samples = {
        1};  ///< rays a pixel, ascending; more than 1 for subjects with light
    std::vector<BenchPeerRow> peers;  ///< of other programs, for the same plots
    std::vector<Placement> placements = {Placement::world, Placement::instance};
    glm::ivec2 size{1024, 1024};      ///< pixels
    glm::ivec2 light_size{256, 256};  ///< pixels of scenes with light
    bool measures_shadows = true;     ///< the edges that subjects without light cast, too
    int repeats = 3;  ///< measured renders of each row, at most, after one that isn't; 0: that one
                      ///< counts, unless it made kernels
};

/// Seconds of one render.
struct BenchTimes {
    double load = 0, voxelize = 0, place = 0, index = 0;
    double image = 0;     ///< sight, trace, shade and resolve
    double total = 0;     ///< sum of all so far
    double kernels = 0;   ///< of it, kernels running on the device
    double programs = 0;  ///< of the first render, making kernels ready that weren't yet; no part
                          ///< of the total
};

/// One subject as one surface in voxels of one size.
struct BenchRow {
    std::string scene;
    Surface surface = Surface::cubes;
    Placement placement = Placement::world;
    int samples = 1;        ///< rays a pixel; depth, normals and outline are measured with 1
    int resolution = 0;     ///< voxels a metre
    double voxel_size = 0;  ///< metres
    double min_radius = 0;  ///< of curvature, metres; 0 for edges, or not known
    BenchTimes seconds;     ///< of the repeat with the least total
    uint64_t voxels = 0;
    uint64_t world_bytes = 0;  ///< of the world's pyramid
    uint64_t peak_bytes = 0;   ///< the most on the device at once
    BenchErrors errors;
    double volume_error = NAN;      ///< relative; positive: too large; NaN: not measured
    double area_error = NAN;        ///< likewise
    ShadowErrors shadow{NAN, NAN};  ///< likewise, pixels
    bool fits_depth = true;         ///< counts for the slope of the depth RMS
    bool fits_normal = true;        ///< likewise for normals
    bool is_best = false;  ///< on the Pareto front of total time and depth RMS in its scene
};

/// How fast the errors of one scene and surface fall with the size of voxels.
struct BenchFit {
    std::string scene;
    Surface surface = Surface::cubes;
    Placement placement = Placement::world;
    SlopeFit depth;        ///< of the RMS, over the rows that count
    SlopeFit normal;       ///< likewise
    SlopeFit volume;       ///< of the relative error, over all rows
    SlopeFit area;         ///< likewise
    double depth_min = 0;  ///< of the RMS of depth over all rows, metres
    double depth_max = 0;
    double depth_max_floats = 0;  ///< the latter in spacings of floats at the scene's distance
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
};

inline constexpr Surface kBenchSurfaces[] = {Surface::cubes, Surface::smooth, Surface::exact};
const char* name_of(Surface surface);
const char* name_of(Placement placement);

/// A row isn't measured again once its renders have taken this long.
inline constexpr double kMaxRowSeconds = 1;

/// `smooth` keeps distances in 16 bits. Measured: where the errors of a sphere stop falling.
inline constexpr double kDepthFloor = 5e-5;      // voxels, RMS
inline constexpr double kNormalFloor = 3.75e-3;  // degrees, RMS

/// Rows of `smooth` are fitted where their error is more than this many floors ...
inline constexpr double kFloorFactor = 3;

/// ... and the solid's least radius of curvature this many voxels, for the gradients' stencils are
/// three voxels wide.
inline constexpr double kMinVoxels = 3;

/// Marks the rows that are fitted and those on the front, and fits. Everything that follows from
/// rows that were measured.
void conclude(BenchReport& report);

/// How many rows the options ask for.
size_t count_rows(const BenchOptions& options);

/// Measures every row. `progress` is called with the rows done and their number. Throws Error as
/// rendering does.
BenchReport run_bench(const Device& device, const BenchOptions& options,
                      const std::function<void(size_t done, size_t total)>& progress);

}  // namespace voxelume
