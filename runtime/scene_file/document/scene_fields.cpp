// SPDX-License-Identifier: Apache-2.0
// Typed access to the values of a scene file, with messages that say where and what to do.
#include "runtime/scene_file/document/scene_fields.hpp"

#include <algorithm>
#include <cmath>
#include <stdexcept>

#include "runtime/base/error.hpp"

namespace voxelume {
namespace {

std::string_view type_name(JsonType type) {
    static constexpr std::string_view names[] = {"null", "true or false", "a number",
                                                 "text", "a list",        "an object"};
    return names[static_cast<size_t>(type)];
}

bool lies_in(double x, Range range) {
    return (range.min_is_open ? x > range.min : x >= range.min) &&
           (range.max_is_open ? x < range.max : x <= range.max);
}

std::string range_text(Range range) {
    const auto end = [](std::string_view open, std::string_view closed, bool is_open,
                        double value) {
        return fmt::format("{} {}", is_open ? open : closed, value);
    };
    if (range.max >= kMaxLength && range.min >= 0) {
        return end("above", "at least", range.min_is_open, range.min) +
               fmt::format(" and at most {}", range.max);
    }
    if (!range.min_is_open && !range.max_is_open) {
        return fmt::format("from {} to {}", range.min, range.max);
    }
    return end("above", "at least", range.min_is_open, range.min) + " and " +
           end("below", "at most", range.max_is_open, range.max);
}

}  // namespace

SourcePlace SceneValue::where(TextPosition at) const {
    return {*file_, at.line, at.column, path_};
}

void SceneValue::fail(const std::string& sentence) const {
    throw Error(ErrorKind::scene, "{}: {}", where(), sentence);
}

void SceneValue::expect(JsonType type, std::string_view expected) const {
    if (!is(type)) fail(fmt::format("needs {} here, not {}", expected, type_name(value_->type)));
}

double SceneValue::number(Range range) const {
    expect(JsonType::number, "a number");
    const double x = value_->number;
    if (!lies_in(x, range)) fail(fmt::format("must be {}; it is {}", range_text(range), x));
    return x;
}

int SceneValue::integer(int min, int max) const {
    expect(JsonType::number, "a whole number");
    const double x = value_->number;
    if (x != std::floor(x)) fail(fmt::format("needs a whole number here, not {}", x));
    if (x < min || x > max) fail(fmt::format("must be from {} to {}; it is {}", min, max, x));
    return static_cast<int>(x);
}

bool SceneValue::boolean() const {
    expect(JsonType::boolean, "true or false");
    return value_->boolean;
}

const std::string& SceneValue::text() const {
    expect(JsonType::string, "text in quotes");
    if (value_->text.empty()) fail("must not be empty");
    return value_->text;
}

std::vector<SceneValue> SceneValue::items() const {
    expect(JsonType::array, "a list in [ ]");
    std::vector<SceneValue> items;
    items.reserve(value_->items.size());
    for (const JsonValue& item : value_->items) {
        items.emplace_back(item, path_ + item_step(*value_, items.size()), *file_);
    }
    return items;
}

glm::dvec3 SceneValue::vector(Range range) const {
    expect(JsonType::array, "a list of 3 numbers");
    // Frames of an animation read thousands of vectors; only messages need the paths of items.
    const std::vector<JsonValue>& list = value_->items;
    if (list.size() == 3 && std::ranges::all_of(list, [&](const JsonValue& item) {
            return item.type == JsonType::number && lies_in(item.number, range);
        }))
        return {list[0].number, list[1].number, list[2].number};
    const auto parts = items();
    if (parts.size() != 3) fail(fmt::format("needs 3 numbers, not {}", parts.size()));
    return {parts[0].number(range), parts[1].number(range), parts[2].number(range)};
}

glm::dvec2 SceneValue::pair(Range range) const {
    expect(JsonType::array, "a list of 2 numbers");
    const auto parts = items();
    if (parts.size() != 2) fail(fmt::format("needs 2 numbers, not {}", parts.size()));
    return {parts[0].number(range), parts[1].number(range)};
}

glm::dvec3 SceneValue::number_or_vector(Range range) const {
    if (is(JsonType::number)) return glm::dvec3(number(range));
    if (!is(JsonType::array)) {
        fail(fmt::format("needs a number or a list of 3 numbers here, not {}",
                         type_name(value_->type)));
    }
    return vector(range);
}

namespace {

/// Reads a value according to the type of its slot.
struct SlotReader {
    const SceneValue& value;
    Range range;
    bool is_uniform;

    void operator()(double* number) const { *number = value.number(range); }
    void operator()(float* number) const { *number = static_cast<float>(value.number(range)); }
    void operator()(int* number) const {
        *number = value.integer(static_cast<int>(range.min), static_cast<int>(range.max));
    }
    void operator()(bool* flag) const { *flag = value.boolean(); }
    void operator()(glm::dvec2* pair) const { *pair = value.pair(range); }
    void operator()(glm::dvec3* vector) const {
        *vector = is_uniform ? value.number_or_vector(range) : value.vector(range);
    }
    void operator()(glm::vec3* color) const { *color = glm::vec3(value.vector(range)); }
    void operator()(std::vector<double>* list) const {
        list->clear();
        for (const SceneValue& item : value.items()) list->push_back(item.number(range));
    }
    void operator()(std::filesystem::path*) const {
        throw std::logic_error("a file is not read as a number");
    }
    template <class T>
    void operator()(std::optional<T>* number) const {
        (*this)(&number->emplace());
    }
};

}  // namespace

void SceneValue::read_into(const Slot& slot, Range range, bool is_uniform) const {
    std::visit(SlotReader{*this, range, is_uniform}, slot);
}

size_t SceneValue::choice(std::span<const std::string_view> names) const {
    const std::string& name = text();
    const auto found = std::find(names.begin(), names.end(), name);
    if (found == names.end())
        fail(fmt::format("does not know {}{}", quote(name), suggest(name, names)));
    return static_cast<size_t>(found - names.begin());
}

SceneValue SceneValue::member(const JsonMember& member) const {
    const bool plain = std::all_of(member.key.begin(), member.key.end(), [](char c) {
        return std::isalnum(static_cast<unsigned char>(c)) != 0 || c == '_' || c == '-' || c == '$';
    });
    const std::string step = plain ? member.key : quote(member.key);
    return {member.value, path_.empty() ? step : path_ + "." + step, *file_};
}

std::vector<std::pair<std::string, SceneValue>> SceneValue::named_members() const {
    expect(JsonType::object, "an object in { }");
    std::vector<std::pair<std::string, SceneValue>> members;
    members.reserve(value_->members.size());
    for (const JsonMember& m : value_->members) {
        if (m.key.empty()) {
            throw Error(ErrorKind::scene, "{}: a name must not be empty", where(m.at));
        }
        members.emplace_back(m.key, member(m));
    }
    return members;
}

SceneFields::SceneFields(SceneValue value, std::string_view table)
    : value_(std::move(value)), table_(&scene_keys(table)) {
    const std::vector<std::string_view>& keys = table_->keys;
    if (!value_.is(JsonType::object)) {
        value_.fail(
            fmt::format("needs an object in {{ }} here, not {}", type_name(value_.json().type)));
    }
    for (const JsonMember& m : value_.json().members) {
        if (std::find(keys.begin(), keys.end(), m.key) != keys.end()) continue;
        throw Error(ErrorKind::scene, "{}: unknown key {}{}", value_.where(m.at), quote(m.key),
                    suggest_key(m.key, keys));
    }
}

const JsonMember* SceneFields::member(std::string_view key) const {
    if (std::find(table_->keys.begin(), table_->keys.end(), key) == table_->keys.end()) {
        throw std::logic_error(fmt::format("{} is not in the key table {}", key, table_->name));
    }
    for (const JsonMember& m : value_.json().members) {
        if (m.key == key) return &m;
    }
    return nullptr;
}

std::optional<SceneValue> SceneFields::find(std::string_view key) const {
    const JsonMember* found = member(key);
    return found == nullptr ? std::nullopt : std::optional(value_.member(*found));
}

SceneValue SceneFields::get(std::string_view key) const {
    if (auto found = find(key)) return *found;
    value_.fail(fmt::format("needs {}", with_article(key)));
}

void SceneFields::refuse_both(std::string_view key, std::string_view other) const {
    if (!has(key)) return;
    if (const auto second = find(other)) {
        second->fail(
            fmt::format("\"{}\" and \"{}\" say the same thing; leave one of them out", key, other));
    }
}

double SceneFields::number(std::string_view key, Range range, double fallback) const {
    const auto found = find(key);
    return found ? found->number(range) : fallback;
}

int SceneFields::integer(std::string_view key, int min, int max, int fallback) const {
    const auto found = find(key);
    return found ? found->integer(min, max) : fallback;
}

Refuse SceneFields::refusal() const {
    return [fields = *this](std::string_view key, const std::string& sentence) {
        (key.empty() ? fields.value() : fields.get(key)).fail(sentence);
    };
}

size_t kind_of(const SceneValue& value, std::string_view key, std::string_view prefix) {
    if (!value.is(JsonType::object)) {
        value.fail(
            fmt::format("needs an object in {{ }} here, not {}", type_name(value.json().type)));
    }
    const std::vector<std::string_view> kinds = scene_kinds(prefix);
    for (const JsonMember& m : value.json().members) {
        if (m.key == key) return value.member(m).choice(kinds);
    }
    value.fail(fmt::format("needs {}{}", with_article(key), suggest("", kinds)));
}

}  // namespace voxelume
