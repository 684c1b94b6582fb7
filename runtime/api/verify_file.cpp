// SPDX-License-Identifier: Apache-2.0
// Whether a file is as it was written, for callers.
#include <algorithm>
#include <optional>

#include "runtime/api/border/guarded.hpp"
#include "runtime/api/border/process.hpp"
#include "runtime/base/files/input_file.hpp"
#include "runtime/base/files/stamp.hpp"
#include "runtime/base/text.hpp"
#include "runtime/io/vdb/vdb.hpp"
#include "runtime/io/volume/volume_check.hpp"
#include "runtime/io/voxels/model_file.hpp"
#include "runtime/voxelume/files.hpp"

namespace voxelume {
namespace {

std::string first_bytes(const std::filesystem::path& path) {
    const InputFile file(path);
    std::string bytes(std::min<uint64_t>(8, file.size()), '\0');
    file.read(0, bytes.data(), bytes.size());
    return bytes;
}

/// Empty for a file without checksums.
std::optional<bool> check_file(const std::filesystem::path& file) {
    const std::string start = first_bytes(file), ending = ending_of(file);
    if (start.starts_with("\x89VXM") || ending == ".vxm") return is_model_as_written(file);
    const std::optional<bool> stamped = is_as_written(file);
    if (ending == ".json") {
        if (stamped != true) return stamped;
        return is_volume_data_as_written(file).value_or(true);
    }
    if (stamped) return stamped;
    if (start.starts_with(" BDV")) return is_vdb_as_written(file);
    return is_volume_data_as_written(file);
}

}  // namespace

namespace v1 {

FileIntegrity verify_file(const std::filesystem::path& file) {
    return api::guarded([&] {
        api::apply_process_options();
        const std::optional<bool> as_written = check_file(file);
        if (!as_written) return FileIntegrity::unknown;
        return *as_written ? FileIntegrity::whole : FileIntegrity::damaged;
    });
}

}  // namespace v1
}  // namespace voxelume
