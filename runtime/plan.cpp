#include "runtime/plan.hpp"

#include <algorithm>
#include <cmath>
#include <glm/common.hpp>
#include <glm/matrix.hpp>
#include <set>

#include "runtime/instances.hpp"
#include "runtime/stages/ray_batch.hpp"
#include "runtime/surface_extent.hpp"

namespace voxelume {
namespace {

// Bytes that a stored brick of 16³ voxels takes.
constexpr double kOccupancy = 512;   // a bit for each voxel
constexpr double kDistance = 8192;   // 2 bytes for each node
constexpr double kWords = 16384;     // 4 bytes for each voxel: attributes, colours, list starts
constexpr double kWinding = 9216;    // winding numbers, their totals and signs, while voxelizing
constexpr double kIndexMarks = 544;  // masks, counts and starts, while indexing
constexpr double kBand = 2.8;        // voxels around a smooth surface with stored distances
constexpr double kPlacedBand = 5;    // around cubes: placing looks at whole leaves of them

// Bytes for each brick of a lattice, stored or not.
constexpr double kModelTable = 12;  // slots, bins' numbers and cursors
constexpr double kWorldTable = 5;   // slots and states

// Bytes for each triangle of an exact surface, as long as it is there.
constexpr double kExactTriangle = 40;

// Bytes for each triangle while voxelizing: corners, shape, places in the lists of two bricks.
constexpr double kTriangle = 112;

// Bytes for each voxel of the pyramid, and for the list of triangles of an exact one.
constexpr double kField = 32, kWord = 4, kPrimitives = 10;
constexpr double kVoxelsPerLeaf = 16, kLeaf = 12;
constexpr double kVoxelsPerSector = 4096, kSectorRecords = 1024;

// Bytes for each ray of a batch with its shadow ray, and for each pixel.
constexpr double kRay = 136;

/// Bytes for each pixel on the device.
double pixel_bytes(const ImageChannels& channels) {
    return 4.0 * (4 + int(channels.depth) + 3 * int(channels.position) + 3 * int(channels.normal) +
                  int(channels.object));
}

double brick_table(const GridFrame& frame) {
    const glm::dvec3 bricks(frame.bricks());
    return bricks.x * bricks.y * bricks.z;
}

/// What the voxels of a model carry besides their place.
struct Extras {
    bool words = false, colors = false;
};

Extras extras_of(const Model& model, const MeshSummary* mesh) {
    if (model.solid) return {};
    return {.words = mesh->group_names.size() > 1, .colors = mesh->has_colors};
}

double band_of(const Model& model) {
    return model.surface == Surface::smooth ? kBand : 0;
}

/// In the model's own space.
SurfaceArea model_area(const Model& model, const MeshSummary* mesh) {
    if (mesh) return mesh->area;
    return solid_area(*model.solid, glm::dmat4(1), {model.reach.min, model.reach.max});
}

/// The memory of a grid whose surface is as large as `extent`.
GridPlan plan_grid(const Model& model, const MeshSummary* mesh, const GridFrame& frame,
                   const SurfaceExtent& extent) {
    GridPlan grid{.frame = frame,
                  .triangles = mesh ? mesh->triangles : 0,
                  .voxels = extent.voxels,
                  .bricks = extent.bricks};
    const Extras extras = extras_of(model, mesh);
    const bool smooth = model.surface == Surface::smooth, exact = model.surface == Surface::exact;
    const bool counts_windings = mesh && (smooth || model.set == VoxelSet::solid);
    const double brick = (smooth ? kDistance : kOccupancy) +
                         kWords * (int(extras.words) + int(extras.colors) + int(exact));
    const double lists = extent.voxels * kPrimitives + double(grid.triangles) * kExactTriangle;
    grid.kept_bytes = brick_table(frame) * 4 + extent.bricks * brick + (exact ? lists : 0);
    grid.made_bytes = grid.kept_bytes + brick_table(frame) * (kModelTable - 4) +
                      double(grid.triangles) * kTriangle +
                      extent.bricks * (counts_windings ? kWinding : kOccupancy) +
                      (extras.words || extras.colors ? extent.bricks * kWords : 0);
    if (!model.cuts.empty()) {
        // The mesh's own grids stay beside the cut one; those of the rest of space make it.
        const bool is_shell = !smooth && model.set != VoxelSet::solid;
        const double operands = (is_shell ? 2 : 1) * grid.kept_bytes;
        grid.kept_bytes += operands;
        grid.made_bytes += 2 * operands;
    }
    return grid;
}

GridPlan plan_model_of(const Model& model, const MeshSummary* mesh, const SurfaceArea& area) {
    const GridFrame frame = model_frame(model, mesh);
    return plan_grid(model, mesh, frame,
                     surface_extent(area, glm::dmat4(1), frame, band_of(model)));
}

class Planner {
  public:
    Planner(const Scene& scene, MeshStore& meshes) : scene_(scene), meshes_(meshes) {
        plan_.world = world_frame(scene.world);
        world_box_ = {
            scene.world.bounds.min,
            scene.world.bounds.min + glm::dvec3(scene.world.voxels) * scene.world.voxel_size};
    }

    ScenePlan run() {
        for (size_t number = 0; number < scene_.objects.size(); ++number) {
            const Object& object = scene_.objects[number];
            if (!is_in_reach(scene_, object)) continue;
            if (is_instanced(scene_, object))
                add_instance(object);
            else
                add_object(int(number));
        }
        add_stages();
        return plan_;
    }

  private:
    const SurfaceArea& area_of(int model_number) {
        const auto [entry, added] = areas_.try_emplace(model_number);
        const Model& model = scene_.models[size_t(model_number)];
        if (added) entry->second = model_area(model, meshes_.summary_of(model));
        return entry->second;
    }

    /// What an object's surface takes of the world.
    SurfaceExtent world_extent(const Object& object, double band) {
        const Model& model = scene_.models[size_t(object.model)];
        const glm::dmat4& map = object.world_from_object;
        if (model.solid)
            return surface_extent(solid_area(*model.solid, map, world_box_), glm::dmat4(1),
                                  plan_.world, band);
        SurfaceExtent extent = surface_extent(area_of(object.model), map, plan_.world, band);
        const double inside = part_in_world(object.model, map);
        return {extent.voxels * inside, extent.bricks * inside};
    }

    /// Voxels of the world inside of an object whose inside rays see: those of its box.
    double inside_voxels(const Object& object) {
        const Model& model = scene_.models[size_t(object.model)];
        const glm::dmat4& map = object.world_from_object;
        const glm::dvec3 edge = plan_.world.voxel_edge;
        const double voxel = edge.x * edge.y * edge.z;
        if (!model.solid) {
            const Bounds& box = meshes_.summary_of(model)->surface;
            const glm::dvec3 size = box.max - box.min, world = world_box_.max - world_box_.min;
            const double volume = size.x * size.y * size.z * std::abs(glm::determinant(map));
            return std::min(volume, world.x * world.y * world.z) / voxel;
        }
        const SolidBounds box = bounds(*model.solid, map, world_box_);
        const glm::dvec3 size = glm::max(box.max - box.min, 0.0);
        return size.x * size.y * size.z / voxel;
    }

    double part_in_world(int model_number, const glm::dmat4& map) {
        const Model& model = scene_.models[size_t(model_number)];
        const Bounds& box = meshes_.summary_of(model)->surface;
        for (int corner = 0; corner < 8; ++corner) {
            const glm::dvec3 p(map * glm::dvec4(corner & 1 ? box.max.x : box.min.x,
                                                corner & 2 ? box.max.y : box.min.y,
                                                corner & 4 ? box.max.z : box.min.z, 1.0));
            if (glm::any(glm::lessThan(p, world_box_.min)) ||
                glm::any(glm::greaterThan(p, world_box_.max)))
                return part_inside(*meshes_.mesh_of(model), map, world_box_);
        }
        return 1;
    }

    void add_object(int number) {
        const Object& object = scene_.objects[size_t(number)];
        const Model& model = scene_.models[size_t(object.model)];
        if (!model.voxels.empty() && model.surface != Surface::exact)
            return add_voxels(object, meshes_.voxels(model));
        const MeshSummary* mesh = meshes_.summary_of(model);
        const Extras extras = extras_of(model, mesh);
        const SurfaceExtent in_world =
            world_extent(object, model.surface == Surface::smooth ? kBand : kPlacedBand);
        plan_.voxels += in_world.voxels;
        plan_.bricks += in_world.bricks;
        if (shows_inside(scene_, object)) {
            const double inside = inside_voxels(object);
            plan_.voxels += inside;
            plan_.bricks += inside / (kBrickSize * kBrickSize * kBrickSize);
        }
        smooth_ |= model.surface == Surface::smooth;
        occupied_ |= model.surface != Surface::smooth;
        colors_ |= extras.colors;
        words_ |= objects_++ > 0 || extras.words;
        if (model.surface == Surface::exact) {
            exact_voxels_ += in_world.voxels;
            exact_bytes_ += in_world.voxels * kPrimitives;
            if (mesh) exact_bytes_ += double(mesh->triangles) * kExactTriangle;
            plan_.grids.push_back(plan_grid(model, mesh, plan_.world, world_extent(object, 0)));
            plan_.grids.back().object = number;
        } else if (made_.insert(object.model).second) {
            plan_.grids.push_back(plan_model_of(model, mesh, area_of(object.model)));
        } else {
            return;
        }
        plan_.grids.back().model = object.model;
    }

    /// An object that keeps its model's voxels: they count once.
    void add_instance(const Object& object) {
        const Model& model = scene_.models[size_t(object.model)];
        const bool is_smooth = model.surface == Surface::smooth;
        instances_.any = true;
        instances_.smooth |= is_smooth;
        if (!shared_.insert(object.model).second) return;
        GridPlan grid;
        if (!model.voxels.empty() && model.surface != Surface::exact) {
            const VoxelModel& voxels = meshes_.voxels(model);
            grid = plan_voxels(voxels);
            instances_.colors |= !voxels.colors.empty();
        } else {
            const MeshSummary* mesh = meshes_.summary_of(model);
            grid = plan_model_of(model, mesh, area_of(object.model));
            instances_.colors |= extras_of(model, mesh).colors;
            if (model.surface == Surface::exact)
                instances_.exact_bytes +=
                    grid.voxels * (kPrimitives + kWord) + double(grid.triangles) * kExactTriangle;
        }
        instances_.voxels += grid.voxels;
        grid.model = object.model;
        if (model.surface == Surface::exact || made_.insert(object.model).second)
            plan_.grids.push_back(grid);
    }

    /// An object whose voxels come from a file: in the world it has as many in its volume, and no
    /// fewer bricks.
    void add_voxels(const Object& object, const VoxelModel& voxels) {
        const auto volume = [](const glm::dvec3& edge) { return edge.x * edge.y * edge.z; };
        const double finer =
            std::max(1.0, volume(voxels.frame.voxel_edge) / volume(plan_.world.voxel_edge) *
                              std::abs(glm::determinant(object.world_from_object)));
        const double count = double(voxels.voxels());
        const auto stored = double(voxels.coordinates.size());
        const bool smooth = voxels.surface == Surface::smooth;
        plan_.voxels += count * finer;
        plan_.bricks += 2 * stored * finer;
        smooth_ |= smooth;
        occupied_ |= !smooth;
        colors_ |= !voxels.colors.empty();
        words_ |= objects_++ > 0 || !voxels.attributes.empty();
        if (!made_.insert(object.model).second) return;
        GridPlan grid = plan_voxels(voxels);
        grid.model = object.model;
        plan_.grids.push_back(grid);
    }

    static GridPlan plan_voxels(const VoxelModel& voxels) {
        const auto stored = double(voxels.coordinates.size());
        GridPlan grid{.frame = voxels.frame, .voxels = double(voxels.voxels())};
        grid.bricks = stored;
        grid.kept_bytes =
            brick_table(voxels.frame) * 4 +
            stored * ((voxels.surface == Surface::smooth ? kDistance : kOccupancy) +
                      kWords * (int(!voxels.attributes.empty()) + int(!voxels.colors.empty())));
        grid.made_bytes = grid.kept_bytes;
        return grid;
    }

    void add_stages() {
        double kept = 0;
        for (const GridPlan& grid : plan_.grids) {
            plan_.voxelize_bytes = std::max(plan_.voxelize_bytes, kept + grid.made_bytes);
            kept += grid.kept_bytes;
        }
        const double table = brick_table(plan_.world);
        plan_.bricks = std::min(plan_.bricks, table);
        double brick = 0;
        if (occupied_) brick += kOccupancy;
        if (smooth_) brick += kDistance;
        if (words_) brick += kWords;
        if (colors_) brick += kWords;
        if (exact_voxels_ > 0) brick += kWords;
        const bool measures_nearest = smooth_ && (words_ || colors_ || occupied_);
        const double world = 4 * table + plan_.bricks * brick + exact_bytes_;
        plan_.place_bytes = kept + world + (kWorldTable - 4) * table +
                            (measures_nearest ? plan_.bricks * kDistance : 0) +
                            (exact_voxels_ > 0 ? plan_.bricks * kWords : 0);
        plan_.world_bytes = pyramid_bytes();
        plan_.index_bytes = world + plan_.bricks * kIndexMarks + plan_.world_bytes;
        if (instances_.any) plan_.index_bytes += plan_.world_bytes;  // before they are joined
        const glm::dvec2 size(scene_.render.size);
        const double pixels = size.x * size.y;
        const double image = pixel_bytes(scene_.render.channels) * pixels;
        plan_.medium = plan_density(scene_.world);
        plan_.halo_bytes = instances_.any ? 0 : sector_bytes();
        plan_.image_bytes = plan_.world_bytes + plan_.halo_bytes + plan_.medium.bytes + image +
                            kRay * std::min(double(kBatchRays), pixels * scene_.render.samples);
        plan_.host_bytes = kWorldTable * table + 2 * image + plan_.medium.host_bytes;
        for (const GridPlan& grid : plan_.grids)
            plan_.host_bytes += double(grid.triangles) * 36 + kModelTable * brick_table(grid.frame);
    }

    /// The table of sectors, and the records of those with voxels.
    double sector_bytes() const {
        const glm::dvec3 sectors(plan_.world.sectors());
        const double table = sectors.x * sectors.y * sectors.z;
        const double stored = 8 + plan_.voxels / kVoxelsPerSector;
        return 4 * table + std::min(table, stored) * kSectorRecords;
    }

    double pyramid_bytes() const {
        double voxel = kLeaf / kVoxelsPerLeaf;
        if (smooth_ || instances_.smooth) voxel += kField;
        if (words_ || (smooth_ && occupied_) || instances_.any) voxel += kWord;
        if (colors_ || instances_.colors) voxel += kWord;
        return sector_bytes() + (plan_.voxels + instances_.voxels) * voxel + exact_voxels_ * kWord +
               exact_bytes_ + instances_.exact_bytes;
    }

    const Scene& scene_;
    MeshStore& meshes_;
    ScenePlan plan_;
    SolidBounds world_box_;
    std::map<int, SurfaceArea> areas_;
    std::set<int> made_;
    int objects_ = 0;
    double exact_voxels_ = 0, exact_bytes_ = 0;
    struct {
        bool any = false, smooth = false, colors = false;
        double voxels = 0, exact_bytes = 0;
    } instances_;           ///< their models
    std::set<int> shared_;  ///< those counted
    bool smooth_ = false, occupied_ = false, words_ = false, colors_ = false;
};

}  // namespace

double ScenePlan::peak_bytes() const {
    return std::max({voxelize_bytes, place_bytes, index_bytes, image_bytes});
}

GridPlan plan_model(const Model& model, const Mesh& mesh) {
    const MeshSummary summary = summary_of(mesh);
    return plan_model_of(model, &summary, summary.area);
}

ScenePlan plan_scene(const Scene& scene, MeshStore& meshes) {
    return Planner(scene, meshes).run();
}

}  // namespace voxelume
