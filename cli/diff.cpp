// voxelume diff A B: how far two images are from each other.
#include <CLI/CLI.hpp>

#include "cli/commands.hpp"
#include "runtime/error.hpp"

namespace voxelume::cli {

Action add_diff(CLI::App& app) {
    auto path = std::make_shared<std::string>();
    app.add_option("A", *path, "the image to judge")->required();
    return [path]() -> int {
        throw Error(ErrorKind::input, "{}: not a file that voxelume knows", *path);
    };
}

}  // namespace voxelume::cli
