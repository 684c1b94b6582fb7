#include "cli/outputs.hpp"

#include <algorithm>
#include <filesystem>

#include "runtime/error.hpp"
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

}  // namespace voxelume::cli
