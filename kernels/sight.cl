// observer -> rays: one sight ray for every sample of every pixel, clipped to the world.
//
// Rays come in tiles of 4 x 4 pixels, a tile's samples one after another: place
// ((tile * samples) + sample) * 16 + pixel of the tile, whatever the number of lanes.
#include "lib/exact_exp.h"
#include "lib/fixed_point.h"
#include "lib/vector.h"
#include "lib/work_item.h"
#include "shared/scene.h"

/// A sight ray in the observer's coordinates, metres.
typedef struct {
    Vector start, direction;
} SightRay;

/// Where the sample at (u, v), each in [-1, 1] with u to the right and v down, looks.
static inline SightRay sight_ray(const Sight* sight, lane_float u, lane_float v, lane_int* seen) {
    SightRay ray;
    const lane_float zero = (lane_float)0.0f;
    // Image right is -X_E, image up is Y_E.
    const lane_float x = -u * sight->half_x, y = -v * sight->half_y;
    ray.start.x = ray.start.y = ray.start.z = zero;
    if (sight->shape == VXL_SHAPE_PYRAMID) {
        ray.start.x = x * sight->lead, ray.start.y = y * sight->lead;
        ray.direction.x = x, ray.direction.y = y, ray.direction.z = (lane_float)1.0f;
    } else if (sight->shape == VXL_SHAPE_BOX) {
        ray.start.x = x, ray.start.y = y;
        ray.direction.x = ray.direction.y = zero, ray.direction.z = (lane_float)1.0f;
    } else if (sight->shape == VXL_SHAPE_BALL) {  // longitude and latitude
        lane_float sin_x, cos_x, sin_y, cos_y;
        exact_sincos(x, &sin_x, &cos_x);
        exact_sincos(y, &sin_y, &cos_y);
        ray.direction.x = sin_x * cos_y, ray.direction.y = sin_y, ray.direction.z = cos_x * cos_y;
    } else {  // sector: the angle from Z_E grows evenly with the distance from the middle
        const lane_float radius = exact_sqrt(fma(u, u, v * v));
        lane_float sine, cosine;
        exact_sincos(radius * sight->half_x, &sine, &cosine);
        const lane_float by =
            exact_divide(sine, LANES_SELECT(LANE_MASK(radius > 0.0f), radius, (lane_float)1.0f));
        ray.direction.x = -u * by, ray.direction.y = -v * by, ray.direction.z = cosine;
        *seen &= LANE_MASK(radius <= 1.0f);
    }
    return ray;
}

/// Observer metres to voxels, along one axis of the world.
static inline lane_float along(float ax, float ay, float az, Vector v) {
    return fma(v.x, ax, fma(v.y, ay, v.z * az));
}

/// Writes the rays of one packet. `offsets` holds x and y in [0, 1) of each sample in its pixel.
kernel void cast_sight(Sight sight, PyramidShape shape, global const float* restrict offsets,
                       uint first_tile, uint count, uint stride, global float* restrict rays) {
    const uint first = work_item() * VXL_LANES;
    if (first >= count) return;
    const uint group = first / 16u;
    const uint tile = first_tile + group / (uint)sight.samples;
    const uint sample = group % (uint)sight.samples;
    const uint tiles_x = ((uint)sight.width + 3u) / 4u;
    const lane_int pixel = LANES_NUMBERS + (int)(first % 16u);
    const lane_int column = (int)(tile % tiles_x * 4u) + (pixel & 3);
    const lane_int row = (int)(tile / tiles_x * 4u) + (pixel >> 2);
    lane_int seen = LANE_MASK(column < sight.width) & LANE_MASK(row < sight.height);

    const lane_float px = LANES_FLOAT(column) + offsets[2u * sample];
    const lane_float py = LANES_FLOAT(row) + offsets[2u * sample + 1u];
    const lane_float u = exact_divide(2.0f * px, (lane_float)(float)sight.width) - 1.0f;
    const lane_float v = exact_divide(2.0f * py, (lane_float)(float)sight.height) - 1.0f;
    const SightRay ray = sight_ray(&sight, u, v, &seen);

    lane_float dx = along(sight.axis_x.x, sight.axis_y.x, sight.axis_z.x, ray.direction);
    lane_float dy = along(sight.axis_x.y, sight.axis_y.y, sight.axis_z.y, ray.direction);
    lane_float dz = along(sight.axis_x.z, sight.axis_y.z, sight.axis_z.z, ray.direction);
    const lane_float scale = power_of_two_scale(dx, dy, dz);
    const lane_float per_metre = exact_reciprocal(scale);
    dx = snap_direction(dx * scale), dy = snap_direction(dy * scale),
    dz = snap_direction(dz * scale);

    const lane_float lx =
        sight.origin_low.x + along(sight.axis_x.x, sight.axis_y.x, sight.axis_z.x, ray.start);
    const lane_float ly =
        sight.origin_low.y + along(sight.axis_x.y, sight.axis_y.y, sight.axis_z.y, ray.start);
    const lane_float lz =
        sight.origin_low.z + along(sight.axis_x.z, sight.axis_y.z, sight.axis_z.z, ray.start);
    const lane_float t_far = sight.far_plane * per_metre;
    lane_float t_first = sight.near_plane * per_metre, t_last = t_far;
    const Vector origin = {sight.origin.x + lx, sight.origin.y + ly, sight.origin.z + lz};
    const Vector direction = {dx, dy, dz};
    clip_to_world(origin, direction, shape.size_x, shape.size_y, shape.size_z, &t_first, &t_last);
    seen &= LANE_MASK(t_first <= t_last);
    t_first = LANES_SELECT(seen, t_first, (lane_float)0.0f);

    const lane_float zero = (lane_float)0.0f;
    const lane_float ox = start_coordinate(sight.origin.x, lx, dx, (float)shape.size_x, t_first);
    const lane_float oy = start_coordinate(sight.origin.y, ly, dy, (float)shape.size_y, t_first);
    const lane_float oz = start_coordinate(sight.origin.z, lz, dz, (float)shape.size_z, t_first);
    LANES_STORE(snap_position(ox, zero, shape.fixed_point), rays, VXL_RAY_OX * stride + first);
    LANES_STORE(snap_position(oy, zero, shape.fixed_point), rays, VXL_RAY_OY * stride + first);
    LANES_STORE(snap_position(oz, zero, shape.fixed_point), rays, VXL_RAY_OZ * stride + first);
    LANES_STORE(dx, rays, VXL_RAY_DX * stride + first);
    LANES_STORE(dy, rays, VXL_RAY_DY * stride + first);
    LANES_STORE(dz, rays, VXL_RAY_DZ * stride + first);
    // The ray ends at the far surface; that it leaves the world the walk finds by itself, exactly.
    const lane_float t_end = LANES_SELECT(seen, t_far - t_first, (lane_float)-1.0f);
    LANES_STORE(t_end, rays, VXL_RAY_END * stride + first);
}
