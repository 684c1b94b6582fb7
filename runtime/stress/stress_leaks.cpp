#include "runtime/stress/stress_leaks.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <glm/common.hpp>
#include <glm/vector_relational.hpp>
#include <numbers>

#include "runtime/stages/index.hpp"
#include "runtime/stages/voxelize.hpp"
#include "runtime/stress/device_walks.hpp"
#include "runtime/stress/stress_random.hpp"
#include "runtime/stress/stress_rays.hpp"

namespace voxelume {
namespace {

constexpr double kPi = std::numbers::pi;
constexpr size_t kBatch = 1u << 14;
const glm::ivec3 kSize(87, 83, 45);

/// A ring with an elliptic tube around z, in voxels.
struct Ring {
    glm::dvec3 center{43.3, 41.1, 22.6};
    double radius = 25.2, tube = 11.4, flatness = 1.3;

    glm::dvec3 point(double around, double across, double share) const {
        const double r = radius + share * tube * std::cos(across);
        return center + glm::dvec3(r * std::cos(around), r * std::sin(around),
                                   share * tube * std::sin(across) / flatness);
    }
    /// At least so many voxels outside, where positive.
    double outside(const glm::dvec3& p) const {
        const glm::dvec3 q = p - center;
        return (std::hypot(std::hypot(q.x, q.y) - radius, q.z * flatness) - tube) / flatness;
    }
};

Mesh mesh_of(const Ring& ring) {
    constexpr uint32_t kAround = 96, kAcross = 48;
    Mesh mesh;
    for (uint32_t i = 0; i < kAround; ++i)
        for (uint32_t j = 0; j < kAcross; ++j) {
            mesh.positions.emplace_back(
                ring.point(2 * kPi * i / kAround, 2 * kPi * j / kAcross, 1));
            const uint32_t a = i * kAcross, b = (i + 1) % kAround * kAcross, k = (j + 1) % kAcross;
            mesh.triangles.emplace_back(a + j, b + j, b + k);
            mesh.triangles.emplace_back(a + j, b + k, a + k);
        }
    return mesh;
}

/// A ray, and the t of a point inside the surface.
struct InwardRay {
    FixedRay ray;
    double inside = 0;
};

/// How far from the surface a point has to be to be inside for certain, as a share of the tube.
double safe_share(const VoxelizeOptions& options) {
    if (options.surface != Surface::cubes) return 0.96;  // the mesh's chords, the field's error
    return options.set == VoxelSet::supercover ? 0.96 : 0.85;  // centres inside: a voxel's diagonal
}

/// Voxels of a surface reach no farther out of the ring than this, in voxels: their diagonal, and
/// some room.
constexpr double kReach = 2;

glm::dvec3 point_inside(const Ring& ring, double share, StressRandom& random) {
    return ring.point(random.uniform(0, 2 * kPi), random.uniform(0, 2 * kPi),
                      random.uniform(0, share));
}

/// From a side of the grid.
InwardRay from_a_side(const Ring& ring, const FixedGrid& grid, double share, StressRandom& random) {
    const glm::dvec3 target = point_inside(ring, share, random);
    InwardRay inward;
    FixedRay& ray = inward.ray;
    const size_t face = random.below(3);
    glm::dvec3 way;
    for (size_t a = 0; a < 3; ++a) {
        const int64_t side = grid.size[int(a)] * grid.unit();
        ray.origin[a] = a == face ? int64_t(random.below(2)) * side : random.between(0, side);
        way[int(a)] = target[int(a)] - double(ray.origin[a]) / double(grid.unit());
    }
    const double longest = std::max({std::abs(way.x), std::abs(way.y), std::abs(way.z)});
    inward.inside = std::exp2(std::ceil(std::log2(longest)));
    for (size_t a = 0; a < 3; ++a)
        ray.direction[a] = std::llround(way[int(a)] / inward.inside * double(kDirectionOne));
    return inward;
}

/// From outside through half-integer places to a lattice point inside: through corners and edges.
InwardRay through_corners(const Ring& ring, const FixedGrid& grid, double share,
                          StressRandom& random) {
    while (true) {
        glm::dvec3 target = glm::round(point_inside(ring, share, random));
        if (random.below(3) == 0) target[int(random.below(3))] += 0.5;
        glm::ivec3 quarters;
        for (int a = 0; a < 3; ++a) quarters[a] = int(random.between(-4, 4));
        const glm::ivec3 size = glm::abs(quarters);
        if (std::max({size.x, size.y, size.z}) < 2 || ring.outside(target) > (share - 1) * 8)
            continue;
        const glm::dvec3 step = glm::dvec3(quarters) / 4.0;
        glm::dvec3 origin = target;
        InwardRay inward;
        const auto in_grid = [&](const glm::dvec3& p) {
            return glm::all(glm::greaterThanEqual(p, glm::dvec3(0))) &&
                   glm::all(glm::lessThanEqual(p, glm::dvec3(grid.size)));
        };
        while (in_grid(origin - step)) origin -= step, inward.inside += 1;
        if (ring.outside(origin) < 1.5) continue;
        for (size_t a = 0; a < 3; ++a) {
            inward.ray.origin[a] = std::llround(origin[int(a)] * double(grid.unit()));
            inward.ray.direction[a] = quarters[int(a)] * (kDirectionOne / 4);
        }
        return inward;
    }
}

glm::dvec3 point_at(const FixedGrid& grid, const FixedRay& ray, double t) {
    glm::dvec3 point;
    for (size_t a = 0; a < 3; ++a)
        point[int(a)] = double(ray.origin[a]) / double(grid.unit()) +
                        double(ray.direction[a]) / double(kDirectionOne) * t;
    return point;
}

/// What is wrong with where a ray was found to meet the ring; empty if nothing is.
std::string fault_of(const Ring& ring, const FixedGrid& grid, const InwardRay& inward,
                     const std::optional<EnteredCell>& hit) {
    if (!hit) return "a miss";
    const double t = hit->t;
    if (!(t >= 0 && t <= inward.inside)) return fmt::format("a hit at t = {} only", t);
    if (ring.outside(point_at(grid, inward.ray, t)) <= kReach) return {};
    return fmt::format("a hit at t = {}, where nothing is", t);
}

}  // namespace

StressResult stress_leaks(const VoxelizeOptions& options, const StressRun& run) {
    const Ring ring;
    const FixedGrid grid = fixed_grid(kSize);
    GridFrame frame;
    frame.size = kSize;
    const Pyramid pyramid = build_index(
        run.device, voxelize_mesh(run.device, mesh_of(ring), glm::dmat4(1), frame, options));
    DeviceHits device(run.device, pyramid);
    const double share = safe_share(options);

    StressResult result;
    std::vector<InwardRay> inward;
    std::vector<FixedRay> rays;
    for_each_batch(run, kBatch, [&](const StressBatch& batch) {
        inward.resize(batch.size);
        rays.resize(batch.size);
        for_each_in_parallel(batch.size / 1024, [&](uint64_t piece) {
            for (size_t i = size_t(piece) * 1024; i < size_t(piece + 1) * 1024; ++i) {
                StressRandom random(run.seed, 200, batch.start + i);
                inward[i] = random.below(2) ? from_a_side(ring, grid, share, random)
                                            : through_corners(ring, grid, share, random);
                rays[i] = inward[i].ray;
            }
        });
        device.start(grid, rays);
        const std::vector<std::optional<EnteredCell>> hits = device.hits();
        for (size_t i = batch.first; i < batch.end; ++i) {
            const std::string fault = fault_of(ring, grid, inward[i], hits[i]);
            if (fault.empty()) continue;
            note_mismatch(result, batch.start + i, [&] {
                return fmt::format("{}: {}, though t = {} is inside", describe(grid, rays[i]),
                                   fault, inward[i].inside);
            });
        }
        result.cases += batch.end - batch.first;
    });
    return result;
}

}  // namespace voxelume
