#include "runtime/bench/bench_peers.hpp"

#include <fmt/format.h>

#include <fstream>
#include <nlohmann/json.hpp>
#include <stdexcept>

#include "runtime/bench/bench.hpp"
#include "runtime/error.hpp"

namespace voxelume {
namespace {

constexpr const char* kNotOne = "{}: not a file of bench_peers: {}";

double number_of(const nlohmann::json& json, const char* key) {
    const double value = json.at(key).get<double>();
    if (!(value >= 0)) throw std::invalid_argument(fmt::format("\"{}\" is below 0", key));
    return value;
}

BenchPeerRow row_of(const nlohmann::json& json) {
    BenchPeerRow row;
    json.at("program").get_to(row.program);
    json.at("scene").get_to(row.scene);
    json.at("setting").get_to(row.setting);
    row.build_seconds = number_of(json, "build_seconds");
    row.trace_seconds = number_of(json, "trace_seconds");
    row.depth_rms = number_of(json, "depth_rms_metres");
    row.depth_max = number_of(json, "depth_max_metres");
    row.normal_rms = number_of(json, "normal_rms_degrees");
    return row;
}

}  // namespace

std::vector<BenchPeerRow> read_peers(const std::filesystem::path& file, glm::ivec2 size) {
    std::ifstream stream(file);
    if (!stream) throw Error(ErrorKind::input, "{}: can't be read", file.string());
    const auto json = nlohmann::json::parse(stream, nullptr, false);
    if (!json.is_object() || !json.contains("size") || !json.contains("rows") ||
        !json["rows"].is_array())
        throw Error(ErrorKind::input, kNotOne, file.string(),
                    "it isn't an object with a \"size\" and a list of \"rows\"");
    std::vector<BenchPeerRow> rows;
    glm::ivec2 theirs(0);
    try {
        theirs = {json["size"].at(0).get<int>(), json["size"].at(1).get<int>()};
        for (const auto& row : json["rows"]) rows.push_back(row_of(row));
    } catch (const std::exception& error) {
        throw Error(ErrorKind::input, kNotOne, file.string(),
                    fmt::format("row {}: {}", rows.size(), error.what()));
    }
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
