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

/// What makes most buffers smaller.
inline constexpr const char* kLargerVoxels = "use larger voxels";

/// Bytes on a device. Freed with its last owner. `name` appears in the counters and in messages,
/// `remedy` where memory doesn't suffice.
class BufferStorage {
  public:
    BufferStorage(Device device, std::string name, size_t bytes, const char* remedy);
    ~BufferStorage();
    BufferStorage(const BufferStorage&) = delete;
    BufferStorage& operator=(const BufferStorage&) = delete;

    void write(size_t offset, const void* data, size_t bytes);
    void read(size_t offset, void* data, size_t bytes) const;
    /// All bytes, as the queue leaves them; where kernels' memory is the host's own, that memory.
    /// Nothing may write them from now on.
    std::shared_ptr<void> contents() const;
    void fill(const void* pattern, size_t pattern_bytes, size_t bytes);
    void copy(const BufferStorage& from, size_t bytes);
    /// Shows `fill` memory of so many bytes, which become the first of these.
    void write_in_place(size_t bytes, const std::function<void(void*)>& fill);
    const cl::Buffer& handle() const { return *buffer_; }

  private:
    void allocate();

    Device device_;
    std::string name_;
    size_t bytes_;
    std::shared_ptr<void> memory_;  ///< the host's, which the device uses; or none
    std::unique_ptr<cl::Buffer> buffer_;
};

/// `size()` values of type T on a device; a cheap handle, copies share the memory.
///
/// A default-constructed buffer is empty and is passed to kernels as a null pointer. Reading waits
/// for the queue; writing, filling and copying are ordered with the kernels. Throws Error::limit
/// when the device has not enough memory.
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
    /// Begins with the values of `from`, which has no more.
    void copy(const Buffer& from) {
        if (!from.empty()) storage_->copy(*from.storage_, from.size_ * sizeof(T));
    }
    /// Shows `fill` all values, undefined, to be written; on a CPU they lie where kernels read
    /// them.
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
    /// All values, not copied where kernels' memory is the host's own; nothing may write them
    /// again.
    std::shared_ptr<T> contents() const {
        if (!storage_) return {};
        const std::shared_ptr<void> bytes = storage_->contents();
        return {bytes, static_cast<T*>(bytes.get())};
    }
    T read_one(size_t index) const { return read(index, 1).front(); }
    /// None for an empty buffer.
    const BufferStorage* storage() const { return storage_.get(); }

  private:
    size_t size_ = 0;
    std::shared_ptr<BufferStorage> storage_;
};

}  // namespace voxelume
