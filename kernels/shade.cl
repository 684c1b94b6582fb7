// hits -> surface points: where each ray met what, facing which way, and what shines there without
// lights.
#include "lib/lanes/vector.h"
#include "lib/lanes/work_item.h"
#include "lib/light/medium_set.h"
#include "lib/solid/solid_surface.h"
#include "lib/surface/cube_body.h"
#include "lib/surface/field.h"
#include "lib/surface/surface_color.h"
#include "lib/surface/triangle.h"
#include "lib/traverse/hit_attributes.h"
#include "lib/traverse/instance_hit.h"
#include "shared/scene.h"
#include "shared/trace.h"
#include "shared/voxel.h"

/// Finds of every hit what is asked for: its point, normal and word, and the ambient light and
/// emission that start its radiance; rays that hit nothing take the background. `hit_attributes`
/// keeps each hit's packed attributes, `sides` how the surface was met, where the scene has
/// transmitting objects or mirrors.
kernel void shade_surface(PyramidShape shape, Environment environment,
                          global const float* restrict materials,
                          global const uint* restrict attributes, uint constant_attribute,
                          global const uint* restrict colors, global const uint* restrict fields,
                          global const float* restrict triangles,
                          global const uint* restrict triangle_attributes,
                          global const SolidShape* restrict solids,
                          global const InstanceRecord* restrict instance_records,
                          global const uint* restrict group_materials,
                          global const uint* restrict ranks, global const float* restrict rays,
                          global const uint* restrict hits, global const uint* restrict paths,
                          uint count, uint stride, global float* restrict positions,
                          global float* restrict normals, global uint* restrict hit_attributes,
                          global uint* restrict sides, global float* restrict radiance) {
    const uint first = work_item() * VXL_LANES;
    if (first >= count) return;
    const float4 edge = shape.edge;
    const lane_float t = LANES_AS_FLOAT(LANES_LOAD(hits, VXL_HIT_T * stride + first));
    const lane_uint number = LANES_LOAD(hits, VXL_HIT_VOXEL * stride + first);
    const lane_uint cell_xy = LANES_LOAD(hits, VXL_HIT_CELL * stride + first);
    const lane_uint cell_face = LANES_LOAD(hits, VXL_HIT_FACE * stride + first);
    const lane_int hit = LANE_MASK(number != VXL_NO_VOXEL);
    const lane_uint voxel = number & LANES_AS_UINT(hit);
    const lane_float cx = LANES_FLOAT(cell_xy & 0xFFFFu), cy = LANES_FLOAT(cell_xy >> 16);
    const lane_float cz = LANES_FLOAT(cell_face & 0xFFFFu);
    const lane_uint axis = (cell_face >> VXL_FACE_AXIS_SHIFT) & VXL_FACE_AXIS_MASK;
    const Vector world_o = load_vector(rays, stride, first);
    const Vector world_d = load_vector(rays + VXL_RAY_DX * stride, stride, first);
    const lane_float world_at = LANES_SELECT(hit, t, (lane_float)0.0f);
    HitRay in_grid;
    in_grid.origin = world_o, in_grid.direction = world_d, in_grid.t = world_at;
    lane_uint instance = (lane_uint)VXL_NO_INSTANCE;
    lane_int of_instance = (lane_int)0;
    if (VXL_INSTANCES) {
        instance = LANES_LOAD(hits, VXL_HIT_INSTANCE * stride + first);
        of_instance = hit & LANE_MASK(instance != VXL_NO_INSTANCE);
        in_grid = transform_hits(instance_records, instance, of_instance, in_grid);
    }
    const Vector o = in_grid.origin, d = in_grid.direction;
    const lane_float at = in_grid.t;
    // The position inside the voxel: a cube's on the face that was crossed, exactly.
    Vector s = {clamp(fma(d.x, at, o.x - cx), 0.0f, 1.0f),
                clamp(fma(d.y, at, o.y - cy), 0.0f, 1.0f),
                clamp(fma(d.z, at, o.z - cz), 0.0f, 1.0f)};

    Vector normal = {(lane_float)0.0f, (lane_float)0.0f, (lane_float)0.0f};
    lane_uint primitive = (lane_uint)VXL_NO_PRIMITIVE;
    if (VXL_EXACT) primitive = LANES_LOAD(hits, VXL_HIT_PRIMITIVE * stride + first);
    lane_uint packed = attributes_of_hit(attributes, constant_attribute, triangle_attributes,
                                         solids, voxel, primitive, hit);
    if (VXL_INSTANCES)
        packed =
            instance_attributes(instance_records, group_materials, instance, packed, of_instance);
    const lane_int exact = LANE_MASK(primitive != VXL_NO_PRIMITIVE) & hit;
    const lane_uint kind = packed >> VXL_KIND_SHIFT;
    if (VXL_CUBES) {
        const lane_float up_x = LANES_FLOAT(LANE_MASK(d.x >= 0.0f)) * 2.0f + 1.0f;
        const lane_float up_y = LANES_FLOAT(LANE_MASK(d.y >= 0.0f)) * 2.0f + 1.0f;
        const lane_float up_z = LANES_FLOAT(LANE_MASK(d.z >= 0.0f)) * 2.0f + 1.0f;
        const lane_float zero = (lane_float)0.0f;
        Vector face = {LANES_SELECT(LANE_MASK(axis == 0u), up_x, zero),
                       LANES_SELECT(LANE_MASK(axis == 1u), up_y, zero),
                       LANES_SELECT(LANE_MASK(axis == 2u), up_z, zero)};
        const lane_int cubes = LANE_MASK(kind == VXL_KIND_CUBES) & hit & ~exact;
        lane_float half_unit = (lane_float)0.5f;  // towards the face that was met
        if (VXL_CUBE_BODIES) half_unit = LANES_SELECT(is_exit(cell_face), -half_unit, half_unit);
        const Vector on_face = {
            LANES_SELECT(LANE_MASK(axis == 0u), fma(up_x, half_unit, 0.5f), s.x),
            LANES_SELECT(LANE_MASK(axis == 1u), fma(up_y, half_unit, 0.5f), s.y),
            LANES_SELECT(LANE_MASK(axis == 2u), fma(up_z, half_unit, 0.5f), s.z)};
        s = select_vector(cubes, on_face, s);
        normal = select_vector(cubes, face, normal);
        if (VXL_INSTANCES) {
            Vector g = world_gradient(&in_grid, face, of_instance);
            g.x *= shape.inverse_edge.x, g.y *= shape.inverse_edge.y, g.z *= shape.inverse_edge.z;
            normal = select_vector(cubes & of_instance, unit(g), normal);
        }
    }
    const lane_int smooth = LANE_MASK(kind != VXL_KIND_CUBES) & hit & ~exact;
    if (VXL_SMOOTH && lanes_any(smooth)) {
        const Field field = read_field(fields, voxel & LANES_AS_UINT(smooth));
        Vector g;
        field_gradient(&field, s.x, s.y, s.z, &g.x, &g.y, &g.z);
        if (VXL_INSTANCES) g = world_gradient(&in_grid, g, of_instance);
        g.x *= shape.inverse_edge.x, g.y *= shape.inverse_edge.y, g.z *= shape.inverse_edge.z;
        normal = select_vector(smooth, unit(g), normal);
    }
    if (VXL_EXACT && lanes_any(exact)) {
        const lane_int is_solid = LANE_MASK((primitive & VXL_SOLID_PRIMITIVE) != 0u) & exact;
        const lane_int is_triangle = exact & ~is_solid;
        if (VXL_TRIANGLES) {
            const lane_uint triangle = primitive & LANES_AS_UINT(is_triangle);
            normal = select_vector(is_triangle, unit(triangle_normal(triangles, triangle, edge)),
                                   normal);
            if (VXL_INSTANCES) {
                Vector g = triangle_normal(triangles, triangle, (float4)(1.0f));
                g = world_gradient(&in_grid, g, of_instance);
                g.x *= shape.inverse_edge.x, g.y *= shape.inverse_edge.y;
                g.z *= shape.inverse_edge.z;
                normal = select_vector(is_triangle & of_instance, unit(g), normal);
            }
        }
        if (VXL_SOLIDS && lanes_any(is_solid)) {
            const lane_uint solid = (primitive & ~VXL_SOLID_PRIMITIVE) & LANES_AS_UINT(is_solid);
            const SolidRay ray = {o.x, o.y, o.z, d.x, d.y, d.z};
            const SolidPoint in_voxels = solid_normals(solids, solid, &ray, at, is_solid);
            Vector g = {in_voxels.x, in_voxels.y, in_voxels.z};
            if (VXL_INSTANCES) g = world_gradient(&in_grid, g, of_instance);
            const Vector gradient = {g.x * shape.inverse_edge.x, g.y * shape.inverse_edge.y,
                                     g.z * shape.inverse_edge.z};
            normal = select_vector(is_solid, unit(gradient), normal);
        }
        const Vector along = {fma(d.x, at, o.x - cx), fma(d.y, at, o.y - cy),
                              fma(d.z, at, o.z - cz)};
        s = select_vector(exact, along, s);
    }
    // Surfaces without an inside, and insides that a ray began in, face the ray.
    const Vector metric = {world_d.x * edge.x, world_d.y * edge.y, world_d.z * edge.z};
    // A smooth one's gradient may turn too far at its silhouette, but the walk knows the side.
    lane_int behind = LANE_MASK(dot_product(metric, normal) > 0.0f);
    if (VXL_SMOOTH)
        behind = LANES_SELECT(smooth, LANE_MASK((cell_face & VXL_FACE_WITHIN) != 0u), behind);
    const Vector flipped = {-normal.x, -normal.y, -normal.z};
    normal = select_vector(behind, flipped, normal);

    Vector position = {cx + s.x, cy + s.y, cz + s.z};
    if (VXL_INSTANCES) {
        const Vector on_ray = {fma(world_d.x, world_at, world_o.x),
                               fma(world_d.y, world_at, world_o.y),
                               fma(world_d.z, world_at, world_o.z)};
        position = select_vector(of_instance, on_ray, position);
    }
    if (VXL_POSITIONS) store_vector(position, positions, stride, first);
    if (VXL_NORMALS) store_vector(normal, normals, stride, first);
    if (VXL_HIT_ATTRIBUTES) LANES_STORE(packed, hit_attributes, first);
    if (!VXL_RADIANCE) return;

    const lane_uint material = material_offset(packed) & LANES_AS_UINT(hit);
    lane_float opacity = surface_opacity(materials, material, colors, voxel);
    lane_uint side = LANES_AS_UINT(behind) & VXL_SIDE_LEAVING;
    if (VXL_TRANSMISSION) {
        lane_int hidden;
        const MediumSet before = load_medium_set(paths, stride, first, hit);
        const lane_int body = is_smooth(packed, primitive) & ~of_instance;
        lane_int leaving = medium_set_holds(&before, packed, body) | behind;
        lane_int inner = (lane_int)0, exit = (lane_int)0;  // faces between cubes, and out of them
        if (VXL_CUBE_BODIES) {
            const lane_int cube = is_cube(packed, primitive) & hit;
            exit = cube & is_exit(cell_face);
            inner = cube & leaving & ~exit;
            leaving = LANES_SELECT(cube, exit, leaving);
        }
        hidden = hides_surface(&before, packed, body, leaving, ranks);
        if (VXL_CUBE_BODIES) {
            hidden |= exit & ~is_joined(packed, materials);
            hidden =
                LANES_SELECT(inner, ~same_medium(effective_medium(&before, ranks), packed), hidden);
            // An observer inside of a joined body is not on any face of it.
            hidden |=
                is_cube(packed, primitive) & LANE_MASK(axis == 3u) & is_joined(packed, materials);
        }
        hidden &= hit & (transmits(materials, material, opacity) | exit);
        opacity = LANES_SELECT(hidden, (lane_float)0.0f, opacity);
        side =
            (LANES_AS_UINT(leaving) & VXL_SIDE_LEAVING) | (LANES_AS_UINT(hidden) & VXL_SIDE_HIDDEN);
    }
    if (VXL_PATHS) LANES_STORE(side, sides, first);

    const lane_float diffuse = LANES_GATHER_FLOAT(materials, material + VXL_MATERIAL_DIFFUSE);
    const lane_uint place = color_offset(materials, material, position.x, position.y, position.z);
    const float ambient[3] = {environment.ambient.x, environment.ambient.y, environment.ambient.z};
    const float background[3] = {environment.background.x, environment.background.y,
                                 environment.background.z};
    for (int channel = 0; channel < 3; ++channel) {
        const lane_float color = surface_color(materials, place, colors, voxel, channel);
        const lane_float emission =
            LANES_GATHER_FLOAT(materials, material + (uint)(VXL_MATERIAL_EMISSION + channel));
        const lane_float own = fma(color * diffuse, ambient[channel], emission) * opacity;
        LANES_STORE(LANES_SELECT(hit, own, (lane_float)background[channel]), radiance,
                    (uint)channel * stride + first);
    }
}
