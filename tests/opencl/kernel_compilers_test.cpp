// SPDX-License-Identifier: Apache-2.0
// Programs that helper processes compile: taken from them, and compiled here whatever becomes of
// them.
#include "runtime/opencl/ahead/kernel_compilers.hpp"

#include <gtest/gtest.h>

#include <chrono>
#include <csignal>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <set>
#include <string>
#include <string_view>
#include <thread>

#include "runtime/opencl/program.hpp"
#include "runtime/opencl/program_cache.hpp"
#include "runtime/opencl/quirks/pocl_folder.hpp"
#include "runtime/opencl/self_test/self_test.hpp"
#include "tests/support/file_fixture.hpp"
#include "tests/support/own_process.hpp"
#include "tests/support/test_device.hpp"

namespace voxelume {
namespace {

namespace fs = std::filesystem;

/// The work of a process of this test, chosen by VXL_TEST_CASE.
std::string_view wanted_case() {
    const char* const name = std::getenv("VXL_TEST_CASE");
    return name ? name : "";
}

bool wait_until(const std::function<bool()>& is_so) {
    for (int tries = 0; tries < 3000; ++tries) {
        if (is_so()) return true;
        std::this_thread::sleep_for(std::chrono::milliseconds(10));
    }
    return false;
}

/// The process of this one's that runs a helper; 0 if there is none.
pid_t helper_process() {
    for (const fs::directory_entry& entry : fs::directory_iterator("/proc")) {
        std::ifstream file(entry.path() / "stat");
        std::string text;
        if (!std::getline(file, text)) continue;
        // "8 (voxelume-kernel) S 7 ...": its number, the start of its name, its state, its parent.
        const size_t end = text.rfind(')');
        if (end == std::string::npos || text.find("(voxelume-kernel") == std::string::npos)
            continue;
        if (std::atoi(text.c_str() + end + 4) == getpid()) return pid_t(std::atoi(text.c_str()));
    }
    return 0;
}

/// The kernels in this process's folder, without those in the folders of helpers.
int compiled_kernels() {
    int count = 0;
    const fs::path& folder = PoclFolder::instance().path();
    for (const fs::directory_entry& entry : fs::recursive_directory_iterator(folder)) {
        const std::string name = entry.path().lexically_relative(folder).string();
        count += int(name.ends_with(".so") && !name.starts_with("pocl."));
    }
    return count;
}

/// Foresees the self-test, and makes it.
void make_self_test(KernelCompilers& compilers) {
    const Device device = test_device();
    const ForeseenProgram foreseen{
        {"self_test.cl"},
        {{"VXL_NATIVE_DIVIDE", device.is_cpu()}},
        {{"answer_lanes", WorkItem::heavy}, {"answer_numbers", WorkItem::light}}};
    Program::foresee(device, foreseen);
    const bool is_killed = wanted_case() == "killed", is_helped = wanted_case() == "helped";
    if (is_killed || wanted_case() == "stopped") {
        ASSERT_TRUE(wait_until([] { return helper_process() != 0; }));
        kill(helper_process(), is_killed ? SIGKILL : SIGSTOP);
    }
    EXPECT_TRUE(!is_helped || wait_until([&] { return compilers.compiled() == 1; }));
    const Program program(device, foreseen.files[0], foreseen.defines);
    if (wanted_case() != "shared") {
        EXPECT_EQ(compilers.compiled(), int(is_helped));
    }
    EXPECT_EQ(compilers.started(), int(wanted_case() != "warm" && wanted_case() != "unwritable"));
    // Kernels that exist before a launch were compiled by helpers, or beside them: all or none.
    const int before = compiled_kernels();
    if (is_helped || wanted_case() == "warm" || wanted_case() == "shared") {
        EXPECT_EQ(before, 2);
    }
    EXPECT_TRUE(before == 0 || (before == 2 && wanted_case() != "unwritable"));
    EXPECT_EQ(find_fault(device), "");
    EXPECT_EQ(compiled_kernels(), 2);
}

/// Run in its own process. The exit code is 10 if the self-test passes and the case's claim about
/// the helper is true.
TEST(KernelCompilersProcess, DISABLED_MakesTheSelfTest) {
    KernelCompilers& compilers = KernelCompilers::instance();
    compilers.allow(1, wanted_case() == "missing" ? "/nowhere/voxelume-kernel-compiler" : "");
    if (wanted_case() == "stopped") compilers.set_longest_wait(std::chrono::milliseconds(500));
    make_self_test(compilers);
    if (!HasFailure()) std::exit(10);
}

class KernelCompilersFiles : public FileTest {
  protected:
    int run(const std::string& name) { return run_with(name, folder); }
    int run_with(const std::string& name, const fs::path& cache) {
        return run_own_test("KernelCompilersProcess.DISABLED_MakesTheSelfTest",
                            "VOXELUME_SELF_TEST=off VXL_TEST_CASE=" + name +
                                " VOXELUME_CACHE_DIR=" + cache.string());
    }
    /// The names of what is kept, without what is hidden while it is written.
    std::set<std::string> entries() const {
        std::set<std::string> names;
        for (const fs::directory_entry& entry : fs::directory_iterator(folder / "programs"))
            names.insert(entry.path().filename().string());
        return names;
    }
    /// No process has left its folder for PoCL's files.
    bool is_tidy() const {
        for (const fs::directory_entry& entry : fs::directory_iterator(folder))
            if (entry.path().filename().string().starts_with("pocl.")) return false;
        return true;
    }
};

TEST_F(KernelCompilersFiles, CompileWhatTheirProcessTakesAndAWarmCacheStartsNone) {
    if (!keeps_pocl_folder(test_device().info())) GTEST_SKIP() << "this driver isn't PoCL";
    EXPECT_EQ(run("helped"), 10);
    EXPECT_TRUE(is_tidy());
    const std::set<std::string> with_helper = entries();
    EXPECT_EQ(run("warm"), 10);
    EXPECT_EQ(entries(), with_helper);
    for (const char* const other : {"shared", "missing"}) {
        fs::remove_all(folder / "programs");
        EXPECT_EQ(run(other), 10) << other;
        EXPECT_EQ(entries(), with_helper) << other;
    }
    EXPECT_EQ(run_with("unwritable", "/proc/nowhere"), 10);
}

TEST_F(KernelCompilersFiles, ThatAreKilledOrStoppedCostTimeOnly) {
    if (!keeps_pocl_folder(test_device().info())) GTEST_SKIP() << "this driver isn't PoCL";
    EXPECT_EQ(run("killed"), 10);
    fs::remove_all(folder / "programs");
    EXPECT_EQ(run("stopped"), 10);
    EXPECT_TRUE(is_tidy());
}

}  // namespace
}  // namespace voxelume
