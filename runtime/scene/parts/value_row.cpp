// SPDX-License-Identifier: Apache-2.0
#include "runtime/scene/parts/value_row.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <stdexcept>

namespace voxelume {
namespace {

/// Writes numbers to the value of a slot.
struct Writer {
    std::span<const double> numbers;
    int item;

    void operator()(double* number) const { *number = numbers[0]; }
    void operator()(float* number) const { *number = float(numbers[0]); }
    void operator()(int* number) const { *number = int(numbers[0]); }
    void operator()(bool* flag) const { *flag = numbers[0] != 0; }
    void operator()(std::filesystem::path*) const {
        throw std::logic_error("a file is not set by numbers");
    }

    void operator()(std::vector<double>* list) const {
        if (item >= 0)
            list->at(size_t(item)) = numbers[0];
        else
            list->assign(numbers.begin(), numbers.end());
    }

    template <glm::length_t kSize, class T>
    void operator()(glm::vec<kSize, T>* vector) const {
        if (item >= 0) {
            (*vector)[item] = T(numbers[0]);
            return;
        }
        for (int i = 0; i < kSize; ++i) (*vector)[i] = T(numbers[numbers.size() == 1 ? 0 : i]);
    }

    template <class T>
    void operator()(std::optional<T>* value) const {
        if (!*value) value->emplace();
        (*this)(&**value);
    }
};

}  // namespace

void put(const Slot& slot, std::span<const double> numbers, int item) {
    std::visit(Writer{numbers, item}, slot);
}

glm::dvec3 unit_vector(const glm::dvec3& v, std::string_view key, const Refuse& refuse) {
    // The vector is scaled to 1 first, so that no square underflows.
    const double largest = std::max({std::abs(v.x), std::abs(v.y), std::abs(v.z)});
    if (largest == 0) refuse(key, "must not be zero, since it gives a direction");
    const glm::dvec3 scaled = v / largest;
    return scaled / glm::length(scaled);
}

glm::dvec3 unit_vector_to(const glm::dvec3& point, const glm::dvec3& position, std::string_view key,
                          const Refuse& refuse) {
    const glm::dvec3 v = point - position;
    const double distance = glm::length(v);
    if (distance == 0) refuse(key, "is the position itself; name a point away from it");
    return v / distance;
}

void refuse_both(bool has_key, std::string_view key, bool has_other, std::string_view other,
                 const Refuse& refuse) {
    if (has_key && has_other)
        refuse(other, fmt::format("\"{}\" and \"{}\" say the same thing; leave one of them out",
                                  key, other));
}

}  // namespace voxelume
