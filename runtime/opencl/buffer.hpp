// SPDX-License-Identifier: Apache-2.0
// Typed arrays in a device's memory.
#pragma once

#include <cstddef>
#include <functional>
#include <memory>
#include <span>
#include <string>
#include <type_traits>
#include <vector>

#include "runtime/opencl/device.hpp"

namespace voxelume {

/// The remedy that makes most buffers smaller.
inline constexpr const char* kLargerVoxels = "use larger voxels";

/// Bytes on a device, freed with their last owner. `name` appears in the counters and in messages;
/// `remedy` is the advice if memory doesn't suffice.
class BufferStorage {
  public:
    BufferStorage(Device device, std::string name, size_t bytes, const char* remedy);
    ~BufferStorage();
    BufferStorage(const BufferStorage&) = delete;
    BufferStorage& operator=(const BufferStorage&) = delete;

    void write(size_t offset, const void* data, size_t bytes);
    void read(size_t offset, void* data, size_t bytes) const;
    /// All bytes, after all work in the queue is done. If kernels' memory is the host's own, it is
    /// that memory, not a copy. Nothing may write the bytes afterwards.
    std::shared_ptr<void> contents() const;
    void fill(const void* pattern, size_t pattern_bytes, size_t bytes);
    void copy(const BufferStorage& from, size_t bytes);
    /// Calls `fill` with memory of `bytes` bytes, which become the first bytes of the storage.
    void write_in_place(size_t bytes, const std::function<void(void*)>& fill);
    const cl::Buffer& handle() const { return *buffer_; }

  private:
    void allocate();

    Device device_;
    std::string name_;
    size_t bytes_;
    std::shared_ptr<void> memory_;  ///< the host's memory that the device uses; null otherwise
    std::unique_ptr<cl::Buffer> buffer_;
};

/// The `size()` values of type T on a device. It is a cheap handle: copies share the memory.
///
/// A default-constructed buffer is empty and is passed to kernels as a null pointer. Reading waits
/// for the queue; writing, filling and copying are ordered with the kernels. Throws Error::limit if
/// the device's memory doesn't suffice.
template <class T>
class Buffer {
    static_assert(std::is_trivially_copyable_v<T>);

  public:
    Buffer() = default;
    Buffer(const Device& device, std::string name, size_t size, const char* remedy = kLargerVoxels)
        : size_(size),
          storage_(size == 0 ? nullptr
                             : std::make_shared<BufferStorage>(device, std::move(name),
                                                               size * sizeof(T), remedy)) {}
    Buffer(const Device& device, std::string name, std::span<const T> values)
        : Buffer(device, std::move(name), values.size()) {
        write(values);
    }

    size_t size() const { return size_; }
    bool empty() const { return size_ == 0; }

    void write(std::span<const T> values, size_t first = 0) {
        if (!values.empty()) storage_->write(first * sizeof(T), values.data(), values.size_bytes());
    }
    void fill(const T& value) {
        if (storage_) storage_->fill(&value, sizeof(T), size_ * sizeof(T));
    }
    /// Copies the values of `from`, which has no more values, to the front of this buffer.
    void copy(const Buffer& from) {
        if (!from.empty()) storage_->copy(*from.storage_, from.size_ * sizeof(T));
    }
    /// Calls `fill` with all values, which are undefined, to be written. On a CPU they lie where
    /// kernels read them.
    template <class Fill>
    void write_in_place(Fill&& fill) {
        if (!storage_) return fill(std::span<T>());
        storage_->write_in_place(size_ * sizeof(T), [&](void* values) {
            fill(std::span<T>(static_cast<T*>(values), size_));
        });
    }
    std::vector<T> read() const { return read(0, size_); }
    std::vector<T> read(size_t first, size_t count) const {
        std::vector<T> values(count);
        if (count) storage_->read(first * sizeof(T), values.data(), count * sizeof(T));
        return values;
    }
    /// All values. They are not copied if kernels' memory is the host's own. Nothing may write them
    /// afterwards.
    std::shared_ptr<T> contents() const {
        if (!storage_) return {};
        const std::shared_ptr<void> bytes = storage_->contents();
        return {bytes, static_cast<T*>(bytes.get())};
    }
    T read_one(size_t index) const { return read(index, 1).front(); }
    /// The storage; null for an empty buffer.
    const BufferStorage* storage() const { return storage_.get(); }

  private:
    size_t size_ = 0;
    std::shared_ptr<BufferStorage> storage_;
};

}  // namespace voxelume
