// SPDX-License-Identifier: Apache-2.0
// Computes what cubes enclose by following rows of empty voxels from the lattice's outside.
#include <algorithm>
#include <glm/vec2.hpp>
#include <vector>

#include "runtime/verify/bench/bench_extent.hpp"
#include "runtime/verify/bench/pyramid_voxels.hpp"

namespace voxelume {
namespace {

/// The voxels first .. last - 1 of a row along x, all of them empty.
struct Run {
    int first = 0, last = 0;
    bool is_outside = false;
};

/// All empty voxels of a lattice, as runs.
class EmptyRuns {
  public:
    explicit EmptyRuns(const Pyramid& pyramid) {
        const PyramidPart part = shown_part(pyramid);
        size_ = part.frame.size;
        const size_t words = (size_t(size_.x) + 63) / 64;
        std::vector<uint64_t> filled(words * size_t(size_.y) * size_t(size_.z));
        for_voxels(pyramid, part, [&](const glm::ivec3& v, uint32_t) {
            filled[row_of(v.y, v.z) * words + size_t(v.x / 64)] |= uint64_t(1) << v.x % 64;
        });
        starts_.push_back(0);
        for (size_t row = 0; row < size_t(size_.y) * size_t(size_.z); ++row) {
            add_row(&filled[row * words]);
            starts_.push_back(runs_.size());
        }
    }

    /// Marks the runs that can be reached from the lattice's outside through faces.
    void mark_outside() {
        for (int z = 0; z < size_.z; ++z)
            for (int y = 0; y < size_.y; ++y) {
                const bool is_border = y == 0 || z == 0 || y + 1 == size_.y || z + 1 == size_.z;
                for (size_t i = starts_[row_of(y, z)]; i < starts_[row_of(y, z) + 1]; ++i)
                    if (is_border || runs_[i].first == 0 || runs_[i].last == size_.x)
                        reach(i, y, z);
            }
        while (!waiting_.empty()) {
            const Waiting run = waiting_.back();
            waiting_.pop_back();
            for (const glm::ivec2 step : {glm::ivec2{1, 0}, {-1, 0}, {0, 1}, {0, -1}})
                reach_neighbour(runs_[run.number], run.y + step.x, run.z + step.y);
        }
    }

    /// The extent of everything that wasn't reached.
    Extent enclosed() const {
        double cells = double(size_.x) * size_.y * size_.z, faces = 0;
        for (const Run& run : runs_) {
            if (!run.is_outside) continue;
            cells -= run.last - run.first;
            faces += (run.first > 0) + (run.last < size_.x);
        }
        for (int z = 0; z < size_.z; ++z)
            for (int y = 0; y < size_.y; ++y) {
                if (y + 1 < size_.y) faces += differing(row_of(y, z), row_of(y + 1, z));
                if (z + 1 < size_.z) faces += differing(row_of(y, z), row_of(y, z + 1));
            }
        return {cells, faces};
    }

  private:
    struct Waiting {
        size_t number;
        int y, z;
    };

    size_t row_of(int y, int z) const { return size_t(y) + size_t(z) * size_t(size_.y); }

    void add_row(const uint64_t* filled) {
        const auto is_filled = [&](int x) { return (filled[x / 64] >> x % 64 & 1) != 0; };
        for (int x = 0; x < size_.x;) {
            while (x < size_.x && is_filled(x)) ++x;
            const int first = x;
            while (x < size_.x && !is_filled(x)) x += x % 64 == 0 && filled[x / 64] == 0 ? 64 : 1;
            x = std::min(x, size_.x);
            if (first < x) runs_.push_back({first, x, false});
        }
    }

    void reach(size_t number, int y, int z) {
        if (runs_[number].is_outside) return;
        runs_[number].is_outside = true;
        waiting_.push_back({number, y, z});
    }

    void reach_neighbour(const Run run, int y, int z) {
        if (y < 0 || z < 0 || y >= size_.y || z >= size_.z) return;
        for (size_t i = starts_[row_of(y, z)]; i < starts_[row_of(y, z) + 1]; ++i)
            if (runs_[i].first < run.last && run.first < runs_[i].last) reach(i, y, z);
    }

    /// The number of faces between two rows that have the outside on one side only.
    double differing(size_t row, size_t other) const {
        double faces = 0;
        for (size_t i = starts_[row]; i < starts_[row + 1]; ++i) {
            if (!runs_[i].is_outside) continue;
            faces += runs_[i].last - runs_[i].first;
            for (size_t k = starts_[other]; k < starts_[other + 1]; ++k)
                if (runs_[k].is_outside)
                    faces -= 2 * std::max(0, std::min(runs_[i].last, runs_[k].last) -
                                                 std::max(runs_[i].first, runs_[k].first));
        }
        for (size_t k = starts_[other]; k < starts_[other + 1]; ++k)
            if (runs_[k].is_outside) faces += runs_[k].last - runs_[k].first;
        return faces;
    }

    glm::ivec3 size_{0};
    std::vector<Run> runs_;
    std::vector<size_t> starts_;  ///< first run of each row; rows are in the order of y, then z
    std::vector<Waiting> waiting_;
};

}  // namespace

Extent cubes_extent(const Pyramid& pyramid) {
    EmptyRuns runs(pyramid);
    runs.mark_outside();
    return runs.enclosed();
}

}  // namespace voxelume
