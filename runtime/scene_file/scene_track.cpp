// SPDX-License-Identifier: Apache-2.0
#include "runtime/scene_file/scene_track.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>

namespace voxelume {
namespace {

constexpr std::array<std::string_view, 5> kInterpolations = {"step", "linear", "cubic", "slerp",
                                                             "spline"};
constexpr double kFarthestFrame = 1e9;
constexpr Range kFrames{-kFarthestFrame, kFarthestFrame};

double read_frame(const SceneValue& key, double fps) {
    const SceneFields fields(key, "key");
    fields.refuse_both("frame", "time");
    if (const auto time = fields.find("time")) return 1 + time->number(kFrames) * fps;
    if (!fields.has("frame")) key.fail("needs a \"frame\" or a \"time\" in seconds");
    return fields.get("frame").number(kFrames);
}

bool is_text_or_switch(const JsonValue& value) {
    return value.type == JsonType::string || value.type == JsonType::boolean;
}

/// Refuses values of a form that no target accepts.
void check_form(const SceneValue& value) {
    if (value.is(JsonType::string)) {
        value.text();
    } else if (value.is(JsonType::array)) {
        const auto items = value.items();
        if (items.empty()) value.fail("must not be an empty list");
        for (const SceneValue& item : items) item.number(kFrames);
    } else if (value.is(JsonType::number)) {
        value.number(kFrames);
    } else if (!value.is(JsonType::boolean)) {
        value.fail("needs a number, a list of numbers, true or false, or text");
    }
}

/// The numbers of a value: none for texts and bools.
std::vector<double> numbers_of(const JsonValue& json) {
    std::vector<double> numbers;
    if (json.type == JsonType::number) numbers.push_back(json.number);
    for (const JsonValue& number : json.items) numbers.push_back(number.number);
    return numbers;
}

/// Appends one of a key's slopes, per frame; 0 if the key has none.
void add_slope(const SceneFields& fields, std::string_view name, double fps, size_t width,
               std::vector<double>& slopes) {
    const auto given = fields.find(name);
    if (!given) return slopes.resize(slopes.size() + width);
    check_form(*given);
    const std::vector<double> numbers = numbers_of(given->json());
    if (numbers.size() != width)
        given->fail(
            fmt::format("has {} numbers, and the key's value has {}", numbers.size(), width));
    for (const double number : numbers) slopes.push_back(number / fps);
}

/// True if the track's lists are the quaternions of turns.
bool has_quaternions(const DocumentTrack& track) {
    return track.target.steps.back().key == "turn" && track.values.front().items.size() == 4;
}

void add_key(const SceneValue& item, double fps, DocumentTrack& track) {
    const double frame = read_frame(item, fps);
    std::vector<double>& frames = track.keys.frames;
    if (!frames.empty() && !(frame > frames.back()))
        item.fail(fmt::format("comes at frame {}, not after the key before it, which comes at {}",
                              frame, frames.back()));
    const SceneFields fields(item, "key");
    const SceneValue value = fields.get("value");
    check_form(value);
    const JsonValue& json = value.json();
    if (!track.values.empty()) {
        const JsonValue& first = track.values.front();
        if (json.type != first.type || json.items.size() != first.items.size())
            value.fail(
                "has another form than the track's first value; give all keys a number, lists of "
                "as many numbers, true or false, or text");
    }
    frames.push_back(frame);
    track.values.push_back(json);
    const std::vector<double> numbers = numbers_of(json);
    track.keys.values.insert(track.keys.values.end(), numbers.begin(), numbers.end());
    track.keys.width = numbers.size();
    add_slope(fields, "in", fps, numbers.size(), track.keys.in);
    add_slope(fields, "out", fps, numbers.size(), track.keys.out);
    if (has_quaternions(track) && std::ranges::count(numbers, 0.0) == 4)
        value.fail("is no quaternion [x, y, z, w]: one of its numbers isn't 0");
}

/// Refuses slopes of keys of a track that isn't a spline.
void refuse_slopes(const SceneValue& keys) {
    for (const SceneValue& item : keys.items())
        for (const std::string_view name : {"in", "out"})
            if (const auto slope = SceneFields(item, "key").find(name))
                slope->fail("is a slope of a spline; write \"interpolation\": \"spline\"");
}

void read_interpolation(const SceneFields& fields, DocumentTrack& track) {
    const bool steps = is_text_or_switch(track.values.front());
    track.keys.has_quaternions = has_quaternions(track);
    track.keys.interpolation = steps                        ? Interpolation::step
                               : track.keys.has_quaternions ? Interpolation::slerp
                                                            : Interpolation::linear;
    const auto value = fields.find("interpolation");
    if (!value) return;
    track.keys.interpolation = static_cast<Interpolation>(value->choice(kInterpolations));
    if (steps && track.keys.interpolation != Interpolation::step)
        value->fail("there is nothing between two texts, or true and false; write \"step\"");
    if (track.keys.interpolation == Interpolation::slerp &&
        (track.target.steps.back().key != "turn" || track.keys.width < 3))
        value->fail("is for turns [psi, theta, gamma] only; write \"linear\" or \"cubic\"");
    if (track.keys.has_quaternions && (track.keys.interpolation == Interpolation::linear ||
                                       track.keys.interpolation == Interpolation::cubic))
        value->fail("is no way between quaternions; write \"slerp\" or \"spline\"");
}

}  // namespace

DocumentTrack read_track(const SceneValue& value, const JsonValue& document, double fps) {
    const SceneFields fields(value, "track");
    DocumentTrack track;
    track.where = value.where();
    track.target = find_target(fields.get("target"), document);
    const SceneValue keys = fields.get("keys");
    const auto items = keys.items();
    if (items.empty()) keys.fail("needs at least one key");
    for (const SceneValue& item : items) add_key(item, fps, track);
    read_interpolation(fields, track);
    if (track.keys.interpolation != Interpolation::spline) refuse_slopes(keys);
    return track;
}

JsonValue value_at(const DocumentTrack& track, double frame) {
    JsonValue value = track.values[key_before(track.keys.frames, frame)];
    if (track.keys.values.empty()) return value;
    const std::vector<double> row = values_at(track.keys, frame);
    if (value.type == JsonType::number) value.number = row.front();
    if (track.keys.has_quaternions) value.items.resize(row.size());
    for (size_t i = 0; i < value.items.size(); ++i) value.items[i].number = row[i];
    return value;
}

}  // namespace voxelume
