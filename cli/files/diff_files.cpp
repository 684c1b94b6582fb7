// SPDX-License-Identifier: Apache-2.0
#include "cli/files/diff_files.hpp"

#include <algorithm>
#include <filesystem>
#include <map>
#include <set>
#include <utility>

#include "cli/shared/checks.hpp"

namespace voxelume::cli {
namespace {

namespace fs = std::filesystem;

bool is_numbered(const std::string& name) {
    return frame_path(name, 1, false) != name;
}

/// The numbers in a name, each as a run of digits. Longer ones than a frame's are none.
std::vector<int> numbers_in(const std::string& name) {
    constexpr size_t kMaxDigits = 9;
    const auto is_digit = [](char c) { return c >= '0' && c <= '9'; };
    std::vector<int> numbers;
    for (size_t i = 0; i < name.size();) {
        size_t end = i;
        while (end < name.size() && is_digit(name[end])) ++end;
        if (end > i && end - i <= kMaxDigits) numbers.push_back(std::stoi(name.substr(i, end - i)));
        i = std::max(end, i + 1);
    }
    return numbers;
}

/// Adds the frames of which there is a file.
void add_frames(const std::string& pattern, std::set<int>& frames) {
    const fs::path folder = fs::path(pattern).parent_path();
    std::error_code error;
    for (const auto& entry : fs::directory_iterator(folder.empty() ? "." : folder, error)) {
        const std::string name = entry.path().filename().string();
        for (const int number : numbers_in(name))
            if (fs::path(frame_path(pattern, number, false)).filename() == name)
                frames.insert(number);
    }
}

std::vector<int> frames_of(const DiffNames& names) {
    if (!names.frames.empty()) return parse_frame_list(names.frames);
    std::set<int> frames;
    add_frames(names.a, frames);
    add_frames(names.b, frames);
    if (frames.empty()) fail_usage("diff: there is no frame of {} or {}", names.a, names.b);
    return {frames.begin(), frames.end()};
}

/// The file that a name leads to.
fs::path target_of(const std::string& name) {
    std::error_code error;
    const fs::path target = fs::weakly_canonical(name, error);
    return error ? fs::absolute(name).lexically_normal() : target;
}

}  // namespace

bool DiffNames::is_animation() const {
    return !frames.empty() || is_numbered(a) || is_numbered(b);
}

void check_inputs(const DiffFiles& files) {
    for (const std::string& image : {files.a, files.b}) {
        std::error_code error;
        if (!fs::exists(image, error)) throw Error(ErrorKind::input, image + ": no such file");
    }
}

void check_outputs(const std::vector<DiffFiles>& list) {
    std::map<fs::path, std::string> inputs, outputs;
    for (const DiffFiles& files : list)
        for (const std::string& image : {files.a, files.b}) inputs.emplace(target_of(image), image);
    for (const DiffFiles& files : list)
        for (const std::string& picture : {files.output, files.flip}) {
            if (picture.empty()) continue;
            const fs::path target = target_of(picture);
            if (const auto input = inputs.find(target); input != inputs.end())
                fail_usage("diff: {}: the picture would replace {}, which is compared", picture,
                           input->second);
            const auto [first, is_new] = outputs.emplace(target, picture);
            if (!is_new)
                fail_usage("diff: {} and {}: two outputs are one file; give each a name of its own",
                           first->second, picture);
        }
}

std::vector<DiffFiles> diff_files(const DiffNames& names) {
    if (!names.is_animation()) return {{0, names.a, names.b, names.output, names.flip}};
    for (const std::string& name : {names.a, names.b})
        if (!is_numbered(name))
            fail_usage("diff: {}: frames have their number in their name: #### stands for it",
                       name);
    std::vector<DiffFiles> list;
    for (const int frame : frames_of(names)) {
        const auto path = [frame](const std::string& name) {
            return name.empty() ? name : frame_path(name, frame, true);
        };
        list.push_back({frame, path(names.a), path(names.b), path(names.output), path(names.flip)});
    }
    return list;
}

}  // namespace voxelume::cli
