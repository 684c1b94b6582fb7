// voxelume info FILE: what is in a file.
#include <CLI/CLI.hpp>

#include "cli/commands.hpp"
#include "runtime/error.hpp"

namespace voxelume::cli {

Action add_info(CLI::App& app) {
    auto path = std::make_shared<std::string>();
    app.add_option("FILE", *path, "an image, volume, model or mesh")->required();
    return [path]() -> int {
        throw Error(ErrorKind::input, "{}: not a file that voxelume knows", *path);
    };
}

}  // namespace voxelume::cli
