// SPDX-License-Identifier: Apache-2.0
// The bytes of numbers in memory, for the keys of entries on disk.
#pragma once

#include <string>
#include <string_view>
#include <type_traits>

namespace voxelume {

/// A string of bytes. Two keys differ wherever the added numbers differ.
class CacheKey {
  public:
    template <class Value>
    CacheKey& add(const Value& value) {
        static_assert(std::is_arithmetic_v<Value>);
        bytes_.append(reinterpret_cast<const char*>(&value), sizeof value);
        return *this;
    }
    /// Adds the components of a vector of GLM.
    template <class Vector>
    CacheKey& add_all(const Vector& vector) {
        for (int i = 0; i < vector.length(); ++i) add(vector[i]);
        return *this;
    }
    /// Adds the columns of a matrix of GLM.
    template <class Matrix>
    CacheKey& add_columns(const Matrix& matrix) {
        for (int column = 0; column < matrix.length(); ++column) add_all(matrix[column]);
        return *this;
    }
    CacheKey& add_text(std::string_view text) {
        add(text.size());
        bytes_ += text;
        return *this;
    }
    std::string_view bytes() const { return bytes_; }

  private:
    std::string bytes_;
};

}  // namespace voxelume
