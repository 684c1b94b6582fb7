// SPDX-License-Identifier: Apache-2.0
#include "runtime/base/helper/helper_program.hpp"

#include <dlfcn.h>
#include <link.h>
#include <unistd.h>

#include <cstdlib>
#include <memory>
#include <vector>

namespace voxelume {
namespace {

/// The folders of RPATH, RUNPATH and the system, in their order.
std::vector<std::filesystem::path> module_folders() {
    Dl_info info{};
    link_map* object = nullptr;  // which is a handle, too
    if (dladdr1(reinterpret_cast<const void*>(&helper_program), &info,
                reinterpret_cast<void**>(&object), RTLD_DL_LINKMAP) == 0)
        return {};
    Dl_serinfo size{};
    if (dlinfo(object, RTLD_DI_SERINFOSIZE, &size) != 0) return {};
    const std::unique_ptr<void, decltype(&std::free)> memory(std::malloc(size.dls_size),
                                                             &std::free);
    if (!memory) return {};
    auto* const list = static_cast<Dl_serinfo*>(memory.get());
    *list = size;
    if (dlinfo(object, RTLD_DI_SERINFO, list) != 0) return {};
    std::vector<std::filesystem::path> folders;
    const Dl_serpath* const paths = list->dls_serpath;
    folders.reserve(list->dls_cnt);
    for (unsigned i = 0; i < list->dls_cnt; ++i) folders.emplace_back(paths[i].dls_name);
    return folders;
}

}  // namespace

std::filesystem::path helper_program(const char* name) {
    for (const std::filesystem::path& folder : module_folders()) {
        std::filesystem::path program = folder / name;
        if (folder.is_absolute() && access(program.c_str(), X_OK) == 0) return program;
    }
    return std::filesystem::path("/") / name;
}

}  // namespace voxelume
