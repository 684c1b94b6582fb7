// SPDX-License-Identifier: Apache-2.0
// PoCL up to 3.1 runs all of LLVM's standard passes over a kernel after its own passes, which have
// done most of it by then: they take a third of the time of compiling. Seven of them yield kernels
// that run as fast. No setting leaves the others out, but PoCL calls a function of LLVM's library
// for them, and the dynamic linker takes a program's function of the same name in its place. So
// programs of ours export it (the link options of voxelume_runtime); the shared library doesn't,
// since programs of others may want that function for themselves. Where a driver doesn't call it,
// or LLVM lacks a pass, everything is as without this file.
#include "runtime/opencl/quirks/llvm_passes.hpp"

#include <dlfcn.h>

#include <algorithm>
#include <array>
#include <atomic>

namespace voxelume {
namespace {

/// llvm::PassManagerBuilder::populateModulePassManager(llvm::legacy::PassManagerBase&)
#define VXL_STANDARD_PASSES \
    "_ZN4llvm18PassManagerBuilder25populateModulePassManagerERNS_6legacy15PassManagerBaseE"

/// In the order in which they run: no functions that nothing calls (such as PoCL's own, which could
/// not be linked), structures in registers, nothing computed twice, simpler operations, nothing in
/// loops that stays the same, fewer branches, and equal operations as one of vectors, without which
/// fog takes a tenth longer.
constexpr std::array kPasses = {"LLVMAddGlobalDCEPass",      "LLVMAddScalarReplAggregatesPass",
                                "LLVMAddEarlyCSEMemSSAPass", "LLVMAddInstructionCombiningPass",
                                "LLVMAddLICMPass",           "LLVMAddCFGSimplificationPass",
                                "LLVMAddSLPVectorizePass"};

using StandardPasses = void (*)(void* builder, void* manager);
using AddPass = void (*)(void* manager);

template <class Function>
Function function_of(void* library, const char* name) {
    return reinterpret_cast<Function>(dlsym(library, name));
}

/// LLVM as PoCL sees it.
struct Llvm {
    StandardPasses standard = nullptr;
    std::array<AddPass, kPasses.size()> passes{};

    /// `caller` is an address inside PoCL.
    explicit Llvm(const void* caller) {
        Dl_info found{};
        if (dladdr(caller, &found) == 0) return;
        void* const library = dlopen(found.dli_fname, RTLD_LAZY | RTLD_NOLOAD);  // never closed
        if (!library) return;
        standard = function_of<StandardPasses>(library, VXL_STANDARD_PASSES);
        std::ranges::transform(kPasses, passes.begin(), [&](const char* name) {
            return function_of<AddPass>(library, name);
        });
    }
    bool has_all() const {
        return std::ranges::none_of(passes, [](AddPass add) { return add == nullptr; });
    }
};

std::atomic<uint64_t>& times_taken() {
    static std::atomic<uint64_t> count{0};
    return count;
}

void add_passes(void* builder, void* manager, const void* caller) {
    static const Llvm llvm(caller);
    if (llvm.has_all()) {
        for (const AddPass add : llvm.passes) add(manager);
        ++times_taken();
    } else if (llvm.standard) {
        llvm.standard(builder, manager);
    }
}

}  // namespace

uint64_t few_passes_taken() {
    return times_taken();
}

}  // namespace voxelume

extern "C" {
[[gnu::visibility("default")]] void voxelume_add_passes(void* builder,
                                                        void* manager) asm(VXL_STANDARD_PASSES);
void voxelume_add_passes(void* builder, void* manager) {
    voxelume::add_passes(builder, manager, __builtin_return_address(0));
}
}
