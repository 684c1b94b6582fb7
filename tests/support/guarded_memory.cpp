// SPDX-License-Identifier: Apache-2.0
// A library that is preloaded into a test program. It places the end of every aligned block of
// memory, which OpenCL uses for buffers on the CPU, next to pages that may not be touched; freed
// blocks become such pages, too. A kernel that reads or writes there ends the program. Blocks begin
// with bytes that no code wrote on purpose.
#include <dlfcn.h>
#include <sys/mman.h>

#include <atomic>
#include <cerrno>
#include <cstddef>
#include <cstdint>
#include <cstring>

namespace {

constexpr size_t kPage = 4096;
constexpr size_t kRegion = size_t{1} << 45;      // bytes of addresses, each of which is used once
constexpr size_t kForbidden = size_t{16} << 20;  // behind each block: room for wrong indices
constexpr size_t kBuffer = 64;  // minimum alignment of possible buffers; compilers ask for less
constexpr int kFilling = 0xA5;

/// The header in front of a block.
struct Header {
    char* pages;
    size_t bytes;
};

char* region() {
    static char* const start = static_cast<char*>(
        mmap(nullptr, kRegion, PROT_NONE, MAP_PRIVATE | MAP_ANONYMOUS | MAP_NORESERVE, -1, 0));
    return start;
}

void* guarded_block(size_t alignment, size_t size) {
    static std::atomic<size_t> used{0};
    const size_t step = alignment > kPage ? alignment : kPage;
    const size_t block = (size + alignment - 1) / alignment * alignment;
    const size_t pages = (block + sizeof(Header) + step - 1) / step * step;
    const size_t span = (pages + kForbidden + step - 1) / step * step;
    const size_t at = used.fetch_add(span + step);
    if (region() == MAP_FAILED || at + span + step > kRegion) return nullptr;
    const uintptr_t address = reinterpret_cast<uintptr_t>(region()) + at;
    char* first = reinterpret_cast<char*>((address + step - 1) / step * step);
    if (mprotect(first, pages, PROT_READ | PROT_WRITE) != 0) return nullptr;
    char* start = first + (pages - block);
    const Header header = {first, pages};
    std::memcpy(start - sizeof header, &header, sizeof header);
    std::memset(start, kFilling, block);
    return start;
}

}  // namespace

extern "C" {

int posix_memalign(void** block, size_t alignment, size_t size) {
    static const auto next =
        reinterpret_cast<int (*)(void**, size_t, size_t)>(dlsym(RTLD_NEXT, "posix_memalign"));
    if (alignment < kBuffer) return next(block, alignment, size);
    *block = guarded_block(alignment, size ? size : 1);
    return *block ? 0 : ENOMEM;
}

void* aligned_alloc(size_t alignment, size_t size) {
    static const auto next =
        reinterpret_cast<void* (*)(size_t, size_t)>(dlsym(RTLD_NEXT, "aligned_alloc"));
    if (alignment < kBuffer) return next(alignment, size);
    return guarded_block(alignment, size ? size : 1);
}

void free(void* block) {
    static const auto next = reinterpret_cast<void (*)(void*)>(dlsym(RTLD_NEXT, "free"));
    const auto offset = reinterpret_cast<uintptr_t>(block) - reinterpret_cast<uintptr_t>(region());
    if (offset >= kRegion) return next(block);
    Header header;
    std::memcpy(&header, static_cast<char*>(block) - sizeof header, sizeof header);
    madvise(header.pages, header.bytes, MADV_DONTNEED);
    mprotect(header.pages, header.bytes, PROT_NONE);
}

}  // extern "C"
