// SPDX-License-Identifier: Apache-2.0
#include "cli/devices/doctor_tests.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <map>
#include <utility>

#include "cli/devices/doctor_pictures.hpp"
#include "runtime/voxelume_verify.hpp"

namespace voxelume::cli {
namespace {

constexpr double kRays = 1e4;  // per test: seconds on a CPU whose kernels are compiled

/// A test that was run, and its result.
struct Test {
    std::string name;
    std::string hash;  ///< of a picture; empty for a test that compares with exact answers
    bool is_right = true;
};

class KernelTests {
  public:
    KernelTests(const Device& device, std::stop_token stop)
        : device_(device), stop_(std::move(stop)) {}

    /// Runs the tests with exact answers.
    Report compare_exactly() {
        Report rows = Report::array();
        const std::string fault = fault_of_known_bits(device_);
        add_row(rows, "known bits", {1, fault.empty() ? 0u : 1u, {}});
        if (!fault.empty()) rows.back()["fault"] = fault;
        for (const StressTest& test : stress_tests()) {
            StressOptions options;
            options.count = std::max<uint64_t>(1, uint64_t(kRays) / test.rays_per_case);
            options.stop = stop_;
            add_row(rows, test.name, run_stress(test.name, device_, options));
        }
        return rows;
    }

    /// Compares the hashes of known pictures.
    Report draw_pictures() {
        Report rows = Report::array();
        const KnownFiles files;
        for (const KnownPicture& picture : known_pictures()) {
            const std::string hash = hash_of_render(picture, files, device_, stop_);
            const bool is_known = hash == picture.hash;
            const size_t kernels = note({std::string(picture.name), hash, is_known});
            rows.push_back(
                {{"picture", picture.name},
                 {"hash", hash},
                 {"state", is_known ? "as known" : "wrong: " + std::string(picture.hash)},
                 {"kernels", kernels}});
        }
        return rows;
    }

    /// Lists every kernel with the picture that tests it, or else a test, and says whether all are
    /// right.
    Report kernels(bool as_json) const {
        Report rows = Report::array();
        for (const KernelName& kernel : kernel_names()) {
            const auto found = of_kernels_.find(kernel.name);
            Report row = {{"kernel", kernel.name}, {"file", kernel.file}};
            if (found == of_kernels_.end())
                row.update({{"test", nullptr}, {"hash", nullptr}, {"state", "not launched"}});
            else
                row.update(result_of(found->second, as_json));
            rows.push_back(row);
        }
        return rows;
    }

    bool are_right() const { return std::ranges::all_of(tests_, &Test::is_right); }

  private:
    void add_row(Report& rows, const std::string& name, const StressResult& result) {
        rows.push_back(
            {{"self-test", name}, {"cases", result.cases}, {"mismatches", result.mismatches}});
        note({name, "", result.mismatches == 0});
    }

    /// Records the kernels that a test has launched, and returns their number.
    size_t note(const Test& test) {
        size_t kernels = 0;
        for (const auto& [kernel, count] : launches_of(device_)) {
            if (count == std::exchange(launches_[kernel], count)) continue;
            of_kernels_[kernel].push_back(tests_.size());
            ++kernels;
        }
        tests_.push_back(test);
        return kernels;
    }

    Report result_of(const std::vector<size_t>& numbers, bool as_json) const {
        const auto test = [this](size_t number) -> const Test& { return tests_[number]; };
        const auto is_wrong = [&](size_t number) { return !test(number).is_right; };
        const auto has_hash = [&](size_t number) { return !test(number).hash.empty(); };
        const auto wrong = std::ranges::find_if(numbers, is_wrong);
        auto shown = wrong;
        if (shown == numbers.end()) shown = std::ranges::find_if(numbers, has_hash);
        if (shown == numbers.end()) shown = numbers.begin();
        const Test& told = test(*shown);
        Report row = {{"test", told.name},
                      {"hash", told.hash.empty() ? Report() : Report(told.hash)},
                      {"state", wrong == numbers.end() ? "right" : "wrong"}};
        if (as_json)
            for (const size_t number : numbers) row["tests"].push_back(test(number).name);
        return row;
    }

    const Device& device_;
    std::stop_token stop_;
    std::vector<Test> tests_;
    std::map<std::string, uint64_t> launches_;               // by kernel
    std::map<std::string, std::vector<size_t>> of_kernels_;  // numbers of tests, by kernel
};

}  // namespace

DeviceTests test_all_kernels(const Device& device, bool as_json, const std::stop_token& stop) {
    KernelTests tests(device, stop);
    DeviceTests result;
    result.report["tests"] = tests.compare_exactly();
    result.report["pictures"] = tests.draw_pictures();
    result.report["kernels"] = tests.kernels(as_json);
    result.are_right = tests.are_right();
    return result;
}

}  // namespace voxelume::cli
