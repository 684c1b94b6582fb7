#include "cli/checks.hpp"

#include <algorithm>
#include <cstdlib>
#include <filesystem>

#include "runtime/io/atomic_file.hpp"

namespace voxelume::cli {

void check_output(const std::string& path, std::initializer_list<const char*> extensions,
                  const char* command) {
    const std::string extension = std::filesystem::path(path).extension();
    if (extensions.size() > 0 && std::ranges::find(extensions, extension) == extensions.end()) {
        std::string list;
        for (const char* known : extensions)
            list += (list.empty() ? "" : " or ") + std::string(known);
        throw Error(ErrorKind::usage, "{}: {}: the name of an output ends in {}", command, path,
                    list);
    }
    const AtomicFile trial(path);  // leaves nothing behind without commit()
}

std::function<std::string(const std::string&)> in_range(double least, double most, Number number) {
    return [=](const std::string& text) -> std::string {
        char* end = nullptr;
        const double value = std::strtod(text.c_str(), &end);
        const bool is_whole = text.find_first_not_of("+-0123456789") == std::string::npos;
        const bool is_number = !text.empty() && *end == '\0' && value >= least && value <= most;
        if (is_number && (is_whole || number == Number::any)) return {};
        return fmt::format("{} isn't a {}number from {:g} to {:g}", quote(text),
                           number == Number::whole ? "whole " : "", least, most);
    };
}

}  // namespace voxelume::cli
