// SPDX-License-Identifier: Apache-2.0
// voxelume bench: measures run time against error on scenes whose truth is known, and noise on any
// scene.
#include <CLI/CLI.hpp>
#include <algorithm>
#include <memory>
#include <string>
#include <vector>

#include "cli/devices/bench_options.hpp"
#include "cli/shared/checks.hpp"
#include "cli/shared/commands.hpp"
#include "cli/shared/progress.hpp"
#include "cli/shared/tell.hpp"
#include "runtime/voxelume_verify.hpp"

namespace voxelume::cli {
namespace {

void check_outputs(const BenchCommand& command) {
    if (!command.page.empty()) check_output(command.page, {".html", ".htm"}, "bench");
    if (!command.plot.empty()) check_output(command.plot, {".svg"}, "bench");
    if (!command.json.empty()) check_output(command.json, {}, "bench");
    if (!command.csv.empty()) check_output(command.csv, {}, "bench");
    check_distinct({command.page, command.json, command.csv, command.plot}, "bench");
}

void write_text(const std::string& path, const std::string& text) {
    if (!path.empty()) write_file(path, text);
}

int run(const BenchCommand& command) {
    const BenchOptions options = options_of(command);
    check_outputs(command);
    check_rows(command, options);
    const Device device = Device::open(command.device);
    BenchReport report;
    {
        Progress bar("measuring", count_bench_rows(options), stderr,
                     command.quiet ? Drawing::never : Drawing::where_watched);
        report = run_bench(device, options, [&bar](size_t, size_t) { bar.advance(); });
    }
    if (!command.quiet)
        tell("\"{}\", {} lanes, driver {}; {}\n", report.device, report.lanes, report.driver,
             report.machine);
    fmt::print("{}", report.text);
    write_text(command.page, report.page);
    write_text(command.csv, report.csv);
    write_text(command.plot, report.picture);
    write_text(command.json, report.json);
    return 0;
}

std::string list_of_scenes() {
    std::string list =
        "run only these scenes: a name, or names separated by commas; may be given again:";
    for (const BenchScene& scene : bench_scenes())
        list += fmt::format("\n{:<8}{}", scene.name, scene.help);
    return list;
}

}  // namespace

Action add_bench(CLI::App& app) {
    const auto command = std::make_shared<BenchCommand>();
    app.add_flag("--quick", command->is_quick,
                 "run every scene in half a minute, and a minute more if kernels must be compiled: "
                 "8 to 128 voxels a metre, 160x160 pixels (4 to 64 and 80x80 with light), no "
                 "repeats, no instances, no shadow edges");
    app.add_option("-o,--output", command->page, "write a report with plots, .html");
    app.add_option("--json", command->json, "write everything that was measured, .json");
    app.add_option("--csv", command->csv, "write the rows, .csv");
    app.add_option("--plot", command->plot,
                   "write the plots of depth and noise against time, .svg");
    app.add_option("--only", command->only, list_of_scenes())
        ->type_name("SCENES")
        ->allow_extra_args(false);
    app.add_option("--scene", command->own_scenes,
                   "measure the noise of this scene or model file in global light, and without "
                   "--only nothing else; may be given again")
        ->type_name("SCENE")
        ->allow_extra_args(false);
    app.add_option("--assets", command->scene.assets,
                   "folder to look for such a scene's models in; may be given again")
        ->allow_extra_args(false);
    app.add_option("--resolution", command->resolutions, "voxels per metre, like 16,32,64")
        ->type_name("NUMBERS")
        ->check(list_of(in_range(4, 4096, Number::whole), "numbers like 16,32,64"));
    app.add_option("--placement", command->placements,
                   "placements: world, instance, or both separated by a comma")
        ->type_name("PLACEMENTS")
        ->check(list_of(one_of({"world", "instance"}), "world, instance, or world,instance"));
    app.add_option("--samples", command->samples,
                   "rays per pixel in scenes with light, like 1,4,16; by default 1,4,16, in global "
                   "light 1,4,16,64,256")
        ->type_name("NUMBERS")
        ->check(list_of(in_range(1, 4096, Number::whole), "numbers like 1,4,16"));
    app.add_option(
        "--peers", command->peers,
        "add the rows of other programs from this file of bench_peers or path_peers.py, .json");
    app.add_option("--size", command->size, "image size, like 640x480")->type_name("WIDTHxHEIGHT");
    app.add_option("--repeat", command->repeats, "renders of each row; the fastest counts")
        ->check(in_range(1, 1000, Number::whole));
    app.add_option("--device", command->device,
                   "device: auto, cpu, gpu, a number, or part of a name")
        ->type_name("DEVICE")
        ->check(one_device);
    app.add_flag("-q,--quiet", command->quiet, "print no progress bar");
    return [command] { return run(*command); };
}

}  // namespace voxelume::cli
