// SPDX-License-Identifier: Apache-2.0
#include "runtime/scene_file/document/scene_change.hpp"

#include <algorithm>
#include <charconv>
#include <cmath>
#include <optional>

#include "runtime/base/error.hpp"
#include "runtime/base/utf8.hpp"
#include "runtime/scene_file/document/scene_path.hpp"

namespace voxelume {
namespace {

/// Sets the text position of a value and of everything in it.
void set_place(JsonValue& value, TextPosition at) {
    value.at = at;
    for (JsonValue& item : value.items) set_place(item, at);
    for (JsonMember& member : value.members) {
        member.at = at;
        set_place(member.value, at);
    }
}

/// A number as people write it, also ".5" and "+2"; empty for other texts.
std::optional<JsonValue> number_of(std::string_view text) {
    while (text.starts_with(' ')) text.remove_prefix(1);
    while (text.ends_with(' ')) text.remove_suffix(1);
    if (text.starts_with('+') && !text.starts_with("+-")) text.remove_prefix(1);
    JsonValue value = json_value(JsonType::number);
    const char* last = text.data() + text.size();
    const auto [end, error] = std::from_chars(text.data(), last, value.number);
    if (end != last || error != std::errc() || !std::isfinite(value.number)) return {};
    return value;
}

/// Numbers separated by commas; empty for other texts.
std::optional<JsonValue> numbers_of(std::string_view text) {
    JsonValue list = json_value(JsonType::array);
    for (size_t start = 0; start <= text.size();) {
        const size_t end = std::min(text.find(',', start), text.size());
        std::optional<JsonValue> number = number_of(text.substr(start, end - start));
        if (!number) return {};
        list.items.push_back(std::move(*number));
        start = end + 1;
    }
    return list;
}

std::string_view name_of(JsonType type) {
    static constexpr std::string_view kTypeNames[] = {"null",   "true or false", "a number",
                                                      "a text", "a list",        "an object"};
    return kTypeNames[size_t(type)];
}

/// Follows a change's path through a document and stores its value there.
class Changer {
  public:
    Changer(JsonValue& document, const SceneChange& change, TextPosition at)
        : document_(document), change_(change), at_(at) {}

    void change() {
        const std::optional<std::vector<PathStep>> steps = parse_path(change_.path);
        if (!steps) fail(fmt::format("the path {} {}", quote(change_.path), kPathAdvice));
        if (change_.value == "null") return remove(*steps);
        JsonValue value = parse_value(change_.value, change_.origin);
        set_place(value, at_);
        JsonValue* here = &document_;
        for (size_t i = 0; i < steps->size(); ++i) {
            const bool is_name = i == 1 && i + 1 < steps->size() && is_named(steps->front().key);
            here = &inside(*here, (*steps)[i], is_name);
        }
        *here = std::move(value);
    }

  private:
    [[noreturn]] void fail(const std::string& sentence) const {
        throw Error(ErrorKind::usage, "{}: {}", change_.origin, sentence);
    }

    void remove(const std::vector<PathStep>& steps) {
        JsonValue* here = &document_;
        for (size_t i = 0; i + 1 < steps.size(); ++i) here = &inside(*here, steps[i], true);
        inside(*here, steps.back(), true);  // it must be there
        if (here->type == JsonType::array) {
            here->items.erase(here->items.begin() + std::ptrdiff_t(index_of(*here, steps.back())));
        } else {
            std::erase_if(here->members,
                          [&](const JsonMember& member) { return member.key == steps.back().key; });
        }
    }

    /// True if the keys of a section are names from the scene.
    static bool is_named(std::string_view section) {
        return section == "materials" || section == "models";
    }

    /// With `must_exist`, the part must already exist; otherwise the value creates it.
    JsonValue& inside(JsonValue& of, const PathStep& step, bool must_exist) {
        if (of.type == JsonType::array) return item(of, step);
        const std::string word = step.key.empty() ? fmt::format("[{}]", step.item) : step.key;
        if (of.type != JsonType::object)
            fail(fmt::format("{} is {} and has no {} in it", here_, name_of(of.type), word));
        if (step.key.empty()) fail(fmt::format("{} is no list, so it has no {}", here_, word));
        const auto found = std::ranges::find(of.members, step.key, &JsonMember::key);
        if (found == of.members.end() && must_exist) {
            std::vector<std::string_view> names;
            names.reserve(of.members.size());
            for (const JsonMember& member : of.members) names.push_back(member.key);
            fail_to_find(step.key, names);
        }
        here_ += (here_.empty() ? "" : ".") + step.key;
        if (found != of.members.end()) return found->value;
        JsonMember& added = of.members.emplace_back();
        added = {step.key, at_, json_value(JsonType::object)};
        added.value.at = at_;
        return added.value;
    }

    JsonValue& item(JsonValue& list, const PathStep& step) {
        const size_t index = index_of(list, step);
        here_ += fmt::format("[{}]", index);
        return list.items[index];
    }

    size_t index_of(const JsonValue& list, const PathStep& step) const {
        size_t index = step.item;
        if (!step.key.empty()) {
            const auto named = std::ranges::find_if(
                list.items, [&](const JsonValue& item) { return name_in(item) == step.key; });
            const char* last = step.key.data() + step.key.size();
            const auto [end, error] = std::from_chars(step.key.data(), last, index);
            if (named != list.items.end())
                index = size_t(named - list.items.begin());
            else if (end != last || error != std::errc())
                fail_to_find(step.key, names_in(list));
        }
        if (index >= list.items.size())
            fail(fmt::format("there is no {}[{}]: {} has {} items, counted from 0", here_, index,
                             here_, list.items.size()));
        return index;
    }

    /// The name of an item; empty for items without one.
    static std::string_view name_in(const JsonValue& item) {
        const auto name = std::ranges::find(item.members, "name", &JsonMember::key);
        return name == item.members.end() ? std::string_view() : name->value.text;
    }

    static std::vector<std::string_view> names_in(const JsonValue& list) {
        std::vector<std::string_view> names;
        for (const JsonValue& item : list.items)
            if (!name_in(item).empty()) names.push_back(name_in(item));
        return names;
    }

    [[noreturn]] void fail_to_find(const std::string& name,
                                   const std::vector<std::string_view>& names) const {
        fail(fmt::format("{} has nothing named {}{}", here_, quote(name), suggest(name, names)));
    }

    JsonValue& document_;
    const SceneChange& change_;
    TextPosition at_;
    std::string here_;  ///< the path so far, for messages
};

/// The document with all changes. With `marks` the values of change i have the position line 0,
/// column i + 1.
JsonValue changed(JsonValue document, std::span<const SceneChange> changes, bool marks) {
    for (size_t i = 0; i < changes.size(); ++i)
        Changer(document, changes[i], {0, marks ? int(i) + 1 : 0}).change();
    return document;
}

}  // namespace

JsonValue parse_value(std::string_view text, const std::string& origin) {
    if (!is_utf8(std::string(text)))
        throw Error(ErrorKind::usage, "{}: the value isn't UTF-8, as a scene's texts are", origin);
    if (std::optional<JsonValue> number = number_of(text)) return std::move(*number);
    if (text.find(',') != text.npos)
        if (std::optional<JsonValue> list = numbers_of(text)) return std::move(*list);
    JsonValue value = json_value(JsonType::boolean);
    value.boolean = text == "true";
    if (text == "true" || text == "false") return value;
    if (text.starts_with('[') || text.starts_with('{') || text.starts_with('"')) {
        try {
            return parse_json(text, origin);
        } catch (const Error& error) {
            throw Error(ErrorKind::usage, "{}", error.what());
        }
    }
    value.type = JsonType::string;
    value.text = text;
    return value;
}

Scene read_changed(const JsonValue& document, std::span<const SceneChange> changes,
                   const std::function<Scene(const JsonValue&)>& read) {
    if (changes.empty()) return read(document);
    try {
        return read(changed(document, changes, false));
    } catch (const Error& error) {
        if (error.place().line != 0) throw;
    }
    // Marks tell which change's value the reader refuses: a scene that is right never has them.
    try {
        return read(changed(document, changes, true));
    } catch (const Error& error) {
        SourcePlace place = error.place();
        if (place.line != 0 || place.column == 0 || size_t(place.column) > changes.size()) throw;
        std::string sentence = error.what();
        const std::string text = place.text(), origin = changes[size_t(place.column) - 1].origin;
        place.column = 0;
        const size_t at = sentence.find(text);
        if (at != sentence.npos) sentence.replace(at, text.size(), place.key);
        if (place.key.empty() && at == 0) sentence.erase(0, 2);
        throw Error(place, ErrorKind::usage, fmt::format("{}: {}", origin, sentence));
    }
}

}  // namespace voxelume
