// SPDX-License-Identifier: Apache-2.0
// A frame -> the moments that its samples show while the observer's shutter is open.
#pragma once

#include <vector>

#include "runtime/scene/scene.hpp"

namespace voxelume {

/// True if the samples of flat images may show several moments of a frame.
bool has_moments(const Scene& scene);

/// The moment of a sample: a frame, which may be a fraction, from `frame` on until the shutter
/// closes. The first sample is at the frame itself. The 2^k samples from the first one, or from
/// number 2^k on, are spread evenly, by van der Corput's sequence.
double moment_of(const Scene& scene, double frame, int sample);

/// The moments of all samples of a frame's image, in ascending order; the frame alone where tracks
/// and numbered files tell that nothing moves.
std::vector<double> moments_of(const Scene& scene, double frame);

/// Some of the frame's moments, for estimates: the first, a middle one and the last.
std::vector<double> some_moments_of(const Scene& scene, double frame);

/// The minimum number of worlds that a run of `frames` frames builds: at least two if frames have
/// moments.
size_t worlds_of(const Scene& scene, size_t frames);

/// The maximum number of successive samples of a frame that show one moment: all if nothing moves
/// while the shutter is open.
int samples_at_once(const Scene& scene, double frame);

/// True if what the scene shows differs between the frame's moments.
bool is_blurred(const Scene& scene, double frame);

}  // namespace voxelume
