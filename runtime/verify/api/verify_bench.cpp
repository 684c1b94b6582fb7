// SPDX-License-Identifier: Apache-2.0
// The benchmark, for callers.
#include <algorithm>
#include <cmath>
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

/// Throws Error::usage for a name that no scene has.
void check_names(const std::vector<std::string>& names) {
    std::vector<std::string_view> known;
    for (const BenchEntry& entry : bench_entries()) known.emplace_back(entry.name);
    for (const GlobalEntry& entry : global_entries()) known.emplace_back(entry.name);
    for (const std::string& name : names)
        if (std::ranges::find(known, name) == known.end())
            throw Error(ErrorKind::usage, "there is no scene named {}{}", quote(name),
                        suggest(name, known));
}

/// Selects the scenes in their own order: those that are named, or without names those that are
/// available.
void choose_scenes(const v1::BenchOptions& options, BenchOptions& result) {
    const std::vector<std::string>& names = options.scenes;
    check_names(names);
    const auto is_named = [&](const char* name) {
        return std::ranges::find(names, name) != names.end();
    };
    const bool takes_all = names.empty() && options.own_scenes.empty();
    for (const BenchEntry& entry : bench_entries())
        if (is_named(entry.name) || (takes_all && entry.is_there()))
            result.subjects.push_back(&entry);
    for (const GlobalEntry& entry : global_entries())
        if (is_named(entry.name) || takes_all)
            result.global_scenes.push_back({entry.name, entry.open(result.light_size), {}});
    for (const auto& [name, scene] : options.own_scenes) {
        if (std::ranges::find(result.global_scenes, name, &GlobalScene::name) !=
            result.global_scenes.end())
            throw Error(ErrorKind::usage, "two scenes are named {}: give one of them another name",
                        quote(name));
        result.global_scenes.push_back({name, api::inside(scene), {}});
    }
}

void sort_once(std::vector<int>& values) {
    std::ranges::sort(values);
    values.erase(std::unique(values.begin(), values.end()), values.end());
}

BenchOptions options_inside(const v1::BenchOptions& options) {
    BenchOptions result;
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
    result.global_samples = options.global_samples;
    sort_once(result.global_samples);
    choose_scenes(options, result);
    return result;
}

/// A picture that another program made of a scene.
Image reference(const std::filesystem::path& file, const GlobalScene& scene) {
    const v1::Image read = v1::Image::read(file);
    const glm::ivec2 size = scene.scene.render.size;
    for (const char* color : {"R", "G", "B"}) {
        if (!read.has(color) || read.holds_codes())
            throw Error(ErrorKind::input, "{}: a reference is an OpenEXR file with R, G and B",
                        file.string());
        for (const float value : read.plane(color))
            if (!std::isfinite(value))
                throw Error(ErrorKind::input, "{}: {} has values that aren't finite", file.string(),
                            color);
    }
    if (read.width() != size.x || read.height() != size.y)
        throw Error(ErrorKind::input,
                    "{}: has {} x {} pixels, and {} is measured with {} x {}: add --size {}x{}",
                    file.string(), read.width(), read.height(), scene.name, size.x, size.y,
                    read.width(), read.height());
    return api::inside(read);
}

/// Adds the measurements of other programs.
void add_peers(const std::filesystem::path& file, BenchOptions& options) {
    PeerResults peers = read_peers(file);
    check_size(peers, file, options.size);
    options.peers = std::move(peers.rows);
    options.global_peers = std::move(peers.global_rows);
    for (GlobalScene& scene : options.global_scenes) {
        const auto files = peers.references.find(scene.name);
        if (files == peers.references.end()) continue;
        scene.references = {reference(files->second[0], scene), reference(files->second[1], scene)};
    }
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
    for (const GlobalEntry& entry : global_entries())
        scenes.push_back({entry.name, entry.help, true});
    return scenes;
}

size_t count_bench_rows(const BenchOptions& options) {
    return api::guarded([&] { return count_rows(options_inside(options)); });
}

BenchReport run_bench(const Device& device, const BenchOptions& options,
                      const std::function<void(size_t, size_t)>& progress) {
    return api::guarded([&] {
        voxelume::BenchOptions inside = options_inside(options);
        if (!options.peers.empty()) add_peers(options.peers, inside);
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
