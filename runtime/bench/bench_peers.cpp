#include "runtime/bench/bench_peers.hpp"

#include <fstream>
#include <nlohmann/json.hpp>

#include "runtime/bench/bench.hpp"
#include "runtime/error.hpp"

namespace voxelume {
namespace {

BenchPeerRow row_of(const nlohmann::json& json) {
    BenchPeerRow row;
    json.at("program").get_to(row.program);
    json.at("scene").get_to(row.scene);
    json.at("setting").get_to(row.setting);
    json.at("build_seconds").get_to(row.build_seconds);
    json.at("trace_seconds").get_to(row.trace_seconds);
    json.at("depth_rms_metres").get_to(row.depth_rms);
    json.at("depth_max_metres").get_to(row.depth_max);
    json.at("normal_rms_degrees").get_to(row.normal_rms);
    return row;
}

}  // namespace

std::vector<BenchPeerRow> read_peers(const std::filesystem::path& file, glm::ivec2 size) {
    std::ifstream stream(file);
    if (!stream) throw Error(ErrorKind::input, "{}: can't be read", file.string());
    std::vector<BenchPeerRow> rows;
    glm::ivec2 theirs(0);
    try {
        const auto json = nlohmann::json::parse(stream);
        theirs = {json.at("size").at(0).get<int>(), json.at("size").at(1).get<int>()};
        for (const auto& row : json.at("rows")) rows.push_back(row_of(row));
    } catch (const nlohmann::json::exception& error) {
        throw Error(ErrorKind::input, "{}: not a file of bench_peers: {}", file.string(),
                    error.what());
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
        if (row.scene != peer.scene || row.samples != 1) continue;
        if (row.errors.depth_rms > peer.depth_rms) continue;
        if (!best || row.seconds.total < best->seconds.total) best = &row;
    }
    return best;
}

}  // namespace voxelume
