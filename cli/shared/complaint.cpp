// SPDX-License-Identifier: Apache-2.0
#include "cli/shared/complaint.hpp"

#include <fmt/format.h>

#include <sstream>
#include <vector>

#include "cli/shared/tell.hpp"
#include "cli/shared/warnings.hpp"

namespace voxelume::cli {

int complain(const std::string& sentence, ErrorKind kind) {
    std::vector<std::string> lines;
    if (kind == ErrorKind::build) {
        std::istringstream stream(sentence);
        for (std::string line; std::getline(stream, line);) lines.push_back(line);
    } else {
        lines.push_back(sentence);
    }
    for (std::string& line : lines) line = harmless_line(std::move(line));
    tell("voxelume: {}\n", fmt::join(lines, "\n"));
    return static_cast<int>(kind);
}

}  // namespace voxelume::cli
