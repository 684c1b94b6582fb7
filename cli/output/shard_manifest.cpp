// SPDX-License-Identifier: Apache-2.0
#include "cli/output/shard_manifest.hpp"

#include <fmt/format.h>

#include <nlohmann/json.hpp>

#include "cli/output/channels.hpp"
#include "cli/output/view_transforms.hpp"
#include "runtime/base/json_text.hpp"

namespace voxelume::cli {
namespace {

using Json = nlohmann::ordered_json;

constexpr int kFormat = 4;  // changes when the keys or their meanings change
constexpr uint64_t kMaxBytes = uint64_t{64} << 20;  // some hundred bytes for each frame
constexpr const char* kFormatKey = "voxelume_shard";

Json json_of(const ShardFile& file) {
    return {{"name", file.name}, {"hash", file.hash}};
}

ShardFile file_of(const Json& json) {
    return {json.at("name").get<std::string>(), json.at("hash").get<std::string>()};
}

Json json_of(const ShardRows& rows) {
    Json json = {{"first", rows.first}, {"end", rows.end},   {"height", rows.height},
                 {"file", nullptr},     {"hash", rows.hash}, {"outputs", rows.outputs}};
    if (rows.file) json["file"] = json_of(*rows.file);
    return json;
}

ShardRows rows_of(const Json& json) {
    ShardRows rows;
    rows.first = json_integer<int>(json.at("first"));
    rows.end = json_integer<int>(json.at("end"));
    rows.height = json_integer<int>(json.at("height"));
    if (!json.at("file").is_null()) rows.file = file_of(json.at("file"));
    rows.hash = json.at("hash").get<std::string>();
    rows.outputs = json.at("outputs").get<std::vector<std::string>>();
    return rows;
}

ShardManifest manifest_of(const Json& json) {
    ShardManifest manifest;
    manifest.shard = {json_integer<int>(json.at("part")), json_integer<int>(json.at("of"))};
    manifest.scene = json.at("scene").get<std::string>();
    for (const Json& frame : json.at("frames").get_ref<const Json::array_t&>())
        manifest.frames.push_back(json_integer<int>(frame));
    manifest.outputs = json.at("outputs").get<std::vector<std::string>>();
    manifest.options.exposure = json.at("exposure").get<double>();
    manifest.options.view_transform =
        parse_view_transform(json.at("view_transform").get<std::string>(), "view_transform");
    manifest.options.png_bits = json_integer<int>(json.at("png_bits"));
    manifest.options.float_color = json.at("float").get<bool>();
    manifest.options.multi_part = json.at("multi_part").get<bool>();
    manifest.options.channels = parse_channels(json.at("channels").get<std::string>(), "channels");
    for (const Json& frame : json.at("own")) {
        ShardManifest::Frame& own = manifest.own.emplace_back();
        own.frame = json_integer<int>(frame.at("frame"));
        for (const Json& file : frame.at("files")) own.files.push_back(file_of(file));
    }
    if (json.contains("rows")) manifest.rows = rows_of(json.at("rows"));
    return manifest;
}

/// True if an unreadable file was meant to be a part: it has the name of a part, or contains the
/// format's key.
bool is_meant(const std::filesystem::path& file, const std::string& text) {
    return file.extension() == ".shard" ||
           text.find(fmt::format("\"{}\"", kFormatKey)) != std::string::npos;
}

/// True if a run can have such a part.
bool is_possible(const ShardManifest& manifest) {
    const auto& [number, count] = manifest.shard;
    if (number < 1 || number > count || manifest.frames.empty() || manifest.outputs.empty())
        return false;
    if (!manifest.rows) return true;
    const ShardRows& rows = *manifest.rows;
    return 0 <= rows.first && rows.first <= rows.end && rows.end <= rows.height &&
           rows.file.has_value() == (rows.first < rows.end) && !rows.outputs.empty();
}

[[noreturn]] void refuse(const std::filesystem::path& file, const std::string& reason) {
    throw Error(ErrorKind::input, fmt::format("{}: {}", file.string(), reason), {file.string()});
}

}  // namespace

bool is_text(const std::string& text) {
    try {
        return !Json(text).dump().empty();
    } catch (const nlohmann::json::exception&) {
        return false;
    }
}

void write_manifest(const std::filesystem::path& file, const ShardManifest& manifest) {
    Json json = {{kFormatKey, kFormat},
                 {"software", fmt::format("voxelume {}", version())},
                 {"part", manifest.shard.number},
                 {"of", manifest.shard.count},
                 {"scene", manifest.scene},
                 {"frames", manifest.frames},
                 {"outputs", manifest.outputs},
                 {"exposure", manifest.options.exposure},
                 {"view_transform", name_of(manifest.options.view_transform)},
                 {"png_bits", manifest.options.png_bits},
                 {"float", manifest.options.float_color},
                 {"multi_part", manifest.options.multi_part},
                 {"channels", channel_names(manifest.options.channels)},
                 {"own", Json::array()}};
    for (const ShardManifest::Frame& frame : manifest.own) {
        Json files = Json::array();
        for (const ShardFile& own : frame.files) files.push_back(json_of(own));
        json["own"].push_back({{"frame", frame.frame}, {"files", files}});
    }
    if (manifest.rows) json["rows"] = json_of(*manifest.rows);
    write_file(file, json.dump(1, ' ', false, Json::error_handler_t::replace) + "\n");
}

ShardManifest read_manifest(const std::filesystem::path& file) {
    const std::string text = read_file(file, kMaxBytes);
    const auto json = parse_json_text<Json>(text);
    constexpr const char* kDamaged = "is damaged: render this part again";
    if (!json.is_object() || !json.contains(kFormatKey))
        refuse(file, is_meant(file, text)
                         ? kDamaged
                         : "isn't a part of a run: `voxelume render --shard` writes those, .shard");
    if (json.at(kFormatKey) != kFormat)
        refuse(file, json.at(kFormatKey).is_number_unsigned() ? "is of another version of voxelume"
                                                              : kDamaged);
    try {
        ShardManifest manifest = manifest_of(json);
        if (is_possible(manifest)) return manifest;
    } catch (const nlohmann::json::exception&) {
    } catch (const Error&) {  // an unknown view transform or channel
    }
    refuse(file, kDamaged);
}

}  // namespace voxelume::cli
