// SPDX-License-Identifier: Apache-2.0
// Has the program voxelume-vdb-reader read OpenVDB files: a damaged file makes OpenVDB corrupt that
// program's memory instead of ours. vdb_reader_main.cpp is the other end.
#include <dlfcn.h>

#include <algorithm>
#include <array>
#include <atomic>

#include "runtime/base/helper/helper_wire.hpp"
#include "runtime/io/vdb/vdb_client.hpp"
#include "runtime/io/vdb/vdb_model.hpp"
#include "runtime/io/vdb/vdb_module.hpp"
#include "runtime/io/vdb/vdb_read.hpp"
#include "runtime/io/vdb/vdb_stream.hpp"
#include "runtime/io/vdb/vdb_tree.hpp"
#include "runtime/io/volume/volume_frame_text.hpp"

namespace voxelume::vdb {
namespace {

namespace fs = std::filesystem;

constexpr uint64_t kMaxText = 1 << 16;
constexpr uint64_t kMaxEntries = 1 << 16;
constexpr uint64_t kMaxVolumeVoxels = UINT32_MAX;

std::atomic<bool> readers_are_isolated = true;

/// The helper, which is installed next to this module.
fs::path reader_program() {
    Dl_info module{};
    if (dladdr(&voxelume_vdb_functions, &module) == 0 || !module.dli_fname) return kReaderName;
    return fs::absolute(module.dli_fname).parent_path() / kReaderName;
}

[[noreturn]] void refuse(const InputFile& file, const HelperFailure& failure) {
    using Cause = HelperFailure::Cause;
    if (failure.cause() == Cause::missing || failure.cause() == Cause::killed)
        file.refuse(fmt::format("can't be read: {}", failure.what()));
    file.refuse(fmt::format(
        "not a readable OpenVDB file: {}, so it is {}; use another copy of it", failure.what(),
        failure.cause() == Cause::too_long ? "too large or damaged" : "damaged"));
}

/// The result of `receive` for the helper's answer to `question`.
template <class Receive>
auto ask(const InputFile& file, const std::vector<std::string>& question, const Receive& receive) {
    std::vector<std::string> arguments = {VXL_VERSION, file.path().string()};
    arguments.insert(arguments.end(), question.begin(), question.end());
    try {
        HelperProcess helper(reader_program(), arguments, file.descriptor(),
                             reader_limits(file.size()).seconds);
        WireReceiver receiver(helper);
        const auto answer = receiver.value<ReaderAnswer>();
        if (answer == ReaderAnswer::refusal)
            throw Error(SourcePlace(file.path().string()), ErrorKind::input,
                        receiver.text(kMaxText));
        if (answer != ReaderAnswer::content) WireReceiver::fail();
        auto content = receive(receiver);
        if (receiver.value<ReaderAnswer>() != ReaderAnswer::end) WireReceiver::fail();
        return content;
    } catch (const HelperFailure& failure) {
        refuse(file, failure);
    }
}

/// The helper holds the tree, too, within its limit.
uint64_t max_tree(const InputFile& file) {
    return reader_limits(file.size()).reading_bytes;
}

VdbFileSummary receive_summary(WireReceiver& receiver) {
    VdbFileSummary summary{receiver.texts(), {}};
    for (uint64_t left = receiver.count(kMaxEntries); left > 0; --left) {
        VdbSummary grid;
        grid.name = receiver.text(kMaxText);
        grid.value_type = receiver.text(kMaxText);
        grid.grid_class = receiver.text(kMaxText);
        grid.active_voxels = receiver.value<uint64_t>();
        grid.min = receiver.value<glm::ivec3>();
        grid.max = receiver.value<glm::ivec3>();
        grid.voxel_edges = receiver.value<glm::dvec3>();
        summary.grids.push_back(std::move(grid));
    }
    return summary;
}

Volume receive_volume(WireReceiver& receiver, const InputFile& file) {
    Volume volume;
    volume.frame = read_frame_text(receiver.text(kMaxText), file.path().string());
    volume.attributes = receiver.texts();
    volume.indices = receiver.values<uint64_t>(kMaxVolumeVoxels);
    volume.colors = receiver.values<glm::vec3>(kMaxVolumeVoxels);
    volume.opacities = receiver.values<float>(kMaxVolumeVoxels);
    volume.depths = receiver.values<float>(kMaxVolumeVoxels);
    volume.objects = receiver.values<uint32_t>(kMaxVolumeVoxels);
    volume.kinds = receiver.values<VoxelKind>(kMaxVolumeVoxels);
    const size_t count = volume.indices.size();
    for (const size_t other : {volume.colors.size(), volume.opacities.size(), volume.depths.size(),
                               volume.objects.size(), volume.kinds.size()})
        if (other != count) WireReceiver::fail();
    const glm::ivec3& size = volume.frame.size;
    const uint64_t cell_count = uint64_t(size.x) * uint64_t(size.y) * uint64_t(size.z);
    for (size_t i = 0; i < count; ++i)
        if (volume.indices[i] >= cell_count ||
            (i > 0 && volume.indices[i] <= volume.indices[i - 1]) ||
            volume.kinds[i] > VoxelKind::unseen)
            WireReceiver::fail();
    return volume;
}

/// Cells along each axis for which a grid has one value, by the depth at which it has it; the
/// background, of depth -1, fills nodes as large as those of depth 0.
constexpr std::array<int, 4> kCellsOfTile{4096, 128, 8, 1};

VdbVoxels with_values(VdbModel model) {
    if (model.grid)
        model.voxels.run_at = [grid = model.grid, tree = model.grid->getConstUnsafeAccessor()](
                                  const glm::ivec3& cell) {
            const openvdb::Coord place(cell.x, cell.y, cell.z);
            const int size = kCellsOfTile[size_t(std::max(tree.getValueDepth(place), 0))];
            return ValueRun{tree.getValue(place), size - (cell.x & (size - 1))};
        };
    return std::move(model.voxels);
}

}  // namespace

void isolate_vdb_readers(bool is_isolated) {
    readers_are_isolated = is_isolated;
}

VdbFileSummary read_vdb_summary(const fs::path& path) {
    const InputFile file(path);
    if (!readers_are_isolated) return summary_in(file);
    return ask(file, {"summary"}, receive_summary);
}

std::unique_ptr<DensityField> read_vdb_density(const GridDensity& density) {
    const InputFile file(density.file);
    if (!readers_are_isolated)
        return density_field_of(density_in(file, density.grid), density.world_from_grid);
    const auto receive = [&](WireReceiver& receiver) {
        return receive_grid(receiver, max_tree(file));
    };
    return density_field_of(ask(file, {"density", density.grid}, receive), density.world_from_grid);
}

VdbVoxels read_vdb_voxels(const fs::path& path, Surface surface) {
    const InputFile file(path);
    if (!readers_are_isolated) return with_values(model_in(read_vdb_content(file), file, surface));
    const auto receive = [&](WireReceiver& receiver) {
        return receive_model(receiver, surface, max_tree(file));
    };
    return with_values(ask(file, {"model", std::to_string(int(surface))}, receive));
}

Volume read_volume_vdb(const VolumePath& path) {
    const InputFile file(path);
    if (!vdb_identifier_holds(file))
        file.refuse(
            "not an OpenVDB file of voxelume, or damaged since: its identifier isn't "
            "the one of its content");
    if (!readers_are_isolated) return volume_in(file);
    return ask(file, {"volume"},
               [&](WireReceiver& receiver) { return receive_volume(receiver, file); });
}

}  // namespace voxelume::vdb
