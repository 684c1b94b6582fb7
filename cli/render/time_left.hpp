// SPDX-License-Identifier: Apache-2.0
// How long work will still take, as far as that can be known.
#pragma once

#include <optional>

namespace voxelume::cli {

/// Learns from the progress of a run; times are seconds since its start. Compiling kernels, which
/// happens once, is told apart: it says nothing about the rest of the work.
class TimeLeft {
  public:
    /// Nothing is foretold before `first_part` of the work is done: its parts, such as frames,
    /// begin with work that shows no progress. Work in a single part is measured from where it gets
    /// on.
    explicit TimeLeft(double first_part = 0) : first_part_(first_part) {}

    /// A kernel is compiled from now on, until there is progress.
    void compiling(double now);
    /// `part` of all is done.
    void advance(double now, double part);

    /// Empty while it isn't known.
    std::optional<double> seconds() const;
    /// What compiling took so far.
    double compile_seconds() const { return compile_; }
    /// What compiling took so far, including the kernel being compiled now.
    double compile_seconds(double now) const {
        return compile_ + (compiling_since_ ? now - *compiling_since_ : 0);
    }

  private:
    double first_part_;
    std::optional<double> compiling_since_;
    double compile_ = 0;
    double part_ = 0, now_ = 0;                                  ///< at the last progress
    double begun_part_ = 0, begun_now_ = 0, begun_compile_ = 0;  ///< at the first
    bool has_begun_ = false;
};

}  // namespace voxelume::cli
