// voxelume bench: run time against error, on scenes whose truth is known.
#include <CLI/CLI.hpp>
#include <algorithm>
#include <memory>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "cli/checks.hpp"
#include "cli/commands.hpp"
#include "cli/progress.hpp"
#include "runtime/base/atomic_file.hpp"
#include "runtime/base/error.hpp"
#include "runtime/opencl/device.hpp"
#include "runtime/verify/bench/bench.hpp"
#include "runtime/verify/report/bench_page.hpp"
#include "runtime/verify/report/bench_plots.hpp"
#include "runtime/verify/report/bench_tables.hpp"

namespace voxelume::cli {
namespace {

struct BenchCommand {
    bool is_quick = false;
    std::string page, json, csv, plot, peers;
    std::vector<std::string> only;
    std::vector<std::string> resolutions, placements, samples;  ///< with commas
    std::string size;
    int repeats = 0;  ///< 0: as --quick says
    std::string device;
    bool quiet = false;
};

std::vector<const BenchEntry*> chosen_entries(const std::vector<std::string>& only) {
    std::vector<std::string_view> names;
    for (const BenchEntry& entry : bench_entries()) names.emplace_back(entry.name);
    const std::vector<std::string> wanted = chosen_names(only, names, "bench", "scene");
    std::vector<const BenchEntry*> chosen;
    for (const BenchEntry& entry : bench_entries()) {
        const bool is_named = std::ranges::find(wanted, entry.name) != wanted.end();
        if (is_named || (only.empty() && entry.is_there())) chosen.push_back(&entry);
    }
    return chosen;
}

std::vector<int> numbers_in(const std::vector<std::string>& texts) {
    std::vector<int> numbers;
    for (const std::string& text : listed(texts)) numbers.push_back(std::stoi(text));
    return numbers;
}

void sort_once(std::vector<int>& values) {
    std::ranges::sort(values);
    values.erase(std::unique(values.begin(), values.end()), values.end());
}

/// What a run of half a minute has. Kernels that aren't compiled yet take a minute more.
void make_quick(BenchOptions& options) {
    options.resolutions = {4, 8, 16, 32, 64, 128};
    options.finest_with_light = 64;
    options.samples = {1, 4};
    options.placements = {Placement::world};
    options.size = glm::ivec2(160);
    options.light_size = glm::ivec2(80);
    options.measures_shadows = false;
    options.repeats = 0;
}

BenchOptions options_of(const BenchCommand& command) {
    BenchOptions options;
    options.subjects = chosen_entries(command.only);
    // The steps are halved where smooth surfaces have not yet reached their floor.
    options.resolutions = {4, 8, 11, 16, 23, 32, 45, 64, 128, 256, 512, 1024};
    options.samples = {1, 4, 16};
    if (command.is_quick) make_quick(options);
    if (!command.resolutions.empty()) {
        options.resolutions = numbers_in(command.resolutions);
        options.finest_with_light = BenchOptions().finest_with_light;
    }
    sort_once(options.resolutions);
    if (!command.samples.empty()) options.samples = numbers_in(command.samples);
    sort_once(options.samples);
    if (!command.placements.empty()) {
        options.placements.clear();
        const std::vector<std::string> named = listed(command.placements);
        for (const Placement placement : {Placement::world, Placement::instance})
            if (std::ranges::find(named, name_of(placement)) != named.end())
                options.placements.push_back(placement);
    }
    if (!command.size.empty())
        options.size = options.light_size = parse_size(command.size, "bench");
    if (command.repeats > 0) options.repeats = command.repeats;
    if (!command.peers.empty()) options.peers = read_peers(command.peers, options.size);
    return options;
}

void check_outputs(const BenchCommand& command) {
    if (!command.page.empty()) check_output(command.page, {".html", ".htm"}, "bench");
    if (!command.plot.empty()) check_output(command.plot, {".svg"}, "bench");
    if (!command.json.empty()) check_output(command.json, {}, "bench");
    if (!command.csv.empty()) check_output(command.csv, {}, "bench");
    check_distinct({command.page, command.json, command.csv, command.plot}, "bench");
}

void write_text(const std::string& path, const std::string& text) {
    if (path.empty()) return;
    AtomicFile file(path);
    file.write(text.data(), text.size());
    file.commit();
}

/// Refuses options that leave no row, or none of a scene that was asked for.
void check_rows(const BenchCommand& command, const BenchOptions& options) {
    constexpr const char* kAdvice = "scenes/BENCH.md names what each has";
    if (count_rows(options) == 0)
        throw Error(ErrorKind::usage, "bench: no scene has rows of these sizes and placements; {}",
                    kAdvice);
    if (command.only.empty()) return;
    BenchOptions of_one = options;
    for (const BenchEntry* entry : options.subjects) {
        of_one.subjects = {entry};
        if (count_rows(of_one) == 0)
            throw Error(ErrorKind::usage, "bench: {} has no row of these sizes and placements; {}",
                        entry->name, kAdvice);
    }
}

int run(const BenchCommand& command) {
    const BenchOptions options = options_of(command);
    check_outputs(command);
    check_rows(command, options);
    const Device device = Device::open(command.device);
    BenchReport report;
    {
        Progress bar("measuring", count_rows(options), stderr, command.quiet);
        report = run_bench(device, options, [&bar](size_t, size_t) { bar.advance(); });
    }
    if (!command.quiet)
        fmt::print(stderr, "\"{}\", {} lanes, driver {}; {}\n", report.device, report.lanes,
                   report.driver, report.machine);
    fmt::print("{}", bench_text(report));
    write_text(command.page, bench_page(report));
    write_text(command.csv, bench_csv(report));
    write_text(command.plot, bench_picture(report));
    // The device's name may be in any encoding.
    const auto json = bench_json(report);
    write_text(command.json,
               json.dump(2, ' ', false, nlohmann::ordered_json::error_handler_t::replace) + "\n");
    return 0;
}

std::string list_of_scenes() {
    std::string list = "of these scenes only: a name, or names with commas; may be given again:";
    for (const BenchEntry& entry : bench_entries())
        list += fmt::format("\n{:<8}{}", entry.name, entry.help);
    return list;
}

}  // namespace

Action add_bench(CLI::App& app) {
    const auto command = std::make_shared<BenchCommand>();
    app.add_flag(
        "--quick", command->is_quick,
        "every scene in half a minute (and a minute more where kernels aren't compiled yet): 8 to "
        "128 voxels a metre, 160x160 pixels (4 to 64 and 80x80 with light), no repeats, no "
        "instances, no shadow edges");
    app.add_option("-o,--output", command->page, "report with plots: .html");
    app.add_option("--json", command->json, "file for everything that was measured");
    app.add_option("--csv", command->csv, "file for the rows");
    app.add_option("--plot", command->plot, "picture of depth against time: .svg");
    app.add_option("--only", command->only, list_of_scenes())->allow_extra_args(false);
    app.add_option("--resolution", command->resolutions, "voxels a metre, like 16,32,64")
        ->check(list_of(in_range(4, 4096, Number::whole), "numbers like 16,32,64"));
    app.add_option("--placement", command->placements, "world, instance, or both with a comma")
        ->check(list_of(one_of({"world", "instance"}), "world, instance, or world,instance"));
    app.add_option("--samples", command->samples, "rays a pixel, like 1,4,16; scenes with light")
        ->check(list_of(in_range(1, 4096, Number::whole), "numbers like 1,4,16"));
    app.add_option("--peers", command->peers, "rows of other programs, from bench_peers: .json");
    app.add_option("--size", command->size, "of the images, like 640x480");
    app.add_option("--repeat", command->repeats, "renders of each row, the fastest of which counts")
        ->check(in_range(1, 1000, Number::whole));
    app.add_option("--device", command->device, "auto, cpu, gpu, a number, or part of a name")
        ->check(one_device);
    app.add_flag("-q,--quiet", command->quiet, "no progress bar");
    return [command] { return run(*command); };
}

}  // namespace voxelume::cli
