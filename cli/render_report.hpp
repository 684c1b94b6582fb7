// What a render came to: the summary line, -v and --stats-json.
#pragma once

#include <string>
#include <vector>

#include "runtime/renderer.hpp"

namespace voxelume::cli {

struct FrameReport {
    int frame = 1;
    RenderReport report;
};

struct Outcome {
    const std::vector<Device>& devices;
    const std::vector<FrameReport>& frames;
    glm::ivec2 size;  ///< pixels
    size_t files;
    double seconds;
};

void write_statistics(const std::string& path, const Outcome& outcome);
void print_summary(const Outcome& outcome);
void print_details(const Outcome& outcome);

}  // namespace voxelume::cli
