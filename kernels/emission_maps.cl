// SPDX-License-Identifier: Apache-2.0
// pieces of smooth objects' emissive surfaces -> the factors by which emission maps multiply their
// light.
#include "lib/lanes/vector.h"
#include "lib/lanes/work_item.h"
#include "lib/surface/paint.h"

/// Finds the factors by which emission maps multiply the light of smooth objects' pieces: the maps'
/// means over squares of the pieces' areas. `points` has seven components, `stride` values apart:
/// the position in voxels, the unit normal in metric space, and the length of the square's sides in
/// metres. `objects` holds the number of each piece's object.
kernel void mean_emission_maps(PyramidShape shape, const uint count, const uint stride,
                               global const uint* restrict objects,
                               global const float* restrict points,
                               global const SourceRecord* restrict source_objects,
                               global const uint* restrict source_words,
                               global float* restrict factors) {
    const uint first = work_item() * VXL_LANES;
    if (first >= count) return;
    const SourceMeshes sources = {source_objects, source_words};
    const lane_int ask = LANE_MASK(LANES_NUMBERS + (lane_int)(int)first < (lane_int)(int)count);
    const lane_uint object = LANES_LOAD(objects, first) & LANES_AS_UINT(ask);
    const Vector at = load_vector(points, stride, first);
    const Vector normal = load_vector(points + 3 * stride, stride, first);
    RaySpan span;
    span_square(opposite(normal), normal, LANES_LOAD(points, 6 * stride + first), &span);
    Vector sides[2];
    for (int i = 0; i < 2; ++i) sides[i] = scaled(span.side[i], shape.inverse_edge);
    lane_float color[VXL_PAINT_OPACITY + 1];
    for (int i = 0; i <= VXL_PAINT_OPACITY; ++i) color[i] = (lane_float)1.0f;
    MapValues maps = no_map_values();
    paint_smooth(&sources, at, object, ask, &span, sides, color, &maps);
    const Vector emission = {maps.emission[0], maps.emission[1], maps.emission[2]};
    store_vector(emission, factors, stride, first);
}
