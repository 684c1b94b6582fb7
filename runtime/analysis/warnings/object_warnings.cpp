// SPDX-License-Identifier: Apache-2.0
#include "runtime/analysis/warnings/object_warnings.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <glm/vector_relational.hpp>

#include "runtime/analysis/dense_meshes.hpp"
#include "runtime/analysis/warnings/thin_warnings.hpp"
#include "runtime/analysis/warnings/warned_object.hpp"
#include "runtime/base/text.hpp"
#include "runtime/geometry/solid/solid_parts.hpp"
#include "runtime/scene/predicates.hpp"

namespace voxelume {
namespace {

/// The ratio by which voxels of a model and the world may differ.
constexpr double kMaxRatio = 4;

/// The ratios of a mesh's size to its world's size at which the mesh is probably too large or too
/// small by mistake. Instances may show things that are small.
constexpr double kTooLarge = 100, kTooSmall = 1.0 / 500, kTooSmallInstance = 1.0 / 1000;

std::string point_text(const glm::dvec3& p) {
    return fmt::format("({:.4g}, {:.4g}, {:.4g})", p.x + 0.0, p.y + 0.0, p.z + 0.0);
}

/// Advice on making a mesh that is too large fit the world.
std::string unit_advice(const Model& model, double times_world) {
    struct Unit {
        double metres;
        const char *name, *key;
    };
    constexpr std::array<Unit, 3> kUnits = {
        {{0.001, "millimetres", "mm"}, {0.01, "centimetres", "cm"}, {0.0254, "inches", "in"}}};
    for (const Unit& unit : kUnits)
        if (model.object_from_file.is_identity() && times_world * unit.metres > 0.02 &&
            times_world * unit.metres < 2)
            return fmt::format(
                "coordinates are metres; if the file is in {}, give its model \"unit\": \"{}\"",
                unit.name, unit.key);
    return "coordinates are metres; change its model's \"unit\", or the object's \"scale\"";
}

/// Advice on making a mesh that is too small fit the world.
std::string small_unit_advice(const Model& model) {
    const FileMap& map = model.object_from_file;
    if (map.scale < 1)
        return fmt::format(
            "its model's \"unit\" takes the file's coordinate 1 for {} m; if it is "
            "1 m, leave \"unit\" out",
            map.scale);
    return "coordinates are metres; if the scene is in millimetres, give the object a \"scale\" "
           "1000 times as large";
}

/// Warns of a mesh whose size doesn't suit the world. Files have no unit, so a wrong unit is the
/// most frequent mistake.
bool add_unit_warning(const Scene& scene, const Object& object, const PlacedModel& placed,
                      std::vector<Warning>& warnings) {
    if (placed.model.mesh.empty()) return false;
    const double side = largest(placed.world.max - placed.world.min),
                 world = largest(glm::dvec3(scene.world.voxels) * scene.world.voxel_size),
                 times = side / world;
    const double too_small = placed.is_instance ? kTooSmallInstance : kTooSmall;
    const bool is_tiny =
        times <= too_small && side < 2 * largest(scene.world.voxel_size) && side > 0;
    if (times < kTooLarge && !is_tiny) return false;
    const std::string advice =
        placed.model.fit > 0
            ? fmt::format("its model's \"fit\" is {:.3g} m, times the object's scale",
                          placed.model.fit)
        : is_tiny ? small_unit_advice(placed.model)
                  : unit_advice(placed.model, times);
    return add_once(
        {WarningKind::unlikely_unit, object.where,
         fmt::format("{} is {:.3g} m large in a world of {:.3g} m, so its {} is probably wrong: {}",
                     title_of(object), side, world, placed.model.fit > 0 ? "size" : "unit",
                     advice)},
        warnings);
}

/// Says that a combination of solids has no points, as an intersection of parts that don't meet.
bool add_void_warning(const Object& object, const PlacedModel& placed,
                      std::vector<Warning>& warnings) {
    if (!placed.is_void) return false;
    return add_once({WarningKind::no_voxels, object.where,
                     fmt::format("{} is empty, so nothing shows it: the parts of its solid don't "
                                 "meet where they should; move them, or make them larger",
                                 title_of(object))},
                    warnings);
}

bool add_outside_warning(const Scene& scene, const Object& object, const PlacedModel& placed,
                         std::vector<Warning>& warnings) {
    const Bounds world = lattice_bounds(scene.world);
    const bool is_apart = placed.is_empty || glm::any(glm::lessThan(placed.world.max, world.min)) ||
                          glm::any(glm::greaterThan(placed.world.min, world.max));
    if (!is_apart) return false;
    const std::string place = placed.is_empty
                                  ? std::string()
                                  : fmt::format(", from {} to {} m", point_text(placed.world.min),
                                                point_text(placed.world.max));
    return add_once(
        {WarningKind::outside_world, object.where,
         fmt::format("{} lies outside the world{}, so nothing shows it: the world "
                     "reaches from {} to {}; move the object, or enlarge \"bounds\"",
                     title_of(object), place, point_text(world.min), point_text(world.max))},
        warnings);
}

void add_rounding_warning(const Model& model, std::vector<Warning>& warnings) {
    if (!stores_distances(model.surface)) return;
    const size_t rounded = model.solid          ? count_undivided(*model.solid)
                           : model.cuts.empty() ? 0
                                                : count_undivided(model.cuts);
    if (rounded == 0) return;
    add_once({WarningKind::rounded_edges, model.where,
              fmt::format("edges within {} of its combinations of solids are rounded on "
                          "\"smooth\", for they are nested too deeply: give \"surface\": "
                          "\"exact\", or combine fewer solids",
                          rounded)},
             warnings);
}

/// Advice on how an object shows all of its cubes. A file's voxels are as large as the file says.
std::string finer_advice(const Model& model, double voxel_size) {
    const std::string placement = "the object \"placement\": \"instance\"";
    if (!model.voxels.empty())
        return placement + ", or make it larger by its \"scale\" or the model's \"fit\"";
    return fmt::format("the model a \"voxel_size\" of {:.3g}, or {}", voxel_size, placement);
}

/// Warns of voxels far finer or coarser than the world's. `smooth` objects in the world have voxels
/// of the world's size, unless the scene asks for coarser ones.
void add_ratio_warning(const Scene& scene, const Object& object, const PlacedModel& placed,
                       std::vector<Warning>& warnings) {
    const Model& model = placed.model;
    if (lists_primitives(model.surface)) return;
    const glm::dvec3& world = scene.world.voxel_size;
    const std::string sizes =
        fmt::format("voxels of {} are {:.3g} m where it stands, and the world's are {:.3g} m",
                    title_of(object), smallest(placed.voxel), smallest(world));
    const double slack = 1 + kSizeRounding;
    if (!placed.is_instance && shows_voxels(model.surface) &&
        smallest(world) > kMaxRatio * slack * largest(placed.voxel))
        add_once({WarningKind::finer_than_world, object.where,
                  fmt::format("{}, which can't show as much: give {}", sizes,
                              finer_advice(model, smallest(world) / largest(placed.scale)))},
                 warnings);
    // Large cubes are a style.
    const bool is_coarse = smallest(placed.voxel) > kMaxRatio * slack * largest(world);
    if (is_coarse && model.is_sized && stores_distances(model.surface) && model.voxels.empty())
        add_once({WarningKind::coarser_than_world, object.where,
                  fmt::format("{}, which can show more: give the model a \"voxel_size\" of {:.3g}",
                              sizes, smallest(world) / largest(placed.scale))},
                 warnings);
}

/// Advice on how a ray tests fewer triangles. Instances of glass are slow in lattices.
std::string density_advice(const Scene& scene, const Object& object, const Model& model,
                           double triangles) {
    std::string finer = fmt::format("the world a \"voxel_size\" of {:.3g}",
                                    largest(scene.world.voxel_size) / std::sqrt(triangles / 2));
    if (scene.observer.display.layout == VolumeLayout::lattice && transmits(scene, object))
        return finer;
    return fmt::format("the object \"placement\": \"instance\"{}, or {}",
                       model.is_sized ? ", without a size of its model's voxels" : "", finer);
}

/// Warns of an exact mesh with many triangles per voxel that `auto` doesn't make an instance.
void add_density_warning(const Scene& scene, const Object& object, const PlacedModel& placed,
                         AssetStore& meshes, std::vector<Warning>& warnings) {
    if (placed.is_instance) return;
    const double triangles = triangles_per_voxel(scene, object, meshes);
    if (triangles <= kTooDenseTriangles) return;
    add_once({WarningKind::finer_than_world, placed.model.where,
              fmt::format("{} has {:.0f} triangles in each of the world's voxels that it passes, "
                          "and a ray there tests all of them: give {}",
                          title_of(object), triangles,
                          density_advice(scene, object, placed.model, triangles))},
             warnings);
}

}  // namespace

void add_object_warnings(const Scene& scene, const Object& object, AssetStore& meshes,
                         std::vector<Warning>& warnings) {
    if (!object.visible) return;
    const PlacedModel model = placed(scene, object, meshes);
    if (add_unit_warning(scene, object, model, warnings)) return;
    if (add_void_warning(object, model, warnings)) return;
    if (add_outside_warning(scene, object, model, warnings)) return;
    add_thin_warning(scene, object, model, meshes, warnings);
    add_thin_part_warning(scene, model, meshes, warnings);
    add_rounding_warning(model.model, warnings);
    add_ratio_warning(scene, object, model, warnings);
    add_density_warning(scene, object, model, meshes, warnings);
}

}  // namespace voxelume
