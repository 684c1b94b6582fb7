// SPDX-License-Identifier: Apache-2.0
// Noise against time: scenes in global light, with more and more samples.
#pragma once

#include <array>
#include <functional>
#include <glm/vec2.hpp>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "runtime/image/image.hpp"
#include "runtime/opencl/device.hpp"
#include "runtime/scene/scene.hpp"
#include "runtime/verify/bench/bench_times.hpp"
#include "runtime/verify/bench/convergence.hpp"

namespace voxelume {

/// Two pictures of a scene, each with noise of its own, in channels R, G and B.
using References = std::array<Image, 2>;

struct GlobalScene {
    std::string name;
    Scene scene;
    std::optional<References> references;  ///< of another program; none: this program makes them
};

/// A scene that the program has, by its name.
struct GlobalEntry {
    const char* name;
    const char* help;
    Scene (*open)(glm::ivec2 size);
};

/// All entries, in the order of measurement.
std::span<const GlobalEntry> global_entries();

/// A scene with a number of samples, by this program or by another.
struct GlobalRow {
    std::string program;  ///< empty: this one
    std::string scene;
    int samples = 0;          ///< per pixel
    double relative_mse = 0;  ///< see `relative_mse`
    double light = 0;         ///< mean light over that of the references; 0: not known
    double seconds = 0;       ///< time of the picture alone, without building the world
    BenchTimes times{};       ///< of this program's picture, with its world, which counts neither
                              ///< among `kernels` nor `programs`
    uint64_t peak_bytes = 0;  ///< maximum of bytes on the device at once; 0: not known
};

/// The slope at which the error of a program's pictures of a scene falls.
struct GlobalFit {
    std::string program, scene;
    SlopeFit by_samples, by_seconds;
};

/// The mean over pixels and colours of the squared error over the squared light, to which a
/// hundredth of the picture's squared mean is added for what is dark.
///
/// The squared error is the product of the differences from both references. Their noise and the
/// image's are independent, so it adds nothing on average. Noise in the light by which errors are
/// divided makes the result larger by about 1.5 times the square of a reference's relative noise.
/// For black references the result is 0, or NaN if the image isn't black. All images have the same
/// size.
double relative_mse(const Image& image, const References& references);

/// Measures a scene with each number of samples, ascending. Of `repeats` pictures and a first one,
/// unless that made kernels, the fastest counts. `progress` is called after each row. Throws the
/// Errors of rendering.
std::vector<GlobalRow> measure_global(const Device& device, const GlobalScene& scene,
                                      std::span<const int> samples, int repeats,
                                      const std::function<void()>& progress);

/// Builds the scene's world, so that its kernels are ready when it is measured. Throws what
/// measuring would, for files that can't be read or worlds that don't fit.
void check_global(const Device& device, const GlobalScene& scene);

/// The fits of each program's rows of each scene, in the order of the rows.
std::vector<GlobalFit> fit_global(std::span<const GlobalRow> rows);

}  // namespace voxelume
