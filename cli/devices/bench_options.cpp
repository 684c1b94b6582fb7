// SPDX-License-Identifier: Apache-2.0
#include "cli/devices/bench_options.hpp"

#include <algorithm>
#include <filesystem>
#include <map>

#include "cli/shared/checks.hpp"

namespace voxelume::cli {
namespace {

std::vector<std::string> scenes_named(const std::vector<std::string>& only) {
    const std::vector<BenchScene> scenes = bench_scenes();
    std::vector<std::string_view> names;
    names.reserve(scenes.size());
    for (const BenchScene& scene : scenes) names.emplace_back(scene.name);
    return chosen_names(only, names, "bench", "scene");
}

std::vector<int> numbers_in(const std::vector<std::string>& texts) {
    std::vector<int> numbers;
    for (const std::string& text : listed(texts)) numbers.push_back(std::stoi(text));
    return numbers;
}

/// The scenes of the user's files, by file name, in global light.
std::map<std::string, Scene> own_scenes(const BenchCommand& command) {
    std::map<std::string, Scene> scenes;
    for (const std::string& file : command.own_scenes) {
        SceneOptions options = command.scene;
        options.scene = file;
        options.size = command.size;
        options.light = "global";
        const std::string name = file == "-" ? "stdin" : std::filesystem::path(file).stem();
        if (!scenes.emplace(name, read_with(options, "bench")).second)
            fail_usage("bench: two scenes are named {}: give one of them another name",
                       quote(name));
    }
    return scenes;
}

/// Sets the options of a run of half a minute. Kernels that aren't compiled yet take a minute more.
void make_quick(BenchOptions& options) {
    options.resolutions = {4, 8, 16, 32, 64, 128};
    options.finest_with_light = 64;
    options.samples = {1, 4};
    options.global_samples = {1, 4, 16};
    options.placements = {Placement::world};
    options.size = {160, 160};
    options.light_size = {80, 80};
    options.measure_shadows = false;
    options.repeats = 0;
}

}  // namespace

BenchOptions options_of(const BenchCommand& command) {
    BenchOptions options;
    options.scenes = scenes_named(command.only);
    if (command.is_quick) make_quick(options);
    if (!command.resolutions.empty()) {
        options.resolutions = numbers_in(command.resolutions);
        options.finest_with_light = BenchOptions().finest_with_light;
    }
    if (!command.samples.empty())
        options.samples = options.global_samples = numbers_in(command.samples);
    if (!command.placements.empty()) {
        options.placements.clear();
        const std::vector<std::string> named = listed(command.placements);
        for (const Placement placement : {Placement::world, Placement::instance})
            if (std::ranges::find(named, placement == Placement::world ? "world" : "instance") !=
                named.end())
                options.placements.push_back(placement);
    }
    if (!command.size.empty())
        options.size = options.light_size = parse_size(command.size, "bench");
    if (command.repeats > 0) options.repeats = command.repeats;
    options.peers = command.peers;
    options.own_scenes = own_scenes(command);
    return options;
}

void check_rows(const BenchCommand& command, const BenchOptions& options) {
    constexpr const char* kAdvice = "scenes/BENCH.md names what each has";
    if (count_bench_rows(options) == 0)
        fail_usage("bench: no scene has rows of these sizes and placements; {}", kAdvice);
    if (command.only.empty()) return;
    BenchOptions of_one = options;
    of_one.own_scenes.clear();
    for (const std::string& scene : options.scenes) {
        of_one.scenes = {scene};
        if (count_bench_rows(of_one) == 0)
            fail_usage("bench: {} has no row of these sizes and placements; {}", scene, kAdvice);
    }
}

}  // namespace voxelume::cli
