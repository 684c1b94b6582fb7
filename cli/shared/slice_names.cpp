// SPDX-License-Identifier: Apache-2.0
#include "cli/shared/slice_names.hpp"

#include <algorithm>
#include <filesystem>
#include <optional>

#include "runtime/voxelume.hpp"

namespace voxelume::cli {
namespace {

namespace fs = std::filesystem;

/// The parts of a file's name before and after the digits that # stands for.
struct SliceName {
    std::string before, after;
    size_t digits;

    /// The number in a name of the stack, without leading zeros.
    std::optional<std::string> number_in(const std::string& name) const {
        if (name.size() < before.size() + digits + after.size() || !name.starts_with(before) ||
            !name.ends_with(after))
            return std::nullopt;
        std::string number = name.substr(before.size(), name.size() - before.size() - after.size());
        if (number.find_first_not_of("0123456789") != std::string::npos) return std::nullopt;
        if (number.size() > digits && number.front() == '0') return std::nullopt;
        number.erase(0, std::min(number.find_first_not_of('0'), number.size() - 1));
        return number;
    }
};

bool is_lower(const std::string& a, const std::string& b) {
    return a.size() != b.size() ? a.size() < b.size() : a < b;
}

}  // namespace

std::string first_slice(const std::string& name) {
    const fs::path path(name);
    const std::string file = path.filename().string();
    const size_t last = file.rfind('#');
    std::error_code error;
    if (last == std::string::npos || path.extension() != ".png" || fs::exists(path, error))
        return name;
    const size_t before = file.find_last_not_of('#', last);
    const size_t begin = before == std::string::npos ? 0 : before + 1;
    const SliceName stack{file.substr(0, begin), file.substr(last + 1), last + 1 - begin};
    const fs::path folder = path.parent_path();
    std::string lowest, found;
    for (const fs::directory_entry& entry :
         fs::directory_iterator(folder.empty() ? fs::path(".") : folder, error)) {
        const std::string candidate = entry.path().filename().string();
        const auto number = stack.number_in(candidate);
        if (!number || (!found.empty() && !is_lower(*number, lowest))) continue;
        lowest = *number;
        found = candidate;
    }
    if (found.empty())
        throw Error(ErrorKind::input,
                    name +
                        ": no file has such a name; each # stands for a digit, as #### does for "
                        "0001",
                    {name});
    return (folder / found).string();
}

}  // namespace voxelume::cli
