// SPDX-License-Identifier: Apache-2.0
#include "runtime/verify/bench/bench_peers.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <fstream>
#include <nlohmann/json.hpp>

#include "runtime/base/error.hpp"
#include "runtime/base/text.hpp"
#include "runtime/scene/scene.hpp"
#include "runtime/verify/bench/bench.hpp"

namespace voxelume {
namespace {

using Json = nlohmann::json;

/// A file, and the part of it that is read. Messages begin with both.
struct Place {
    std::string file, part;

    template <class... Args>
    [[noreturn]] void refuse(fmt::format_string<Args...> format, Args&&... args) const {
        throw Error(ErrorKind::input, "{}: not a file of bench_peers: {}{}", file, part,
                    fmt::format(format, std::forward<Args>(args)...));
    }
};

/// The bounds of a row's numbers. They keep ratios finite.
constexpr double kMin = 1e-30, kMax = 1e30;

/// The kind of a value for messages: "null", "a string".
std::string kind_of(const Json& value) {
    if (value.is_null()) return "null";
    return fmt::format("{} {}", value.is_array() || value.is_object() ? "an" : "a",
                       value.type_name());
}

const Json& value_of(const Json& row, const char* key, const Place& place) {
    if (!row.contains(key)) place.refuse("there is no \"{}\"", key);
    return row[key];
}

std::string text_of(const Json& row, const char* key, const Place& place) {
    const Json& value = value_of(row, key, place);
    if (!value.is_string()) place.refuse("\"{}\" is {}, not a text", key, kind_of(value));
    return value.get<std::string>();
}

double number_of(const Json& row, const char* key, const Place& place) {
    const Json& value = value_of(row, key, place);
    if (!value.is_number()) place.refuse("\"{}\" is {}, not a number", key, kind_of(value));
    const auto number = value.get<double>();
    if (!(number >= 0)) place.refuse("\"{}\" is below 0", key);
    if (number > kMax || (number > 0 && number < kMin))
        place.refuse("\"{}\" is {}; what was measured lies from {} to {}, or is 0", key, number,
                     kMin, kMax);
    return number;
}

uint64_t count_of(const Json& row, const char* key, const Place& place) {
    const double value = number_of(row, key, place);
    if (value != std::floor(value) || value > 0x1p53)
        place.refuse("\"{}\" is {}, not a number of pixels", key, value);
    return uint64_t(value);
}

std::string scene_of(const Json& row, const Place& place) {
    std::string scene = text_of(row, "scene", place);
    std::vector<std::string_view> names;
    for (const BenchEntry& entry : bench_entries()) names.emplace_back(entry.name);
    if (std::ranges::find(names, scene) == names.end())
        place.refuse("there is no scene named {}{}", quote(scene), suggest(scene, names));
    return scene;
}

BenchPeerRow row_of(const Json& json, const Place& place) {
    if (!json.is_object()) place.refuse("it is {}, not an object", kind_of(json));
    BenchPeerRow row;
    row.program = text_of(json, "program", place);
    row.scene = scene_of(json, place);
    row.setting = text_of(json, "setting", place);
    row.build_seconds = number_of(json, "build_seconds", place);
    row.trace_seconds = number_of(json, "trace_seconds", place);
    row.depth_rms = number_of(json, "depth_rms_metres", place);
    row.depth_max = number_of(json, "depth_max_metres", place);
    row.normal_rms = number_of(json, "normal_rms_degrees", place);
    row.other_parts = count_of(json, "other_part_pixels", place);
    return row;
}

glm::ivec2 size_of(const Json& size, const Place& place) {
    const auto is_side = [](const Json& side) {
        return side.is_number_integer() && side > 0 && side <= kMaxImageSide;
    };
    if (!size.is_array() || size.size() != 2 || !is_side(size[0]) || !is_side(size[1]))
        place.refuse("\"size\" is {}, not two numbers of pixels like [1024, 1024]", size.dump());
    return {size[0].get<int>(), size[1].get<int>()};
}

}  // namespace

std::vector<BenchPeerRow> read_peers(const std::filesystem::path& file, glm::ivec2 size) {
    std::ifstream stream(file);
    if (std::filesystem::is_directory(file))
        throw Error(ErrorKind::input, "{}: this is a folder, not a file of bench_peers",
                    file.string());
    if (!stream)
        throw Error(ErrorKind::input, "{}: {}", file.string(),
                    std::filesystem::exists(file) ? "no permission to read it" : "no such file");
    const auto json = Json::parse(stream, nullptr, false);
    const Place place{file.string(), ""};
    if (!json.is_object() || !json.contains("size") || !json.contains("rows") ||
        !json["rows"].is_array())
        place.refuse("it isn't an object with a \"size\" and a list of \"rows\"");
    const glm::ivec2 theirs = size_of(json["size"], place);
    std::vector<BenchPeerRow> rows;
    for (const auto& row : json["rows"])
        rows.push_back(row_of(row, {place.file, fmt::format("row {}: ", rows.size())}));
    if (theirs != size)
        throw Error(ErrorKind::input,
                    "{}: measured with {} x {} pixels, and this run has {} x {}: add --size {}x{}",
                    file.string(), theirs.x, theirs.y, size.x, size.y, theirs.x, theirs.y);
    return rows;
}

const BenchRow* row_as_accurate(const BenchReport& report, const BenchPeerRow& peer) {
    const BenchRow* best = nullptr;
    for (const BenchRow& row : report.rows) {
        if (row.scene != peer.scene || row.samples != 1 || row.errors.compared == 0) continue;
        if (row.errors.depth_rms > peer.depth_rms) continue;
        if (!best || row.seconds.total < best->seconds.total) best = &row;
    }
    return best;
}

}  // namespace voxelume
