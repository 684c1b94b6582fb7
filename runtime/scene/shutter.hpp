// SPDX-License-Identifier: Apache-2.0
// A frame -> the moments that its samples show while the observer's shutter is open.
#pragma once

#include <vector>

#include "runtime/scene/scene.hpp"

namespace voxelume {

/// True if the samples of flat images may show several moments of a frame.
bool has_moments(const Scene& scene);

/// When a sample is taken: a frame, which may be a fraction, from `frame` on until the shutter
/// closes. The first sample shows the frame itself. The 2^k samples from the first one, or from
/// number 2^k on, are spread evenly, as van der Corput's sequence has them.
double moment_of(const Scene& scene, double frame, int sample);

/// The moments of all samples of a frame's image, in ascending order; the frame alone where tracks
/// and numbered files tell that nothing moves.
std::vector<double> moments_of(const Scene& scene, double frame);

/// Some of these, for estimates: the first, a middle one and the last.
std::vector<double> some_moments_of(const Scene& scene, double frame);

/// How many worlds a run of so many frames builds at least: more than one if frames have moments.
size_t worlds_of(const Scene& scene, size_t frames);

/// The most samples of a frame that show one moment, of those taken in a row: all if the scene
/// shows the same while the shutter is open.
int samples_at_once(const Scene& scene, double frame);

/// True if the frame's moments differ in what the scene shows.
bool is_blurred(const Scene& scene, double frame);

}  // namespace voxelume
