// SPDX-License-Identifier: Apache-2.0
// Golden scenes under combinations of all properties in which devices may differ: lanes,
// work-groups, threads, sub-devices, options of the OpenCL compiler. It combines the stress cases
// D1 and D2.
#include <sys/wait.h>
#include <unistd.h>

#include <gtest/gtest.h>

#include <cstdio>
#include <set>
#include <stdexcept>

#include "tests/batch/device_image.hpp"
#include "tests/oracles/image_hash.hpp"
#include "tests/pictures/golden_hash.hpp"
#include "tests/pictures/small_scene.hpp"
#include "tests/support/exhaustive.hpp"
#include "tests/support/setting.hpp"

namespace voxelume {
namespace {

/// A way of rendering; bits and hashes must not depend on it.
struct Combination {
    int lanes;
    const char* work_group;  ///< VOXELUME_WORK_GROUP; "": each kernel's own
    const char* options;     ///< of the OpenCL compiler
    int threads;             ///< of each part
    int parts;               ///< parts of the CPU that share an image's tiles
};

std::string text_of(const Combination& c) {
    return fmt::format("{} lanes, work-group {}, {}, {} of {} threads", c.lanes,
                       *c.work_group ? c.work_group : "own", *c.options ? c.options : "optimized",
                       c.parts == 1 ? "one device" : "two halves", c.threads);
}

constexpr std::array kLanes = {1, 4, 8, 16};
constexpr std::array kWorkGroups = {"", "1", "24"};
constexpr std::array kOptions = {"", "-cl-opt-disable"};
constexpr std::array kCounts = {1, 2};  // of threads, of parts

/// All combinations. Those that share compiled kernels are neighbours.
std::vector<Combination> product() {
    std::vector<Combination> all;
    for (const char* work_group : kWorkGroups)
        for (const char* options : kOptions)
            for (const int lanes : kLanes)
                for (const int threads : kCounts)
                    for (const int parts : kCounts)
                        all.push_back({lanes, work_group, options, threads, parts});
    return all;
}

/// Combinations that contain each pair of lanes and work-groups once. The other settings are spread
/// over them so that every pair of values of any two settings occurs.
std::vector<Combination> covering_array() {
    std::vector<Combination> rows;
    for (size_t i = 0; i < kLanes.size(); ++i)
        for (size_t j = 0; j < kWorkGroups.size(); ++j)
            rows.push_back({kLanes[i], kWorkGroups[j], kOptions[(i + j) % 2],
                            kCounts[(i / 2 + j) % 2], kCounts[(i + i / 2 + j) % 2]});
    return rows;
}

std::array<std::string, 5> settings_of(const Combination& c) {
    return {std::to_string(c.lanes), c.work_group, c.options, std::to_string(c.threads),
            std::to_string(c.parts)};
}

/// The pairs of settings' values, as texts, that occur in the combinations.
std::set<std::string> pairs_in(const std::vector<Combination>& combinations) {
    std::set<std::string> pairs;
    for (const Combination& c : combinations) {
        const auto settings = settings_of(c);
        for (size_t a = 0; a < settings.size(); ++a)
            for (size_t b = a + 1; b < settings.size(); ++b)
                pairs.insert(fmt::format("{}={} {}={}", a, settings[a], b, settings[b]));
    }
    return pairs;
}

TEST(Matrix, CoveringArrayHasEveryPairOfValues) {
    EXPECT_EQ(pairs_in(covering_array()), pairs_in(product()));
    EXPECT_EQ(product().size(), 96u);
}

Image rendered_by(const std::vector<Device>& devices, const Scene& scene) {
    RenderReport report;
    return devices.size() == 1 ? render(devices[0], scene, report)
                               : *image_by(devices, scene, report);
}

std::vector<Device> cpu_in_parts(int parts) {
    if (parts == 1) return {Device::open("cpu")};
    std::vector<Device> devices = Device::open_all(fmt::format("all/{}", parts));
    std::erase_if(devices, [](const Device& device) { return !device.is_cpu(); });
    if (int(devices.size()) != parts) throw std::runtime_error("the CPU isn't cut");
    return devices;
}

/// The number of scenes whose bits differ from the golden ones; prints which they are.
int count_differing(const Combination& c, const std::vector<std::string>& scenes) {
    const Setting lanes("VOXELUME_LANES", std::to_string(c.lanes));
    const Setting work_group("VOXELUME_WORK_GROUP", c.work_group);
    const Setting options("VOXELUME_BUILD_OPTIONS", c.options);
    const Setting threads("POCL_MAX_PTHREAD_COUNT", std::to_string(c.threads * c.parts));
    const std::vector<Device> devices = cpu_in_parts(c.parts);
    for (const Device& device : devices)
        if (device.info().compute_units != c.threads)
            throw std::runtime_error(fmt::format("{} threads", device.info().compute_units));
    int differing = 0;
    for (const std::string& name : scenes) {
        const Image image = rendered_by(devices, small_scene(name, {96, 72}, 128));
        const std::string hash = fmt::format("{:016x}", oracle::image_hash(image));
        if (hash == golden_hash(name)) continue;
        ++differing;
        fmt::print("{} differs with {}: {}\n", name, text_of(c), hash);
    }
    return differing;
}

/// Starts `work` in its own process, which exits with its result, or with 255 if it fails. PoCL
/// reads the number of threads only once per process.
template <class Work>
pid_t start_in_own_process(const Work& work) {
    std::fflush(stdout);
    const pid_t child = fork();
    if (child != 0) return child;
    int result = 255;
    try {
        result = work();
    } catch (const std::exception& error) {
        fmt::print("{}\n", error.what());
    }
    std::fflush(stdout);
    _exit(result);
}

int result_of(pid_t child) {
    int status = 0;
    return waitpid(child, &status, 0) == child && WIFEXITED(status) ? WEXITSTATUS(status) : 255;
}

/// Scenes of cubes, mirrors and glass of triangles, smooth objects, instances, and paths. Their
/// kernels compile the fastest.
constexpr std::array kScenesInTurn = {"cubes", "prism", "turntable", "procession", "stage"};

TEST(Matrix, EveryPairOfSettingsGivesTheGoldenBits) {
    const std::vector<Combination> rows = covering_array();
    // Optimizing takes longest, and cubes take the least time.
    const auto scene_of = [&](size_t row) {
        if (is_exhaustive()) return kScenesInTurn[row % kScenesInTurn.size()];
        return kScenesInTurn[*rows[row].options ? row / 2 % kScenesInTurn.size() : 0];
    };
    // Two processes run at a time, because most of the time is one compiler's.
    for (size_t first = 0; first < rows.size(); first += 2) {
        std::array<pid_t, 2> children;
        for (size_t i = 0; i < 2; ++i)
            children[i] = start_in_own_process(
                [&] { return count_differing(rows[first + i], {scene_of(first + i)}); });
        for (size_t i = 0; i < 2; ++i)
            EXPECT_EQ(result_of(children[i]), 0)
                << scene_of(first + i) << ", " << text_of(rows[first + i]);
    }
}

std::vector<std::string> golden_scenes() {
    std::vector<std::string> names;
    for (const auto& entry : std::filesystem::directory_iterator(kScenes))
        if (golden_hash(entry.path().stem()) != "none") names.push_back(entry.path().stem());
    std::ranges::sort(names);
    return names;
}

/// All scenes with every combination, one test for each size of work-groups. Each takes up to half
/// an hour and runs only by name: matrix_test --gtest_also_run_disabled_tests
/// --gtest_filter='*Product*'.
class MatrixProduct : public testing::TestWithParam<const char*> {};

TEST_P(MatrixProduct, DISABLED_GivesTheGoldenBits) {
    const std::vector<std::string> scenes = golden_scenes();
    EXPECT_GE(scenes.size(), 14u);
    for (const Combination& c : product()) {
        if (c.work_group != std::string(GetParam())) continue;
        EXPECT_EQ(result_of(start_in_own_process([&] { return count_differing(c, scenes); })), 0);
        fmt::print("{} scenes: {}\n", scenes.size(), text_of(c));
        std::fflush(stdout);
    }
}

INSTANTIATE_TEST_SUITE_P(WorkGroups, MatrixProduct, testing::ValuesIn(kWorkGroups),
                         [](const auto& group) {
                             return *group.param ? fmt::format("Of{}", group.param) : "Own";
                         });

}  // namespace
}  // namespace voxelume
