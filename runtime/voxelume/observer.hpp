// SPDX-License-Identifier: Apache-2.0
// The observer of a scene, its display, and the quality of images, as plain structs.
#pragma once

#include <array>
#include <optional>
#include <variant>

#include "values.hpp"

namespace voxelume::v1 {

/// A rectangular pyramid: the perspective of a camera.
struct PyramidDisplay {
    std::optional<std::array<double, 2>> angles{};  ///< degrees: horizontal and vertical opening
    /// Degrees: horizontal opening of square pixels; 40 without both.
    std::optional<double> angle{};
    double near = 0;              ///< metres along Z_E
    std::optional<double> far{};  ///< metres; without it the end of the world
};

/// A cone of sight rays around Z_E.
struct SectorDisplay {
    double angle = 0;             ///< degrees: whole opening, up to 360
    double near = 0;              ///< metres along the ray
    std::optional<double> far{};  ///< metres, along the ray; the world's end if not given
};

/// All directions around the observer.
struct BallDisplay {
    double radius = 0;  ///< metres
};

/// Parallel sight rays along Z_E.
struct BoxDisplay {
    Vec3 size{};      ///< metres along X_E, Y_E and Z_E; centred on Z_E
    double near = 0;  ///< metres: where the box begins
};

/// The layout of the voxels of a volumetric image.
enum class VolumeLayout {
    rays,    ///< (u, v, k): sight ray by step; u to the image's right, v down, k away
    lattice  ///< (x, y, z): Cartesian voxels along X_E, Y_E and Z_E
};

/// The surfaces of the world that a lattice shows.
enum class Visibility {
    observer,  ///< surfaces that the observer sees
    outside,   ///< surfaces that can be seen from somewhere outside of the world
    all        ///< all surfaces
};

/// The sight lines for which opacities are computed: along these, a lattice's voxels together cover
/// as much as the surfaces that they show.
enum class SeenAlong {
    observer,  ///< sight lines of the observer
    facing,    ///< lines along the axis that the surface faces most, voxel by voxel
    x,         ///< lines along X_E
    y,         ///< lines along Y_E
    z          ///< lines along Z_E
};

/// The space that the observer sees, VS_E, and the voxels of a volumetric image of it.
struct Display {
    /// The sight space.
    std::variant<PyramidDisplay, SectorDisplay, BallDisplay, BoxDisplay> shape{};
    /// Voxels along u, v, k, or x, y, z; without it the image's size, and 256.
    std::optional<std::array<int, 3>> voxels{};
    VolumeLayout layout = VolumeLayout::rays;  ///< how the voxels of a volumetric image lie
    std::optional<Visibility> visibility{};    ///< surfaces in a lattice; without it `observer`
    /// Sight lines of a lattice; without it `facing`, and `observer` for what the observer sees.
    std::optional<SeenAlong> seen_along{};
    bool cylinder = false;  ///< true: the upright cylinder inside a lattice clips it, too
};

/// The projection of an observer's flat images.
enum class Projection {
    display,       ///< `Observer::display`: a perspective if that is a pyramid
    orthographic,  ///< parallel rays, `width` or `height` metres across, to the world's end
    panoramic      ///< all directions by longitude and latitude, to the world's end
};

/// The observer looks along +Z_E with Y_E up, so that the right-hand side of the image is -X_E.
struct Observer {
    Vec3 position{};                ///< metres
    std::optional<Vec3> look_at{};  ///< a point in the middle of the view
    std::optional<Vec3> up{};       ///< the direction that is up in the image; without it +Y
    std::optional<Vec3> turn{};     ///< degrees [psi, theta, gamma], instead of `look_at` and `up`
    std::optional<double> aperture{};  ///< metres: diameter of a lens, of flat images of a pyramid
    std::optional<double> focus{};     ///< metres to the plane in focus; without it `look_at`
    Display display{};                 ///< the display, and the layout of its voxels
    Projection projection = Projection::display;  ///< other values replace `display`
    std::optional<double> width{};                ///< metres that an orthographic image shows
    std::optional<double> height{};               ///< metres of its height, for square pixels
    std::optional<int> blades{};  ///< blades of the lens, which is a polygon then; 3 to 16
    /// Frames for which the shutter is open, from each frame on: samples of flat images show
    /// moments of this time.
    std::optional<double> shutter{};
};

/// The kind of light that reaches surfaces of a flat image.
enum class LightMode {
    local,  ///< light of lights, and along mirrored and refracted rays
    global  ///< all light, including that from surfaces
};

/// The way in which paths of global light find emissive surfaces. The mean light is the same.
enum class EmitterSearch {
    both,   ///< rays to them and paths that run into them: the lowest noise
    paths,  ///< paths that run into them: for large emissive objects
    rays    ///< rays to them, except in mirrors and glass
};

/// The weights of the samples around the middle of a pixel.
enum class ReconstructionFilter {
    box,             ///< equal weights
    tent,            ///< weights that fall evenly
    gaussian,        ///< the weights of a bell of three standard deviations to each side
    blackman_harris  ///< the weights of Blackman-Harris's window
};

/// The flat image.
struct RenderSettings {
    Size size{640, 480};  ///< pixels, 1..kMaxImageSide each
    int samples = 1;      ///< sight rays a pixel, 1..4096
    double adaptive = 0;  ///< local light, 0..1: pixels above this contrast get all samples; 0: all
    int depth = 5;        ///< reflections and refractions in a row, 0..64
    bool shadows = true;  ///< true: lights cast shadows
    bool filtered_shadows = false;   ///< refracting objects tint light instead of hiding it
    double min_weight = 1.0 / 4096;  ///< paths end if they would add less than this part of a pixel
    LightMode light = LightMode::local;  ///< the kind of light that reaches surfaces
    int bounces = 8;                     ///< times that a path of global light is scattered, 0..64
    EmitterSearch emitters = EmitterSearch::both;             ///< search in global light
    ReconstructionFilter filter = ReconstructionFilter::box;  ///< filter of samples
    std::optional<double> filter_width{};  ///< pixels from end to end, at most 16; without it 1 for
                                           ///< a box, 2 for a tent, 3 for others
    /// Observers see nothing where no object is: A is 0 there, and PNG files are transparent.
    /// Mirrors and glass still show the background or the sky.
    bool transparent = false;
    double pixel_aspect = 1;  ///< width of a pixel over its height, 0.1..10
};

}  // namespace voxelume::v1
