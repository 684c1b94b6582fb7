// SPDX-License-Identifier: Apache-2.0
// Rays a second through a mesh's pyramid: sight rays that hit, shadow rays, incoherent bounces, and
// all sight rays of the picture, for each surface and number of lanes.
//
//   bench_trace [MESH] [voxels along the longest side, 512] [lanes ... | surfaces ... | peers |
//   halved | gpu]
//
// Without a mesh it takes Debian's bunny (glmark2-data). Each `halved` cuts each triangle into four
// at the middles of its edges. `peers` lets Embree, OpenVDB and NanoVDB trace the same rays, if
// they are installed, and prints the ratios of our rates to theirs.
//
// The set-up of RESULTS.md: longest side 1, eye at normalize(0.5, 0.35, 1) * 1.8, vertical angle 40
// degrees, 1024 x 1024, point light at (1.5, 2.5, 2). Ray lists are made beforehand. Every list
// goes through the kernel that a frame sends such rays through; of shadow rays these and Embree's
// quicker query only find out whether something is in the way. Times are the process's CPU time
// over all threads, so a figure is per core; set POCL_MAX_PTHREAD_COUNT=1 to compare packets alone.
// With `gpu` the device is a GPU, times are the wall's, and a figure is of the whole device.
// The last column is a hash of all closest hits: programs that differ in speed alone print the
// same.
#include <fmt/format.h>

#include <algorithm>

#include "runtime/grid/pyramid_bytes.hpp"
#include "runtime/stages/index/index.hpp"
#include "runtime/stages/voxelize/voxelize.hpp"
#include "tests/bench/peers/trace_peers.hpp"
#include "tests/bench/trace_kernels.hpp"

namespace voxelume {
namespace {

/// Million rays a second of each kind: rays that hit, shadow rays, bounced rays, the picture's
/// rays.
struct Row {
    std::string name;
    double build_seconds = 0;  ///< CPU time to build a pyramid, or a peer's own structure
    double rates[4] = {};
    std::string note;
};

void print(const Row& row) {
    fmt::print("{:24} {:7.0f} ", row.name, row.build_seconds * 1e3);
    for (const double rate : row.rates) fmt::print(" {:7.2f}", rate);
    fmt::print("  {}\n", row.note);
    std::fflush(stdout);
}

Row bench(const Mesh& mesh, Surface surface, const std::string& name, int voxels, int lanes) {
    const Device device = Device::open(measures_accelerator ? "gpu" : "cpu", lanes);
    const GridFrame frame = frame_around(mesh, glm::dvec3(1.0 / voxels));
    Voxelizer voxelizer(device);
    const auto build = [&] {
        const BrickGrid grid = voxelizer.voxelize(mesh, glm::dmat4(1), frame, {surface, {}});
        Pyramid made = build_index(device, grid);
        device.finish();
        return made;
    };
    const Pyramid pyramid = build();
    const double start = busy_seconds();
    build();
    Row row{fmt::format("{}, {}", name, lanes), busy_seconds() - start, {}, {}};
    const std::vector<Ray> rays = picture_rays(frame);
    TraceKernels timed(device, pyramid);
    std::vector<Hit> hits;
    row.rates[3] = timed.sight(rays, &hits);
    const RayLists lists = split_rays(rays, hits, frame);
    row.rates[0] = timed.sight(lists.hitting);
    row.rates[1] = timed.shadow(lists.shadow);
    row.rates[2] = timed.bounce(lists.bounce);
    row.note = fmt::format("{} voxels of {:.2f} bytes, {:016x}", pyramid.voxel_count,
                           double(bytes_of(pyramid)) / double(pyramid.voxel_count), timed.hash());
    return row;
}

std::vector<PeerRay> in_metres(const std::vector<Ray>& rays, const GridFrame& frame) {
    std::vector<PeerRay> list;
    for (const Ray& ray : rays)
        list.push_back({glm::vec3(frame.origin + frame.voxel_edge * ray.origin),
                        glm::vec3(glm::normalize(frame.voxel_edge * ray.direction))});
    return list;
}

/// Measures the peers on the rays that the exact surface gives.
std::vector<Row> bench_peers(const Mesh& mesh, int voxels) {
    const Device device = Device::open("cpu");
    const GridFrame frame = frame_around(mesh, glm::dvec3(1.0 / voxels));
    const BrickGrid grid =
        Voxelizer(device).voxelize(mesh, glm::dmat4(1), frame, {Surface::exact, {}});
    const Pyramid pyramid = build_index(device, grid);
    std::vector<Ray> rays = picture_rays(frame);
    std::erase_if(rays, [](const Ray& ray) { return ray.end < 0; });
    RayBatch batch = batch_of(device, features_of(pyramid), pyramid, rays);
    TraceStage(device, features_of(pyramid)).closest(pyramid, batch, uint32_t(rays.size()));
    const RayLists lists = split_rays(rays, hits_of(batch, rays.size()), frame);
    std::vector<TracePeer> peers = level_set_tracers(mesh, 1.0 / voxels);
#if VXL_BENCH_EMBREE
    std::ranges::move(embree_tracers(mesh), std::back_inserter(peers));
#endif
    std::vector<Row> rows;
    for (const TracePeer& peer : peers) {
        Row row{peer.name, peer.build_seconds, {}, {}};
        size_t hits = 0;
        const auto rate = [&](const std::vector<Ray>& list, PeerQuery query) {
            const PeerPass pass = peer.prepare(in_metres(list, frame), query);
            return double(list.size()) / median_seconds([&] { hits = pass(); }) * 1e-6;
        };
        row.rates[0] = rate(lists.hitting, PeerQuery::closest_coherent);
        row.rates[1] = rate(lists.shadow, PeerQuery::occluded_coherent);
        row.rates[2] = rate(lists.bounce, PeerQuery::closest_incoherent);
        row.rates[3] = rate(rays, PeerQuery::closest_coherent) * kPictureSide * kPictureSide /
                       double(rays.size());
        row.note = fmt::format("{} of {} rays hit", hits, lists.hitting.size());
        print(row);
        rows.push_back(row);
    }
    return rows;
}

/// Prints the ratios of our rates to a peer's. If the peer has several rows, its best one for each
/// kind of ray counts.
void print_ratios(const std::vector<Row>& ours, const std::vector<Row>& theirs) {
    std::vector<Row> best;
    for (const Row& row : theirs) {
        const std::string name = row.name.substr(0, row.name.find_first_of(" ,"));
        if (best.empty() || best.back().name != name) best.push_back({name, 0, {}, {}});
        for (int i = 0; i < 4; ++i)
            best.back().rates[i] = std::max(best.back().rates[i], row.rates[i]);
        best.back().build_seconds = row.build_seconds;
    }
    for (const Row& row : ours)
        for (const Row& peer : best) {
            fmt::print("{:24} {:7.3f} ", row.name + " / " + peer.name,
                       row.build_seconds / peer.build_seconds);
            for (int i = 0; i < 4; ++i) fmt::print(" {:7.2f}", row.rates[i] / peer.rates[i]);
            fmt::print("\n");
        }
}

void run(const std::vector<std::string>& words) {
    std::string path = "/usr/share/glmark2/models/bunny.obj";
    int voxels = 0, halvings = 0;
    bool with_peers = false;
    std::vector<int> lanes;
    std::vector<std::pair<Surface, std::string>> surfaces;
    for (const std::string& word : words) {
        const int number = std::atoi(word.c_str());
        if (word == "cubes")
            surfaces.emplace_back(Surface::cubes, word);
        else if (word == "smooth")
            surfaces.emplace_back(Surface::smooth, word);
        else if (word == "exact")
            surfaces.emplace_back(Surface::exact, word);
        else if (word == "peers")
            with_peers = true;
        else if (word == "gpu")
            measures_accelerator = true;
        else if (word == "halved")
            ++halvings;
        else if (number > 0 && voxels == 0)
            voxels = number;
        else if (number > 0)
            lanes.push_back(number);
        else
            path = word;
    }
    if (voxels == 0) voxels = 512;
    if (lanes.empty()) lanes = measures_accelerator ? std::vector{1} : std::vector{16, 8, 4, 1};
    if (surfaces.empty())
        surfaces = {
            {Surface::cubes, "cubes"}, {Surface::smooth, "smooth"}, {Surface::exact, "exact"}};
    Mesh mesh = scaled_mesh(path.c_str());
    for (int i = 0; i < halvings; ++i) mesh = halved(mesh);
    fmt::print("{}, {} triangles\n", path, mesh.triangles.size());
    fmt::print("{:24} {:>7}  million rays a second and core: that hit, shadow, bounce, all\n", "",
               "build");
    std::vector<Row> ours;
    for (const auto& [surface, name] : surfaces)
        for (const int n : lanes) {
            ours.push_back(bench(mesh, surface, name, voxels, n));
            print(ours.back());
        }
    if (with_peers) print_ratios(ours, bench_peers(mesh, voxels));
}

}  // namespace
}  // namespace voxelume

int main(int count, char** arguments) {
    try {
        voxelume::run({arguments + 1, arguments + count});
    } catch (const std::exception& error) {
        fmt::print(stderr, "bench_trace: {}\n", error.what());
        return 1;
    }
}
