// SPDX-License-Identifier: Apache-2.0
#include "runtime/verify/stress/stress_rays.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <glm/vector_relational.hpp>
#include <map>
#include <memory>

#include "runtime/stages/index/index.hpp"
#include "runtime/verify/stress/device_walks.hpp"
#include "runtime/verify/stress/stress_random.hpp"

namespace voxelume {
namespace {

constexpr uint32_t kAll = 0;

/// Small and large grids, up to the largest worlds, and cubes only where they can't be avoided.
constexpr std::array<RayGrid, kRayGrids> kGrids = {{
    RayGrid{{64, 61, 37}, Compared::cells, kAll},
    RayGrid{{70, 37, 130}, Compared::first_hit, kAll},
    RayGrid{{600, 300, 400}, Compared::blocks, kAll},
    RayGrid{{16384, 16384, 16384}, Compared::blocks, 256},
    RayGrid{{7, 5, 3}, Compared::cells, kAll},
    RayGrid{{256, 255, 129}, Compared::cells, kAll},
    RayGrid{{300, 200, 270}, Compared::first_hit, kAll},
    RayGrid{{1024, 1024, 1024}, Compared::blocks, 256},
    RayGrid{{33, 64, 50}, Compared::cells, kAll},
    RayGrid{{4095, 2047, 3000}, Compared::cells, 256},
    RayGrid{{16383, 3, 9000}, Compared::blocks, 256},
    RayGrid{{17, 16, 15}, Compared::cells, kAll},
    RayGrid{{65536, 65536, 65536}, Compared::blocks, 256},
    RayGrid{{65536, 40, 30}, Compared::first_hit, kAll},
    RayGrid{{23, 65535, 40001}, Compared::cells, 256},
}};

/// Scattered bricks with a few voxels in each: rays cross empty blocks of every size.
VoxelBits scattered_voxels(const glm::ivec3& size, uint64_t seed) {
    VoxelBits voxels(size);
    const glm::ivec3 bricks = (size + 15) / 16;
    StressRandom random(seed, 1000, uint64_t(size.x));
    for (glm::ivec3 b{0}; b.z < bricks.z; ++b.z)
        for (b.y = 0; b.y < bricks.y; ++b.y)
            for (b.x = 0; b.x < bricks.x; ++b.x) {
                if (random.below(12) != 0) continue;
                for (uint64_t left = random.below(40); left > 0; --left) {
                    const glm::ivec3 in(int(random.below(16)), int(random.below(16)),
                                        int(random.below(16)));
                    const glm::ivec3 v = b * 16 + in;
                    if (glm::all(glm::lessThan(v, size))) voxels.set(v);
                }
            }
    return voxels;
}

GridFrame frame_of(const glm::ivec3& size) {
    GridFrame frame;
    frame.size = size;
    return frame;
}

/// A world for first hits, and its voxels for the exact walk.
struct HitWorld {
    HitWorld(const Device& device, const glm::ivec3& size, uint64_t seed)
        : voxels(scattered_voxels(size, seed)),
          pyramid(build_index(device, cubes_of(device, voxels, frame_of(size)))),
          device_hits(device, pyramid) {}

    VoxelBits voxels;
    Pyramid pyramid;
    DeviceHits device_hits;
};

std::string text_of(const EnteredCell& c) {
    return fmt::format("({},{},{}) across {} at t = {:a}", c.cell.x, c.cell.y, c.cell.z,
                       c.axis == 3 ? "nothing" : fmt::format("{}", "xyz"[c.axis]), c.t);
}

std::string text_of(const std::optional<EnteredCell>& hit) {
    return hit ? text_of(*hit) : "a miss";
}

/// Describes the first difference between two lists.
std::string first_difference(const std::vector<EnteredCell>& device,
                             const std::vector<EnteredCell>& exact) {
    size_t i = 0;
    while (i < device.size() && i < exact.size() && device[i] == exact[i]) ++i;
    const auto at = [i](const std::vector<EnteredCell>& cells) {
        return i < cells.size() ? text_of(cells[i]) : "the end";
    };
    if (i == device.size() && i == exact.size())
        return "the lists agree, only the digests don't: the walk isn't the same each time";
    return fmt::format("cell {} of {}: the device has {}, exact is {}", i, exact.size(), at(device),
                       at(exact));
}

/// The axis across which a ray that begins on one of the grid's sides enters: the lowest one; 3 if
/// it doesn't begin on a side.
int entry_axis(const FixedGrid& grid, const FixedRay& ray) {
    for (size_t a = 0; a < 3; ++a)
        if ((ray.origin[a] == 0 && ray.direction[a] > 0) ||
            (ray.origin[a] == grid.size[int(a)] * grid.unit() && ray.direction[a] < 0))
            return int(a);
    return 3;
}

class RayStress {
  public:
    RayStress(RayClass kind, const StressRun& run) : kind_(kind), run_(run), walks_(run.device) {}

    StressResult all() {
        for_each_batch(run_, kRaysOfOneGrid, [this](const StressBatch& batch) { compare(batch); });
        return std::move(result_);
    }

  private:
    void compare(const StressBatch& batch) {
        const RayGrid chosen = grid_of_ray(batch.start);
        const FixedGrid grid = fixed_grid(chosen.size);
        rays_.resize(batch.size);
        in_pieces(0, batch.size, [&](size_t i) {
            rays_[i] = ray_of_class(kind_, grid, run_.seed, batch.start + i);
        });
        if (chosen.compared == Compared::first_hit)
            compare_hits(grid, batch);
        else
            compare_walks(grid, batch, chosen);
        result_.cases += batch.end - batch.first;
    }

    /// Calls `work(i)` for first .. end-1 on all of the host's cores.
    template <class Work>
    void in_pieces(size_t first, size_t end, const Work& work) {
        constexpr size_t kPiece = 1024;
        for_each_in_parallel((end - first + kPiece - 1) / kPiece, [&](uint64_t piece) {
            const size_t from = first + size_t(piece) * kPiece;
            for (size_t i = from; i < std::min(end, from + kPiece); ++i) work(i);
        });
    }

    void compare_walks(const FixedGrid& grid, const StressBatch& batch, const RayGrid& chosen) {
        const Steps steps = chosen.compared == Compared::cells ? Steps::cells : Steps::blocks;
        // No exact walk is longer than the sum of the sides. A longer walk of the device ends
        // there, too.
        const uint32_t longest = uint32_t(grid.size.x + grid.size.y + grid.size.z);
        const uint32_t max_cells = chosen.max_cells == kAll ? longest : chosen.max_cells;
        walks_.start(grid, rays_, steps, max_cells);
        exact_.resize(rays_.size());
        in_pieces(batch.first, batch.end,
                  [&](size_t i) { exact_[i] = exact_digest(grid, rays_[i], steps, max_cells); });
        const std::vector<WalkDigest> device = walks_.digests();
        for (size_t i = batch.first; i < batch.end; ++i) {
            result_.cells += exact_[i].cells;
            // The digests tell whether walks agree; for one walk, the cells are compared, too.
            if (device[i] == exact_[i] &&
                (i != batch.first || lists_agree(grid, rays_[i], steps, max_cells)))
                continue;
            note_mismatch(result_, batch.start + i, [&] {
                const uint32_t maximum =
                    std::min(max_cells, std::max(device[i].cells, exact_[i].cells) + 1);
                return describe(grid, rays_[i]) + ": " +
                       first_difference(walks_.cells(grid, rays_[i], steps, maximum),
                                        exact_cells(grid, rays_[i], steps, maximum));
            });
        }
    }

    bool lists_agree(const FixedGrid& grid, const FixedRay& ray, Steps steps, uint32_t maximum) {
        constexpr uint32_t kCells = 1024;
        const uint32_t listed = std::min(maximum, kCells);
        return walks_.cells(grid, ray, steps, listed) == exact_cells(grid, ray, steps, listed);
    }

    void compare_hits(const FixedGrid& grid, const StressBatch& batch) {
        HitWorld& world = world_of(grid.size);
        world.device_hits.start(grid, rays_);
        std::vector<std::optional<EnteredCell>> exact(rays_.size());
        in_pieces(batch.first, batch.end, [&](size_t i) {
            EnteredCell hit;
            if (!exact_first_hit(grid, rays_[i], world.voxels, hit)) return;
            if (hit.axis == 3) hit.axis = entry_axis(grid, rays_[i]);
            exact[i] = hit;
        });
        const auto device = world.device_hits.hits();
        for (size_t i = batch.first; i < batch.end; ++i) {
            if (device[i] == exact[i]) continue;
            note_mismatch(result_, batch.start + i, [&] {
                return fmt::format("{}: the device hits {}, exact is {}", describe(grid, rays_[i]),
                                   text_of(device[i]), text_of(exact[i]));
            });
        }
    }

    HitWorld& world_of(const glm::ivec3& size) {
        std::unique_ptr<HitWorld>& world = worlds_[size.x];
        if (!world) world = std::make_unique<HitWorld>(run_.device, size, run_.seed);
        return *world;
    }

    RayClass kind_;
    const StressRun& run_;
    DeviceWalks walks_;
    std::map<int, std::unique_ptr<HitWorld>> worlds_;
    std::vector<FixedRay> rays_;
    std::vector<WalkDigest> exact_;
    StressResult result_;
};

}  // namespace

RayGrid grid_of_ray(uint64_t number) {
    return kGrids[number / kRaysOfOneGrid % kGrids.size()];
}

std::string describe(const FixedGrid& grid, const FixedRay& ray) {
    return fmt::format("grid {}x{}x{}, origin ({},{},{}) / 2^{}, direction ({},{},{}) / 2^22",
                       grid.size.x, grid.size.y, grid.size.z, ray.origin[0], ray.origin[1],
                       ray.origin[2], grid.fraction_bits, ray.direction[0], ray.direction[1],
                       ray.direction[2]);
}

StressResult stress_rays(RayClass kind, const StressRun& run) {
    return RayStress(kind, run).all();
}

}  // namespace voxelume
