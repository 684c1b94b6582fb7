// SPDX-License-Identifier: Apache-2.0
// The objects O_i: models with their lattices, and where they stand.
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

/// A mesh on its way to another shape.
struct Morph {
    std::filesystem::path mesh;  ///< of the shape at its end; empty: the sphere below
    glm::dvec3 center{0};        ///< metres in object space
    double radius = 1;           ///< metres, > 0
    double amount = 0;           ///< share of the way, 0..1
    /// Instead, the weight of each target of a glTF file's mesh; empty where the values above
    /// count.
    std::vector<double> weights{};
    int skin = 0;        ///< number of a skin of that file, from 1 on, which then moves it; 0: none
    std::string clip{};  ///< of that file, which moves the skin's joints; empty: they stand still
    double time = 0;     ///< seconds of the clip, >= 0
    bool operator==(const Morph&) const = default;

    /// True if what moves the mesh is in its own file.
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
    std::filesystem::path voxels;  ///< such a file of voxels that are there already; may be empty
    std::shared_ptr<const VoxelModel>
        given;     ///< voxels in memory; then `voxels` is their name and there is no such file
    int part = 0;  ///< number of the model in a file of several, from 1 on; 0: all of the file
    VoxelValues values;          ///< of a file of values: which of them are voxels
    double fit = 0;              ///< metres that the file's longest side becomes; 0: as in the file
    FileMap object_from_file;    ///< of both files, and of the mesh that a morph ends as
    std::optional<Morph> morph;  ///< of a mesh
    std::vector<Solid> cuts;     ///< of a mesh that isn't exact: what is taken away from it
    std::optional<Solid> solid;  ///< has a value exactly when both files are empty
    glm::dvec3 voxel_size{0};    ///< metres in object space, > 0; 0 when `resolution` decides
    int resolution = 0;  ///< voxels along the longest side, 1..65536; 0 when `voxel_size` decides
    bool is_sized = false;  ///< the scene says one of these two, and may want coarser voxels than
                            ///< the world's
    Surface surface = Surface::smooth;
    bool is_surface_open = false;  ///< the scene leaves the surface to its files; until they are
                                   ///< read, `surface` is that of most files of the kind
    std::string surface_reason;    ///< why make_choices() chose it, as half a sentence
    double thin_edge = 0;          ///< of a smooth mesh: its parts that are too thin for voxels of
                                   ///< this size, metres in object space, are exact; 0: none are
    bool is_thin_part = false;     ///< it is the exact model of these parts alone
    VoxelSet set = VoxelSet::supercover;       ///< for `cubes`
    Shading shading;                           ///< of an exact mesh, or of cubes with its normals
    CubeNormals normals = CubeNormals::faces;  ///< of `cubes`
    /// Box in object space outside of which no object shows the model: the world's bounds as seen
    /// from all objects that use it. An infinite solid ends there. Empty (min = max) for a model
    /// not used.
    Bounds extent;
    SourcePlace where;

    friend bool operator==(const Model&, const Model&) = default;
};

/// The model of the parts of a smooth mesh that are exact, which its objects show besides; none if
/// there are no such parts.
std::optional<Model> thin_part_of(const Model& model);

/// The material of one group of faces of an object's mesh.
struct GroupMaterial {
    std::string group;  ///< as named in the mesh file
    int material = 0;
    SourcePlace where;

    friend bool operator==(const GroupMaterial&, const GroupMaterial&) = default;
};

/// How an object gets into the picture.
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
    std::optional<int> light_samples;  ///< that its emission lights the world by; none: by its size
    glm::dmat4 world_from_object{
        1};               ///< affine and safely invertible; mirrors and shears are allowed
    bool moves = false;   ///< some track changes where it stands
    bool visible = true;  ///< otherwise the world is as if it weren't there
    bool potentially_visible =
        true;  ///< not in scene files: whether some ray may meet it, see culling.hpp
    SourcePlace where;

    friend bool operator==(const Object&, const Object&) = default;
};

/// The values of models and objects that tracks may change, but those of solids and placements.
std::span<const ValueRow<Model>> model_rows();
std::span<const ValueRow<Morph>> morph_rows();
std::span<const ValueRow<Object>> object_rows();

}  // namespace voxelume
