// SPDX-License-Identifier: Apache-2.0
#include "runtime/io/vdb/vdb_module.hpp"

#include <dlfcn.h>
#include <fmt/format.h>

#include <atomic>
#include <cstring>

#include "runtime/base/error.hpp"
#include "runtime/base/version.hpp"

namespace voxelume {
namespace {

std::atomic<bool> readers_are_isolated = true;

struct VdbModule {
    const VdbFunctions* functions = nullptr;
    std::string failure;  ///< the reason why `functions` is null; else empty
};

/// Opens the module in the folder that CMakeLists.txt wrote into the program. The module stays
/// open.
VdbModule open_module() {
    void* module = dlopen("libvoxelume_vdb.so", RTLD_NOW | RTLD_LOCAL);
    void* table = module ? dlsym(module, "voxelume_vdb_functions") : nullptr;
    if (!table) return {nullptr, dlerror()};
    const auto* functions = static_cast<const VdbFunctions*>(table);
    if (std::strcmp(functions->version, version()) != 0)
        return {nullptr, fmt::format("libvoxelume_vdb.so is of version {}, the program of {}",
                                     functions->version, version())};
    return {functions, {}};
}

const VdbFunctions& functions_for(const std::filesystem::path& path, ErrorKind kind) {
    static const VdbModule module = open_module();
    if (!module.functions)
        throw Error(kind,
                    "{}: can't be {}: the part of voxelume for OpenVDB can't be loaded: {}; "
                    "install voxelume and OpenVDB again",
                    path.string(), kind == ErrorKind::input ? "read" : "written", module.failure);
    return *module.functions;
}

const VdbFunctions& reader_of(const std::filesystem::path& path) {
    const VdbFunctions& functions = functions_for(path, ErrorKind::input);
    functions.isolate_vdb_readers(readers_are_isolated);
    return functions;
}

const VdbFunctions& writer_of(const std::filesystem::path& path) {
    return functions_for(path, ErrorKind::output);
}

}  // namespace

void isolate_vdb_readers(bool is_isolated) {
    readers_are_isolated = is_isolated;
}

void check_vdb_output(const std::filesystem::path& path) {
    writer_of(path);
}

void write_vdb(const std::filesystem::path& path, const VdbVolume& volume) {
    writer_of(path).write_vdb(path, volume);
}

VdbFileSummary read_vdb_summary(const std::filesystem::path& path) {
    return reader_of(path).read_vdb_summary(path);
}

std::optional<bool> is_vdb_as_written(const std::filesystem::path& path) {
    return reader_of(path).is_vdb_as_written(path);
}

std::unique_ptr<DensityField> read_vdb_density(const GridDensity& density) {
    return reader_of(density.file).read_vdb_density(density);
}

VdbVoxels read_vdb_voxels(const std::filesystem::path& path, Surface surface) {
    return reader_of(path).read_vdb_voxels(path, surface);
}

void write_volume_vdb(const VolumePath& path, const Volume& volume) {
    writer_of(path).write_volume_vdb(path, volume);
}

Volume read_volume_vdb(const VolumePath& path) {
    return reader_of(path).read_volume_vdb(path);
}

}  // namespace voxelume
