// SPDX-License-Identifier: Apache-2.0
#include "runtime/memory/counted_grids.hpp"

#include <algorithm>

#include "runtime/assets/model_frame.hpp"
#include "runtime/base/error.hpp"
#include "runtime/stages/voxelize/mesh_lattice.hpp"

namespace voxelume {
namespace {

bool has_own_voxels(const Model& model) {
    return !model.voxels.empty() && !lists_primitives(model.surface);
}

/// Refuses a mesh that is voxelized in the world's own lattice if the lattice is too large.
void check_lattice(const Object& object, const Model& model, const glm::ivec3& size) {
    if (std::max({size.x, size.y, size.z}) <= kLatticeReach) return;
    const bool is_exact = lists_primitives(model.surface);
    throw Error(ErrorKind::limit,
                "{}: {} mesh in {} {} x {} x {} voxels, and {} along an axis are the most for it: "
                "give it \"placement\": \"instance\", or the world a larger \"voxel_size\"",
                object.where, is_exact ? "an exact" : "a smooth",
                is_exact ? "a world of" : "the world, where it takes", size.x, size.y, size.z,
                kLatticeReach);
}

/// Refuses a mesh if some of its vertices are surely too far from the lattice: each side of its box
/// holds one.
void check_reach(const Object& object, const Bounds& box, const GridFrame& frame) {
    for (int side = 0; side < 6; ++side) {
        glm::dvec3 low(INFINITY), high(-INFINITY);
        for (int i = 0; i < 8; ++i) {
            if ((i >> side / 2 & 1) != side % 2) continue;
            const glm::dvec3 p(object.world_from_object * glm::dvec4(corner(box, i), 1));
            const glm::dvec3 voxels = (p - frame.origin) / frame.voxel_edge;
            low = glm::min(low, voxels), high = glm::max(high, voxels);
        }
        const glm::dvec3 nearest = glm::max(low, -high);
        const double farthest = std::max({nearest.x, nearest.y, nearest.z});
        if (farthest > kLatticeReach)
            throw Error(
                ErrorKind::limit,
                "{}: the mesh reaches {:.0f} voxels from the world, more than {}: if that "
                "is wrong, give its model another \"unit\" or the object another \"scale\"; "
                "if not, give the world a larger \"voxel_size\"",
                object.where, farthest, kLatticeReach);
    }
}

/// The voxels of a grid that rays must see, and the primitives that these voxels list.
WorldCounts indexed_counts(const GridCounts& grid) {
    return {grid.bricks, grid.voxels, grid.listed};
}

/// Makes the grid by `make`, and notes the memory that this takes.
template <class Make>
void measure(const Device& device, CountedGrid& counted, const Make& make) {
    DeviceCounters& counters = device.counters();
    const uint64_t before = counters.bytes_in_use, height = counters.peak_bytes;
    counters.peak_bytes = before;
    counters.largest_bytes = 0;
    counted.grid = std::make_shared<const BrickGrid>(make());
    counted.made_bytes = double(counters.peak_bytes - before);
    counted.kept_bytes = double(counters.bytes_in_use - before);
    counted.largest_buffer = counters.largest_buffer;
    counted.largest_bytes = double(counters.largest_bytes);
    counters.peak_bytes = std::max(counters.peak_bytes, height);
}

}  // namespace

CountedGrid count_mesh(const Device& device, const GridCounts& counts) {
    CountedGrid counted{.counts = counts};
    measure(device, counted, [&] { return count_mesh_grid(device, counts); });
    counted.grid.reset();
    return counted;
}

CountedInstances CountedGrids::instances() {
    CountedInstances result;
    result.listed = list_instances(
        scene_, meshes_,
        [this](const Object& object, const Model& model) { return own_grid(object, model); });
    for (const SharedGrid& grid : result.listed.grids)
        result.models.push_back(indexed_counts(counts_of(grid)));
    return result;
}

std::vector<PlacedObject> CountedGrids::placed() {
    std::vector<SharedGrid> shown;  // the grids stay in grids_, too
    return placed_objects(
        scene_, meshes_, objects_.boxes(),
        [this](const Object& object, const Model& model, const ObjectLattice& lattice) {
            return world_grid(object, model, lattice);
        },
        shown);
}

/// The grid that shows an object in the world.
SharedGrid CountedGrids::world_grid(const Object& object, const Model& model,
                                    const ObjectLattice& lattice) {
    if (has_own_voxels(model)) return own_grid(object, model);
    if (lattice.lattice != Lattice::world) return model_grid(object, model, lattice.frame);
    if (!model.solid) {
        check_lattice(object, model, lattice.frame.size);
        check_reach(object, meshes_.summary_of(model)->surface, lattice.frame);
    }
    return make({.model = object.model,
                 .object = int(&object - scene_.objects.data()),
                 .is_thin_part = model.is_thin_part,
                 .counts = objects_.object_grid(object, model, lattice.frame, estimate_)},
                model);
}

/// The grid of an object's model, whole, in its own space.
SharedGrid CountedGrids::own_grid(const Object& object, const Model& model) {
    if (has_own_voxels(model)) {
        const VoxelModel& voxels = meshes_.voxels(model);
        if (SharedGrid grid = found(object, model, voxels.frame)) return grid;
        GridCounts counts{.frame = voxels.frame, .surface = voxels.surface, .set = voxels.set};
        counts.bricks = voxels.coordinates.size();
        counts.voxels = voxels.voxels();
        return make({.model = object.model, .counts = counts}, model);
    }
    return model_grid(object, model, model_frame(model, meshes_.summary_of(model)));
}

SharedGrid CountedGrids::model_grid(const Object& object, const Model& model,
                                    const GridFrame& frame) {
    if (SharedGrid grid = found(object, model, frame)) return grid;
    return make({.model = object.model,
                 .is_thin_part = model.is_thin_part,
                 .counts = objects_.model_grid(model, frame, estimate_)},
                model);
}

SharedGrid CountedGrids::make(CountedGrid counted, const Model& model) {
    measure(device_, counted, [&] { return grid_of(counted.counts, model); });
    grids_.push_back(std::move(counted));
    return grids_.back().grid;
}

/// Makes a grid as GridCache does.
BrickGrid CountedGrids::grid_of(const GridCounts& counts, const Model& model) {
    if (has_own_voxels(model)) return meshes_.voxels(model).upload(device_);
    if (model.solid) return count_solid_grid(device_, counts);
    BrickGrid grid = count_mesh_grid(device_, counts);
    if (model.cuts.empty()) return grid;
    bodies_.push_back(std::move(grid));  // kept together with the cut one
    return count_cut_grid(device_, bodies_.back(), counts);
}

SharedGrid CountedGrids::found(const Object& object, const Model& model,
                               const GridFrame& frame) const {
    const auto same = std::ranges::find_if(grids_, [&](const CountedGrid& counted) {
        return counted.model == object.model && counted.object == -1 &&
               counted.is_thin_part == model.is_thin_part && counted.counts.frame == frame;
    });
    return same == grids_.end() ? nullptr : same->grid;
}

const GridCounts& CountedGrids::counts_of(const SharedGrid& grid) const {
    return std::ranges::find(grids_, grid, &CountedGrid::grid)->counts;
}

std::vector<BrickGrid> CountedGrids::make_again(
    const std::function<bool(const CountedGrid&)>& is_changed) {
    std::vector<BrickGrid> made;
    for (const CountedGrid& grid : grids_) {
        if (!is_changed(grid)) continue;
        const Model& model = scene_.models[size_t(grid.model)];
        made.push_back(grid_of(grid.counts, grid.is_thin_part ? *thin_part_of(model) : model));
    }
    return made;
}

void CountedGrids::forget_if(const std::function<bool(const CountedGrid&)>& is_old) {
    bodies_.clear();
    for (CountedGrid& counted : grids_)
        if (is_old(counted)) counted.grid.reset();
}

}  // namespace voxelume
