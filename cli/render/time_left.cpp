// SPDX-License-Identifier: Apache-2.0
#include "cli/render/time_left.hpp"

namespace voxelume::cli {

void TimeLeft::compiling(double now) {
    if (!compiling_since_) compiling_since_ = now;
}

void TimeLeft::advance(double now, double part) {
    if (compiling_since_) compile_ += now - *compiling_since_;
    compiling_since_.reset();
    part_ = part;
    now_ = now;
    if (has_begun_) return;
    has_begun_ = true;
    begun_part_ = part;
    begun_now_ = now;
    begun_compile_ = compile_;
}

std::optional<double> TimeLeft::seconds() const {
    constexpr double kMinPart = 0.02, kMinSeconds = 0.5;  // less would predict only noise
    if (part_ >= 1) return 0;
    const bool is_single = first_part_ <= 0;
    if (part_ < first_part_) return {};
    const double part = is_single ? part_ - begun_part_ : part_;
    const double work =
        is_single ? now_ - begun_now_ - (compile_ - begun_compile_) : now_ - compile_;
    if (part < kMinPart || work < kMinSeconds) return {};
    return work * (1 - part_) / part;
}

}  // namespace voxelume::cli
