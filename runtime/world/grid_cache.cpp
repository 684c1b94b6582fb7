// SPDX-License-Identifier: Apache-2.0
#include "runtime/world/grid_cache.hpp"

#include <algorithm>
#include <chrono>

#include "runtime/base/error.hpp"
#include "runtime/geometry/solid/solid_clip.hpp"
#include "runtime/grid/grid_bytes.hpp"
#include "runtime/stages/voxelize/cut.hpp"
#include "runtime/stages/voxelize/leave_out.hpp"
#include "runtime/stages/voxelize/voxelize_solid.hpp"

namespace voxelume {
namespace {

using Seconds = std::chrono::duration<double>;

bool has_own_voxels(const Model& model) {
    return !model.voxels.empty() && !lists_primitives(model.surface);
}

/// A model without its name, its place in the scene's text, and the values that its frame already
/// contains.
Model source_of(Model model) {
    model.name.clear();
    model.where = {};
    model.extent = {};
    model.voxel_size = glm::dvec3(0);
    model.resolution = 0;
    model.is_sized = false;
    model.is_surface_open = false;
    model.surface_reason.clear();
    return model;
}

/// True if a model may be closed where a lattice ends, but stays open because light goes through
/// it.
bool stays_open(const Model& model, bool transmits) {
    return transmits && model.solid && lists_primitives(model.surface);
}

/// The whole mesh of a model with cuts, as a voxel set.
Model whole_of(Model model, VoxelSet set) {
    model.cuts.clear();
    model.set = set;
    return model;
}

/// The sets of the whole mesh from which a cut model is made.
std::vector<VoxelSet> body_sets(const Model& model) {
    if (shows_voxels(model.surface) && model.set != VoxelSet::solid)
        return {model.set, VoxelSet::solid};
    return {model.set};
}

}  // namespace

SharedGrid GridCache::grid_of(const Object& object, const Model& model,
                              const ObjectLattice& lattice, bool transmits) {
    Source source{source_of(model), lattice.frame_from_object, {}, stays_open(model, transmits)};
    if (!has_own_voxels(model)) source.frame = lattice.frame;
    if (lattice.lattice != Lattice::world) return find_or_make(model, source, model.where);
    return find_or_make(model, source, object.where, !object.moves);
}

SharedGrid GridCache::own_grid_of(const Model& model, bool transmits) {
    Source source{source_of(model), glm::dmat4(1), {}, stays_open(model, transmits)};
    if (!has_own_voxels(model)) source.frame = model_frame(model, meshes_.summary_of(model));
    return find_or_make(model, source, model.where);
}

SharedGrid GridCache::find_or_make(const Model& model, const Source& source,
                                   const SourcePlace& where, bool keeps) {
    const auto found = std::ranges::find(kept_, source, &Kept::source);
    if (found != kept_.end()) {
        found->is_used = true;
        // A cut that stands still may move again later, so the mesh's own grids are retained for
        // it.
        if (!model.cuts.empty())
            for (const VoxelSet set : body_sets(model)) use(body_source(model, source, set));
        return found->grid;
    }
    try {
        auto grid = std::make_shared<const BrickGrid>(read_or_make(model, source, keeps));
        kept_.push_back({source, grid});
        return grid;
    } catch (const Error& error) {
        const bool is_users = error.kind() == ErrorKind::input || error.kind() == ErrorKind::limit;
        if (!is_users || where.empty()) throw;
        const glm::ivec3& size = source.frame.size;
        if (error.kind() == ErrorKind::limit && size != glm::ivec3(0))
            throw Error(ErrorKind::limit, "{}: a grid of {}x{}x{} voxels: {}", where, size.x,
                        size.y, size.z, error.what());
        throw Error(error.kind(), "{}: {}", where, error.what());
    }
}

BrickGrid GridCache::read_or_make(const Model& model, const Source& source, bool keeps) {
    if (!model.cuts.empty()) return make_cut(model, source, keeps);
    const ModelCache& cache = meshes_.cache();
    const std::string mesh = keeps ? meshes_.source_of(model) : std::string();
    std::string key;
    if (!mesh.empty()) {
        key = grid_key(mesh, options_of(model), source.frame_from_model, source.frame);
        if (auto grid = cache.grid(device_, key)) {
            ++from_cache_;
            return std::move(*grid);
        }
    }
    const auto start = std::chrono::steady_clock::now();
    BrickGrid grid = make(model, source);
    device_.finish();
    ++voxelized_;
    const auto made = std::chrono::steady_clock::now();
    if (!key.empty()) cache.keep(key, grid, Seconds(made - start).count());
    keep_seconds_ += Seconds(std::chrono::steady_clock::now() - made).count();
    return grid;
}

BrickGrid GridCache::make(const Model& model, const Source& source) {
    if (has_own_voxels(model)) return meshes_.voxels(model).upload(device_);
    const VoxelizeOptions options = options_of(model);
    if (model.solid && lists_primitives(model.surface) && !source.is_open)
        return voxelize_solid(device_,
                              clipped_solid(*model.solid, source.frame_from_model, source.frame),
                              glm::dmat4(1), source.frame, options);
    if (model.solid && stores_distances(model.surface))
        return voxelize_parts(device_, *model.solid, source.frame_from_model, source.frame);
    if (model.solid)
        return voxelize_solid(device_, *model.solid, source.frame_from_model, source.frame,
                              options);
    BrickGrid grid = voxelizer_.voxelize(*meshes_.mesh_of(model), source.frame_from_model,
                                         source.frame, options);
    if (thin_part_of(model))
        leave_out(meshes_.thin_part_of(model).points, model.thin_edge, source.frame_from_model,
                  grid);
    return grid;
}

GridCache::Source GridCache::body_source(const Model& model, const Source& source, VoxelSet set) {
    return {source_of(whole_of(model, set)), source.frame_from_model, source.frame};
}

void GridCache::use(const Source& source) {
    const auto found = std::ranges::find(kept_, source, &Kept::source);
    if (found != kept_.end()) found->is_used = true;
}

/// Makes the grid of a model with cuts. The mesh's own grids are kept like others, so moving cuts
/// are the only thing that is voxelized again.
BrickGrid GridCache::make_cut(const Model& model, const Source& source, bool keeps) {
    const Solid rest = rest_of(source.frame, source.frame_from_model, model.cuts);
    const auto body = [&](VoxelSet set) {
        return find_or_make(whole_of(model, set), body_source(model, source, set), "", keeps);
    };
    const auto left = [&](VoxelSet set) {
        const VoxelizeOptions options{
            .surface = model.surface, .set = set, .normals = model.normals};
        return voxelize_solid(device_, rest, glm::dmat4(1), source.frame, options);
    };
    ++voxelized_;
    const SharedGrid whole = body(model.set);
    if (stores_distances(model.surface)) return cut_field(device_, whole, rest);
    const BrickGrid space = left(model.set);
    if (model.set == VoxelSet::solid)
        return common_cubes(device_, {*whole, *whole}, {space, space});
    return common_cubes(device_, {*whole, *body(VoxelSet::solid)}, {space, left(VoxelSet::solid)});
}

/// True if a grid belongs to a model of which no grid was asked for: it is left from earlier
/// frames.
bool GridCache::is_old(const Model& model, const Source& source) const {
    const std::optional<Model> part = source.model.is_thin_part ? thin_part_of(model) : model;
    if (!part) return false;
    const Model own = source_of(*part);
    if (source.model != own && source.model != source_of(whole_of(model, source.model.set)))
        return false;
    return std::ranges::none_of(
        kept_, [&](const Kept& kept) { return kept.is_used && kept.source.model == own; });
}

bool GridCache::is_retained(const Scene& scene, const std::vector<bool>& retained,
                            const Source& source) const {
    for (size_t model = 0; model < retained.size(); ++model)
        if (retained[model] && is_old(scene.models[model], source)) return true;
    return false;
}

void GridCache::forget_unused(const Scene& scene, const std::vector<bool>& retained,
                              uint64_t room) {
    std::vector<const BrickGrid*> forgotten;
    retained_bytes_ = 0;
    for (const Kept& kept : kept_) {
        if (kept.is_used) continue;
        const uint64_t bytes = device_bytes(*kept.grid);
        if (retained_bytes_ + bytes <= room && is_retained(scene, retained, kept.source))
            retained_bytes_ += bytes;
        else
            forgotten.push_back(kept.grid.get());
    }
    std::erase_if(kept_, [&](const Kept& kept) {
        return std::ranges::find(forgotten, kept.grid.get()) != forgotten.end();
    });
    for (Kept& kept : kept_) kept.is_used = false;
}

}  // namespace voxelume
