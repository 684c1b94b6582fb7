// SPDX-License-Identifier: Apache-2.0
// The list of kernels, and the launches of each on a device, for callers, and a folder for what
// tests of a device read.
#include "runtime/api/border/guarded.hpp"
#include "runtime/api/border/handles.hpp"
#include "runtime/base/files/temporary_folder.hpp"
#include "runtime/opencl/self_test/self_test.hpp"
#include "runtime/opencl/source/kernel_source.hpp"
#include "runtime/voxelume_verify.hpp"

namespace voxelume::v1 {
namespace {

constexpr std::string_view kBegin = "\nkernel void ";

void add_kernels(const std::string& file, std::string_view text, std::vector<KernelName>& names) {
    for (size_t at = text.find(kBegin); at != text.npos; at = text.find(kBegin, at + 1)) {
        const size_t first = at + kBegin.size();
        names.push_back({std::string(text.substr(first, text.find('(', first) - first)), file});
    }
}

}  // namespace

std::shared_ptr<const std::filesystem::path> make_temporary_folder() {
    return api::guarded([] {
        const auto folder = std::make_shared<const TemporaryFolder>();
        return std::shared_ptr<const std::filesystem::path>(folder, &folder->path());
    });
}

std::vector<KernelName> kernel_names() {
    std::vector<KernelName> names;
    for (const auto& [file, text] : embedded_kernels()) add_kernels(file, text, names);
    return names;
}

std::map<std::string, uint64_t> launches_of(const Device& device) {
    return api::guarded([&] {
        const voxelume::Device& inside = api::inside(device);
        const auto locked = inside.lock();
        return inside.counters().launches;
    });
}

std::string fault_of_known_bits(const Device& device) {
    return api::guarded([&] { return find_fault(api::inside(device)); });
}

}  // namespace voxelume::v1
