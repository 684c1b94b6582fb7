// SPDX-License-Identifier: Apache-2.0
// The benchmark, for callers.
#include <algorithm>
#include <nlohmann/json.hpp>

#include "runtime/api/border/convert.hpp"
#include "runtime/api/border/guarded.hpp"
#include "runtime/api/border/handles.hpp"
#include "runtime/scene_file/document/scene_fields.hpp"
#include "runtime/verify/bench/bench.hpp"
#include "runtime/verify/report/bench_page.hpp"
#include "runtime/verify/report/bench_plots.hpp"
#include "runtime/verify/report/bench_tables.hpp"
#include "runtime/voxelume_verify.hpp"

namespace voxelume {
namespace {

/// The entries in their own order: those that are named, or without names those that are there.
std::vector<const BenchEntry*> chosen_entries(const std::vector<std::string>& names) {
    std::vector<std::string_view> known;
    for (const BenchEntry& entry : bench_entries()) known.emplace_back(entry.name);
    for (const std::string& name : names)
        if (std::ranges::find(known, name) == known.end())
            throw Error(ErrorKind::usage, "there is no scene named {}{}", quote(name),
                        suggest(name, known));
    std::vector<const BenchEntry*> chosen;
    for (const BenchEntry& entry : bench_entries()) {
        const bool is_named = std::ranges::find(names, entry.name) != names.end();
        if (is_named || (names.empty() && entry.is_there())) chosen.push_back(&entry);
    }
    return chosen;
}

void sort_once(std::vector<int>& values) {
    std::ranges::sort(values);
    values.erase(std::unique(values.begin(), values.end()), values.end());
}

BenchOptions options_inside(const v1::BenchOptions& options) {
    BenchOptions result;
    result.subjects = chosen_entries(options.scenes);
    result.resolutions = options.resolutions;
    sort_once(result.resolutions);
    result.finest_with_light = options.finest_with_light;
    result.samples = options.samples;
    sort_once(result.samples);
    result.placements.clear();
    for (const v1::Placement placement : options.placements)
        result.placements.push_back(static_cast<Placement>(placement));
    result.size = api::vector_of(options.size);
    result.light_size = api::vector_of(options.light_size);
    result.measures_shadows = options.measure_shadows;
    result.repeats = options.repeats;
    return result;
}

/// The device's name may be in any encoding.
std::string text_of(const nlohmann::ordered_json& json) {
    return json.dump(2, ' ', false, nlohmann::ordered_json::error_handler_t::replace) + "\n";
}

}  // namespace

namespace v1 {

std::vector<BenchScene> bench_scenes() {
    std::vector<BenchScene> scenes;
    for (const BenchEntry& entry : bench_entries())
        scenes.push_back({entry.name, entry.help, entry.is_there()});
    return scenes;
}

size_t count_bench_rows(const BenchOptions& options) {
    return api::guarded([&] { return count_rows(options_inside(options)); });
}

BenchReport run_bench(const Device& device, const BenchOptions& options,
                      const std::function<void(size_t, size_t)>& progress) {
    return api::guarded([&] {
        voxelume::BenchOptions inside = options_inside(options);
        if (!options.peers.empty()) inside.peers = read_peers(options.peers, inside.size);
        const auto report = [done = api::callback(progress)](size_t n, size_t of) {
            if (done) done(n, of);
        };
        const voxelume::BenchReport found =
            voxelume::run_bench(api::inside(device), inside, report);
        return BenchReport{found.device,     found.driver,         found.machine,
                           found.lanes,      bench_text(found),    bench_page(found),
                           bench_csv(found), bench_picture(found), text_of(bench_json(found))};
    });
}

}  // namespace v1
}  // namespace voxelume
