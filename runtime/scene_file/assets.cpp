// SPDX-License-Identifier: Apache-2.0
// The search for files that a scene names, inside the allowed folders only.
#include "runtime/scene_file/assets.hpp"

#include <algorithm>
#include <cstdlib>

#include "runtime/base/error.hpp"

namespace voxelume {
namespace fs = std::filesystem;
namespace {

void refuse_names_that_lead_out(std::string_view name, const SourcePlace& where) {
    const fs::path path(name);
    if (name.find('\0') != name.npos) {
        throw Error(ErrorKind::scene, "{}: a file's name must not hold a zero byte", where);
    }
    if (path.is_absolute()) {
        throw Error(
            ErrorKind::scene,
            "{}: \"{}\" is an absolute path; name the file as seen from the scene's folder, or "
            "give its folder with --assets",
            where, name);
    }
    if (std::find(path.begin(), path.end(), "..") != path.end()) {
        throw Error(
            ErrorKind::scene,
            "{}: \"{}\" leads out of its folder with \"..\"; give the other folder with --assets",
            where, name);
    }
}

bool lies_below(const fs::path& file, const fs::path& folder) {
    const auto [in_folder, in_file] =
        std::mismatch(folder.begin(), folder.end(), file.begin(), file.end());
    return in_folder == folder.end() && in_file != file.end();
}

}  // namespace

AssetFolders asset_folders(const std::vector<fs::path>& from_command_line) {
    AssetFolders folders = from_command_line;
    const char* variable = std::getenv("VOXELUME_ASSETS");
    std::string_view rest = variable == nullptr ? "" : variable;
    while (!rest.empty()) {
        const size_t end = std::min(rest.find(':'), rest.size());
        if (end > 0) folders.emplace_back(rest.substr(0, end));
        rest.remove_prefix(std::min(end + 1, rest.size()));
    }
    return folders;
}

bool is_asset(std::string_view name, const fs::path& scene_folder, const AssetFolders& assets) {
    const auto holds = [&](const fs::path& folder) {
        std::error_code error;
        return fs::exists(folder / name, error);
    };
    return holds(scene_folder) || std::ranges::any_of(assets, holds);
}

fs::path find_asset(std::string_view name, const fs::path& scene_folder, const AssetFolders& assets,
                    const SourcePlace& where) {
    refuse_names_that_lead_out(name, where);
    AssetFolders folders = {scene_folder.empty() ? fs::path(".") : scene_folder};
    folders.insert(folders.end(), assets.begin(), assets.end());

    std::string searched;
    for (const fs::path& folder : folders) {
        const fs::path candidate = folder / name;
        std::error_code error;
        const fs::file_status status = fs::status(candidate, error);
        if (status.type() == fs::file_type::not_found) {
            searched +=
                (searched.empty() ? "" : ", ") + fs::absolute(folder).lexically_normal().string();
            continue;
        }
        if (error) {
            throw Error(ErrorKind::input, "{}: {} can't be looked at: {}", where,
                        candidate.string(), error.message());
        }
        fs::path file = fs::canonical(candidate, error);
        const fs::path root = error ? fs::path() : fs::canonical(folder, error);
        if (error || !lies_below(file, root)) {
            throw Error(
                ErrorKind::scene,
                "{}: \"{}\" is a link that leads out of {}; give the folder of the file itself "
                "with --assets",
                where, name, folder.string());
        }
        if (!fs::is_regular_file(file, error)) {
            throw Error(ErrorKind::input, "{}: {} is not a file", where, candidate.string());
        }
        return file;
    }
    throw Error(ErrorKind::input,
                "{}: there is no file \"{}\"; searched {}; give its folder with --assets or "
                "VOXELUME_ASSETS",
                where, name, searched);
}

}  // namespace voxelume
