// SPDX-License-Identifier: Apache-2.0
// warnings of a scene and of its rendered frames -> each once, to whoever hears them
#pragma once

#include <span>
#include <vector>

#include "runtime/base/warning.hpp"
#include "runtime/batch/render_frames.hpp"
#include "runtime/render/shown_content.hpp"

namespace voxelume {

/// The warnings of a run.
class RunWarnings {
  public:
    /// Passes to `warn` what is known before the first frame. The cache is for `end`.
    RunWarnings(std::vector<Warning> before, ModelCache cache, BatchWarnings warn);

    /// Takes note of a rendered frame.
    void add(const FrameResult& result);

    /// Passes on the warnings that frames added, and warns of what no frame shows, unless the
    /// frames are a part of a run or the images parts of their frames.
    void end(const Scene& scene, std::span<const int> frames, bool is_part);

  private:
    bool has(WarningKind kind) const;
    void add_view_warning(const Scene& scene);
    void add_light_warning(const Scene& scene);

    std::vector<Warning> warnings_;
    std::vector<SourcePlace> lost_;  ///< places of objects that had no voxels in some frame
    size_t told_ = 0;                ///< number of the first warnings, which `warn_` knows
    ModelCache cache_;
    BatchWarnings warn_;
    ShownContent content_{false, false};
};

}  // namespace voxelume
