// What a scene really contains: the constants that decide which code its kernels are made of.
#pragma once

#include "runtime/opencl/program.hpp"

namespace voxelume {

/// Every feature that is false does not exist in the machine code, and its buffers are not
/// allocated.
struct Features {
    bool cubes = false;         ///< some voxel is its own surface
    bool smooth = false;        ///< some voxel has a distance field
    bool triangles = false;     ///< some voxel lists triangles
    bool solids = false;        ///< some voxel lists analytic solids
    bool attributes = false;    ///< voxels differ in object, material or kind
    bool colors = false;        ///< voxels have colours of their own
    bool medium = false;        ///< the space absorbs light
    bool medium_grid = false;   ///< ... not everywhere alike
    bool shadows = false;       ///< lights can be hidden
    bool area_samples = false;  ///< some light has an area
    bool checker = false;       ///< some material changes its colour from block to block
    bool paths = false;         ///< rays are reflected, refracted or go on through surfaces
    bool transmission = false;  ///< some object lets light through
    bool refracts = false;      ///< some surface bends rays, or reflects by Fresnel's law
    bool absorbs = false;       ///< the space, or an object that light goes through, takes of it
    bool filter = false;        ///< shadow rays may go through transmitting objects
    bool filtered_refraction = false;  ///< refracting ones among them
    bool cube_bodies = false;          ///< some object of cubes lets light through
    bool voxel_opacity = false;        ///< voxels have opacities of their own
    bool observer_in_medium = false;   ///< observers' rays may begin inside of a transmitting mesh
                                      ///< or smooth object
    int other_media = 0;  ///< of the sets of transmitting objects that rays are inside of, beside
                          ///< the smooth body
    bool medium_set_capped = false;  ///< ... which may not be enough
    bool instances = false;          ///< some objects keep voxels of their own
    // what is asked for
    bool radiance = true;   ///< the light along rays, and how much of what is behind they cover
    bool positions = true;  ///< of the points that rays meet ...
    bool normals = true;
    bool hit_attributes = true;  ///< ... and which object and material

    friend bool operator==(const Features&, const Features&) = default;

    bool exact() const { return triangles || solids; }

    Defines defines(const Device& device) const {
        return {{"VXL_CUBES", cubes},
                {"VXL_SMOOTH", smooth},
                {"VXL_EXACT", exact()},
                {"VXL_TRIANGLES", triangles},
                {"VXL_SOLIDS", solids},
                {"VXL_ATTRIBUTES", attributes},
                {"VXL_COLORS", colors},
                {"VXL_MEDIUM", medium},
                {"VXL_MEDIUM_GRID", medium_grid},
                {"VXL_SHADOWS", shadows},
                {"VXL_AREA_SAMPLES", area_samples},
                {"VXL_CHECKER", checker},
                {"VXL_PATHS", paths},
                {"VXL_TRANSMISSION", transmission},
                {"VXL_REFRACTS", refracts},
                {"VXL_ABSORBS", absorbs},
                {"VXL_FILTER", filter},
                {"VXL_FILTERED", filtered_refraction},
                {"VXL_CUBE_BODIES", cube_bodies},
                {"VXL_VOXEL_OPACITY", voxel_opacity},
                {"VXL_OBSERVER_IN_MEDIUM", observer_in_medium},
                {"VXL_OTHER_MEDIA", other_media},
                {"VXL_MEDIUM_SET_CAPPED", medium_set_capped},
                {"VXL_INSTANCES", instances},
                {"VXL_RADIANCE", radiance},
                {"VXL_POSITIONS", positions},
                {"VXL_NORMALS", normals},
                {"VXL_HIT_ATTRIBUTES", hit_attributes},
                {"VXL_NATIVE_DIVIDE", device.is_cpu()}};
    }
};

}  // namespace voxelume
