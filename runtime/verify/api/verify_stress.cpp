// SPDX-License-Identifier: Apache-2.0
// The tests of devices, for callers.
#include <algorithm>

#include "runtime/api/border/guarded.hpp"
#include "runtime/api/border/handles.hpp"
#include "runtime/scene_file/document/scene_fields.hpp"
#include "runtime/verify/stress/stress.hpp"
#include "runtime/voxelume_verify.hpp"

namespace voxelume {
namespace {

const StressTest& test_named(const std::string& name) {
    const auto& tests = stress_tests();
    const auto found = std::ranges::find(tests, name, &StressTest::name);
    if (found != tests.end()) return *found;
    std::vector<std::string_view> names;
    names.reserve(tests.size());
    for (const StressTest& test : tests) names.push_back(test.name);
    throw Error(ErrorKind::usage, "there is no test named {}{}", quote(name), suggest(name, names));
}

}  // namespace

namespace v1 {

static_assert(kMaxStressExamples == kMaxExamples);

std::vector<StressTest> stress_tests() {
    std::vector<StressTest> tests;
    for (const voxelume::StressTest& test : voxelume::stress_tests())
        tests.push_back({test.name, test.help, test.rays_per_case});
    return tests;
}

StressResult run_stress(const std::string& test, const Device& device,
                        const StressOptions& options) {
    return api::guarded([&] {
        const voxelume::StressResult found = test_named(test).run(
            {api::inside(device), options.seed, options.first, options.count,
             api::callback(options.progress), [&] { return options.stop.stop_requested(); }});
        StressResult result{found.cases, found.mismatches, {}};
        for (const voxelume::StressExample& example : found.examples)
            result.examples.push_back({example.number, example.text});
        return result;
    });
}

}  // namespace v1
}  // namespace voxelume
