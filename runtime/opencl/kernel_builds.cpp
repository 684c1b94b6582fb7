// SPDX-License-Identifier: Apache-2.0
#include "runtime/opencl/kernel_builds.hpp"

#include <algorithm>
#include <array>
#include <semaphore>
#include <system_error>
#include <thread>
#include <utility>

#include "runtime/base/error.hpp"
#include "runtime/base/files/disk_cache.hpp"
#include "runtime/opencl/source/kernel_slice.hpp"

namespace voxelume {
namespace {

/// A slot for one running compiler; the machine has as many slots as cores.
class CompilerSlot {
  public:
    CompilerSlot() { slots().acquire(); }
    ~CompilerSlot() { slots().release(); }
    CompilerSlot(const CompilerSlot&) = delete;
    CompilerSlot& operator=(const CompilerSlot&) = delete;

  private:
    static std::counting_semaphore<>& slots() {
        static std::counting_semaphore<> left(std::max(1u, std::thread::hardware_concurrency()));
        return left;
    }
};

BuiltProgram build_part(const CompilerTarget& target, const std::string& label,
                        const KernelPart& part, const ProgramText& whole) {
    const CompilerSlot slot;
    try {
        return build_with_binary(target, label, part.text);
    } catch (const Error&) {
        return build_with_binary(target, label, whole);
    }
}

}  // namespace

std::shared_ptr<const ProgramParts> KernelBuilds::parts_of(const std::string& key,
                                                           const std::string& source,
                                                           const std::string& options) {
    const std::lock_guard lock(mutex_);
    std::shared_ptr<const ProgramParts>& known = parts_[key];
    if (known) return known;
    const std::string others = without_constants(options);
    auto parts = std::make_shared<ProgramParts>();
    parts->whole = {source, options};
    for (KernelSlice& slice : slice_kernels(source, options)) {
        const std::array<std::string_view, 2> contents = {slice.text, others};
        const std::string part = cache_key(contents);
        parts->kernels[slice.kernel] = {part, {std::move(slice.text), others}};
    }
    return known = std::move(parts);
}

std::shared_future<BuiltProgram> KernelBuilds::start(const CompilerTarget& target,
                                                     const std::string& label,
                                                     const KernelPart& part,
                                                     const ProgramText& whole) {
    const std::lock_guard lock(mutex_);
    std::shared_future<BuiltProgram>& build = builds_[part.key];
    if (!build.valid())
        build = std::async(std::launch::async, build_part, target, label, part, whole).share();
    return build;
}

void KernelBuilds::begin(const std::string& key, std::function<BuiltProgram()> build) {
    const std::lock_guard lock(mutex_);
    if (begun_.contains(key)) return;
    try {
        begun_.emplace(key, std::async(std::launch::async, std::move(build)));
    } catch (const std::system_error&) {
        return;  // no thread can be started, so the program is built when it is needed
    }
}

std::optional<BuiltProgram> KernelBuilds::take(const std::string& key) {
    std::future<BuiltProgram> begun;
    {
        const std::lock_guard lock(mutex_);
        const auto found = begun_.find(key);
        if (found == begun_.end()) return std::nullopt;
        begun = std::move(found->second);
        begun_.erase(found);
    }
    return begun.get();
}

}  // namespace voxelume
