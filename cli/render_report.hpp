// What a render came to: the summary line, -v and --stats-json.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "runtime/render/renderer.hpp"

namespace voxelume::cli {

struct FrameReport {
    int frame = 1;
    size_t device = 0;  ///< its number among the outcome's
    RenderReport report;
};

struct Outcome {
    const std::vector<Device>& devices;
    const std::vector<FrameReport>& frames;
    glm::ivec2 size;  ///< pixels
    size_t files;
    double open_seconds;   ///< reading the scene, finding and opening devices
    double write_seconds;  ///< writing files, perhaps beside other work
    std::optional<int>
        one_by_one_from;  ///< frame from which on none overlapped, for want of memory
    double seconds;       ///< of all of it
};

void write_statistics(const std::string& path, const Outcome& outcome);
void print_summary(const Outcome& outcome);
void print_details(const Outcome& outcome);

}  // namespace voxelume::cli
