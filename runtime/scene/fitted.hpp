// SPDX-License-Identifier: Apache-2.0
// What a scene may leave out, found from the box around its objects: the world's lattice, an
// observer, a light.
#pragma once

#include <string>

#include "runtime/scene/parts/bounds.hpp"

namespace voxelume {

struct Scene;
struct World;

inline constexpr int kFittedMargin = 4;  ///< voxels around the objects, as around models

/// The parts that a scene leaves out.
struct Fitted {
    bool voxel_size = false;
    bool bounds = false;
    bool observer = false;
    bool ambient = false;   ///< added with the default light
    Bounds shown;           ///< the box that a fitted observer shows, metres
    glm::dvec3 look_at{0};  ///< the point that a fitted observer looks at, metres
    glm::dvec3 light{0};    ///< direction of the default light: nearly a unit vector, in few digits

    friend bool operator==(const Fitted&, const Fitted&) = default;
};

/// Sets the world's bounds around a box, and its voxel size where that is 0.
///
/// The voxel size is the box's longest side over `resolution`, rounded up to four digits. The
/// bounds are the whole multiples of the voxel size that leave at least kFittedMargin voxels on
/// every side, so that models of this voxel size share their voxels with the world. Throws
/// Error::scene for a box that is a single point, where it is to give the voxel size, and for one
/// that reaches too far.
void fit_lattice(const Bounds& objects, World& world);

/// Sets `voxels` to as many as cover the bounds. Throws Error::limit where those are too many.
void count_voxels(World& world);

/// The distance at which a fitted pyramid begins, in metres along the observer's view: that of the
/// world's nearest corner, rounded down to three digits, or 0 if the corner isn't ahead. Nothing
/// visible lies before it, and volumetric images hold little empty space.
double fitted_near(const World& world, const glm::dvec3& position, const glm::dvec3& view);

/// Lets a scene's observer show the whole of `fitted.shown` in an image of the scene's size:
/// through a pyramid of 40 degrees, from the right of the front and from above, that begins at
/// fitted_near(). The display's voxels are kept. Values are rounded to a few digits, as
/// `fitted_text` has them.
void frame_observer(Scene& scene);

/// Lets the scene's only light come from over the observer's left shoulder.
void place_default_light(Scene& scene);

/// The parts that were left out, as members of a scene file, a line each; empty if there are none.
std::string fitted_text(const Scene& scene);

}  // namespace voxelume
