// SPDX-License-Identifier: Apache-2.0
// Stands in for the module that uses OpenVDB, whose part that asks the helper is linked with the
// target. Nothing is read in the target itself, and nothing is written.
#include <cstdlib>

#include "runtime/io/vdb/vdb_module.hpp"
#include "runtime/io/vdb/vdb_read.hpp"
#include "runtime/io/vdb/vdb_stream.hpp"

namespace voxelume {

namespace vdb {

decltype(voxelume::read_vdb_summary) read_vdb_summary;
decltype(voxelume::read_vdb_density) read_vdb_density;
decltype(voxelume::read_vdb_voxels) read_vdb_voxels;
decltype(voxelume::read_volume_vdb) read_volume_vdb;

bool vdb_identifier_holds(const InputFile&) {
    return true;
}
VdbContent read_vdb_content(const InputFile&) {
    std::abort();
}
VdbFileSummary summary_in(const InputFile&) {
    std::abort();
}
VdbModel model_in(const VdbContent&, const InputFile&, Surface) {
    std::abort();
}
Volume volume_in(const InputFile&) {
    std::abort();
}

}  // namespace vdb

const VdbFunctions voxelume_vdb_functions = {};

void isolate_vdb_readers(bool) {}
void check_vdb_output(const std::filesystem::path&) {
    std::abort();
}
void write_vdb(const std::filesystem::path&, const VdbVolume&) {
    std::abort();
}
void write_volume_vdb(const VolumePath&, const Volume&) {
    std::abort();
}
std::optional<bool> is_vdb_as_written(const std::filesystem::path&) {
    return std::nullopt;
}
VdbFileSummary read_vdb_summary(const std::filesystem::path& path) {
    return vdb::read_vdb_summary(path);
}
std::unique_ptr<DensityField> read_vdb_density(const GridDensity& density) {
    return vdb::read_vdb_density(density);
}
VdbVoxels read_vdb_voxels(const std::filesystem::path& path, Surface surface) {
    return vdb::read_vdb_voxels(path, surface);
}
Volume read_volume_vdb(const VolumePath& path) {
    return vdb::read_volume_vdb(path);
}

}  // namespace voxelume
