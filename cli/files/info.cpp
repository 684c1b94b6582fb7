// SPDX-License-Identifier: Apache-2.0
// voxelume info FILE: describes what a file contains.
#include <CLI/CLI.hpp>
#include <algorithm>
#include <array>
#include <memory>
#include <string>

#include "cli/shared/checks.hpp"
#include "cli/shared/commands.hpp"
#include "cli/shared/import_options.hpp"
#include "cli/shared/report.hpp"
#include "cli/shared/slice_names.hpp"
#include "runtime/voxelume.hpp"

namespace voxelume::cli {
namespace {

Report report_of(const Facts& facts) {
    if (facts.kind == Facts::Kind::value)
        return std::visit(
            [](const auto& value) -> Report {
                using Value = std::decay_t<decltype(value)>;
                if constexpr (std::is_same_v<Value, std::monostate> ||
                              std::is_same_v<Value, std::vector<Facts>>)
                    return nullptr;
                else
                    return value;
            },
            facts.value);
    const bool is_list = facts.kind == Facts::Kind::list;
    Report report = is_list ? Report::array() : Report::object();
    for (const Facts& inner : std::get<std::vector<Facts>>(facts.value)) {
        if (is_list)
            report.push_back(report_of(inner));
        else
            report[inner.name] = report_of(inner);
    }
    return report;
}

/// The end of the message on a file that isn't whole.
const char* fault_of(FileIntegrity found, const std::string& ending) {
    constexpr std::array kInTwoFiles = {".json",    ".raw",    ".planes",
                                        ".cplanes", ".rgb332", ".rgb565"};
    constexpr std::array kWithoutPlace = {".kv6", ".binvox", ".npy", ".vox"};
    const auto is_one_of = [&](const auto& endings) {
        return std::ranges::find(endings, ending) != endings.end();
    };
    if (found == FileIntegrity::damaged)
        return is_one_of(kInTwoFiles)
                   ? "is damaged, or the header or data beside it: the bytes aren't those that "
                     "were written"
                   : "is damaged: its bytes aren't those that were written";
    return is_one_of(kWithoutPlace)
               ? "can't be verified: its format has no place for a checksum"
               : "has no checksum; images, volumetric images, pages and statistics that voxelume "
                 "writes have one, and voxels in .vxm, .vdb and .nrrd";
}

void check_integrity(const std::string& path) {
    const FileIntegrity found = verify_file(path);
    if (found == FileIntegrity::whole) return;
    throw Error(ErrorKind::input, path + ": " + fault_of(found, ending_of(path)), {path});
}

}  // namespace

Action add_info(CLI::App& app) {
    struct Options {
        std::string path;
        v1::SceneOptions scene;
        bool json = false, verify = false;
    };
    auto options = std::make_shared<Options>();
    app.add_option("FILE", options->path,
                   "scene or statistics, .json; OpenEXR image, PNG, volumetric image (.vdb .exr "
                   ".nrrd .json "
                   ".kv6), page (.html), or mesh, voxels or scan: " +
                       model_endings())
        ->required();
    app.add_option("--assets", options->scene.assets,
                   "folder to look for a scene's models in; may be given again")
        ->allow_extra_args(false);
    app.add_flag("--json", options->json, "print the result as JSON");
    app.add_flag("--verify", options->verify, "compare all of FILE with the checksum in it");
    return [options] {
        const std::string path = first_slice(options->path);
        if (options->verify) check_integrity(path);
        const bool is_stack = path != options->path;
        print_report(
            report_of(is_stack ? describe_slices(path) : describe_file(path, options->scene)),
            options->json);
        return 0;
    };
}

}  // namespace voxelume::cli
