// SPDX-License-Identifier: Apache-2.0
// One channel of an image.
#pragma once

#include <algorithm>
#include <cstddef>
#include <initializer_list>
#include <memory>
#include <utility>
#include <vector>

namespace voxelume {

/// The values of one channel; their number is fixed. A copy owns its values. The memory itself may
/// be part of a larger allocation, such as the buffer that kernels wrote.
template <class T>
class Plane {
  public:
    Plane() = default;
    // NOLINTNEXTLINE(google-explicit-constructor): values become a plane wherever one is wanted
    Plane(std::vector<T> values) {
        const auto owner = std::make_shared<std::vector<T>>(std::move(values));
        size_ = owner->size();
        values_ = {owner, owner->data()};
    }
    Plane(std::initializer_list<T> values) : Plane(std::vector<T>(values)) {}
    /// Takes `size` values from where `values` points. `values` keeps their memory alive.
    Plane(std::shared_ptr<T> values, size_t size) : values_(std::move(values)), size_(size) {}

    Plane(const Plane& other) : Plane(std::vector<T>(other.begin(), other.end())) {}
    Plane(Plane&& other) noexcept
        : values_(std::move(other.values_)), size_(std::exchange(other.size_, 0)) {}
    Plane& operator=(Plane other) noexcept {
        std::swap(values_, other.values_);
        std::swap(size_, other.size_);
        return *this;
    }
    ~Plane() = default;

    size_t size() const { return size_; }
    bool empty() const { return size_ == 0; }
    T* data() { return values_.get(); }
    const T* data() const { return values_.get(); }
    T& operator[](size_t i) { return data()[i]; }
    const T& operator[](size_t i) const { return data()[i]; }
    T* begin() { return data(); }
    T* end() { return data() + size_; }
    const T* begin() const { return data(); }
    const T* end() const { return data() + size_; }

    friend bool operator==(const Plane& a, const Plane& b) { return std::ranges::equal(a, b); }

  private:
    std::shared_ptr<T> values_;
    size_t size_ = 0;
};

}  // namespace voxelume
