// Rays a second through a mesh's pyramid: closest hits of the sight rays that hit, of shadow rays
// and of incoherent bounces, for each surface and number of lanes.
//
//   bench_trace MESH [voxels along the longest side, 512] [lanes ... | surfaces ... | peers |
//   halved]
//
// `halved`, as often as it is there, cuts each triangle into four at the middles of its edges.
// `peers` has Embree, OpenVDB and NanoVDB trace the same rays, as far as they are installed. Embree
// takes the shadow rays by its quicker query, which only says that something was met.
//
// The set-up of RESULTS.md: longest side 1, eye at normalize(0.5, 0.35, 1) * 1.8, vertical angle 40
// degrees, 1024 x 1024, point light at (1.5, 2.5, 2). Ray lists are made beforehand. Times are the
// process's CPU time over all threads, so a figure is per core; set POCL_MAX_PTHREAD_COUNT=1 to
// compare packets alone. The last column is a hash of all hits: programs that differ in speed alone
// print the same.
#include <fmt/format.h>
#include <xxhash.h>

#include <algorithm>
#include <cmath>
#include <cstring>
#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <glm/trigonometric.hpp>
#include <map>
#include <random>

#include "kernels/shared/voxel.h"
#include "runtime/io/mesh_reader.hpp"
#include "runtime/pyramid_bytes.hpp"
#include "runtime/stages/beam.hpp"
#include "runtime/stages/index.hpp"
#include "runtime/stages/trace.hpp"
#include "runtime/stages/voxelize.hpp"
#include "tests/bench/cpu_time.hpp"
#include "tests/bench/trace_peers.hpp"

namespace voxelume {
namespace {

constexpr int kImage = 1024;
constexpr int kRuns = 7;

/// A ray in the pyramid's voxels, snapped as kernels/lib/fixed_point.h does.
struct Ray {
    glm::dvec3 origin, direction;
    float end = INFINITY;
};

struct Hit {
    bool met = false;
    float t = 0;
    glm::dvec3 at{0};
};

class RayList {
  public:
    RayList(const Device& device, const Pyramid& pyramid, const std::vector<Ray>& rays)
        : count_(uint32_t(rays.size())) {
        batch_.stride = (count_ + 15) / 16 * 16;
        std::vector<float> values(size_t(batch_.stride) * VXL_RAY_COMPONENTS, 0.0f);
        std::fill(values.begin() + VXL_RAY_END * batch_.stride, values.end(), -1.0f);
        const double unit = 1 / double(shape_of(pyramid).fixed_point);
        const double step = std::ldexp(1.0, -VXL_DIRECTION_BITS);
        for (uint32_t i = 0; i < count_; ++i) {
            const glm::dvec3& d = rays[i].direction;
            int exponent = 0;
            std::frexp(std::max({std::abs(d.x), std::abs(d.y), std::abs(d.z)}), &exponent);
            for (uint32_t a = 0; a < 3; ++a) {
                values[(VXL_RAY_OX + a) * batch_.stride + i] =
                    float(std::round(rays[i].origin[int(a)] / unit) * unit);
                values[(VXL_RAY_DX + a) * batch_.stride + i] =
                    float(std::round(std::ldexp(d[int(a)], -exponent) / step) * step);
            }
            values[VXL_RAY_END * batch_.stride + i] = rays[i].end;
        }
        batch_.rays = Buffer<float>(device, "rays", std::span<const float>(values));
        batch_.hits = Buffer<uint32_t>(device, "hits", size_t(batch_.stride) * VXL_HIT_COMPONENTS);
    }

    /// Median CPU seconds of one pass over the list.
    double time(const Device& device, TraceStage& stage, const Pyramid& pyramid,
                BeamStage* beams = nullptr) {
        std::vector<double> seconds;
        for (int run = 0; run <= kRuns; ++run) {
            device.finish();
            const double start = cpu_seconds();
            if (beams) beams->start(batch_, count_);
            stage.closest(pyramid, batch_, count_);
            device.finish();
            seconds.push_back(cpu_seconds() - start);
        }
        seconds.erase(seconds.begin());  // warm-up: it builds the kernel
        std::nth_element(seconds.begin(), seconds.begin() + kRuns / 2, seconds.end());
        return seconds[kRuns / 2];
    }

    std::vector<Hit> hits() const {
        const std::vector<uint32_t> words = batch_.hits.read();
        const std::vector<float> rays = batch_.rays.read();
        std::vector<Hit> hits(count_);
        for (uint32_t i = 0; i < count_; ++i) {
            hits[i].met = words[VXL_HIT_VOXEL * batch_.stride + i] != VXL_NO_VOXEL;
            std::memcpy(&hits[i].t, &words[VXL_HIT_T * batch_.stride + i], 4);
            for (uint32_t a = 0; a < 3; ++a)
                hits[i].at[int(a)] =
                    double(rays[(VXL_RAY_OX + a) * batch_.stride + i]) +
                    double(rays[(VXL_RAY_DX + a) * batch_.stride + i]) * double(hits[i].t);
        }
        return hits;
    }

    uint32_t size() const { return count_; }

    /// Of the hits' t, voxels, cells and faces.
    uint64_t hash() const {
        std::vector<uint32_t> words = batch_.hits.read();
        for (uint32_t i = 0; i < batch_.stride; ++i)
            if (words[VXL_HIT_VOXEL * batch_.stride + i] == VXL_NO_VOXEL)
                for (uint32_t c = 0; c < VXL_HIT_PRIMITIVE; ++c)
                    words[c * batch_.stride + i] = VXL_NO_VOXEL;
        return XXH3_64bits(words.data(), size_t(batch_.stride) * VXL_HIT_PRIMITIVE * 4);
    }

  private:
    uint32_t count_;
    RayBatch batch_;
};

/// All rays of the picture in 4 x 4 tiles, entering the grid's box; rays past it have an end of -1.
std::vector<Ray> picture_rays(const GridFrame& frame) {
    const glm::dvec3 eye = glm::normalize(glm::dvec3(0.5, 0.35, 1)) * 1.8;
    const glm::dvec3 ahead = glm::normalize(-eye);
    const glm::dvec3 right = glm::normalize(glm::cross(ahead, glm::dvec3(0, 1, 0)));
    const glm::dvec3 up = glm::cross(right, ahead);
    const double half = std::tan(glm::radians(20.0));
    std::vector<Ray> rays;
    for (int place = 0; place < kImage * kImage; ++place) {
        const int tile = place / 16, pixel = place % 16;
        const int column = tile % (kImage / 4) * 4 + pixel % 4;
        const int row = tile / (kImage / 4) * 4 + pixel / 4;
        const double u = (2.0 * column + 1) / kImage - 1, v = 1 - (2.0 * row + 1) / kImage;
        const glm::dvec3 direction =
            (ahead + right * (u * half) + up * (v * half)) / frame.voxel_edge;
        const glm::dvec3 origin = (eye - frame.origin) / frame.voxel_edge;
        double first = 0, last = INFINITY;
        for (int a = 0; a < 3; ++a) {
            const double p = -origin[a] / direction[a];
            const double q = (frame.size[a] - origin[a]) / direction[a];
            first = std::max(first, std::min(p, q));
            last = std::min(last, std::max(p, q));
        }
        const glm::dvec3 entry = origin + direction * (first > last ? 0 : first);
        rays.push_back({glm::clamp(entry, glm::dvec3(0), glm::dvec3(frame.size)), direction,
                        first > last ? -1.0f : INFINITY});
    }
    return rays;
}

/// The rays of `rays` that met something, and from where they did: bounces and shadow rays start
/// two voxels back towards the eye, on the outside.
struct RayLists {
    std::vector<Ray> hitting, shadow, bounce;
};

RayLists split_rays(const std::vector<Ray>& rays, const std::vector<Hit>& hits,
                    const GridFrame& frame) {
    RayLists lists;
    std::mt19937 random(7);
    const auto uniform = [&] { return double(random()) / 4294967296.0; };
    const glm::dvec3 light = (glm::dvec3(1.5, 2.5, 2) - frame.origin) / frame.voxel_edge;
    for (size_t i = 0; i < rays.size(); ++i) {
        if (!hits[i].met) continue;
        lists.hitting.push_back(rays[i]);
        const glm::dvec3 back = -glm::normalize(rays[i].direction);
        const glm::dvec3 start = hits[i].at + back * 2.0;
        lists.shadow.push_back({start, light - start});
        const double radius = std::sqrt(uniform()), angle = 6.283185307179586 * uniform();
        const glm::dvec3 side = glm::normalize(glm::cross(back, glm::dvec3(0.3, 1, 0.2)));
        const glm::dvec3 other = glm::cross(back, side);
        lists.bounce.push_back({start, back * std::sqrt(1 - radius * radius) +
                                           side * (radius * std::cos(angle)) +
                                           other * (radius * std::sin(angle))});
    }
    return lists;
}

Mesh scaled_mesh(const char* path) {
    Mesh mesh = read_mesh(path);
    glm::vec3 low(INFINITY), high(-INFINITY);
    for (const glm::vec3& p : mesh.positions) low = glm::min(low, p), high = glm::max(high, p);
    const glm::vec3 extent = high - low;
    const float scale = 1 / std::max({extent.x, extent.y, extent.z});
    for (glm::vec3& p : mesh.positions) p = (p - 0.5f * (low + high)) * scale;
    return mesh;
}

/// Each triangle as the four between its corners and the middles of its edges.
Mesh halved(const Mesh& mesh) {
    Mesh result;
    result.positions = mesh.positions;
    std::map<std::pair<uint32_t, uint32_t>, uint32_t> middles;
    const auto middle = [&](uint32_t a, uint32_t b) {
        const auto [at, is_new] =
            middles.emplace(std::minmax(a, b), uint32_t(result.positions.size()));
        if (is_new) result.positions.push_back(0.5f * (mesh.positions[a] + mesh.positions[b]));
        return at->second;
    };
    for (const glm::uvec3& t : mesh.triangles) {
        const uint32_t xy = middle(t.x, t.y), yz = middle(t.y, t.z), zx = middle(t.z, t.x);
        result.triangles.insert(result.triangles.end(),
                                {{t.x, xy, zx}, {xy, t.y, yz}, {zx, yz, t.z}, {xy, yz, zx}});
    }
    return result;
}

/// Million rays a second: that hit, of shadow, that bounced, of the picture.
struct Row {
    std::string name;
    double build_seconds = 0;  ///< of CPU time: to a pyramid, to a peer's own
    double rates[4] = {};
    std::string note;
};

void print(const Row& row) {
    fmt::print("{:18} {:7.0f} ", row.name, row.build_seconds * 1e3);
    for (const double rate : row.rates) fmt::print(" {:7.2f}", rate);
    fmt::print("  {}\n", row.note);
    std::fflush(stdout);
}

Row bench(const Mesh& mesh, Surface surface, const std::string& name, int voxels, int lanes) {
    const Device device = Device::open("cpu", lanes);
    const GridFrame frame = frame_around(mesh, glm::dvec3(1.0 / voxels));
    Voxelizer voxelizer(device);
    const auto build = [&] {
        const BrickGrid grid = voxelizer.voxelize(mesh, glm::dmat4(1), frame, {surface, {}});
        Pyramid made = build_index(device, grid);
        device.finish();
        return made;
    };
    const Pyramid pyramid = build();
    const double start = cpu_seconds();
    build();
    Row row{fmt::format("{}, {}", name, lanes), cpu_seconds() - start, {}, {}};
    TraceStage stage(device, features_of(pyramid));
    const std::vector<Ray> rays = picture_rays(frame);
    RayList all(device, pyramid, rays);
    BeamStage beams(device, features_of(pyramid), pyramid, build_halo(device, pyramid));
    row.rates[3] = kImage * kImage / all.time(device, stage, pyramid, &beams) * 1e-6;
    uint64_t hash = all.hash();
    const RayLists lists = split_rays(rays, all.hits(), frame);
    double* rate = row.rates;
    for (const std::vector<Ray>* list : {&lists.hitting, &lists.shadow, &lists.bounce}) {
        RayList timed(device, pyramid, *list);
        *rate++ = timed.size() /
                  timed.time(device, stage, pyramid, list == &lists.hitting ? &beams : nullptr) *
                  1e-6;
        hash ^= timed.hash();
    }
    row.note = fmt::format("{} voxels of {:.2f} bytes, {:016x}", pyramid.voxel_count,
                           double(bytes_of(pyramid)) / double(pyramid.voxel_count), hash);
    return row;
}

std::vector<PeerRay> in_metres(const std::vector<Ray>& rays, const GridFrame& frame) {
    std::vector<PeerRay> list;
    for (const Ray& ray : rays)
        list.push_back({glm::vec3(frame.origin + frame.voxel_edge * ray.origin),
                        glm::vec3(glm::normalize(frame.voxel_edge * ray.direction))});
    return list;
}

/// Million rays a second of a peer's pass: medians of CPU time.
double rate_of(const PeerPass& pass, size_t rays, size_t& hits) {
    std::vector<double> seconds;
    for (int run = 0; run < kRuns; ++run) {
        const double start = cpu_seconds();
        hits = pass();
        seconds.push_back(cpu_seconds() - start);
    }
    std::nth_element(seconds.begin(), seconds.begin() + kRuns / 2, seconds.end());
    return double(rays) / seconds[kRuns / 2] * 1e-6;
}

/// The peers on the rays that the exact surface gives.
void bench_peers(const Mesh& mesh, int voxels) {
    const Device device = Device::open("cpu");
    const GridFrame frame = frame_around(mesh, glm::dvec3(1.0 / voxels));
    const BrickGrid grid =
        Voxelizer(device).voxelize(mesh, glm::dmat4(1), frame, {Surface::exact, {}});
    const Pyramid pyramid = build_index(device, grid);
    TraceStage stage(device, features_of(pyramid));
    std::vector<Ray> rays = picture_rays(frame);
    std::erase_if(rays, [](const Ray& ray) { return ray.end < 0; });
    RayList all(device, pyramid, rays);
    all.time(device, stage, pyramid);
    const RayLists lists = split_rays(rays, all.hits(), frame);
    std::vector<TracePeer> peers = level_set_tracers(mesh, 1.0 / voxels);
#if VXL_BENCH_EMBREE
    std::ranges::move(embree_tracers(mesh), std::back_inserter(peers));
#endif
    for (const TracePeer& peer : peers) {
        Row row{peer.name, peer.build_seconds, {}, {}};
        size_t hits = 0;
        const auto time = [&](const std::vector<Ray>& list, PeerQuery query) {
            return rate_of(peer.prepare(in_metres(list, frame), query), list.size(), hits);
        };
        row.rates[0] = time(lists.hitting, PeerQuery::closest_coherent);
        row.rates[1] = time(lists.shadow, PeerQuery::occluded_coherent);
        row.rates[2] = time(lists.bounce, PeerQuery::closest_incoherent);
        row.rates[3] =
            time(rays, PeerQuery::closest_coherent) * kImage * kImage / double(rays.size());
        row.note = fmt::format("{} of {} rays hit", hits, lists.hitting.size());
        print(row);
    }
}

}  // namespace
}  // namespace voxelume

int main(int count, char** arguments) {
    using namespace voxelume;
    if (count < 2) return 2;
    const int voxels = count > 2 ? std::atoi(arguments[2]) : 512;
    bool with_peers = false;
    int halvings = 0;
    std::vector<int> lanes;
    std::vector<std::pair<Surface, std::string>> surfaces;
    for (int i = 3; i < count; ++i) {
        const std::string word = arguments[i];
        if (word == "cubes") surfaces.emplace_back(Surface::cubes, word);
        if (word == "smooth") surfaces.emplace_back(Surface::smooth, word);
        if (word == "exact") surfaces.emplace_back(Surface::exact, word);
        with_peers |= word == "peers";
        halvings += word == "halved";
        if (std::atoi(arguments[i]) > 0) lanes.push_back(std::atoi(arguments[i]));
    }
    if (lanes.empty()) lanes = {16, 8, 4, 1};
    if (surfaces.empty())
        surfaces = {
            {Surface::cubes, "cubes"}, {Surface::smooth, "smooth"}, {Surface::exact, "exact"}};
    Mesh mesh = scaled_mesh(arguments[1]);
    for (int i = 0; i < halvings; ++i) mesh = halved(mesh);
    fmt::print("{} triangles\n", mesh.triangles.size());
    fmt::print("{:18} {:>7}  million rays a second and core: that hit, shadow, bounce, all\n", "",
               "build");
    for (const auto& [surface, name] : surfaces)
        for (const int n : lanes) print(bench(mesh, surface, name, voxels, n));
    if (with_peers) bench_peers(mesh, voxels);
}
