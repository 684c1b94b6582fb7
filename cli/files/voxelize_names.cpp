// SPDX-License-Identifier: Apache-2.0
#include "cli/files/voxelize_names.hpp"

#include <algorithm>
#include <filesystem>
#include <numeric>
#include <set>

#include "cli/shared/checks.hpp"
#include "cli/shared/numbered_files.hpp"

namespace voxelume::cli {
namespace {

namespace fs = std::filesystem;

bool is_there(const std::string& file) {
    std::error_code error;
    return fs::exists(file, error);
}

/// The names with the frame's number in them. Only those of a sequence change in `file`.
VoxelizeNames names_of(const VoxelizeNames& names, int frame) {
    VoxelizeNames numbered{frame_path(names.file, frame, false), {}, frame};
    for (const std::string& output : names.outputs)
        numbered.outputs.push_back(frame_path(output, frame, true));
    return numbered;
}

/// Throws where frames would share an output, or replace a file that is read.
void check_names(const std::vector<VoxelizeNames>& frames) {
    std::vector<std::string> outputs;
    std::set<fs::path> inputs;
    for (const VoxelizeNames& names : frames) {
        outputs.insert(outputs.end(), names.outputs.begin(), names.outputs.end());
        inputs.insert(fs::absolute(names.file).lexically_normal());
    }
    check_distinct(outputs, "voxelize");
    for (const std::string& output : outputs)
        if (inputs.contains(fs::absolute(output).lexically_normal()))
            fail_usage("voxelize: {}: the voxels would replace a file that they are made of",
                       output);
}

/// Up to five names, and how many there are.
std::string listed_names(const std::vector<std::string>& names) {
    constexpr size_t kMaxNamed = 5;
    std::string text;
    for (size_t i = 0; i < std::min(names.size(), kMaxNamed); ++i)
        text += (i == 0 ? "" : ", ") + names[i];
    return names.size() > kMaxNamed ? text + ", ..." : text;
}

}  // namespace

bool is_file_sequence(const std::string& file) {
    return is_numbered(file) && ending_of(file) != ".png" && !is_there(file);
}

std::vector<VoxelizeNames> names_of_files(const VoxelizeNames& names, const std::string& list,
                                          std::vector<std::string>& gaps) {
    std::vector<int> numbers;
    if (!list.empty()) {
        numbers = parse_frame_list(list);
    } else {
        const std::set<int> found = numbers_of_files(names.file);
        numbers.assign(found.begin(), found.end());
    }
    if (numbers.empty())
        throw Error(ErrorKind::input,
                    names.file +
                        ": no file has such a name; each # stands for a digit, as #### does for "
                        "0001",
                    {names.file});
    std::vector<VoxelizeNames> frames;
    std::vector<std::string> missing;
    for (const int number : numbers) {
        frames.push_back(names_of(names, number));
        if (!is_there(frames.back().file)) missing.push_back(frames.back().file);
    }
    if (!missing.empty())
        throw Error(ErrorKind::input,
                    fmt::format("voxelize: {} of the {} files are missing: {}", missing.size(),
                                numbers.size(), listed_names(missing)),
                    {missing.front()});
    check_names(frames);
    if (list.empty())
        for (size_t i = 1; i < numbers.size(); ++i)
            if (numbers[i] > numbers[i - 1] + 1)
                gaps.push_back(frame_path(names.file, numbers[i - 1] + 1, false));
    return frames;
}

std::vector<VoxelizeNames> names_of_frames(const VoxelizeNames& names, const std::string& list,
                                           int count) {
    std::vector<int> numbers(size_t(std::max(count, 1)));
    std::iota(numbers.begin(), numbers.end(), 1);
    if (!list.empty()) numbers = parse_frame_list(list);
    std::vector<VoxelizeNames> frames;
    for (const int number : numbers) {
        if (number < 1 || number > count)
            fail_usage("{}: there is no frame {}: the last one is {}", names.file, number, count);
        frames.push_back(names_of(names, number));
        frames.back().file = names.file;
    }
    check_names(frames);
    return frames;
}

}  // namespace voxelume::cli
