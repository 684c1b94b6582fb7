// SPDX-License-Identifier: Apache-2.0
// voxelume import FILE: writes the scene that `render` would show for a model file, for editing.
#include <CLI/CLI.hpp>
#include <filesystem>
#include <memory>
#include <string>

#include "cli/shared/checks.hpp"
#include "cli/shared/commands.hpp"
#include "cli/shared/import_options.hpp"
#include "cli/shared/slice_names.hpp"
#include "cli/shared/tell.hpp"

namespace voxelume::cli {
namespace {

struct ImportCommand {
    std::string file, output, size;
    ImportChoices choices;
    bool quiet = false;
};

int run(const ImportCommand& command) {
    const Size size = command.size.empty() ? Size{} : parse_size(command.size, "import");
    if (!command.output.empty()) check_output(command.output, {".json"}, "import");
    const std::string file = first_slice(command.file);
    if (!is_model_file(file))
        fail_usage("import: {} isn't the name of a model file, such as .obj, .ply, .stl or .vdb",
                   quote(file));
    const std::filesystem::path folder = std::filesystem::path(command.output).parent_path();
    const std::string text = import_file(file, folder, options_of(command.choices, size, "import"));
    if (command.output.empty()) {
        fmt::print("{}", text);
        return 0;
    }
    write_file(command.output, text);
    const auto home = std::filesystem::canonical(file).parent_path();
    const auto inside =
        home.lexically_relative(std::filesystem::weakly_canonical(folder.empty() ? "." : folder));
    if (!command.quiet && (inside.empty() || *inside.begin() == ".."))
        tell("the file lies elsewhere: render the scene with --assets {}\n", quote(home.string()));
    return 0;
}

}  // namespace

Action add_import(CLI::App& app) {
    const auto command = std::make_shared<ImportCommand>();
    app.add_option("FILE", command->file, "model file: " + model_endings())->required();
    app.add_option("-o,--output", command->output,
                   "scene to write, .json; printed if this is left out");
    app.add_option("--size", command->size,
                   "image size, WIDTHxHEIGHT in pixels; 800x600 by default")
        ->type_name("WIDTHxHEIGHT");
    add_import_options(app, command->choices);
    app.add_flag("-q,--quiet", command->quiet, "print errors only");
    return [command] { return run(*command); };
}

}  // namespace voxelume::cli
