// SPDX-License-Identifier: Apache-2.0
// One job of `render`: renders a scene to its files.
#pragma once

#include <string>
#include <vector>

#include "cli/render/frame_files.hpp"
#include "cli/render/render_progress.hpp"

namespace voxelume::cli {

/// The devices of a selector. They are opened once, after the first scene to render was read.
class LazyDevices {
  public:
    explicit LazyDevices(std::string selector) : selector_(std::move(selector)) {}
    const std::vector<Device>& open();
    const std::string& selector() const { return selector_; }

  private:
    std::string selector_;
    std::vector<Device> devices_;
};

/// The style of progress. `-q` silences only the automatic style.
ProgressStyle style_of(const RenderCommand& command);

/// Reads the command's scene and writes what the command asks for, or plans it. `label` precedes
/// the progress bar. Throws Error.
void render_job(const RenderCommand& command, LazyDevices& lazy_devices, const std::string& label);

}  // namespace voxelume::cli
