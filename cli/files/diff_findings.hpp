// SPDX-License-Identifier: Apache-2.0
// What `diff` has found: a report, and what makes it fail.
#pragma once

#include <optional>
#include <string>

#include "cli/files/diff_files.hpp"
#include "cli/files/diff_limits.hpp"
#include "cli/shared/report.hpp"
#include "runtime/voxelume.hpp"

namespace voxelume::cli {

/// The findings of one comparison, or of those of an animation's frames.
class DiffFindings {
  public:
    /// Rows of frames have all that is known of them if they are printed `as_json`.
    DiffFindings(const DiffLimits& limits, bool is_animation, bool as_json)
        : limits_(limits), is_animation_(is_animation), as_json_(as_json) {}

    void add(const DiffFiles& files, const ImageDifference& difference);

    /// Lists a frame that can't be compared; the others are compared all the same.
    void add_failure(const DiffFiles& files, const Error& error);

    const Report& report() const { return report_; }

    /// Throws what makes the comparison fail. Frames that can't be compared count more than limits.
    void throw_faults() const;

  private:
    DiffLimits limits_;
    bool is_animation_;
    bool as_json_;
    Report report_;
    std::optional<std::string> excess_;  ///< the first limit that is exceeded
    std::optional<Error> failure_;       ///< of the first frame that can't be compared
};

}  // namespace voxelume::cli
