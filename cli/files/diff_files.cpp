// SPDX-License-Identifier: Apache-2.0
#include "cli/files/diff_files.hpp"

#include <filesystem>
#include <map>
#include <set>
#include <utility>

#include "cli/shared/checks.hpp"
#include "cli/shared/numbered_files.hpp"

namespace voxelume::cli {
namespace {

namespace fs = std::filesystem;

std::vector<int> frames_of(const DiffNames& names) {
    if (!names.frames.empty()) return parse_frame_list(names.frames);
    std::set<int> frames = numbers_of_files(names.a);
    frames.merge(numbers_of_files(names.b));
    if (frames.empty()) fail_usage("diff: there is no frame of {} or {}", names.a, names.b);
    return {frames.begin(), frames.end()};
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
        for (const std::string& image : {files.a, files.b}) inputs.emplace(real_path(image), image);
    for (const DiffFiles& files : list)
        for (const std::string& picture : {files.output, files.flip}) {
            if (picture.empty()) continue;
            const fs::path target = real_path(picture);
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
