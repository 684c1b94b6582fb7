// SPDX-License-Identifier: Apache-2.0
// The program voxelume-vdb-reader: reads one OpenVDB file, for vdb_client.cpp, under limits of its
// own. What a damaged file does to its memory stays here.
#include <tbb/global_control.h>

#include <cstdlib>
#include <cstring>
#include <string_view>

#include "runtime/base/helper/helper_calls.hpp"
#include "runtime/base/helper/helper_limits.hpp"
#include "runtime/base/helper/helper_wire.hpp"
#include "runtime/io/vdb/vdb_client.hpp"
#include "runtime/io/vdb/vdb_model.hpp"
#include "runtime/io/vdb/vdb_read.hpp"
#include "runtime/io/vdb/vdb_tree.hpp"
#include "runtime/io/volume/volume_frame_text.hpp"

namespace voxelume::vdb {
namespace {

void send_summary(WireSender& sender, const VdbFileSummary& summary) {
    sender.texts(summary.metadata);
    sender.value(uint64_t{summary.grids.size()});
    for (const VdbSummary& grid : summary.grids) {
        sender.text(grid.name);
        sender.text(grid.value_type);
        sender.text(grid.grid_class);
        sender.value(grid.active_voxels);
        sender.value(grid.min);
        sender.value(grid.max);
        sender.value(grid.voxel_edges);
    }
}

void send_volume(WireSender& sender, const Volume& volume) {
    sender.text(write_frame_text(volume.frame));
    sender.texts(volume.attributes);
    sender.values(volume.indices);
    sender.values(volume.colors);
    sender.values(volume.opacities);
    sender.values(volume.depths);
    sender.values(volume.objects);
    sender.values(volume.kinds);
}

/// Sends the answer when all of it is known, so that a refusal never follows its beginning.
void answer(WireSender& sender, const InputFile& file, std::string_view question,
            const std::string& detail) {
    const auto begin = [&] { sender.value(ReaderAnswer::content); };
    if (question == "summary") {
        const VdbFileSummary summary = summary_in(file);
        begin();
        send_summary(sender, summary);
    } else if (question == "density") {
        const openvdb::FloatGrid::Ptr grid = density_in(file, detail);
        begin();
        send_grid(sender, *grid);
    } else if (question == "model") {
        const auto surface = static_cast<Surface>(std::atoi(detail.c_str()));
        const VdbContent content = read_vdb_content(file);
        raise_memory_limit();
        const VdbModel model = model_in(content, file, surface);
        begin();
        send_model(sender, model, surface);
    } else {
        const Volume volume = volume_in(file);
        begin();
        send_volume(sender, volume);
    }
    sender.value(ReaderAnswer::end);
}

void refuse(WireSender& sender, const std::string& sentence) {
    sender.value(ReaderAnswer::refusal);
    sender.text(sentence);
}

/// Answers the question in the arguments and ends the process. Returns an exit code if there is no
/// question that this version understands, or if the limits can't be set.
int serve(int count, char** arguments) {
    if (count < 4 || std::strcmp(arguments[1], VXL_VERSION) != 0) return 2;
    const std::string path = arguments[2];
    WireSender sender(kHelperAnswer);
    try {
        const InputFile file(path, kHelperInput);
        const ReaderLimits limits = reader_limits(file.size());
        if (!limit_helper({limits.reading_bytes, limits.model_bytes, limits.computing_seconds}))
            return 3;
        // The stacks and heaps of a large machine's threads would take all of the address space.
        const tbb::global_control alone(tbb::global_control::max_allowed_parallelism, 1);
        forbid_system_calls();
        answer(sender, file, arguments[3], count > 4 ? arguments[4] : "");
    } catch (const Error& error) {
        refuse(sender, error.what());
    } catch (const std::bad_alloc&) {
        refuse(sender,
               path + ": not a readable OpenVDB file: it declares more than there is memory");
    } catch (const std::exception& error) {
        refuse(sender, fmt::format("{}: not a readable OpenVDB file: {}", path,
                                   std::string(error.what()).substr(0, 400)));
    }
    sender.flush();
    _exit(0);  // skips destructors: the heap may be damaged
}

}  // namespace
}  // namespace voxelume::vdb

int main(int count, char** arguments) {
    return voxelume::vdb::serve(count, arguments);
}
