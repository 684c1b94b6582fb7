#include "runtime/plan.hpp"

#include <algorithm>
#include <cmath>
#include <glm/common.hpp>
#include <glm/matrix.hpp>
#include <set>

#include "runtime/error.hpp"
#include "runtime/illumination.hpp"
#include "runtime/instances.hpp"
#include "runtime/object_boxes.hpp"
#include "runtime/plan_extent.hpp"
#include "runtime/stages/mesh_lattice.hpp"

namespace voxelume {
namespace {

constexpr double kIndexMarks = 544;  // bytes for each brick: masks, counts, starts, while indexing
constexpr double kPlacedBand = 5;    // voxels around cubes: placing looks at whole leaves of them
constexpr double kWorldTable = 5;    // bytes for each brick of the lattice: slots and states

// Bytes for each voxel of the pyramid.
constexpr double kField = 32, kWord = 4;
constexpr double kVoxelsPerLeaf = 16, kLeaf = 12;
constexpr double kVoxelsPerSector = 4096, kSectorRecords = 1024;

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
            // Refuses names of groups that aren't there, before any frame is rendered.
            materials_of_groups(object, meshes_.groups_of(scene_.models[size_t(object.model)]));
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

    /// What an object's surface takes of the world, at least or as planned.
    SurfaceExtent world_extent(const Object& object, double band, bool at_least = false) {
        const Model& model = scene_.models[size_t(object.model)];
        const glm::dmat4& map = object.world_from_object;
        if (model.solid) {
            const auto& area_of_solid = at_least ? least_solid_area : solid_area;
            return surface_extent(area_of_solid(*model.solid, map, world_box_), glm::dmat4(1),
                                  plan_.world, band);
        }
        const SurfaceArea& area =
            at_least ? meshes_.summary_of(model)->least_area : area_of(object.model);
        SurfaceExtent extent = surface_extent(area, map, plan_.world, band);
        const double inside = part_in_world(object.model, map);
        return {extent.voxels * inside, extent.bricks * inside};
    }

    /// No more than it takes; nothing of a mesh that is cut.
    SurfaceExtent least_extent(const Object& object, double band) {
        if (!scene_.models[size_t(object.model)].cuts.empty()) return {};
        return world_extent(object, band, true);
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

    /// Whether the map takes all of a box into the world.
    bool lies_in_world(const glm::dvec3& low, const glm::dvec3& high, const glm::dmat4& map) const {
        for (int corner = 0; corner < 8; ++corner) {
            const glm::dvec3 p(map * glm::dvec4(corner & 1 ? high.x : low.x,
                                                corner & 2 ? high.y : low.y,
                                                corner & 4 ? high.z : low.z, 1.0));
            if (glm::any(glm::lessThan(p, world_box_.min)) ||
                glm::any(glm::greaterThan(p, world_box_.max)))
                return false;
        }
        return true;
    }

    double part_in_world(int model_number, const glm::dmat4& map) {
        const Model& model = scene_.models[size_t(model_number)];
        const Bounds& box = meshes_.summary_of(model)->surface;
        if (lies_in_world(box.min, box.max, map)) return 1;
        return part_inside(*meshes_.mesh_of(model), map, world_box_);
    }

    const std::vector<VoxelBox>& boxes() {
        if (boxes_.empty()) boxes_ = object_boxes(scene_, meshes_);
        return boxes_;
    }

    void add_least(int number, const WorldExtent& extent) {
        const VoxelBox& box = boxes()[size_t(number)];
        if (overlap(box, box)) extents_.push_back({box, extent});
    }

    void add_object(int number) {
        const Object& object = scene_.objects[size_t(number)];
        const Model& model = scene_.models[size_t(object.model)];
        if (!model.voxels.empty() && model.surface != Surface::exact)
            return add_voxels(number, meshes_.voxels(model));
        const MeshSummary* mesh = meshes_.summary_of(model);
        const GridExtras extras = extras_of(model, mesh);
        const bool is_exact = model.surface == Surface::exact;
        const double band = model.surface == Surface::smooth ? kSurfaceBand : kPlacedBand;
        const SurfaceExtent in_world = world_extent(object, band);
        const SurfaceExtent least = least_extent(object, band);
        plan_.voxels += in_world.voxels;
        plan_.bricks += in_world.bricks;
        add_least(number, {least.voxels, least.bricks, is_exact ? least.voxels : 0});
        if (shows_inside(scene_, object)) {
            const double inside = inside_voxels(object);
            plan_.voxels += inside;
            plan_.bricks += inside / (kBrickSize * kBrickSize * kBrickSize);
        }
        smooth_ |= model.surface == Surface::smooth;
        exact_ |= is_exact;
        occupied_ |= model.surface != Surface::smooth;
        colors_ |= extras.colors;
        words_ |= objects_++ > 0 || extras.words;
        if (is_exact) {
            if (mesh) check_reach(object);
            exact_voxels_ += in_world.voxels;
            if (mesh) exact_triangles_ += double(mesh->triangles);
            GridPlan grid = plan_grid(model, mesh, plan_.world, world_extent(object, 0));
            set_least(grid, plan_grid(model, mesh, plan_.world, least_extent(object, 0)));
            plan_.grids.push_back(grid);
            plan_.grids.back().object = number;
        } else if (made_.insert(object.model).second) {
            plan_.grids.push_back(plan_grid(model, mesh, area_of(object.model)));
        } else {
            return;
        }
        plan_.grids.back().model = object.model;
    }

    /// An exact mesh is voxelized in the world's own lattice.
    void check_reach(const Object& object) const {
        const glm::ivec3& size = plan_.world.size;
        if (std::max({size.x, size.y, size.z}) > kLatticeReach)
            throw Error(ErrorKind::limit,
                        "{}: an exact mesh in a world of {} x {} x {} voxels, and {} along an axis "
                        "are the most for it: give it \"placement\": \"instance\", or the world a "
                        "larger \"voxel_size\"",
                        object.where, size.x, size.y, size.z, kLatticeReach);
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
            grid = plan_grid(voxels);
            instances_.colors |= !voxels.colors.empty();
        } else {
            const MeshSummary* mesh = meshes_.summary_of(model);
            grid = plan_grid(model, mesh, area_of(object.model));
            instances_.colors |= extras_of(model, mesh).colors;
            if (model.surface == Surface::exact) {
                exact_ = true;
                instances_.exact_voxels += grid.least.voxels;
                instances_.exact_triangles += double(grid.triangles);
            }
        }
        instances_.voxels += grid.voxels;
        instances_.least_voxels += grid.least.voxels;
        grid.model = object.model;
        if (model.surface == Surface::exact || made_.insert(object.model).second)
            plan_.grids.push_back(grid);
    }

    /// An object whose voxels come from a file: in the world it has as many in its volume, and no
    /// fewer bricks. At least it has as many as a larger voxel holds of its own, if the world shows
    /// all of it.
    void add_voxels(int number, const VoxelModel& voxels) {
        const Object& object = scene_.objects[size_t(number)];
        const auto volume = [](const glm::dvec3& edge) { return edge.x * edge.y * edge.z; };
        const double own = volume(voxels.frame.voxel_edge) / volume(plan_.world.voxel_edge) *
                           std::abs(glm::determinant(object.world_from_object));
        const double finer = std::max(1.0, own), least = std::min(1.0, own);
        const double count = double(voxels.voxels());
        const auto stored = double(voxels.coordinates.size());
        const bool smooth = voxels.surface == Surface::smooth;
        plan_.voxels += count * finer;
        plan_.bricks += 2 * stored * finer;
        const GridFrame& frame = voxels.frame;
        if (lies_in_world(frame.origin, frame.origin + frame.voxel_edge * glm::dvec3(frame.size),
                          object.world_from_object))
            add_least(number, {count * least, stored * least, 0});
        smooth_ |= smooth;
        occupied_ |= !smooth;
        colors_ |= !voxels.colors.empty();
        transparent_ |= voxels.transparent;
        words_ |= objects_++ > 0 || !voxels.attributes.empty();
        if (!made_.insert(object.model).second) return;
        GridPlan grid = plan_grid(voxels);
        grid.model = object.model;
        plan_.grids.push_back(grid);
    }

    /// Bytes of the world's stages at their height.
    struct StageBytes {
        double place = 0, index = 0, world = 0, halo = 0, image = 0;
    };

    void add_stages() {
        double kept = 0, least_kept = 0;
        for (const GridPlan& grid : plan_.grids) {
            plan_.voxelize_bytes = std::max(plan_.voxelize_bytes, kept + grid.made_bytes);
            plan_.least_bytes = std::max(plan_.least_bytes, least_kept + grid.least.made_bytes);
            kept += grid.kept_bytes;
            least_kept += grid.least.kept_bytes;
        }
        const double table = brick_table(plan_.world);
        plan_.bricks = std::min(plan_.bricks, table);
        plan_.medium = plan_density(scene_.world);
        plan_.rays = ray_bytes(scene_, features());
        const StageBytes all = stages({plan_.voxels, plan_.bricks, exact_voxels_},
                                      instances_.voxels, kept, plan_.rays.most());
        plan_.place_bytes = all.place;
        plan_.index_bytes = all.index;
        plan_.image_bytes = all.image;
        plan_.world_bytes = all.world;
        plan_.halo_bytes = all.halo;
        const WorldExtent least = extent_at_least(std::move(extents_));
        const StageBytes fewest =
            stages(least, instances_.least_voxels, least_kept, plan_.rays.least());
        plan_.least_bytes = std::max({plan_.least_bytes, fewest.place, fewest.index, fewest.image});
        plan_.least_image_bytes = fewest.image;
        plan_.least_with_next = fewest.place + fewest.index + fewest.image;
        add_largest(least);
        plan_.host_bytes =
            kWorldTable * table + 2 * image_bytes(scene_.render) + plan_.medium.host_bytes;
        for (const GridPlan& grid : plan_.grids)
            plan_.host_bytes += double(grid.triangles) * 36 + kTableBytes * brick_table(grid.frame);
    }

    /// What the image's kernels are made for, as far as it decides what rays take.
    Features features() {
        Features features;
        features.smooth = smooth_ || instances_.smooth;
        features.solids = exact_;
        features.attributes = has_words();
        features.colors = colors_ || instances_.colors;
        features.voxel_opacity = transparent_;
        features.instances = instances_.any;
        Pyramid world;
        world.frame = plan_.world;
        world.object_boxes = boxes();
        add_scene(scene_, world, features);
        return features;
    }

    /// Of a world of such an extent with its instances' models, beside `kept` bytes of models, and
    /// with so many of rays.
    StageBytes stages(const WorldExtent& extent, double instanced, double kept, double rays) const {
        const double table = brick_table(plan_.world);
        double brick = 0;
        if (occupied_) brick += kOccupancyBytes;
        if (smooth_) brick += kDistanceBytes;
        if (words_) brick += kWordBytes;
        if (colors_) brick += kWordBytes;
        if (exact_voxels_ > 0) brick += kWordBytes;
        const bool measures_nearest = smooth_ && (words_ || colors_ || occupied_);
        const double lists =
            extent.exact_voxels * kListBytes + exact_triangles_ * kExactTriangleBytes;
        const double world = 4 * table + extent.bricks * brick + lists;
        StageBytes bytes;
        bytes.place = kept + world + (kWorldTable - 4) * table +
                      (measures_nearest ? extent.bricks * kDistanceBytes : 0) +
                      (exact_voxels_ > 0 ? extent.bricks * kWordBytes : 0);
        bytes.world = pyramid_bytes(extent, instanced);
        bytes.index = world + extent.bricks * kIndexMarks + bytes.world;
        if (instances_.any) bytes.index += bytes.world;  // before they are joined
        bytes.halo = instances_.any ? 0 : sector_bytes(extent.voxels);
        bytes.image =
            bytes.world + bytes.halo + plan_.medium.bytes + image_bytes(scene_.render) + rays;
        return bytes;
    }

    /// The largest buffer of the world, its pyramid's with the models of instances behind it. What
    /// is more than that, the buffer itself refuses.
    void add_largest(const WorldExtent& least) {
        const double bricks = std::min(least.bricks, brick_table(plan_.world));
        const double voxels = least.voxels + instances_.least_voxels;
        const double exact_voxels = least.exact_voxels + instances_.exact_voxels;
        const auto keep = [&](bool is_there, const BufferPlan& buffer) {
            if (is_there) keep_larger(plan_.largest, buffer);
        };
        keep(occupied_, {"its voxels", bricks * kOccupancyBytes});
        keep(smooth_, {"its distances", bricks * kDistanceBytes});
        keep(words_, {"its voxels' materials", bricks * kWordBytes});
        keep(colors_, {"its voxels' colors", bricks * kWordBytes});
        keep(exact_voxels_ > 0, {"the starts of its voxels' lists", bricks * kWordBytes});
        keep(true, {"its voxels' lists", exact_voxels * kListBytes});
        keep(true,
             {"its triangles", (exact_triangles_ + instances_.exact_triangles) * kTriangleBytes,
              BufferGrowth::triangles});
        keep(smooth_ || instances_.smooth, {"its voxels' fields", voxels * kField});
        keep(has_words(), {"its voxels' words", voxels * kWord});
    }

    /// The table of sectors, and the records of those with voxels.
    double sector_bytes(double voxels) const {
        const glm::dvec3 sectors(plan_.world.sectors());
        const double table = sectors.x * sectors.y * sectors.z;
        const double stored = 8 + voxels / kVoxelsPerSector;
        return 4 * table + std::min(table, stored) * kSectorRecords;
    }

    /// Whether each voxel of the pyramid has a word of its own.
    bool has_words() const { return words_ || (smooth_ && occupied_) || instances_.any; }

    double pyramid_bytes(const WorldExtent& extent, double instanced) const {
        double voxel = kLeaf / kVoxelsPerLeaf;
        if (smooth_ || instances_.smooth) voxel += kField;
        if (has_words()) voxel += kWord;
        if (colors_ || instances_.colors) voxel += kWord;
        const double exact_voxels = extent.exact_voxels + instances_.exact_voxels;
        const double triangles = exact_triangles_ + instances_.exact_triangles;
        return sector_bytes(extent.voxels) + (extent.voxels + instanced) * voxel +
               exact_voxels * (kWord + kListBytes) + triangles * kExactTriangleBytes;
    }

    const Scene& scene_;
    MeshStore& meshes_;
    ScenePlan plan_;
    SolidBounds world_box_;
    std::map<int, SurfaceArea> areas_;
    std::set<int> made_;
    int objects_ = 0;
    double exact_voxels_ = 0, exact_triangles_ = 0;
    std::vector<VoxelBox> boxes_;        ///< of all objects; none before the first is needed
    std::vector<ObjectExtent> extents_;  ///< of what is seen of objects in the world
    struct {
        bool any = false, smooth = false, colors = false;
        double voxels = 0, least_voxels = 0, exact_voxels = 0, exact_triangles = 0;
    } instances_;           ///< their models
    std::set<int> shared_;  ///< those counted
    bool smooth_ = false, occupied_ = false, words_ = false, colors_ = false;
    bool exact_ = false, transparent_ = false;  ///< some object, or instance
};

}  // namespace

double pixel_bytes(const ImageChannels& channels) {
    return 4.0 * (4 + int(channels.depth) + 3 * int(channels.position) + 3 * int(channels.normal));
}

double image_bytes(const RenderSettings& render) {
    const double pixels = double(render.size.x) * double(render.size.y);
    return (pixel_bytes(render.channels) + (render.channels.object ? 4 : 0)) * pixels;
}

double ScenePlan::peak_bytes() const {
    return std::max({voxelize_bytes, place_bytes, index_bytes, image_bytes});
}

GridPlan plan_model(const Model& model, const Mesh& mesh) {
    const MeshSummary summary = summary_of(mesh);
    return plan_grid(model, &summary, summary.area);
}

ScenePlan plan_scene(const Scene& scene, MeshStore& meshes) {
    return Planner(scene, meshes).run();
}

}  // namespace voxelume
