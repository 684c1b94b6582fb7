// SPDX-License-Identifier: Apache-2.0
// The cache of compiled kernels on disk, tested with real processes: this program starts itself.
#include <gtest/gtest.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <cstdlib>
#include <fstream>
#include <thread>

#include "runtime/base/files/disk_cache.hpp"
#include "runtime/base/files/process_tag.hpp"
#include "runtime/opencl/program.hpp"
#include "runtime/opencl/program_cache.hpp"
#include "runtime/stages/features.hpp"
#include "tests/support/file_fixture.hpp"
#include "tests/support/own_process.hpp"
#include "tests/support/test_device.hpp"

namespace voxelume {
namespace {

using ProgramCacheFiles = FileTest;

namespace fs = std::filesystem;

/// The work of a process of these tests: builds two programs and launches one kernel of each,
/// `scale` unless VXL_TEST_KERNEL names the other. Returns how many were compiled.
int build_and_run() {
    const char* name = std::getenv("VXL_TEST_KERNEL");
    const std::string kernel = name ? name : "scale";
    const Device device = test_device();
    const uint32_t count = 37;
    for (int factor = 3; factor < 5; ++factor) {
        const Program program =
            Program::from_text(device,
                               "#include \"lib/lanes/work_item.h\"\n"
                               "kernel void scale(uint count, global uint* numbers) {\n"
                               "    if (work_item() >= count) return;\n"
                               "    numbers[work_item()] = FACTOR * work_item();\n"
                               "}\n"
                               "kernel void shift(uint count, global uint* numbers) {\n"
                               "    if (work_item() >= count) return;\n"
                               "    numbers[work_item()] = FACTOR + work_item();\n"
                               "}\n",
                               {{"FACTOR", factor}});
        Buffer<uint32_t> numbers(device, "numbers", count);
        program.kernel(kernel).launch(WorkItem::light, count, count, numbers);
        const std::vector<uint32_t> result = numbers.read();
        for (uint32_t i = 0; i < count; ++i)
            EXPECT_EQ(result[i], kernel == "scale" ? i * uint32_t(factor) : i + uint32_t(factor));
    }
    return int(device.counters().programs_built - device.counters().programs_from_cache);
}

/// The tests below run this in its own process; its exit code is 10 + the programs compiled.
TEST(ProgramCacheProcess, DISABLED_BuildsAndRuns) {
    const int compiled = build_and_run();
    if (!HasFailure()) std::exit(10 + compiled);
}

/// Runs a kernel with functions that lib/lanes/declared.h doesn't declare. Returns how many
/// programs were compiled.
int call_other_functions() {
    const Device device = test_device();
    const Program program = Program::from_text(
        device, "kernel void f(global uint* x) { *x = rotate(*x, 4u) + add_sat(*x, 1u); }\n");
    Buffer<uint32_t> number(device, "number", 1);
    number.fill(0xFFFFFFF5u);
    program.kernel("f").launch(WorkItem::heavy, 1, number);
    EXPECT_EQ(number.read()[0], 0xFFFFFF5Fu + 0xFFFFFFF6u);
    return int(device.counters().programs_built - device.counters().programs_from_cache);
}

/// Run in its own process; the exit code is 10 + the programs compiled.
TEST(ProgramCacheProcess, DISABLED_CallsOtherFunctions) {
    const int compiled = call_other_functions();
    if (!HasFailure()) std::exit(10 + compiled);
}

/// The number of compiled files of the kernel `keep_words` that are ready for PoCL.
int count_ready() {
    int count = 0;
    for (const auto& entry : fs::recursive_directory_iterator(cache_folder()))
        count += entry.path().filename() == "keep_words.so";
    return count;
}

/// Builds cut.cl together with shade.cl twice, with different constants, each time on its own
/// device and context, which stay open; keep_words runs on both. Returns for each build how many
/// compiled files of keep_words were ready after it.
std::array<int, 2> ready_when_joined() {
    constexpr std::array kFiles = {"cut.cl", "shade.cl"};
    const std::vector<uint32_t> slot = {0}, numbers(4096, 7);
    std::vector<Device> devices;
    std::array<int, 2> ready{};
    for (size_t i = 0; i < 2; ++i) {
        const Device& device = devices.emplace_back(Device::open("cpu"));
        Features features;
        (i == 0 ? features.cubes : features.smooth) = true;
        Program::build_together(device, kFiles, features.defines(device));
        ready[i] = count_ready();
        const Buffer<uint32_t> slots(device, "slots", std::span(slot)),
            from(device, "from", std::span(numbers)), words(device, "words", 4096);
        Program(device, "cut.cl", features.defines(device))
            .kernel("keep_words")
            .launch(WorkItem::heavy, 1, 1u, slots, from, 9u, words);
        EXPECT_EQ(words.read(), numbers);
    }
    return ready;
}

/// Run in its own process; the exit code is 10 + 3 x the ready files of the first program + those
/// of the second.
TEST(ProgramCacheProcess, DISABLED_JoinsAndRuns) {
    const auto [first, second] = ready_when_joined();
    if (!HasFailure()) std::exit(10 + 3 * first + second);
}

/// Starts `processes` processes at once on one cache folder; returns the number that each compiled,
/// -1 for a failure.
std::vector<int> compiled_by_processes(int processes, const std::string& environment,
                                       const char* work = "BuildsAndRuns") {
    const std::string test = fmt::format("ProgramCacheProcess.DISABLED_{}", work);
    std::vector<int> results(size_t(processes), -1);
    std::vector<std::thread> threads;
    for (int& result : results)
        threads.emplace_back([&test, &environment, &result] {
            const int code = run_own_test(test, environment);
            result = code < 10 ? -1 : code - 10;
        });
    for (std::thread& thread : threads) thread.join();
    return results;
}

bool device_keeps_programs() {
    return test_device().info().platform != "Oclgrind";
}

TEST_F(ProgramCacheFiles, ASecondRunCompilesNothing) {
    if (!device_keeps_programs()) GTEST_SKIP() << "this device's programs are not kept";
    const std::string environment = "VOXELUME_CACHE_DIR=" + folder.string();
    EXPECT_EQ(compiled_by_processes(1, environment), std::vector<int>{2});
    EXPECT_EQ(compiled_by_processes(1, environment), std::vector<int>{0});
}

/// The content of an entry must also serve kernels that no earlier run has launched.
TEST_F(ProgramCacheFiles, SoDoesOneWithAFunctionThatOurKernelsDoNotUse) {
    if (!device_keeps_programs()) GTEST_SKIP() << "this device's programs are not kept";
    const std::string environment = "VOXELUME_CACHE_DIR=" + folder.string();
    EXPECT_EQ(compiled_by_processes(1, environment, "CallsOtherFunctions"), std::vector<int>{1});
    EXPECT_EQ(compiled_by_processes(1, environment, "CallsOtherFunctions"), std::vector<int>{0});
}

TEST_F(ProgramCacheFiles, AKernelFirstLaunchedByALaterRunIsMadeOfTheKeptBitcode) {
    if (!device_keeps_programs()) GTEST_SKIP() << "this device's programs are not kept";
    const std::string environment = "VOXELUME_CACHE_DIR=" + folder.string();
    EXPECT_EQ(compiled_by_processes(1, environment), std::vector<int>{2});
    const auto bytes = [&] {
        uintmax_t sum = 0;
        for (const fs::directory_entry& entry : fs::directory_iterator(folder / "programs"))
            sum += entry.file_size();
        return sum;
    };
    const uintmax_t with_one = bytes();
    for (int run = 0; run < 2; ++run)
        EXPECT_EQ(compiled_by_processes(1, environment + " VXL_TEST_KERNEL=shift"),
                  std::vector<int>{0});
    EXPECT_GT(bytes(), with_one) << "the second kernel is kept, too";
    EXPECT_EQ(compiled_by_processes(1, environment), std::vector<int>{0});
}

/// VXL_STRESS_ROUNDS=12 starts the 96 processes with which PoCL's own folder fails.
TEST_F(ProgramCacheFiles, EightProcessesShareAColdFolder) {
    const char* text = std::getenv("VXL_STRESS_ROUNDS");
    const int rounds = text ? std::atoi(text) : 1;
    for (int round = 0; round < rounds; ++round) {
        const std::string environment =
            fmt::format("VOXELUME_CACHE_DIR={}/{}", folder.string(), round);
        for (const int compiled : compiled_by_processes(8, environment))
            EXPECT_GE(compiled, 0) << "round " << round;
        if (!device_keeps_programs()) continue;
        EXPECT_EQ(compiled_by_processes(1, environment), std::vector<int>{0});
    }
}

TEST_F(ProgramCacheFiles, OfProcessesThatStartTogetherOneCompiles) {
    if (!device_keeps_programs()) GTEST_SKIP() << "this device's programs are not kept";
    const std::string environment = "VOXELUME_CACHE_DIR=" + folder.string();
    std::vector<int> compiled = compiled_by_processes(4, environment);
    std::ranges::sort(compiled);
    EXPECT_EQ(compiled, (std::vector<int>{0, 0, 0, 2}));
    for (const fs::directory_entry& entry : fs::directory_iterator(folder / "programs"))
        EXPECT_NE(entry.path().extension(), ".turn") << entry.path();
}

TEST_F(ProgramCacheFiles, DamagedEntriesAreCompiledAgain) {
    if (!device_keeps_programs()) GTEST_SKIP() << "this device's programs are not kept";
    const std::string environment = "VOXELUME_CACHE_DIR=" + folder.string();
    ASSERT_EQ(compiled_by_processes(1, environment), std::vector<int>{2});
    for (const double kept : {0.0, 0.7}) {
        int entries = 0;
        for (const fs::directory_entry& entry : fs::directory_iterator(folder / "programs")) {
            fs::resize_file(entry.path(), uintmax_t(double(entry.file_size()) * kept));
            ++entries;
        }
        // Programs, and with PoCL their kernels; those of the driver's self-test, too.
        ASSERT_EQ(entries, keeps_pocl_folder(test_device().info()) ? 7 : 3);
        EXPECT_EQ(compiled_by_processes(1, environment), std::vector<int>{2}) << kept;
        EXPECT_EQ(compiled_by_processes(1, environment), std::vector<int>{0}) << kept;
    }
}

/// An entry with the right checksum, which only its user can make, still writes nowhere else.
TEST_F(ProgramCacheFiles, EntriesThatNameFilesElsewhereWriteNothingAndAreReplaced) {
    if (!keeps_pocl_folder(test_device().info())) GTEST_SKIP() << "files are PoCL's";
    const std::string environment = "VOXELUME_CACHE_DIR=" + folder.string();
    ASSERT_EQ(compiled_by_processes(1, environment), std::vector<int>{2});
    const DiskCache cache(folder / "programs", 1 << 20);
    for (const std::string& name :
         {(folder / "planted.so").string(), std::string("../planted.so"),
          std::string("AB/../../planted.so"), std::string("AB/CD/planted.sh")}) {
        for (const fs::directory_entry& entry : fs::directory_iterator(folder / "programs"))
            cache.write(entry.path().filename(), fmt::format("4 AB/good.so\ntext4 {}\ntext", name));
        EXPECT_EQ(compiled_by_processes(1, environment), std::vector<int>{2}) << name;
        for (const fs::directory_entry& entry : fs::recursive_directory_iterator(folder))
            EXPECT_NE(entry.path().stem(), "planted") << entry.path();
        EXPECT_EQ(compiled_by_processes(1, environment), std::vector<int>{0}) << name;
    }
}

/// Others could put kernels of theirs into it.
TEST_F(ProgramCacheFiles, AFolderThatOthersMayWriteToIsNotUsed) {
    if (!device_keeps_programs()) GTEST_SKIP() << "this device's programs are not kept";
    fs::create_directory(folder / "open");
    fs::permissions(folder / "open", fs::perms::all);
    const std::string environment =
        fmt::format("VOXELUME_CACHE_DIR={0}/open TMPDIR={0}/open", folder.string());
    EXPECT_EQ(compiled_by_processes(1, environment), std::vector<int>{2});
    for (const fs::directory_entry& entry : fs::directory_iterator(folder / "open"))
        EXPECT_FALSE(entry.path().filename().string().starts_with("pocl")) << entry.path();
}

TEST(ProgramCache, WithoutAFolderEveryRunCompiles) {
    EXPECT_EQ(compiled_by_processes(1, "VOXELUME_CACHE_DIR="), std::vector<int>{2});
    EXPECT_EQ(compiled_by_processes(1, "VOXELUME_CACHE_DIR=/proc/none"), std::vector<int>{2});
}

TEST_F(ProgramCacheFiles, KernelsServeEveryProgramThatHoldsThem) {
    if (!keeps_pocl_folder(test_device().info())) GTEST_SKIP() << "files are PoCL's";
    const std::string environment = "VOXELUME_CACHE_DIR=" + folder.string();
    EXPECT_EQ(compiled_by_processes(1, environment, "JoinsAndRuns"), std::vector<int>{0 + 2})
        << "the second's from the first's";
    EXPECT_EQ(compiled_by_processes(1, environment, "JoinsAndRuns"), std::vector<int>{3 + 2});
}

/// The number of a killed process may be another's since; when that one started tells.
TEST_F(ProgramCacheFiles, FoldersOfKilledProcessesAreRemovedAndNoOthers) {
    if (!device_keeps_programs()) GTEST_SKIP() << "this device's programs are not kept";
    const std::string own = process_tag();
    const std::string killed = "pocl." + own.substr(0, own.rfind('.')) + ".12345-aBc012";
    const std::string living = "pocl." + own + "-aBc012";
    const std::array<std::string, 5> others = {"pocl", "pocl-src", "pocl.git", "pocl-1-abc",
                                               "poclwork.1.2-abcdef"};
    fs::create_directories(folder / killed / "AB");
    fs::create_directories(folder / living / "AB");
    for (const std::string& name : others) {
        fs::create_directory(folder / name);
        fs::last_write_time(folder / name,
                            fs::file_time_type::clock::now() - std::chrono::hours(2));
    }
    compiled_by_processes(1, "VOXELUME_CACHE_DIR=" + folder.string());
    EXPECT_FALSE(fs::exists(folder / killed));
    EXPECT_TRUE(fs::exists(folder / living)) << "it is new";
    for (const std::string& name : others) EXPECT_TRUE(fs::exists(folder / name)) << name;
}

TEST_F(ProgramCacheFiles, LeavesNoFolderOfPoclBehind) {
    compiled_by_processes(2, "VOXELUME_CACHE_DIR=" + folder.string());
    for (const fs::directory_entry& entry : fs::directory_iterator(folder))
        EXPECT_TRUE(entry.path().filename() == "programs" || entry.path().filename() == "drivers")
            << entry.path();
}

}  // namespace
}  // namespace voxelume
