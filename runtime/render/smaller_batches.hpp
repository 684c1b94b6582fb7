// SPDX-License-Identifier: Apache-2.0
// Rendering again with smaller batches of rays where a device lacks memory for them.
#pragma once

#include "runtime/base/error.hpp"
#include "runtime/opencl/device.hpp"

namespace voxelume {

/// Calls `render`. Where it meets a limit before `has_begun()` is true, that is before a part of
/// the work is done, it is called again with batches of half the size, down to 4,096 rays. Batches
/// change no bit of what is rendered. Throws what the last call threw.
template <class HasBegun, class Render>
auto with_batches_that_fit(const Device& device, const HasBegun& has_begun, const Render& render) {
    for (;;) try {
            return render();
        } catch (const Error& error) {
            if (error.kind() != ErrorKind::limit || has_begun() || !device.use_smaller_batches())
                throw;
        }
}

}  // namespace voxelume
