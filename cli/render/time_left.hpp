// SPDX-License-Identifier: Apache-2.0
// Estimates how long work will still take.
#pragma once

#include <optional>

namespace voxelume::cli {

/// Learns from the progress of a run; times are seconds since its start. The compilation of
/// kernels, which happens once, is measured separately, because it says nothing about the rest of
/// the work.
class TimeLeft {
  public:
    /// Predicts nothing before `first_part` of the work is done: its parts, such as frames, begin
    /// with work that shows no progress. Work in a single part is measured from its first progress
    /// on.
    explicit TimeLeft(double first_part = 0) : first_part_(first_part) {}

    /// A kernel is being compiled from now on, until there is progress.
    void compiling(double now);
    /// `part` of the whole work is done.
    void advance(double now, double part);

    /// The seconds left; empty while they are unknown.
    std::optional<double> seconds() const;
    /// The seconds spent on compiling so far.
    double compile_seconds() const { return compile_; }
    /// The seconds spent on compiling so far, including the kernel that is being compiled now.
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
