// SPDX-License-Identifier: Apache-2.0
// The bodies of a scene as plain structs: solids and meshes, and the objects that place them.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <utility>
#include <variant>
#include <vector>

#include "values.hpp"
#include "world.hpp"

namespace voxelume::v1 {

// Solids lie around the origin; their axis is Y; all measures are metres above 0.
/// A ball around the origin.
struct Sphere {
    double radius = 0;  ///< metres
};
/// An ellipsoid around the origin.
struct Ellipsoid {
    Vec3 radii{};  ///< half axes, metres
};
/// A box around the origin.
struct Box {
    Vec3 size{};  ///< whole edges
};
/// A cylinder around the origin, along Y.
struct Cylinder {
    double radius = 0;  ///< metres
    double height = 0;  ///< metres
};
/// A cone around the origin, along Y, upright.
struct Cone {
    double radius = 0;      ///< metres, at y = -height / 2
    double height = 0;      ///< metres
    double top_radius = 0;  ///< metres, at y = height / 2; 0: a point
};
/// A ring around the origin, in the plane of X and Z.
struct Torus {
    double radius = 0;  ///< metres: radius of the ring
    double tube = 0;    ///< radius of the tube, at most `radius`
};
/// A cylinder with round caps around the origin, along Y.
struct Capsule {
    double radius = 0;  ///< metres
    double height = 0;  ///< metres of the part between the round caps
};
/// A slab has no end in x and z: it ends where the world does.
struct Slab {
    double thickness = 0;  ///< metres, along Y
};

struct Part;

/// The operation that combines parts.
enum class Operation {
    union_of,      ///< all points in any part
    intersection,  ///< the points in all parts
    difference     ///< the points of the first part that are in no other part
};

/// Solids combined, up to 16 levels deep and with up to 256 shapes in a model. Parts of one body
/// must overlap a little.
struct Combination {
    Operation operation = Operation::union_of;  ///< the operation on the parts
    std::vector<Part> parts;  ///< solids; a difference takes all others from the first
};

/// A shape, or a combination of shapes.
using Solid =
    std::variant<Sphere, Ellipsoid, Box, Cylinder, Cone, Torus, Capsule, Slab, Combination>;

/// A solid with its placement in its parent.
struct Part {
    Solid solid{};        ///< the solid that is placed
    Vec3 position{};      ///< metres, in its parent
    Vec3 turn{};          ///< degrees [psi, theta, gamma]: R_y(psi) * R_x(theta) * R_z(gamma)
    Vec3 scale{1, 1, 1};  ///< negative ones mirror
    std::optional<Matrix> matrix{};  ///< instead of position, turn and scale
};

/// A change of a mesh's vertices to another shape, in straight lines.
struct Morph {
    double amount = 0;             ///< part of the way, 0..1
    std::filesystem::path mesh{};  ///< the mesh at the end: as many vertices, the same triangles
    /// Instead of a mesh, a sphere: each vertex moves there straight away from the centre.
    std::optional<Vec3> center{};
    std::optional<double> radius{};  ///< metres
    /// Instead of all these: the weight of each target of a glTF file's mesh.
    std::vector<double> weights{};
    /// With weights or alone: number of a skin of that file, from 1 on, whose joints move the mesh.
    std::optional<int> skin{};
    /// Name of a clip of that file, which moves the joints; empty: they stand still.
    std::string clip{};
    std::optional<double> time{};  ///< seconds of the clip
};

/// The normals by which light falls on an exact mesh, or on cubes with those of their mesh.
enum class Shading {
    automatic,  ///< the normals of the file's vertices, where it has some; else flat
    flat,       ///< each triangle's own
    smooth  ///< as automatic, but a mesh without normals gets those of the faces around a vertex
};

/// The length of a file's coordinate 1.
enum class Unit {
    micrometre,
    millimetre,
    centimetre,
    decimetre,
    metre,
    kilometre,
    inch,
    foot,
    yard
};

/// Triangles of an OBJ, PLY, STL or glTF file. Files are looked for in SceneOptions::assets.
struct MeshFile {
    std::filesystem::path file{};        ///< .obj, .ply, .stl, .gltf or .glb
    std::optional<Sequence> sequence{};  ///< makes it a file for each frame
    std::optional<Morph> morph{};        ///< moves its vertices
    std::vector<Part> cuts{};            ///< solids removed from the mesh; not for exact ones
    /// Metres that the longest side of the mesh becomes, with the middle of its box at the origin.
    std::optional<double> fit{};
    std::optional<Unit> unit{};        ///< unit of the file, instead of `fit`; without both metres
    std::optional<Shading> shading{};  ///< normals of an exact mesh, or of cubes with its
                                       ///< normals; without it automatic
    std::optional<double> crease_angle{};  ///< degrees, for Shading::smooth; without it 30
    std::optional<int> part{};  ///< number of a mesh in a glTF file, from 1 on; without it all
};

/// Voxels that are there already: a .vxm of `voxelize`, an OpenVDB or a MagicaVoxel file, an array
/// of values or colours, or a file of another voxel editor or game.
struct VoxelFile {
    std::filesystem::path file{};        ///< .vxm, .vdb, .vox, .npy, .nrrd, .nii, .hdr and others
    std::optional<int> part{};           ///< number of the model in a .vox, from 1; without it all
    std::optional<Sequence> sequence{};  ///< makes it a file for each frame
    std::optional<double> fit{};         ///< metres of the longest side
    std::optional<Unit> unit{};          ///< unit of the file, instead of `fit`
    /// Cells of an array with this value or more are voxels; a smooth surface runs at the value.
    std::optional<double> iso{};
    std::optional<int> label{};  ///< instead: cells with this value are voxels
    bool each_label = false;     ///< instead: cells with any value but 0, a colour for each
};

/// Voxels in memory, which a model shows as cubes: `VoxelFile{"NAME"}`, or "voxels": "NAME" in the
/// text of a scene. Voxel (i, j, k) fills [(i, j, k), (i, j, k) + 1] metres in object space unless
/// `fit` or `unit` says otherwise.
struct VoxelArray {
    std::string name{};  ///< name that models use for it; takes precedence over files of that name
    std::array<int, 3> size{};      ///< voxels along x, y and z
    const uint8_t* rgba = nullptr;  ///< voxel (0, 0, 0): R, G, B and the opacity, a byte each.
                                    ///< Colours are sRGB; opacity 0: no voxel. Not kept.
    /// Bytes from a voxel to the next along x, y and z, perhaps negative; without a value x is
    /// fastest, then y, without gaps.
    std::optional<std::array<std::ptrdiff_t, 3>> strides{};
};

/// The representation of the surface inside a voxel.
enum class Surface {
    cubes,   ///< the voxel is the object
    smooth,  ///< a distance field runs through the voxels; for closed meshes and solids
    exact    ///< voxels list their triangles or solid; also for open sheets and sharp edges
};

/// The set of voxels of a surface of `cubes`.
enum class VoxelSet {
    supercover,  ///< all voxels that the surface touches
    thin,        ///< the minimum that no path through faces can pass
    solid        ///< all voxels whose centre is inside
};

/// The normals by which light falls on `cubes`.
enum class CubeNormals {
    faces,   ///< normals of their own faces
    surface  ///< normals of the mesh or solid that they stand for
};

/// An object before it is placed, and the lattice that it is voxelized on.
struct Model {
    std::string name{};                                 ///< name by which objects refer to it
    std::variant<Solid, MeshFile, VoxelFile> source{};  ///< a mesh, voxels or a solid
    std::optional<Vec3> voxel_size{};  ///< metres in object space; without it the world's
    std::optional<int> resolution{};   ///< instead: voxels along the longest side, 1..65536
    /// Surface of the voxels; without it one that suits the model, which plan() tells.
    std::optional<Surface> surface{};
    std::optional<VoxelSet> set{};         ///< voxel set of cubes; without it supercover
    std::optional<CubeNormals> normals{};  ///< normals of cubes; without it faces
};

/// The way in which an object gets into the picture.
enum class Placement {
    automatic,  ///< `world` for objects that stand still, `instance` for moving ones
    world,      ///< resampled into the world's voxels
    instance    ///< rays are transformed into the object's own voxels
};

/// A placement in the world, or in another placement.
struct Parent {
    Vec3 position{};                 ///< metres
    Vec3 turn{};                     ///< degrees [psi, theta, gamma]
    Vec3 scale{1, 1, 1};             ///< negative numbers mirror
    std::optional<Matrix> matrix{};  ///< instead of position, turn and scale
};

/// A model in the world. Scaling comes first, then turning, then shifting.
struct Object {
    std::string name{};      ///< name for messages and tracks; empty: "objects[n]"
    std::string model{};     ///< name of its model
    std::string material{};  ///< name of its material; empty: "default"
    /// Pairs of a group of faces and its material.
    std::vector<std::pair<std::string, std::string>> group_materials{};
    Vec3 position{};                 ///< metres: where the model's origin goes
    Vec3 turn{};                     ///< degrees [psi, theta, gamma]
    Vec3 scale{1, 1, 1};             ///< negative numbers mirror
    std::optional<Matrix> matrix{};  ///< instead of position, turn and scale
    int priority = 0;     ///< where objects overlap: the higher wins, then the earlier in the list
    bool visible = true;  ///< false: the object is ignored, with its shadow and its light
    /// Number of points from which its emission lights the world, 0..16384.
    std::optional<int> light_samples{};
    /// In the world's voxels, as an instance, or an automatic choice.
    Placement placement = Placement::automatic;
    /// Parents of the object: each is placed in the one before it, and the object in the last.
    std::vector<Parent> parents{};
};

}  // namespace voxelume::v1
