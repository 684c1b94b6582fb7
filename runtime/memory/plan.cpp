#include "runtime/memory/plan.hpp"

#include <algorithm>
#include <cmath>
#include <glm/common.hpp>
#include <glm/matrix.hpp>
#include <set>

#include "runtime/analysis/scene_features.hpp"
#include "runtime/base/error.hpp"
#include "runtime/grid/world_frame.hpp"
#include "runtime/memory/plan_object.hpp"
#include "runtime/memory/plan_stages.hpp"
#include "runtime/render/illumination.hpp"
#include "runtime/scene/predicates.hpp"
#include "runtime/stages/trace/sight.hpp"
#include "runtime/stages/voxelize/mesh_lattice.hpp"

namespace voxelume {
namespace {

constexpr double kPlacedBand = 5;  // voxels around cubes: placing looks at whole leaves of them

class Planner {
  public:
    Planner(const Scene& scene, AssetStore& meshes)
        : scene_(scene), meshes_(meshes), extents_(scene, meshes) {
        contents_.frame = plan_.world = world_frame(scene.world);
    }

    ScenePlan run() {
        for (size_t number = 0; number < scene_.objects.size(); ++number) {
            const Object& object = scene_.objects[number];
            if (!may_be_shown(scene_, object)) continue;
            // Refuses names of groups that aren't there, before any frame is rendered.
            materials_of_groups(object, meshes_.groups_of(scene_.models[size_t(object.model)]));
            if (!object.potentially_visible) continue;
            if (is_instanced(scene_, object))
                add_instance(object);
            else
                add_object(int(number));
        }
        add_stages();
        return plan_;
    }

  private:
    void add_minimum(int number, const WorldExtent& extent) {
        const VoxelBox& box = extents_.boxes()[size_t(number)];
        if (overlap(box, box)) minimum_.push_back({box, extent});
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
        const SurfaceExtent in_world = extents_.planned(object, band);
        const SurfaceExtent minimum = extents_.minimum(object, band);
        plan_.voxels += in_world.voxels;
        plan_.bricks += in_world.bricks;
        add_minimum(number, {minimum.voxels, minimum.bricks, is_exact ? minimum.voxels : 0});
        if (shows_inside(scene_, object)) {
            const double inside = extents_.inside_voxels(object);
            plan_.voxels += inside;
            plan_.bricks += inside / (kBrickSize * kBrickSize * kBrickSize);
        }
        contents_.smooth |= model.surface == Surface::smooth;
        exact_ |= is_exact;
        contents_.occupied |= model.surface != Surface::smooth;
        contents_.colors |= extras.colors;
        contents_.attributes |= objects_++ > 0 || extras.attributes;
        if (is_exact) {
            if (mesh) check_reach(object);
            exact_voxels_ += in_world.voxels;
            contents_.lists |= in_world.voxels > 0;
            if (mesh) contents_.exact_triangles += double(mesh->triangles);
            GridPlan grid = plan_grid(model, mesh, plan_.world, extents_.planned(object, 0));
            set_minimum(grid, plan_grid(model, mesh, plan_.world, extents_.minimum(object, 0)));
            plan_.grids.push_back(grid);
            plan_.grids.back().object = number;
        } else if (made_.insert(object.model).second) {
            plan_.grids.push_back(plan_grid(model, mesh, extents_.area_of(object.model)));
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
        contents_.instances.any = true;
        contents_.instances.smooth |= is_smooth;
        if (!shared_.insert(object.model).second) return;
        GridPlan grid;
        if (!model.voxels.empty() && model.surface != Surface::exact) {
            const VoxelModel& voxels = meshes_.voxels(model);
            grid = plan_grid(voxels);
            contents_.instances.colors |= !voxels.colors.empty();
        } else {
            const MeshSummary* mesh = meshes_.summary_of(model);
            grid = plan_grid(model, mesh, extents_.area_of(object.model));
            contents_.instances.colors |= extras_of(model, mesh).colors;
            if (model.surface == Surface::exact) {
                exact_ = true;
                contents_.instances.exact_voxels += grid.minimum.voxels;
                contents_.instances.exact_triangles += double(grid.triangles);
            }
        }
        contents_.instances.voxels += grid.voxels;
        contents_.instances.min_voxels += grid.minimum.voxels;
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
        const double finer = std::max(1.0, own), minimum = std::min(1.0, own);
        const double count = double(voxels.voxels());
        const auto stored = double(voxels.coordinates.size());
        const bool smooth = voxels.surface == Surface::smooth;
        plan_.voxels += count * finer;
        plan_.bricks += 2 * stored * finer;
        const GridFrame& frame = voxels.frame;
        if (extents_.lies_in_world(frame.origin,
                                   frame.origin + frame.voxel_edge * glm::dvec3(frame.size),
                                   object.world_from_object))
            add_minimum(number, {count * minimum, stored * minimum, 0});
        contents_.smooth |= smooth;
        contents_.occupied |= !smooth;
        contents_.colors |= !voxels.colors.empty();
        transparent_ |= voxels.transparent;
        contents_.attributes |= objects_++ > 0 || !voxels.attributes.empty();
        if (!made_.insert(object.model).second) return;
        GridPlan grid = plan_grid(voxels);
        grid.model = object.model;
        plan_.grids.push_back(grid);
    }

    void add_stages() {
        double kept = 0, min_kept = 0;
        for (const GridPlan& grid : plan_.grids) {
            plan_.voxelize_bytes = std::max(plan_.voxelize_bytes, kept + grid.made_bytes);
            plan_.min_bytes = std::max(plan_.min_bytes, min_kept + grid.minimum.made_bytes);
            kept += grid.kept_bytes;
            min_kept += grid.minimum.kept_bytes;
        }
        const double table = brick_table(plan_.world);
        plan_.bricks = std::min(plan_.bricks, table);
        plan_.medium = plan_density(scene_.world);
        const Features made_for = features();
        plan_.rays = ray_bytes(scene_, made_for);
        const double shown = plan_.medium.bytes + image_bytes(scene_.render);
        const StageBytes all = stage_bytes(contents_, {plan_.voxels, plan_.bricks, exact_voxels_},
                                           contents_.instances.voxels, kept);
        plan_.place_bytes = all.place;
        plan_.index_bytes = all.index;
        plan_.image_bytes = all.world + all.dilated_occupancy + shown + plan_.rays.maximum();
        if (lights_send_beams(made_for) && !made_for.instances)
            plan_.image_bytes += light_beam_bytes();
        plan_.world_bytes = all.world;
        plan_.dilated_occupancy_bytes = all.dilated_occupancy;
        const WorldExtent minimum = min_extent(std::move(minimum_));
        const StageBytes fewest =
            stage_bytes(contents_, minimum, contents_.instances.min_voxels, min_kept);
        plan_.min_image_bytes =
            fewest.world + fewest.dilated_occupancy + shown + plan_.rays.minimum();
        plan_.min_bytes =
            std::max({plan_.min_bytes, fewest.place, fewest.index, plan_.min_image_bytes});
        plan_.min_with_next = fewest.place + fewest.index + plan_.min_image_bytes;
        plan_.largest = largest_buffer(contents_, minimum);
        plan_.host_bytes =
            kWorldTable * table + 2 * image_bytes(scene_.render) + plan_.medium.host_bytes;
        for (const GridPlan& grid : plan_.grids)
            plan_.host_bytes += double(grid.triangles) * 36 + kTableBytes * brick_table(grid.frame);
    }

    /// What the beams of lights take at most.
    double light_beam_bytes() const {
        const Camera camera = camera_of(scene_, plan_.world);
        const uint64_t rays =
            16ull * tile_count(camera.width, camera.height) * uint64_t(camera.samples);
        return sizeof(float) * Illumination::kLightsOfMaxBeams *
               double(light_beams_that_pay(plan_.world, rays, camera.samples,
                                           voxels_a_pixel(scene_, camera, plan_.world)));
    }

    /// What the image's kernels are made for, as far as it decides what rays take.
    Features features() {
        Features features;
        features.smooth = contents_.smooth || contents_.instances.smooth;
        features.solids = exact_;
        features.attributes = contents_.has_attributes();
        features.colors = contents_.colors || contents_.instances.colors;
        features.voxel_opacity = transparent_;
        features.instances = contents_.instances.any;
        Pyramid world;
        world.frame = plan_.world;
        world.object_boxes = extents_.boxes();
        world.clear = plan_.medium.is_zero;
        add_scene(scene_, world, features);
        return features;
    }

    const Scene& scene_;
    AssetStore& meshes_;
    ScenePlan plan_;
    ObjectExtents extents_;
    WorldContents contents_;
    std::set<int> made_;
    int objects_ = 0;
    double exact_voxels_ = 0;
    std::vector<ObjectExtent> minimum_;         ///< of what is seen of objects in the world
    std::set<int> shared_;                      ///< those counted
    bool exact_ = false, transparent_ = false;  ///< some object, or instance
};

}  // namespace

double pixel_bytes(const ImageChannels& channels) {
    return 4.0 * (4 * int(channels.color) + int(channels.depth) + 3 * int(channels.position) +
                  3 * int(channels.normal));
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

ScenePlan plan_scene(const Scene& scene, AssetStore& meshes) {
    return Planner(scene, meshes).run();
}

}  // namespace voxelume
