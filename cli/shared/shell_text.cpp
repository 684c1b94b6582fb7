// SPDX-License-Identifier: Apache-2.0
#include "cli/shared/shell_text.hpp"

namespace voxelume::cli {

std::string escaped(const std::string& text, std::string_view characters) {
    std::string result;
    for (const char c : text) {
        if (characters.find(c) != characters.npos) result += '\\';
        result += c == '\n' ? ' ' : c;
    }
    return result;
}

std::string quoted(const std::string& text) {
    std::string result = "'";
    for (const char c : text)
        if (c == '\'')
            result += "'\\''";
        else
            result += c;
    return result + "'";
}

}  // namespace voxelume::cli
