// SPDX-License-Identifier: Apache-2.0
// Voxelume held against the truth: exact arithmetic for what a device does, known surfaces and
// lights for what images show.
//
// The library libvoxelume has none of this: programs of this source tree link `voxelume_verify`
// in addition. `voxelume stress` and `voxelume bench` are made of these calls.
#pragma once

#include <cstdint>
#include <filesystem>
#include <functional>
#include <map>
#include <memory>
#include <stop_token>
#include <string>
#include <vector>

#include "voxelume.hpp"

namespace voxelume::v1 {

/// A new temporary folder of this user alone. Its last owner removes it with all that is in it, or
/// else the next process that makes one. Throws Error::output.
std::shared_ptr<const std::filesystem::path> make_temporary_folder();

/// A test of what devices do. A case costs about as much as `rays_per_case` rays.
struct StressTest {
    std::string name;
    std::string help;  ///< one line: what its cases are
    uint64_t rays_per_case = 1;
};

/// All tests, in the order in which they run.
std::vector<StressTest> stress_tests();

/// The choice of a test's cases. A case depends on the seed and its number alone.
struct StressOptions {
    uint64_t seed = 1;
    uint64_t first = 0;  ///< number of the first case
    uint64_t count = 0;  ///< number of cases
    /// Called after every batch with the number of its cases.
    std::function<void(uint64_t cases)> progress{};
    std::stop_token stop{};  ///< ends the run after the batch it is in
};

/// A case that came out wrong.
struct StressExample {
    uint64_t number = 0;  ///< StressOptions::first of a run of this case alone
    std::string text;     ///< the input, and what differs
};

struct StressResult {
    uint64_t cases = 0;
    uint64_t mismatches = 0;
    std::vector<StressExample> examples{};  ///< examples of the first kMaxStressExamples mismatches
};

inline constexpr size_t kMaxStressExamples = 5;

/// Runs cases of the test of that name. A run that is stopped returns what it has. Throws
/// Error::usage for an unknown name, and Error as devices do.
StressResult run_stress(const std::string& test, const Device& device,
                        const StressOptions& options);

/// A kernel of the program. No two have one name.
struct KernelName {
    std::string name;
    std::string file;  ///< below kernels/
};

/// All kernels, by file.
std::vector<KernelName> kernel_names();

/// The number of launches of each kernel since the device was opened.
std::map<std::string, uint64_t> launches_of(const Device& device);

/// Repeats the self-test of an open device: arithmetic, long loops and walks whose answers are
/// known. Returns the first fault as a sentence for people, or an empty string if all answers are
/// right. Throws Error as devices do.
std::string fault_of_known_bits(const Device& device);

/// A scene whose truth is known.
struct BenchScene {
    std::string name;
    std::string help;          ///< one line
    bool is_available = true;  ///< true if the files that it needs are there
};

/// All scenes, in the order in which they are measured.
std::vector<BenchScene> bench_scenes();

/// The measurements to make: every surface of every scene at every voxel size.
struct BenchOptions {
    /// Empty: all that are available, or with `own_scenes` none.
    std::vector<std::string> scenes{};
    std::vector<int> resolutions{4, 8, 11, 16, 23, 32, 45, 64, 128, 256, 512, 1024};  ///< voxels/m
    int finest_with_light = 1024;        ///< voxels a metre of scenes with light, at most
    std::vector<int> samples{1, 4, 16};  ///< rays a pixel of scenes with light
    std::vector<Placement> placements{Placement::world, Placement::instance};
    Size size{1024, 1024};          ///< pixels
    Size light_size{256, 256};      ///< pixels of scenes with light
    bool measure_shadows = true;    ///< the edges that shadows have, too
    int repeats = 3;                ///< renders of each row, at most; 0: a single one
    std::filesystem::path peers{};  ///< rows of other programs, a file of tests/bench/bench_peers
                                    ///< or tests/bench/peers/path_peers.py
    /// Scenes whose noise in global light is measured, by the names of their rows. They have the
    /// sizes of their images.
    std::map<std::string, Scene> own_scenes{};
    std::vector<int> global_samples{1, 4, 16, 64, 256};  ///< rays a pixel in global light
};

/// The number of rows that the options ask for. Throws Error::usage for an unknown scene.
size_t count_bench_rows(const BenchOptions& options);

/// The results in every form in which they are read.
struct BenchReport {
    std::string device;
    std::string driver;
    std::string machine;
    int lanes = 1;
    std::string text;     ///< lines of columns for people
    std::string page;     ///< HTML with plots
    std::string csv;      ///< a line a row
    std::string picture;  ///< SVG: depth against time
    std::string json;     ///< everything
};

/// Measures every row. `progress` is called after each. Throws Error as rendering does, and
/// Error::input for a file of peers that can't be used.
BenchReport run_bench(const Device& device, const BenchOptions& options,
                      const std::function<void(size_t done, size_t total)>& progress = {});

}  // namespace voxelume::v1
