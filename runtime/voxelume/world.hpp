// SPDX-License-Identifier: Apache-2.0
// The space of a scene as plain structs: the world's lattice, its medium, and materials.
#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <variant>
#include <vector>

#include "values.hpp"

namespace voxelume::v1 {

/// Numbered files, one for each frame. The number replaces the last run of `#` in the file's name.
struct Sequence {
    int first = 1;      ///< number of the first file
    int last = 1;       ///< number of the last file
    int start = 1;      ///< frame that shows the first file
    bool loop = false;  ///< true: the first file follows the last one; else the last stays
};

/// Fog on the ground: density 1 up to y = `base`, above it exp(-(y - base) / scale_height).
struct HeightDensity {
    double base = 0;          ///< metres
    double scale_height = 1;  ///< metres, above 0
};

/// Density 1 in a ball and 0 outside.
struct BallDensity {
    Vec3 center{};       ///< metres
    double radius = 1;   ///< metres, above 0
    double falloff = 0;  ///< metres of the rim over which the density falls smoothly, up to radius
};

/// The optical properties of a medium at one value of a file; see GridDensity::transfer.
struct TransferPoint {
    double value = 0;              ///< value of the file; above that of the point before
    double absorption = 0;         ///< absorption per metre, times the medium's
    std::optional<Color> color{};  ///< radiance of an infinitely deep medium; without it white
};

/// A float grid of an OpenVDB file, or the values of an array. Its own transform gives positions in
/// metres, to which `position`, `turn` and `scale`, or `matrix`, apply.
struct GridDensity {
    std::filesystem::path file{};        ///< .vdb, .nrrd, .nii, .hdr or .npy
    std::optional<Sequence> sequence{};  ///< a file for each frame
    std::string grid = "density";        ///< its name in the file
    Vec3 position{};                     ///< metres: position of the grid's origin
    Vec3 turn{};          ///< degrees [psi, theta, gamma]: R_y(psi) * R_x(theta) * R_z(gamma)
    Vec3 scale{1, 1, 1};  ///< negative ones mirror
    std::optional<Matrix> matrix{};  ///< instead of position, turn and scale
    /// The transfer function: it gives the file's values the absorption and colour of these points,
    /// linearly between them, instead of using them as densities.
    std::vector<TransferPoint> transfer{};
    std::optional<Vec3> lit{};  ///< with a transfer: direction of light that shows surfaces
    /// With a transfer: true if the scene's lights show surfaces, instead of `lit`.
    bool is_lit_by_scene = false;
    /// Up to 15 further scans in the same medium, or windows of one, without `others` of their own.
    std::vector<GridDensity> others{};
};

/// The medium between the objects.
struct Medium {
    Color absorption{};  ///< per metre at density 1, at least 0; with a transfer 0 means 1
    Color color{};       ///< radiance of an infinitely deep medium, at least 0
    /// The density at each voxel of the world; monostate: 1 everywhere.
    std::variant<std::monostate, HeightDensity, BallDensity, GridDensity> density{};
    /// Per metre at density 1, at least 0; only in global light. With a transfer, per metre where
    /// the transfer's absorption is 1.
    Color scattering{};
    /// The mean cosine of the scattering angle (Henyey & Greenstein 1941), -0.99 to 0.99: 0 is
    /// equal in all directions, positive values are forwards.
    double anisotropy = 0;
};

/// A sky of one colour.
struct ConstantSky {
    Color color{1, 1, 1};  ///< radiance
};

/// A sky that changes from the horizon to the zenith, by the sine of the height.
struct GradientSky {
    Color zenith{0.25, 0.45, 0.9};   ///< radiance from above
    Color horizon{0.8, 0.9, 1};      ///< radiance from the side
    Color ground{0.25, 0.23, 0.21};  ///< radiance from below the horizon
};

/// A clear sky with a sun in it (Preetham, Shirley and Smits 1999).
struct SunSky {
    Vec3 direction{0, -1, 0};        ///< direction in which the sun's light travels; downwards
    double angle = 0.53;             ///< degrees that the disc fills, up to 90
    Color color{1, 0.95, 0.88};      ///< colour of the disc's light
    double intensity = 1;            ///< strength of the light from the disc
    double turbidity = 3;            ///< haze, 2 clear to 10 thick
    Color ground{0.25, 0.23, 0.21};  ///< radiance from below the horizon
};

/// A picture of everything around, as a latitude-longitude map.
struct MapSky {
    std::filesystem::path file{};  ///< .exr, .hdr or .png, as seen from the scene's folder
    double rotation = 0;           ///< degrees, counterclockwise as seen from above
};

/// The environment that rays see where they leave the world, and that lights surfaces.
struct Sky {
    std::variant<ConstantSky, GradientSky, SunSky, MapSky> kind{};  ///< the kind of sky
    double strength = 1;  ///< multiplies the radiance, except that of the sun's disc
    int samples = 16;     ///< directions in which a point in local light samples the sky, 0..1024
    bool visible = true;  ///< true: observers see it, who otherwise see the background
};

/// The lattice S in which all objects are placed, and the space around it.
struct World {
    Vec3 voxel_size{};                ///< metres along each axis; 0: by `resolution`
    std::optional<int> resolution{};  ///< voxels along the longest side; without it 256
    /// Corner of the bounds, where the lattice starts. Both corners 0: around the objects of all
    /// frames, with a margin; infinite solids don't count.
    Vec3 min{};
    Vec3 max{};          ///< the opposite corner; the last voxels may reach past it
    Color background{};  ///< radiance where a ray leaves the world
    Color ambient{};     ///< light that reaches every surface; black: none, or the default light's
    std::optional<Medium> medium{};  ///< the medium between objects
    std::optional<Sky> sky{};        ///< replaces the background
};

/// A second colour in every other block of a lattice that is fixed in the world.
struct Checker {
    Color color{};  ///< linear Rec. 709, of every other block
    Vec3 size{};    ///< edges of a block; 0: no change along that axis
    Vec3 origin{};  ///< a corner of a block of the material's own colour
};

/// The look of a surface (Whitted 1980), and of the body behind it. Objects without a material have
/// the material named "default".
struct Material {
    std::string name{};          ///< name by which objects refer to it
    Color color{0.8, 0.8, 0.8};  ///< 0..1
    double diffuse = 1;          ///< part of the light that Lambert's term returns, 0..1
    /// Part of the light that the Blinn-Phong highlight returns, 0..1; otherwise 0. Physically
    /// based: factor of the reflectance of the non-metallic part; otherwise 1.
    std::optional<double> specular{};
    double shininess = 50;  ///< exponent of the highlight, 1..1e6
    double reflection = 0;  ///< part of the reflected ray's value, 0..1
    double refraction = 0;  ///< part of the refracted ray's value, 0..1
    double ior = 1.5;       ///< index of refraction inside, 0.1..10
    bool fresnel = false;   ///< the exact reflectance for the angle scales the two parts above
    double opacity = 1;     ///< share of what lies behind that the surface covers, 0..1
    Color absorption{};     ///< inside of the object, per metre, at least 0
    Color emission{};       ///< radiance that the surface sends out, at least 0
    std::optional<Checker> checker{};  ///< a second colour in every other block
    /// The material is physically based if it has one of these: then `color`, `diffuse`,
    /// `shininess`, `reflection`, `refraction` and `fresnel` have no effect. See
    /// scenes/manual/materials.md.
    std::optional<Color> base_color{};       ///< 0..1; otherwise `color`
    std::optional<double> metallic{};        ///< share of metal, 0..1; otherwise 0
    std::optional<double> roughness{};       ///< 0 polished to 1 dull; otherwise 0.5
    std::optional<double> transmission{};    ///< share of glass in the non-metallic part, 0..1
    std::optional<double> coat{};            ///< share under a clear coat, 0..1; otherwise 0
    std::optional<double> coat_roughness{};  ///< roughness of the coat, 0..1; otherwise 0
};

}  // namespace voxelume::v1
