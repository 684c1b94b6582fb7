// SPDX-License-Identifier: Apache-2.0
// The body of a PLY file, value by value: one interface for text and both byte orders.
#pragma once

#include "runtime/base/decimal.hpp"
#include "runtime/io/mesh/ply/mesh_ply_header.hpp"

#include <algorithm>
#include <bit>
#include <cmath>
#include <cstring>

namespace voxelume {

/// Rows of text, one line each. Error messages name the line.
class PlyAsciiRows {
  public:
    PlyAsciiRows(const MeshSource& source, const char* body) : source_(source), p_(body) {}

    void begin_row() {
        for (p_ = skip_blanks(p_); *p_ == '\n'; p_ = skip_blanks(p_ + 1)) {
        }
        if (*p_ == '\0') {
            fail("the file ends before its last element");
        }
    }

    void end_row() {
        p_ = skip_blanks(p_);
        if (*p_ != '\n' && *p_ != '\0') {
            fail(fmt::format("{} is one value more than the element has", quoted_token(p_)));
        }
    }

    double number(PlyType) {
        find_value();
        return static_cast<double>(require_number(source_, p_));
    }

    /// The value of a number; NaN for another word.
    double number_or_nan(PlyType) {
        find_value();
        const Decimal found = scan_decimal(p_);
        const bool is_number = found.status == DecimalStatus::ok && ends_token(*found.end);
        p_ = skip_token(p_);
        return is_number ? static_cast<double>(found.value) : NAN;
    }

    int64_t integer(PlyType) {
        find_value();
        const Integer value = scan_integer(p_);
        if (value.end == p_ || !ends_token(*value.end)) {
            fail(fmt::format("{} is no whole number", quoted_token(p_)));
        }
        p_ = value.end;
        return value.value;
    }

    void skip(PlyType, uint64_t count) {
        for (uint64_t i = 0; i < count; ++i) {
            find_value();
            p_ = skip_token(p_);
        }
    }

    /// True if the file may hold `count` more values.
    bool holds(PlyType, uint64_t count) const {
        return count <= static_cast<uint64_t>(source_.end() - p_) / 2 + 1;
    }

    const char* at() const { return p_; }
    [[noreturn]] void fail(std::string_view sentence) const { source_.fail_at_line(p_, sentence); }

  private:
    void find_value() {
        p_ = skip_blanks(p_);
        if (*p_ == '\n' || *p_ == '\0') {
            fail("the line ends before the last value of its element");
        }
    }

    const MeshSource& source_;
    const char* p_;
};

/// Rows of binary values in the byte order `Order`. Error messages name the byte.
template <std::endian Order>
class PlyBinaryRows {
  public:
    PlyBinaryRows(const MeshSource& source, const char* body)
        : source_(source), p_(body), value_(body) {}

    void begin_row() { value_ = p_; }
    void end_row() {}

    double number(PlyType type) {
        switch (type) {
            case PlyType::float32:
                return static_cast<double>(load<float>());
            case PlyType::float64:
                return load<double>();
            default:
                return static_cast<double>(integer(type));
        }
    }

    double number_or_nan(PlyType type) { return number(type); }

    /// Reads an integer. `type` has to be an integer type.
    int64_t integer(PlyType type) {
        switch (type) {
            case PlyType::int8:
                return load<int8_t>();
            case PlyType::uint8:
                return load<uint8_t>();
            case PlyType::int16:
                return load<int16_t>();
            case PlyType::uint16:
                return load<uint16_t>();
            case PlyType::int32:
                return load<int32_t>();
            default:
                return load<uint32_t>();
        }
    }

    void skip(PlyType type, uint64_t count) {
        value_ = p_;
        require(holds(type, count));
        p_ += count * size_of(type);
    }

    bool holds(PlyType type, uint64_t count) const {
        return count <= static_cast<uint64_t>(source_.end() - p_) / size_of(type);
    }

    const char* at() const { return p_; }
    [[noreturn]] void fail(std::string_view sentence) const {
        source_.fail_at_byte(value_, sentence);
    }

  private:
    void require(bool held) const {
        if (!held) {
            fail("the file ends inside an element; it is damaged or incomplete");
        }
    }

    template <class T>
    T load() {
        value_ = p_;
        require(static_cast<size_t>(source_.end() - p_) >= sizeof(T));
        char bytes[sizeof(T)];
        std::memcpy(bytes, p_, sizeof(T));
        if constexpr (Order != std::endian::native) {
            std::reverse(bytes, bytes + sizeof(T));
        }
        p_ += sizeof(T);
        T value;
        std::memcpy(&value, bytes, sizeof(T));
        return value;
    }

    const MeshSource& source_;
    const char* p_;
    const char* value_;  ///< start of the value that was read last
};

}  // namespace voxelume
