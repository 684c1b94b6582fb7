// SPDX-License-Identifier: Apache-2.0
// PoCL up to 3.1 runs all of LLVM's standard passes over a kernel after its own passes, which have
// done most of the work by then; the standard passes take a third of the time of compiling. Seven
// of them yield kernels that run as fast. No setting leaves the others out, but PoCL calls a
// function of LLVM's library for them, and the dynamic linker prefers a function of the same name
// in the program. So Voxelume's programs export such a function (the link options of
// voxelume_runtime); the shared library doesn't, since other programs may want that function for
// themselves. Other callers, such as Oclgrind, get all passes of their own LLVM, and so does PoCL
// if its LLVM lacks one of the seven.
#include "runtime/opencl/quirks/llvm_passes.hpp"

#include <dlfcn.h>

#include <algorithm>
#include <array>
#include <atomic>
#include <string_view>

namespace voxelume {
namespace {

/// llvm::PassManagerBuilder::populateModulePassManager(llvm::legacy::PassManagerBase&)
#define VXL_STANDARD_PASSES \
    "_ZN4llvm18PassManagerBuilder25populateModulePassManagerERNS_6legacy15PassManagerBaseE"

/// The passes, in the order in which they run. They remove functions that nothing calls (such as
/// PoCL's own, which could not be linked), move structures to registers, compute nothing twice,
/// simplify operations, move what stays the same out of loops, remove branches, and join equal
/// operations to one of vectors, without which fog takes a tenth longer.
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

/// The LLVM of the library that asks for passes. A process may have several: PoCL's, Oclgrind's.
struct Llvm {
    StandardPasses standard = nullptr;
    std::array<AddPass, kPasses.size()> passes{};
    bool is_pocls = false;

    /// `caller` is an address inside that library, and `ours` our own function.
    Llvm(const void* caller, StandardPasses ours) {
        Dl_info found{};
        void* library = nullptr;
        if (dladdr(caller, &found) != 0 && found.dli_fname) {
            library = dlopen(found.dli_fname, RTLD_LAZY | RTLD_NOLOAD);  // never closed
            const std::string_view path = found.dli_fname;
            is_pocls = path.substr(path.rfind('/') + 1).starts_with("libpocl");
        }
        if (library) {
            standard = function_of<StandardPasses>(library, VXL_STANDARD_PASSES);
            std::ranges::transform(kPasses, passes.begin(), [&](const char* name) {
                return function_of<AddPass>(library, name);
            });
        }
        if (!standard || standard == ours)
            standard = function_of<StandardPasses>(RTLD_NEXT, VXL_STANDARD_PASSES);
    }
    bool has_all() const {
        return std::ranges::none_of(passes, [](AddPass add) { return add == nullptr; });
    }
};

std::atomic<uint64_t>& times_taken() {
    static std::atomic<uint64_t> count{0};
    return count;
}

void add_passes(void* builder, void* manager, const void* caller, StandardPasses ours) {
    const Llvm llvm(caller, ours);  // PoCL asks once for each device
    if (llvm.is_pocls && llvm.has_all()) {
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
    voxelume::add_passes(builder, manager, __builtin_return_address(0), voxelume_add_passes);
}
}
