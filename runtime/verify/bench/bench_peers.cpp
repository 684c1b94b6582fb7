// SPDX-License-Identifier: Apache-2.0
#include "runtime/verify/bench/bench_peers.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>

#include "runtime/base/error.hpp"
#include "runtime/base/files/input_file.hpp"
#include "runtime/base/json_text.hpp"
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
    return {json_integer<int>(size[0]), json_integer<int>(size[1])};
}

GlobalRow global_row_of(const Json& json, const Place& place) {
    if (!json.is_object()) place.refuse("it is {}, not an object", kind_of(json));
    GlobalRow row;
    row.program = text_of(json, "program", place);
    if (row.program.empty()) place.refuse("\"program\" is empty");
    row.scene = text_of(json, "scene", place);
    const double samples = number_of(json, "samples", place);
    if (samples != std::floor(samples) || samples < 1 || samples > 1'000'000)
        place.refuse("\"samples\" is {}, not a whole number from 1 to 1000000", samples);
    row.samples = int(samples);
    row.relative_mse = number_of(json, "relative_mse", place);
    row.seconds = number_of(json, "seconds", place);
    if (json.contains("light")) row.light = number_of(json, "light", place);
    return row;
}

/// The paths of two files in the folder of the file that names them.
std::array<std::filesystem::path, 2> references_of(const Json& json, const Place& place) {
    if (!json.is_array() || json.size() != 2 || !json[0].is_string() || !json[1].is_string())
        place.refuse("it is {}, not the names of two pictures", kind_of(json));
    const std::filesystem::path folder = std::filesystem::path(place.file).parent_path();
    return {folder / json[0].get<std::string>(), folder / json[1].get<std::string>()};
}

void read_global(const Json& json, const std::string& file, PeerResults& peers) {
    const Place place{file, ""};
    if (!json.is_object() || !json.contains("rows") || !json["rows"].is_array())
        place.refuse("\"global\" isn't an object with a list of \"rows\"");
    for (const auto& row : json["rows"])
        peers.global_rows.push_back(global_row_of(
            row, {file, fmt::format("row {} of \"global\": ", peers.global_rows.size())}));
    if (!json.contains("references")) return;
    if (!json["references"].is_object())
        place.refuse("\"references\" of \"global\" is {}, not an object",
                     kind_of(json["references"]));
    for (const auto& [scene, files] : json["references"].items())
        peers.references[scene] =
            references_of(files, {file, fmt::format("the references of {}: ", quote(scene))});
}

Json parsed(const std::filesystem::path& file) {
    constexpr uint64_t kMaxBytes = uint64_t{16} << 20;
    if (std::filesystem::is_directory(file))
        throw Error(ErrorKind::input, "{}: this is a folder, not a file of bench_peers",
                    file.string());
    return parse_json_text<Json>(InputFile(file).read_all(kMaxBytes));
}

}  // namespace

PeerResults read_peers(const std::filesystem::path& file) {
    const Json json = parsed(file);
    const Place place{file.string(), ""};
    const bool has_rows = json.is_object() && json.contains("size") && json.contains("rows") &&
                          json["rows"].is_array();
    const bool has_global = json.is_object() && json.contains("global");
    const bool has_other_rows = json.is_object() && json.contains("rows") && !has_rows;
    if (has_other_rows || (!has_rows && !has_global))
        place.refuse("it isn't an object with a \"size\" and a list of \"rows\"");
    PeerResults peers;
    if (has_rows) {
        peers.size = size_of(json["size"], place);
        for (const auto& row : json["rows"])
            peers.rows.push_back(
                row_of(row, {place.file, fmt::format("row {}: ", peers.rows.size())}));
    }
    if (has_global) read_global(json["global"], place.file, peers);
    return peers;
}

void check_size(const PeerResults& peers, const std::filesystem::path& file, glm::ivec2 size) {
    const glm::ivec2 theirs = peers.size;
    if (theirs == glm::ivec2(0) || theirs == size) return;
    throw Error(ErrorKind::input,
                "{}: measured with {} x {} pixels, and this run has {} x {}: add --size {}x{}",
                file.string(), theirs.x, theirs.y, size.x, size.y, theirs.x, theirs.y);
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
