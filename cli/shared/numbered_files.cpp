// SPDX-License-Identifier: Apache-2.0
#include "cli/shared/numbered_files.hpp"

#include <algorithm>
#include <filesystem>
#include <vector>

#include "runtime/voxelume.hpp"

namespace voxelume::cli {
namespace {

namespace fs = std::filesystem;

/// The numbers in a name, each a run of digits. Runs that are too long for a frame's number don't
/// count.
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

}  // namespace

bool is_numbered(const std::string& name) {
    return frame_path(name, 1, false) != name;
}

std::set<int> numbers_of_files(const std::string& pattern) {
    std::set<int> found;
    const fs::path folder = fs::path(pattern).parent_path();
    std::error_code error;
    for (const auto& entry : fs::directory_iterator(folder.empty() ? "." : folder, error)) {
        const std::string name = entry.path().filename().string();
        for (const int number : numbers_in(name))
            if (fs::path(frame_path(pattern, number, false)).filename() == name)
                found.insert(number);
    }
    return found;
}

}  // namespace voxelume::cli
