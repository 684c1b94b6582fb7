// SPDX-License-Identifier: Apache-2.0
// The medium's scattering, as kernels take it.
#pragma once

#include <optional>

#include "kernels/shared/scene.h"
#include "runtime/opencl/float4.hpp"
#include "runtime/opencl/program.hpp"
#include "runtime/scene/parts/world.hpp"
#include "runtime/stages/features.hpp"

namespace voxelume {

/// Scattering per metre at density 1, and the anisotropy; only for features with `scattering`.
struct MediumScattering {
    std::optional<float4> value{};
};

inline MediumScattering scattering_of(const Features& features, const Medium& medium) {
    if (!features.scattering) return {};
    return {float4{medium.scattering.x, medium.scattering.y, medium.scattering.z,
                   float(medium.anisotropy)}};
}

/// VXL_SCATTERING_PARAMETER of kernels.
inline void bind(KernelArguments& to, const MediumScattering& scattering) {
    if (scattering.value) to.add(*scattering.value);
}

}  // namespace voxelume
