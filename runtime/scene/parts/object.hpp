// SPDX-License-Identifier: Apache-2.0
// The objects O_i: models with their lattices, and their placements.
#pragma once

#include <cstdint>
#include <filesystem>
#include <glm/mat4x4.hpp>
#include <glm/vec3.hpp>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "runtime/base/source_place.hpp"
#include "runtime/scene/parts/bounds.hpp"
#include "runtime/scene/parts/shading.hpp"
#include "runtime/scene/parts/solid.hpp"
#include "runtime/scene/parts/surface.hpp"
#include "runtime/scene/parts/value_row.hpp"
#include "runtime/scene/parts/voxel_values.hpp"

namespace voxelume {

struct VoxelModel;

/// A mesh that changes to another shape.
struct Morph {
    std::filesystem::path mesh;  ///< mesh of the final shape; empty: the sphere below
    glm::dvec3 center{0};        ///< metres in object space
    double radius = 1;           ///< metres, > 0
    double amount = 0;           ///< part of the change, 0..1
    /// Replaces the values above: the weight of each target of a glTF file's mesh; empty if the
    /// values above count.
    std::vector<double> weights{};
    int skin = 0;        ///< number of the file's skin that moves the mesh, from 1 on; 0: none
    std::string clip{};  ///< clip that moves the skin's joints; empty: they stand still
    double time = 0;     ///< seconds of the clip, >= 0
    bool operator==(const Morph&) const = default;

    /// True if the morph is defined in the mesh's own file.
    bool is_of_file() const { return !weights.empty() || skin > 0; }
};

/// The map from the coordinates of a model's files to object space.
struct FileMap {
    double scale = 1;     ///< metres per unit of the file, > 0
    glm::dvec3 shift{0};  ///< metres; added after scaling
    bool operator==(const FileMap&) const = default;

    bool is_identity() const { return *this == FileMap(); }
    glm::dvec3 operator()(const glm::dvec3& p) const { return scale * p + shift; }
    Bounds operator()(const Bounds& box) const { return {(*this)(box.min), (*this)(box.max)}; }
};

/// O_i before it is placed: a mesh file or a solid, with the lattice that it is voxelized on.
struct Model {
    std::string name;
    std::filesystem::path mesh;    ///< a regular file inside the asset folders; may be empty
    std::filesystem::path voxels;  ///< such a file that holds voxels; may be empty
    std::shared_ptr<const VoxelModel>
        given;                   ///< voxels in memory; `voxels` is then their name, not a file
    int part = 0;                ///< number of the model in the file, from 1 on; 0: all of the file
    VoxelValues values;          ///< for a file of values: those that are voxels
    double fit = 0;              ///< metres of the file's longest side; 0: as in the file
    FileMap object_from_file;    ///< for both files, and for the final mesh of a morph
    std::optional<Morph> morph;  ///< morph of a mesh
    std::vector<Solid> cuts;     ///< solids that are removed from a mesh that isn't exact
    std::optional<Solid> solid;  ///< has a value exactly when both files are empty
    glm::dvec3 voxel_size{0};    ///< metres in object space, > 0; 0 when `resolution` decides
    int resolution = 0;  ///< voxels along the longest side, 1..65536; 0 when `voxel_size` decides
    bool is_sized = false;  ///< the scene says one of these two, and may want coarser voxels than
                            ///< the world's
    Surface surface = Surface::smooth;
    bool is_surface_open = false;  ///< the scene leaves the surface to its files; until they are
                                   ///< read, `surface` is the usual one for the kind of file
    std::string surface_reason;    ///< why make_choices() chose the surface, as half a sentence
    double thin_edge = 0;  ///< for a smooth mesh: parts that are too thin for voxels of this size,
                           ///< metres in object space, are exact; 0: no parts
    bool is_thin_part = false;            ///< the exact model of these thin parts alone
    VoxelSet set = VoxelSet::supercover;  ///< for `cubes`
    Shading shading;  ///< normals of an exact mesh, or of cubes with its normals
    CubeNormals normals = CubeNormals::faces;  ///< normals of `cubes`
    /// Box in object space outside of which no object shows the model: the world's bounds as seen
    /// from all objects that use it. An infinite solid ends there. Empty (min = max) for an unused
    /// model.
    Bounds extent;
    SourcePlace where;

    friend bool operator==(const Model&, const Model&) = default;
};

/// The model of the exact parts of a smooth mesh, which its objects show in addition; empty if
/// there are none.
std::optional<Model> thin_part_of(const Model& model);

/// The material of one group of faces of an object's mesh.
struct GroupMaterial {
    std::string group;  ///< name in the mesh file
    int material = 0;
    SourcePlace where;

    friend bool operator==(const GroupMaterial&, const GroupMaterial&) = default;
};

/// The way in which an object gets into the picture.
enum class Placement : uint8_t {
    automatic,  ///< `world` for what stands still, `instance` for what moves
    world,      ///< resampled into the world's voxels
    instance    ///< rays are transformed into the object's own voxels
};

struct Object {
    std::string name;
    int model = 0;     ///< index into Scene::models
    int material = 0;  ///< index into Scene::materials, for all faces that `groups` does not name
    std::vector<GroupMaterial> groups;
    int priority = 0;  ///< where objects overlap: the higher wins, then the earlier in the list
    Placement placement = Placement::automatic;
    std::optional<int> light_samples;  ///< number for its emission; none: by its size
    glm::dmat4 world_from_object{
        1};               ///< affine and safely invertible; mirrors and shears are allowed
    bool moves = false;   ///< some track changes the placement
    bool visible = true;  ///< otherwise the object is ignored
    bool potentially_visible =
        true;  ///< not in scene files: whether some ray may meet it, see culling.hpp
    SourcePlace where;

    friend bool operator==(const Object&, const Object&) = default;
};

/// The values of models and objects that tracks may change, except those of solids and placements.
std::span<const ValueRow<Model>> model_rows();
std::span<const ValueRow<Morph>> morph_rows();
std::span<const ValueRow<Object>> object_rows();

}  // namespace voxelume
