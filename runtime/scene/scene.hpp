// The scene as plain values: names are indices, angles are radians, placements are matrices.
#pragma once

#include <cstdint>
#include <filesystem>
#include <glm/mat3x3.hpp>
#include <glm/mat4x4.hpp>
#include <glm/vec2.hpp>
#include <glm/vec3.hpp>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <variant>
#include <vector>

#include "runtime/scene/solid.hpp"
#include "runtime/scene/surface.hpp"
#include "runtime/scene_file/assets.hpp"

namespace voxelume {

/// An axis-aligned box; `min < max` on every axis unless said otherwise.
struct Bounds {
    glm::dvec3 min{0};
    glm::dvec3 max{0};

    friend bool operator==(const Bounds&, const Bounds&) = default;
};

/// Density 1 up to the height `base`, from there falling by a factor of e every `scale_height`.
struct HeightDensity {
    double base = 0;          ///< metres along Y
    double scale_height = 1;  ///< metres, > 0

    friend bool operator==(const HeightDensity&, const HeightDensity&) = default;
};

/// Density 1 in a ball; over its outer `falloff` metres it falls smoothly to 0.
struct BallDensity {
    glm::dvec3 center{0};  ///< metres
    double radius = 1;     ///< metres, > 0
    double falloff = 0;    ///< metres, 0..radius

    friend bool operator==(const BallDensity&, const BallDensity&) = default;
};

/// A float grid of an OpenVDB file, which has a transform of its own to metres.
struct GridDensity {
    std::filesystem::path file;
    std::string grid;               ///< name in the file
    glm::dmat4 world_from_grid{1};  ///< from the grid's metres; affine and safely invertible
    std::string where;

    friend bool operator==(const GridDensity&, const GridDensity&) = default;
};

/// The medium's density at the world's voxels; without any it is 1 everywhere.
using Density = std::variant<std::monostate, HeightDensity, BallDensity, GridDensity>;

/// What fills the space between the objects.
struct Medium {
    glm::vec3 absorption{0};  ///< per metre at density 1, >= 0
    glm::vec3 color{0};       ///< radiance that an infinitely deep medium shows, >= 0
    Density density;

    friend bool operator==(const Medium&, const Medium&) = default;
};

/// Whether the medium's density differs from voxel to voxel.
inline bool has_density(const Medium& medium) {
    return !std::holds_alternative<std::monostate>(medium.density);
}

/// S: its lattice starts at `bounds.min`; the last voxels may reach past `bounds.max`.
struct World {
    glm::dvec3 voxel_size{0};  ///< metres per axis, > 0
    Bounds bounds;             ///< metres
    glm::ivec3 voxels{0};      ///< per axis: bounds over voxel_size, rounded up
    glm::vec3 background{0};   ///< radiance where a ray leaves the world
    glm::vec3 ambient{0};      ///< light that reaches every surface
    Medium medium;
    std::string where;  ///< "file:line:column: world", to open a message with

    friend bool operator==(const World&, const World&) = default;
};

/// A second colour in every other block of a lattice that stands still in the world.
struct Checker {
    glm::vec3 color{0};    ///< linear Rec. 709, 0..1
    glm::dvec3 size{0};    ///< edges of a block, metres; 0: no change along that axis
    glm::dvec3 origin{0};  ///< a corner of a block of the material's own colour, metres

    friend bool operator==(const Checker&, const Checker&) = default;
};

struct Material {
    std::string name;
    glm::vec3 color{0.8f};    ///< linear Rec. 709, 0..1
    float diffuse = 1;        ///< 0..1
    float specular = 0;       ///< 0..1
    float shininess = 50;     ///< Blinn-Phong exponent, 1..1e6
    float reflection = 0;     ///< R_i, 0..1
    float refraction = 0;     ///< F_i, 0..1
    float ior = 1.5f;         ///< 0.1..10
    bool fresnel = false;     ///< the exact unpolarised reflectance scales the two ratios
    float opacity = 1;        ///< share of the light behind that the surface covers, 0..1
    glm::vec3 absorption{0};  ///< inside, per metre, >= 0
    glm::vec3 emission{0};    ///< radiance, >= 0
    std::optional<Checker> checker;

    friend bool operator==(const Material&, const Material&) = default;
};

/// A mesh on its way to another shape.
struct Morph {
    std::filesystem::path mesh;  ///< of the shape at its end; empty: the sphere below
    glm::dvec3 center{0};        ///< metres in object space
    double radius = 1;           ///< metres, > 0
    double amount = 0;           ///< share of the way, 0..1
    bool operator==(const Morph&) const = default;
};

/// O_i before it is placed: a mesh file or a solid, with the lattice that it is voxelized on.
struct Model {
    std::string name;
    std::filesystem::path mesh;    ///< a regular file inside the asset folders; may be empty
    std::filesystem::path voxels;  ///< likewise, of voxels that are there already; may be empty
    std::optional<Morph> morph;    ///< of a mesh
    std::vector<Solid> cuts;       ///< of a mesh that isn't exact: what is taken away from it
    std::optional<Solid> solid;    ///< has a value exactly when both files are empty
    glm::dvec3 voxel_size{0};      ///< metres in object space, > 0; 0 when `resolution` decides
    int resolution = 0;  ///< voxels along the longest side, 1..65536; 0 when `voxel_size` decides
    Surface surface = Surface::smooth;
    VoxelSet set = VoxelSet::supercover;  ///< for `cubes`
    /// Box in object space outside of which no object shows the model: the world's bounds as seen
    /// from all objects that use it. An infinite solid ends there. Empty (min = max) for a model
    /// not used.
    Bounds extent;
    std::string where;

    friend bool operator==(const Model&, const Model&) = default;
};

/// The material of one group of faces of an object's mesh.
struct GroupMaterial {
    std::string group;  ///< as named in the mesh file
    int material = 0;
    std::string where;

    friend bool operator==(const GroupMaterial&, const GroupMaterial&) = default;
};

/// How an object gets into the picture.
enum class Placement : uint8_t {
    automatic,  ///< `world` for what stands still, `instance` for what moves
    world,      ///< resampled into the world's voxels
    instance    ///< rays are carried into the object's own voxels
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
    std::string where;

    friend bool operator==(const Object&, const Object&) = default;
};

enum class LightKind : uint8_t { point, spot, directional, disk, rectangle };

/// The most light samples that one source of light is made of.
inline constexpr int kMaxLightSamples = 16384;

struct Light {
    std::string name;
    LightKind kind = LightKind::point;
    glm::dvec3 position{0};   ///< metres; all but directional; the centre of a disk or rectangle
    glm::dvec3 direction{0};  ///< unit vector along which the light travels; all but point
    glm::vec3 intensity{1};   ///< colour times intensity: at 1 m, or everywhere for directional;
                              ///< of a disk or rectangle, along `direction` from far away
    double inner_half_angle = 0;  ///< radians; spot: full light up to here, ...
    double outer_half_angle = 0;  ///< ... none from here, between them smoothstep of the cosine
    double radius = 0;            ///< metres; disk
    glm::dvec2 size{0};           ///< metres; rectangle: along axis_x, and across it
    glm::dvec3 axis_x{0};         ///< unit vector across `direction`; disk and rectangle
    int light_samples = 64;       ///< disk and rectangle: points that they shine from
    std::string where;

    friend bool operator==(const Light&, const Light&) = default;
};

enum class DisplayShape : uint8_t { pyramid, sector, ball, box };

enum class VolumeLayout : uint8_t {
    rays,    ///< (u, v, k): sight ray by step; u to the image's right, v down, k away from E
    lattice  ///< (x, y, z): Cartesian voxels along X_E, Y_E, Z_E, clipped by the display's shape
};

/// Which surfaces of the world a lattice shows.
enum class Visibility : uint8_t {
    observer,  ///< those that E sees
    outside,   ///< those that can be seen from somewhere outside of the world
    all        ///< all
};

/// VD_E, in the observer's coordinates. A ball is centred at the observer, the others lie around
/// Z_E.
struct Display {
    DisplayShape shape = DisplayShape::pyramid;
    glm::dvec2 half_angles{
        0};  ///< radians; pyramid: horizontal, vertical; sector: both the same, up to pi
    glm::dvec2 half_size{0};  ///< metres; box: half of its edges along X_E and Y_E
    double near = 0;  ///< metres, >= 0; pyramid and box: along Z_E; sector and ball: along the ray
    double far = 0;   ///< metres, > near; ball: its radius
    glm::ivec3 voxels{0};  ///< u, v, k
    bool square_pixels =
        false;  ///< pyramid given by one angle: the vertical one follows the image's size
    VolumeLayout layout = VolumeLayout::rays;
    Visibility visibility = Visibility::observer;  ///< always `observer` for rays
    bool cylinder = false;  ///< lattice: clipped by the upright cylinder that it circumscribes, too

    friend bool operator==(const Display&, const Display&) = default;
};

/// What half of the image spans, u and v: tangents for a pyramid, metres for a box, else radians.
glm::dvec2 half_extent(const Display& display);

/// E: looks along +Z_E with Y_E up, so the right-hand side of the image is -X_E.
struct Observer {
    glm::dvec3 position{0};             ///< metres
    glm::dmat3 world_from_observer{1};  ///< rotation; its columns are X_E, Y_E, Z_E in the world
    Display display;
    std::string where;

    friend bool operator==(const Observer&, const Observer&) = default;
};

struct Animation {
    int frames = 1;   ///< numbered from 1
    double fps = 24;  ///< frames a second

    friend bool operator==(const Animation&, const Animation&) = default;
};

struct SceneMotion;

inline constexpr int kMaxImageSide = 65536;

/// What a flat image shows of a pixel. What none of it needs isn't computed.
struct ImageChannels {
    bool color = true;     ///< R G B A
    bool depth = true;     ///< Z
    bool position = true;  ///< P.X P.Y P.Z
    bool normal = true;    ///< N.X N.Y N.Z
    bool object = true;    ///< objectId

    friend bool operator==(const ImageChannels&, const ImageChannels&) = default;
};

struct RenderSettings {
    glm::ivec2 size{640, 480};  ///< pixels
    int samples = 1;            ///< per pixel, 1..4096
    int depth = 5;              ///< reflections and refractions in a row, 0..64
    bool shadows = true;
    bool filtered_shadows = false;   ///< refracting objects tint and dim light instead of hiding it
    double min_weight = 1.0 / 4096;  ///< paths that would add less than this share of a pixel end
    ImageChannels channels;          ///< not in scene files: what the outputs have

    friend bool operator==(const RenderSettings&, const RenderSettings&) = default;
};

/// Everything that a scene file says, as it is at frame 1; `scene_at` gives other frames. Indices
/// are in range, numbers finite and in their documented ranges.
struct Scene {
    std::filesystem::path file;
    World world;
    std::vector<Material>
        materials;  ///< number 0 is `default`, whether the scene defines it or not
    std::vector<Model> models;
    std::vector<Object> objects;
    std::vector<Light> lights;
    Observer observer;
    Animation animation;
    std::shared_ptr<const SceneMotion> motion;  ///< null: the world stands still
    RenderSettings render;

    friend bool operator==(const Scene&, const Scene&) = default;
};

/// Reads and checks a scene. The format is described in scenes/README.md.
///
/// Throws Error::scene, "file:line:column: key path: sentence", for text or values that are wrong,
/// Error::input for a scene or asset that is missing, Error::limit for a file of more than 64 MiB.
Scene read_scene(const std::filesystem::path& file, const AssetFolders& assets);

/// The same for text that is at hand; `file` names it in messages and gives the folder of its
/// assets.
Scene parse_scene(std::string_view text, const std::filesystem::path& file,
                  const AssetFolders& assets);

/// Changes the size of the image and with it the angles of a display with square pixels.
void resize(Scene& scene, glm::ivec2 size);

/// One material per group of a mesh, or one in all for a mesh without groups. Throws Error::scene
/// when the object names a group that the mesh does not have.
std::vector<int> materials_of_groups(const Object& object,
                                     const std::vector<std::string>& group_names);

/// Whether one of the object's materials has emission.
bool has_emission(const Scene& scene, const Object& object);

/// Whether light goes through or past surfaces of the material.
bool transmits(const Material& material);

/// Whether a material that the object may show transmits light.
bool transmits(const Scene& scene, const Object& object);

/// What the scene holds, in lines for people: world, models, objects, lights, observer.
std::string describe(const Scene& scene);

}  // namespace voxelume
