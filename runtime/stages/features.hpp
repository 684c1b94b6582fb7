// SPDX-License-Identifier: Apache-2.0
// The features of a scene: the constants that decide which code its kernels consist of.
#pragma once

#include "runtime/opencl/program.hpp"

namespace voxelume {

/// A feature that is false does not exist in the machine code, and its buffers are not allocated.
struct Features {
    bool cubes = false;            ///< some voxel is a surface itself
    bool smooth = false;           ///< some voxel has a distance field
    bool triangles = false;        ///< some voxel lists triangles
    bool corner_normals = false;   ///< some triangle has normals at its corners
    bool voxel_normals = false;    ///< some cube has the normal of the surface it stands for
    bool resampled_cubes = false;  ///< some cube with such a normal comes from another lattice
    bool solids = false;           ///< some voxel lists analytic solids
    bool solids_ahead = false;     ///< few solids are all that rays can meet
    int solid_kinds = 0xFF;       ///< 1 << VXL_SOLID_* of kinds that may be present, except spheres
    bool field_lists = false;     ///< some voxel lists the distance fields in it
    bool field_chains = false;    ///< some listed fields belong to parts of a solid
    int chain_depth = 0;          ///< maximum depth of nested brackets in the parts' formulas
    bool mixed = false;           ///< some mesh has a field and triangles, and rays begin on it
    bool attributes = false;      ///< voxels differ in object, material or kind
    bool colors = false;          ///< voxels have colours of their own
    bool worn_triangles = false;  ///< some exact triangle wears a texture
    bool source_meshes = false;   ///< some smooth object shows the textures of its mesh
    bool texture_alpha = false;   ///< the alpha of some triangle's texture counts
    bool texture_maps = false;    ///< some texture has maps
    bool medium = false;          ///< the environment absorbs light, or scatters it
    bool medium_grid = false;     ///< the environment's density varies
    bool medium_colors = false;   ///< the environment's colour varies
    bool scattering = false;      ///< paths are scattered in the environment
    bool near_light = false;      ///< in scattering, some light isn't infinitely far away
    bool shadows = false;         ///< lights can be hidden
    bool area_samples = false;    ///< some light has an area
    bool chosen_lights = false;   ///< paths choose one of many lights at each point
    bool chosen_areas = false;    ///< some of these lights have an area
    bool asked_areas = false;     ///< points of paths send rays to each of some lights with an area
    bool checker = false;         ///< some material changes its colour from block to block
    bool tinted = false;          ///< some metal in local light reflects in its own colour
    bool paths = false;           ///< rays are reflected, refracted or continue through surfaces
    bool transmission = false;    ///< some object transmits light
    bool refracts = false;        ///< some surface bends rays, or reflects by Fresnel's law
    bool absorbs = false;  ///< the environment, or an object that light passes through, absorbs
                           ///< light
    bool filter = false;   ///< shadow rays may pass through transmitting objects
    bool filtered_refraction = false;  ///< some of these objects refract
    bool cube_bodies = false;          ///< some object of cubes lets light through
    bool voxel_opacity = false;        ///< voxels have opacities of their own
    bool observer_in_medium = false;   ///< observers' rays may begin inside a transmitting mesh or
                                       ///< smooth object
    bool global = false;               ///< light is followed along paths
    bool own_light = false;     ///< global light of surfaces alone, without what these let through
                                ///< straight
    bool physical = false;      ///< in global light, some material is physically based
    bool rough_glass = false;   ///< some physically based material transmits light
    bool coat = false;          ///< some physically based material has a coat
    bool weak_facets = false;   ///< some physical material reflects less than its index implies
    bool area_shares = false;   ///< paths and rays to area lights are combined
    bool meets_lights = false;  ///< paths may run into area lights
    bool direct_alone = false;  ///< only light that comes straight to the first surfaces
    bool scattered_sight = false;  ///< each pixel has samples at places of its own
    bool lens = false;             ///< sight rays start on all points of a lens
    bool blades = false;           ///< the lens is a polygon
    int emitters = 0;              ///< VXL_EMITTERS_*: how paths find emissive surfaces
    int sky = 0;                   ///< VXL_SKY_*: the kind of environment
    int sky_rays = 0;              ///< VXL_EMITTERS_*: how paths find the light of a sky map
    bool sky_hidden = false;       ///< observers don't see the sky
    int media = 0;  ///< maximum number of transmitting objects that a ray may be inside of
    bool medium_set_capped = false;  ///< `media` may be too small
    bool instances = false;          ///< some objects keep voxels of their own
    // The results that are asked for:
    bool radiance = true;   ///< the light along rays, and how much they cover of what lies behind
    bool positions = true;  ///< positions of the points that rays meet
    bool normals = true;    ///< normals at these points
    bool hit_attributes = true;  ///< objects and materials of these points

    friend bool operator==(const Features&, const Features&) = default;

    bool exact() const { return triangles || solids; }
    /// True if hits have colours of their own.
    bool textures() const { return worn_triangles || source_meshes; }
    void leave_out_textures() {
        worn_triangles = source_meshes = texture_alpha = texture_maps = false;
    }
    /// True if paths send rays to emitters or to the sky.
    bool looks() const { return emitters != 0 || sky_rays != 0; }
    /// True if normals for lighting differ from those of the surfaces that rays meet.
    bool shading_normals() const { return corner_normals || voxel_normals; }
    /// True if rays must know on which of a voxel's surfaces they begin.
    bool sources() const { return exact() || field_lists; }

    /// The constants by which kernels know these features.
    Defines defines(const Device& device) const;
};

}  // namespace voxelume
