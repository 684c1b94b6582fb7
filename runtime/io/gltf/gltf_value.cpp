// SPDX-License-Identifier: Apache-2.0
#include <fmt/format.h>

#include <cmath>

#include "runtime/base/error.hpp"
#include "runtime/base/text.hpp"
#include "runtime/io/gltf/gltf_file.hpp"

namespace voxelume {
namespace {

/// The value of a missing member.
const nlohmann::json& nothing() {
    static const nlohmann::json none;
    return none;
}

}  // namespace

void GltfValue::fail(std::string_view sentence) const {
    throw Error(ErrorKind::input, "{}: {}{}{}", SourcePlace(*file_), place_,
                place_.empty() ? "" : ": ", sentence);
}

const nlohmann::json* GltfValue::find(const char* key) const {
    if (!json_->is_object()) return nullptr;
    const auto found = json_->find(key);
    return found == json_->end() ? nullptr : &*found;
}

GltfValue GltfValue::member(const char* key, const nlohmann::json& json) const {
    return {*file_, json, place_.empty() ? key : fmt::format("{}.{}", place_, key)};
}

bool GltfValue::has(const char* key) const {
    return find(key) != nullptr;
}

GltfValue GltfValue::at(const char* key) const {
    const nlohmann::json* const found = find(key);
    GltfValue value = member(key, found ? *found : nothing());
    if (found && !found->is_structured()) value.fail("should be an object");
    return value;
}

bool GltfValue::has_extension(const char* name) const {
    return at("extensions").has(name);
}

GltfValue GltfValue::extension(const char* name) const {
    return at("extensions").at(name);
}

size_t GltfValue::size(const char* key) const {
    const nlohmann::json* const found = find(key);
    if (!found) return 0;
    if (!found->is_array()) member(key, *found).fail("should be a list");
    return found->size();
}

GltfValue GltfValue::item(const char* key, size_t number) const {
    const nlohmann::json& list = *find(key);
    return {*file_, list[number], fmt::format("{}[{}]", member(key, list).place(), number)};
}

std::vector<GltfValue> GltfValue::items(const char* key) const {
    std::vector<GltfValue> items;
    const size_t count = size(key);
    if (count == 0) return items;
    const nlohmann::json& list = *find(key);
    const std::string place = member(key, list).place();
    items.reserve(count);
    for (size_t i = 0; i < count; ++i)
        items.emplace_back(*file_, list[i], fmt::format("{}[{}]", place, i));
    return items;
}

double GltfValue::number(const char* key, double otherwise) const {
    const nlohmann::json* const found = find(key);
    if (!found) return otherwise;
    const double value = found->is_number() ? found->get<double>() : NAN;
    if (!std::isfinite(value)) member(key, *found).fail("should be a number");
    return value;
}

bool GltfValue::boolean(const char* key, bool otherwise) const {
    const nlohmann::json* const found = find(key);
    if (!found) return otherwise;
    if (!found->is_boolean()) member(key, *found).fail("should be true or false");
    return found->get<bool>();
}

std::string GltfValue::text(const char* key, const std::string& otherwise) const {
    const nlohmann::json* const found = find(key);
    if (!found) return otherwise;
    if (!found->is_string()) member(key, *found).fail("should be a text");
    return found->get<std::string>();
}

std::vector<double> GltfValue::numbers(const char* key, size_t count) const {
    const nlohmann::json* const found = find(key);
    std::vector<double> values;
    if (!found) return values;
    const GltfValue list = member(key, *found);
    if (!found->is_array() || found->size() != count)
        list.fail(fmt::format("should be a list of {} numbers", count));
    for (const nlohmann::json& item : *found) {
        values.push_back(item.is_number() ? item.get<double>() : NAN);
        if (!std::isfinite(values.back()))
            list.fail(fmt::format("should be a list of {} numbers", count));
    }
    return values;
}

uint64_t GltfValue::count(const char* key, uint64_t otherwise) const {
    constexpr double kMax = 9007199254740992.0;
    const nlohmann::json* const found = find(key);
    if (!found) return otherwise;
    const double value = found->is_number() ? found->get<double>() : -1;
    if (!(value >= 0 && value <= kMax && value == std::floor(value)))
        member(key, *found).fail("should be a whole number of at least 0");
    return static_cast<uint64_t>(value);
}

int GltfValue::index(const char* key, size_t size) const {
    if (!has(key)) return -1;
    const uint64_t number = count(key, 0);
    if (number >= size)
        member(key, *find(key))
            .fail(fmt::format("is {}, and the file has {} of these", number, size));
    return static_cast<int>(number);
}

}  // namespace voxelume
