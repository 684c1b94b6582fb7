// SPDX-License-Identifier: Apache-2.0
#include "runtime/analysis/object_warnings.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <glm/mat3x3.hpp>
#include <glm/vector_relational.hpp>

#include "runtime/assets/model_frame.hpp"
#include "runtime/base/text.hpp"
#include "runtime/geometry/mesh_shape.hpp"
#include "runtime/geometry/solid/solid_bounds.hpp"
#include "runtime/geometry/solid/solid_inside.hpp"
#include "runtime/geometry/solid/solid_parts.hpp"
#include "runtime/scene/predicates.hpp"

namespace voxelume {
namespace {

/// The ratio by which voxels of a model and the world may differ.
constexpr double kMaxRatio = 4;

/// How far rounding may take sizes that are meant to be equal apart, as a share of them: turned
/// maps and a "resolution" round theirs.
constexpr double kSizeRounding = 1e-9;

/// From where on a mesh is too large for the world it stands in to be meant so, and too small.
constexpr double kTooLarge = 100, kTooSmall = 1.0 / 500;

double largest(const glm::dvec3& v) {
    return std::max({v.x, v.y, v.z});
}
double smallest(const glm::dvec3& v) {
    return std::min({v.x, v.y, v.z});
}

std::string point_text(const glm::dvec3& p) {
    return fmt::format("({:.4g}, {:.4g}, {:.4g})", p.x + 0.0, p.y + 0.0, p.z + 0.0);
}

/// An object as the world shows it. Lengths are metres.
struct PlacedModel {
    const Model& model;
    bool is_instance = false;
    bool is_empty = false;  ///< nothing of its solid is left within the world
    Bounds own{};           ///< box in object space
    Bounds world{};         ///< box in the world
    glm::dvec3 scale{1};    ///< by which lengths along the axes of object space grow
    glm::dvec3 voxel{0};    ///< edges of its voxels, in the world
};

glm::dvec3 scale_of(const glm::dmat4& map) {
    return {glm::length(glm::dvec3(map[0])), glm::length(glm::dvec3(map[1])),
            glm::length(glm::dvec3(map[2]))};
}

Bounds mapped(const Bounds& box, const glm::dmat4& map) {
    Bounds image{glm::dvec3(INFINITY), glm::dvec3(-INFINITY)};
    for (int i = 0; i < 8; ++i) {
        const glm::dvec3 p(map * glm::dvec4(corner(box, i), 1));
        image.min = glm::min(image.min, p);
        image.max = glm::max(image.max, p);
    }
    return image;
}

/// Edges of a model's voxels in object space.
glm::dvec3 own_voxel(const Model& model, const Bounds& own, AssetStore& meshes) {
    if (!model.voxels.empty()) return meshes.voxels(model).frame.voxel_edge;
    if (model.resolution == 0) return model.voxel_size;
    return glm::dvec3(largest(own.max - own.min) / model.resolution);
}

PlacedModel placed(const Scene& scene, const Object& object, AssetStore& meshes) {
    PlacedModel result{scene.models[size_t(object.model)]};
    const Model& model = result.model;
    result.is_instance = is_instanced(scene, object);
    result.scale = scale_of(object.world_from_object);
    if (model.solid) {
        const Bounds lattice = lattice_bounds(scene.world);
        const bool is_endless = is_infinite(*model.solid);
        const SolidBounds clip{lattice.min, lattice.max};
        const SolidBounds box = bounds(*model.solid, object.world_from_object,
                                       is_endless ? std::optional(clip) : std::nullopt);
        result.is_empty = box.is_empty();
        result.world = {box.min, box.max};
        if (!is_endless) {
            const SolidBounds own = bounds(*model.solid, glm::dmat4(1));
            result.own = {own.min, own.max};
        }
    } else if (const MeshSummary* mesh = meshes.summary_of(model)) {
        result.own = mesh->surface;
        result.world = mapped(result.own, object.world_from_object);
    } else {
        const GridFrame& frame = meshes.voxels(model).frame;
        result.own = {frame.origin, frame.origin + frame.voxel_edge * glm::dvec3(frame.size)};
        result.world = mapped(result.own, object.world_from_object);
    }
    result.voxel = own_voxel(model, result.own, meshes) * result.scale;
    return result;
}

/// What makes a mesh that is too large fit the world.
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
            return fmt::format("if the file is in {}, give its model \"unit\": \"{}\"", unit.name,
                               unit.key);
    return "change its model's \"unit\", or the object's \"scale\"";
}

/// Files have no unit, so this is the most frequent mistake.
bool add_unit_warning(const Scene& scene, const Object& object, const PlacedModel& placed,
                      std::vector<Warning>& warnings) {
    if (placed.model.mesh.empty()) return false;
    const double side = largest(placed.world.max - placed.world.min),
                 world = largest(glm::dvec3(scene.world.voxels) * scene.world.voxel_size),
                 times = side / world;
    const bool is_tiny = times <= kTooSmall && !placed.is_instance &&
                         side < 2 * largest(scene.world.voxel_size) && side > 0;
    if (times < kTooLarge && !is_tiny) return false;
    const std::string advice =
        is_tiny ? "if the scene is in millimetres, give the object a \"scale\" 1000 times as large"
                : unit_advice(placed.model, times);
    return add_once(
        {WarningKind::unlikely_unit, object.where,
         fmt::format("{} is {:.3g} m large in a world of {:.3g} m, so its unit is probably wrong: "
                     "coordinates are metres; {}",
                     title_of(object), side, world, advice)},
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

/// Its thinnest width over the edge of the voxels that show it.
struct Thinness {
    double width = INFINITY, voxel = 1;
    void consider(double other_width, double other_voxel) {
        if (other_width / other_voxel < width / voxel) width = other_width, voxel = other_voxel;
    }
};

/// The edge of the voxels that hold an object's distances.
double field_voxel(const Scene& scene, const PlacedModel& placed) {
    const double own = smallest(placed.voxel), world = smallest(scene.world.voxel_size);
    if (placed.is_instance) return own;
    return placed.model.is_sized ? std::max(own, world) : world;
}

Thinness thinness_of(const Scene& scene, const Object& object, const PlacedModel& placed) {
    const Model& model = placed.model;
    const double world_edge = smallest(scene.world.voxel_size);
    const glm::dvec3 sides = (placed.own.max - placed.own.min) * placed.scale;
    Thinness thin;
    if (shows_voxels(model.surface) && model.set != VoxelSet::solid) {
        // A layer of voxels shows a sheet as it should; only what is small all around grows.
        thin.consider(largest(sides), placed.is_instance ? smallest(placed.voxel) : world_edge);
        return thin;
    }
    for (int axis = 0; axis < 3 && !model.solid; ++axis) {
        thin.consider(sides[axis], placed.voxel[axis]);
        if (!placed.is_instance) thin.consider(sides[axis], world_edge);
    }
    if (model.solid) {
        const double width = thickness(*model.solid, glm::dmat3(object.world_from_object));
        thin.consider(width, smallest(placed.voxel));
        if (!placed.is_instance) thin.consider(width, world_edge);
    }
    return thin;
}

void add_thin_warning(const Scene& scene, const Object& object, const PlacedModel& placed,
                      std::vector<Warning>& warnings) {
    const Model& model = placed.model;
    if (lists_primitives(model.surface) || !model.voxels.empty()) return;
    if (model.solid && is_infinite(*model.solid) && shows_voxels(model.surface) &&
        model.set != VoxelSet::solid)
        return;
    const Thinness thin = thinness_of(scene, object, placed);
    if (thin.width >= thin.voxel * (1 - kSizeRounding)) return;
    add_once({WarningKind::thinner_than_voxel, object.where,
              fmt::format("{} is {:.3g} m thin where it is thinnest, and its voxels are {:.3g} m, "
                          "so parts of it get lost or too thick: give its model \"surface\": "
                          "\"exact\", or use voxels below {:.2g} m",
                          title_of(object), thin.width, thin.voxel, thin.width / 2)},
             warnings);
}

/// Says once of a mesh that a `smooth` surface loses parts of it, unless it is wholly too thin.
void add_thin_part_warning(const Scene& scene, const PlacedModel& placed, AssetStore& meshes,
                           std::vector<Warning>& warnings) {
    const Model& model = placed.model;
    if (model.mesh.empty() || !stores_distances(model.surface) || model.thin_edge > 0) return;
    const auto is_known = [&](const Warning& w) {
        return w.kind == WarningKind::thinner_than_voxel && w.where == model.where;
    };
    const MeshSummary& mesh = *meshes.summary_of(model);
    if (is_open(mesh) || std::ranges::any_of(warnings, is_known)) return;
    const double part = meshes.thickness_of(model).part * smallest(placed.scale),
                 voxel = field_voxel(scene, placed);
    const bool has_inside = part > 0;
    if (!has_inside || part >= kThinPartVoxels * voxel) return;
    if (has_sharp_edges(mesh, meshes.shape_of(model))) return;
    add_once({WarningKind::thinner_than_voxel, model.where,
              fmt::format("parts of {} are less than {:.2g} voxels thick and get lost on "
                          "\"smooth\": leave \"surface\" out or give \"exact\", or use voxels "
                          "below {:.2g} m",
                          quote(model.mesh.filename().string()), part / voxel, part)},
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

void add_ratio_warning(const Scene& scene, const Object& object, const PlacedModel& placed,
                       std::vector<Warning>& warnings) {
    const Model& model = placed.model;
    if (placed.is_instance || lists_primitives(model.surface)) return;
    const glm::dvec3& world = scene.world.voxel_size;
    const std::string sizes =
        fmt::format("voxels of {} are {:.3g} m where it stands, and the world's are {:.3g} m",
                    title_of(object), smallest(placed.voxel), smallest(world));
    const double slack = 1 + kSizeRounding;
    if (smallest(world) > kMaxRatio * slack * largest(placed.voxel))
        add_once({WarningKind::finer_than_world, object.where,
                  fmt::format("{}, which can't show as much: give the model a \"voxel_size\" of "
                              "{:.3g}, or the object \"placement\": \"instance\"",
                              sizes, smallest(world) / largest(placed.scale))},
                 warnings);
    // Large cubes are a style.
    const bool is_coarse = smallest(placed.voxel) > kMaxRatio * slack * largest(world);
    if (is_coarse && stores_distances(model.surface) && model.voxels.empty())
        add_once({WarningKind::coarser_than_world, object.where,
                  fmt::format("{}, which can show more: give the model a \"voxel_size\" of {:.3g}",
                              sizes, smallest(world) / largest(placed.scale))},
                 warnings);
}

}  // namespace

std::string title_of(const Object& object) {
    return object.name.empty() || object.name.starts_with("objects[") ? "the object"
                                                                      : quote(object.name);
}

void add_object_warnings(const Scene& scene, const Object& object, AssetStore& meshes,
                         std::vector<Warning>& warnings) {
    if (!object.visible) return;
    const PlacedModel model = placed(scene, object, meshes);
    if (add_unit_warning(scene, object, model, warnings)) return;
    if (add_outside_warning(scene, object, model, warnings)) return;
    add_thin_warning(scene, object, model, warnings);
    add_thin_part_warning(scene, model, meshes, warnings);
    add_rounding_warning(model.model, warnings);
    add_ratio_warning(scene, object, model, warnings);
}

}  // namespace voxelume
