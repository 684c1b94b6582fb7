// SPDX-License-Identifier: Apache-2.0
#include "runtime/verify/stress/stress_leaks.hpp"

#include <fmt/format.h>

#include <memory>

#include "runtime/stages/index/index.hpp"
#include "runtime/stages/voxelize/voxelize.hpp"
#include "runtime/verify/stress/device_walks.hpp"
#include "runtime/verify/stress/inward_rays.hpp"
#include "runtime/verify/stress/stress_rays.hpp"

namespace voxelume {
namespace {

constexpr size_t kBatch = 1u << 14;

/// The share of the tube within which a point is certainly inside.
double safe_share(const VoxelizeOptions& options) {
    // Surfaces without cubes deviate by the mesh's chords and the field's error.
    if (!shows_voxels(options.surface)) return 0.96;
    // Other sets than the supercover depend on voxels' centres, which costs a voxel's diagonal.
    return options.set == VoxelSet::supercover ? 0.96 : 0.85;
}

/// The maximum distance, in voxels, of a surface's voxels from the ring: their diagonal, and some
/// room.
constexpr double kReach = 2;

using Hits = std::vector<std::optional<EnteredCell>>;

/// Describes what is wrong with the point where a ray met the ring; empty if nothing is.
std::string fault_of(const Ring& ring, const FixedGrid& grid, const InwardRay& inward,
                     const std::optional<EnteredCell>& hit) {
    if (!hit) return fmt::format("a miss, though t = {} is inside", inward.inside);
    const double t = hit->t;
    if (!(t >= 0 && t <= inward.inside))
        return fmt::format("a hit at t = {} only, though t = {} is inside", t, inward.inside);
    if (ring.outside(point_at(grid, inward.ray, t)) <= kReach) return {};
    return fmt::format("a hit at t = {}, where nothing is", t);
}

GridFrame frame_of(const Ring& ring) {
    GridFrame frame;
    frame.size = ring.grid_size;
    return frame;
}

/// A ring in its grid.
struct RingWorld {
    RingWorld(const Device& device, const Ring& its, const VoxelizeOptions& options)
        : ring(its),
          grid(fixed_grid(its.grid_size)),
          pyramid(build_index(
              device, voxelize_mesh(device, its.mesh(), glm::dmat4(1), frame_of(its), options))),
          hits(device, pyramid) {}

    const Ring& ring;
    FixedGrid grid;
    Pyramid pyramid;
    DeviceHits hits;
};

class LeakStress {
  public:
    LeakStress(const VoxelizeOptions& options, const StressRun& run)
        : options_(options), share_(safe_share(options)), run_(run) {}

    /// Runs all batches. Rings alternate, and the second of every two batches uses beams.
    StressResult all() {
        for_each_batch(run_, kBatch, [this](const StressBatch& batch) {
            const size_t turn = size_t(batch.start / kBatch);
            compare(world_of(turn / 2 % kRings.size()), turn % 2 == 1, batch);
            result_.cases += batch.end - batch.first;
        });
        return std::move(result_);
    }

  private:
    RingWorld& world_of(size_t ring) {
        std::unique_ptr<RingWorld>& world = worlds_[ring];
        if (!world) world = std::make_unique<RingWorld>(run_.device, kRings[ring], options_);
        return *world;
    }

    void make_rays(const RingWorld& world, bool beams, const StressBatch& batch) {
        inward_.resize(batch.size);
        rays_.resize(batch.size);
        for_each_in_parallel(batch.size / VXL_BEAM_RAYS, [&](uint64_t tile) {
            const size_t first = size_t(tile) * VXL_BEAM_RAYS;
            if (beams) {
                StressRandom random(run_.seed, 201, batch.start + first);
                const auto rays = inward_tile(world.ring, world.grid, share_, random);
                std::ranges::copy(rays, &inward_[first]);
            }
            for (size_t i = first; i < first + VXL_BEAM_RAYS; ++i) {
                StressRandom random(run_.seed, 200, batch.start + i);
                if (!beams) inward_[i] = inward_ray(world.ring, world.grid, share_, random);
                rays_[i] = inward_[i].ray;
            }
        });
    }

    void compare(RingWorld& world, bool beams, const StressBatch& batch) {
        make_rays(world, beams, batch);
        world.hits.start(world.grid, rays_);
        const Hits alone = world.hits.hits();
        if (beams) world.hits.start_along_beams(world.grid, rays_);
        const Hits hits = beams ? world.hits.hits() : alone;
        for (size_t i = batch.first; i < batch.end; ++i) {
            std::string fault = fault_of(world.ring, world.grid, inward_[i], hits[i]);
            if (fault.empty() && hits[i] != alone[i]) fault = "another hit than without its beam";
            if (fault.empty()) continue;
            note_mismatch(result_, batch.start + i, [&] {
                return fmt::format("{}{}: {}", describe(world.grid, rays_[i]),
                                   beams ? ", along a beam" : "", fault);
            });
        }
    }

    VoxelizeOptions options_;
    double share_;
    const StressRun& run_;
    std::array<std::unique_ptr<RingWorld>, kRings.size()> worlds_;
    std::vector<InwardRay> inward_;
    std::vector<FixedRay> rays_;
    StressResult result_;
};

}  // namespace

StressResult stress_leaks(const VoxelizeOptions& options, const StressRun& run) {
    return LeakStress(options, run).all();
}

}  // namespace voxelume
