// SPDX-License-Identifier: Apache-2.0
#include "runtime/scene_file/document/scene_path.hpp"

#include <algorithm>
#include <charconv>

namespace voxelume {

std::optional<std::vector<PathStep>> parse_path(std::string_view text) {
    std::vector<PathStep> steps;
    for (size_t i = 0; i < text.size();) {
        const bool is_item = text[i] == '[';
        if (!steps.empty() && !is_item && text[i++] != '.') return {};
        const bool is_quoted = i < text.size() && text[i] == '"';
        i += is_item || is_quoted ? 1 : 0;
        const size_t end = text.find_first_of(is_item ? "]" : is_quoted ? "\"" : ".[", i);
        if ((is_item || is_quoted) && end == text.npos) return {};
        const std::string_view word = i <= text.size() ? text.substr(i, end - i) : "";
        if (word.empty()) return {};
        PathStep& step = steps.emplace_back();
        if (is_item) {
            const char* last = word.data() + word.size();
            const auto [end_of_number, error] = std::from_chars(word.data(), last, step.item);
            if (end_of_number != last || error != std::errc()) return {};
        } else {
            step.key = word;
        }
        i = end == text.npos ? text.size() : end + (is_item || is_quoted ? 1 : 0);
    }
    if (steps.empty() || steps.front().key.empty()) return {};
    return steps;
}

void put_value(JsonValue& part, const std::vector<PathStep>& steps, JsonValue value) {
    JsonValue* at = &part;
    for (const PathStep& step : steps) {
        if (step.key.empty()) {
            at = &at->items[step.item];
            continue;
        }
        const auto found = std::ranges::find(at->members, step.key, &JsonMember::key);
        at = found != at->members.end()
                 ? &found->value
                 : &at->members.emplace_back(JsonMember{step.key, value.at, {}}).value;
    }
    *at = std::move(value);
}

}  // namespace voxelume
