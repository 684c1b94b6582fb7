// SPDX-License-Identifier: Apache-2.0
#include "runtime/opencl/buffer.hpp"

#include <sys/mman.h>
#include <CL/opencl.hpp>

#include <algorithm>
#include <cstdlib>

#include "runtime/base/error.hpp"
#include "runtime/opencl/device_call.hpp"

namespace voxelume {
namespace {

std::string megabytes(uint64_t bytes) {
    return fmt::format("{:.1f} MB", double(bytes) / 1e6);
}

constexpr size_t kHugePage = size_t{2} << 20;

/// Allocates memory in huge pages if the system offers them. Rays read voxels from all over the
/// world, and with small pages the page's address would seldom be in a cache.
std::shared_ptr<void> allocate_huge_pages(size_t bytes) {
    const size_t whole = (bytes + kHugePage - 1) / kHugePage * kHugePage;
    void* memory = std::aligned_alloc(kHugePage, whole);
    if (!memory) throw cl::Error(CL_MEM_OBJECT_ALLOCATION_FAILURE, "aligned_alloc");
    madvise(memory, whole, MADV_HUGEPAGE);
    return {memory, std::free};
}

void CL_CALLBACK let_go(cl_mem, void* owner) {
    delete static_cast<std::shared_ptr<void>*>(owner);
}

/// A buffer in the host's memory. The buffer keeps the memory for as long as the driver uses it.
cl::Buffer buffer_around(const cl::Context& context, size_t bytes,
                         const std::shared_ptr<void>& memory) {
    cl::Buffer buffer(context, CL_MEM_READ_WRITE | CL_MEM_USE_HOST_PTR, bytes, memory.get());
    auto owner = std::make_unique<std::shared_ptr<void>>(memory);
    buffer.setDestructorCallback(let_go, owner.get());
    (void)owner.release();
    return buffer;
}

}  // namespace

BufferStorage::BufferStorage(Device device, std::string name, size_t bytes, const char* remedy)
    : device_(std::move(device)), name_(std::move(name)), bytes_(bytes) {
    const DeviceInfo& info = device_.info();
    const auto locked = device_.lock();
    DeviceCounters& counters = device_.counters();
    if (bytes > info.max_allocation)
        throw Error(ErrorKind::limit, "the {} buffer needs {} in one piece, \"{}\" allows {}: {}",
                    name_, megabytes(bytes), info.name, megabytes(info.max_allocation), remedy);
    if (counters.bytes_in_use + bytes > info.memory)
        throw Error(ErrorKind::limit, "the {} buffer needs {} on \"{}\", which has {} left: {}",
                    name_, megabytes(bytes), info.name,
                    megabytes(info.memory - counters.bytes_in_use), remedy);
    if (!device_.is_counting()) allocate();
    counters.allocated_bytes[name_] += bytes;
    counters.bytes_in_use += bytes;
    counters.peak_bytes = std::max(counters.peak_bytes, counters.bytes_in_use);
    if (bytes > counters.largest_bytes) {
        counters.largest_bytes = bytes;
        counters.largest_buffer = name_;
    }
}

void BufferStorage::allocate() {
    try {
        const DeviceCall call(device_.info(), "allocating the ", name_, " buffer");
        if (device_.is_cpu() && bytes_ >= kHugePage) {
            memory_ = allocate_huge_pages(bytes_);
            buffer_ =
                std::make_unique<cl::Buffer>(buffer_around(device_.context(), bytes_, memory_));
        } else {
            buffer_ = std::make_unique<cl::Buffer>(device_.context(), CL_MEM_READ_WRITE, bytes_);
        }
    } catch (const cl::Error& error) {
        throw_device_error(error, device_.info(), fmt::format("allocating the {} buffer", name_));
    }
}

BufferStorage::~BufferStorage() {
    const auto locked = device_.lock();
    device_.counters().bytes_in_use -= bytes_;
}

void BufferStorage::write(size_t offset, const void* data, size_t bytes) {
    if (device_.is_counting()) return;
    try {
        const DeviceCall call(device_.info(), "writing the ", name_, " buffer");
        device_.queue().enqueueWriteBuffer(*buffer_, CL_TRUE, offset, bytes, data);
    } catch (const cl::Error& error) {
        throw_device_error(error, device_.info(), fmt::format("writing the {} buffer", name_));
    }
}

void BufferStorage::read(size_t offset, void* data, size_t bytes) const {
    try {
        const DeviceCall call(device_.info(), "reading the ", name_, " buffer");
        device_.queue().enqueueReadBuffer(*buffer_, CL_TRUE, offset, bytes, data);
    } catch (const cl::Error& error) {
        throw_device_error(error, device_.info(), fmt::format("reading the {} buffer", name_));
    }
}

std::shared_ptr<void> BufferStorage::contents() const {
    if (!memory_) {
        const std::shared_ptr<char[]> bytes(new char[bytes_]);
        read(0, bytes.get(), bytes_);
        return bytes;
    }
    try {
        const DeviceCall call(device_.info(), "reading the ", name_, " buffer");
        const cl::CommandQueue& queue = device_.queue();
        void* const place = queue.enqueueMapBuffer(*buffer_, CL_TRUE, CL_MAP_READ, 0, bytes_);
        queue.enqueueUnmapMemObject(*buffer_, place);
    } catch (const cl::Error& error) {
        throw_device_error(error, device_.info(), fmt::format("reading the {} buffer", name_));
    }
    return memory_;
}

void BufferStorage::fill(const void* pattern, size_t pattern_bytes, size_t bytes) {
    if (device_.is_counting()) return;
    const DeviceCall call(device_.info(), "filling the ", name_, " buffer");
    const cl_int status = clEnqueueFillBuffer(device_.queue()(), (*buffer_)(), pattern,
                                              pattern_bytes, 0, bytes, 0, nullptr, nullptr);
    if (status != CL_SUCCESS)
        throw_device_error(cl::Error(status, "clEnqueueFillBuffer"), device_.info(),
                           fmt::format("filling the {} buffer", name_));
}

void BufferStorage::copy(const BufferStorage& from, size_t bytes) {
    if (device_.is_counting()) return;
    try {
        const DeviceCall call(device_.info(), "copying to the ", name_, " buffer");
        device_.queue().enqueueCopyBuffer(*from.buffer_, *buffer_, 0, 0, bytes);
    } catch (const cl::Error& error) {
        throw_device_error(error, device_.info(), fmt::format("copying to the {} buffer", name_));
    }
}

void BufferStorage::write_in_place(size_t bytes, const std::function<void(void*)>& fill) {
    if (device_.is_counting()) return;
    try {
        const DeviceCall call(device_.info(), "writing the ", name_, " buffer");
        cl::CommandQueue& queue = device_.queue();
        void* const place =
            queue.enqueueMapBuffer(*buffer_, CL_TRUE, CL_MAP_WRITE_INVALIDATE_REGION, 0, bytes);
        const auto unmap = [&](void* mapped) {
            clEnqueueUnmapMemObject(queue(), (*buffer_)(), mapped, 0, nullptr, nullptr);
        };
        const std::unique_ptr<void, decltype(unmap)> mapping(place, unmap);
        fill(place);
    } catch (const cl::Error& error) {
        throw_device_error(error, device_.info(), fmt::format("writing the {} buffer", name_));
    }
}

}  // namespace voxelume
