// SPDX-License-Identifier: Apache-2.0
#include "runtime/scene_file/scene_track.hpp"

#include <fmt/format.h>

#include <array>

namespace voxelume {
namespace {

constexpr std::array<std::string_view, 4> kInterpolations = {"step", "linear", "cubic", "slerp"};
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

/// Refuses what no target takes.
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

void add_key(const SceneValue& item, double fps, DocumentTrack& track) {
    const double frame = read_frame(item, fps);
    std::vector<double>& frames = track.keys.frames;
    if (!frames.empty() && !(frame > frames.back()))
        item.fail(fmt::format("comes at frame {}, not after the key before it, which comes at {}",
                              frame, frames.back()));
    const SceneValue value = SceneFields(item, "key").get("value");
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
    if (json.type == JsonType::number) track.keys.values.push_back(json.number);
    for (const JsonValue& number : json.items) track.keys.values.push_back(number.number);
    track.keys.width = track.keys.values.size() / frames.size();
}

void read_interpolation(const SceneFields& fields, DocumentTrack& track) {
    const bool steps = is_text_or_switch(track.values.front());
    track.keys.interpolation = steps ? Interpolation::step : Interpolation::linear;
    const auto value = fields.find("interpolation");
    if (!value) return;
    track.keys.interpolation = static_cast<Interpolation>(value->choice(kInterpolations));
    if (steps && track.keys.interpolation != Interpolation::step)
        value->fail("there is nothing between two texts, or true and false; write \"step\"");
    if (track.keys.interpolation == Interpolation::slerp &&
        (track.target.steps.back().key != "turn" || track.keys.width != 3))
        value->fail("is for turns [psi, theta, gamma] only; write \"linear\" or \"cubic\"");
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
    return track;
}

JsonValue value_at(const DocumentTrack& track, double frame) {
    JsonValue value = track.values[key_before(track.keys.frames, frame)];
    if (track.keys.values.empty()) return value;
    const std::vector<double> row = values_at(track.keys, frame);
    if (value.type == JsonType::number) value.number = row.front();
    for (size_t i = 0; i < value.items.size(); ++i) value.items[i].number = row[i];
    return value;
}

}  // namespace voxelume
