// SPDX-License-Identifier: Apache-2.0
#include "runtime/stages/medium/density_grid.hpp"

#include <algorithm>
#include <array>
#include <bit>
#include <map>
#include <span>
#include <utility>
#include <vector>

#include "runtime/base/error.hpp"
#include "runtime/base/ranges.hpp"
#include "runtime/stages/medium/density_lattice.hpp"

namespace voxelume {
namespace {

/// The maximum number of slots: a cell's index, slot * 4096 + cell, is a 32-bit number.
constexpr double kMaxSlots = 1 << 20;
/// If cells have colours, three times a cell's index must be a 32-bit number, too.
constexpr double kMaxColoredSlots = 1 << 18;
/// The number of bricks that are sampled before they are written to the device together.
constexpr size_t kBricksAtOnce = 64;

/// Numbers the distinct constant densities.
class ConstantTable {
  public:
    uint32_t word(float density) {
        const auto number = uint32_t(values_.size());
        const auto [entry, added] = numbers_.try_emplace(std::bit_cast<uint32_t>(density), number);
        if (added) values_.push_back(density);
        return VXL_DENSITY_CONSTANT | 4u << VXL_DENSITY_SIZE_SHIFT | entry->second;
    }
    const std::vector<float>& values() const { return values_; }

  private:
    std::map<uint32_t, uint32_t> numbers_;
    std::vector<float> values_;
};

/// The slots that a lattice needs: first for constants, then for bricks. Every brick may turn out
/// to have a constant density of its own.
struct SlotCount {
    size_t constants = 0, bricks = 0;

    size_t total() const { return constants + bricks; }
};

SlotCount count_slots(const DensityLattice& lattice) {
    SlotCount slots;
    ConstantTable constants;
    for (size_t number = 0; number < lattice.brick_count(); ++number) {
        if (const auto density = lattice.constant_in(number))
            constants.word(*density);
        else
            ++slots.bricks;
    }
    slots.constants = (constants.values().size() + slots.bricks + kBrickCells - 1) / kBrickCells;
    return slots;
}

/// Marks the bricks of each aligned cube of `edge` bricks as a larger cube if all have one word.
void join_constants(std::vector<uint32_t>& words, const glm::ivec3& bricks, int edge,
                    uint32_t log2_size) {
    const auto at = [&](int x, int y, int z) -> uint32_t& {
        return words[(size_t(z) * bricks.y + y) * bricks.x + x];
    };
    for (int z = 0; z < bricks.z; z += edge)
        for (int y = 0; y < bricks.y; y += edge)
            for (int x = 0; x < bricks.x; x += edge) {
                const glm::ivec3 end = glm::min(glm::ivec3(x, y, z) + edge, bricks);
                const auto for_each = [&](const auto& action) {
                    for (int k = z; k < end.z; ++k)
                        for (int j = y; j < end.y; ++j)
                            for (int i = x; i < end.x; ++i) action(at(i, j, k));
                };
                const uint32_t word = at(x, y, z);
                bool one = (word & VXL_DENSITY_CONSTANT) != 0;
                for_each([&](uint32_t other) { one &= other == word; });
                const uint32_t joined = VXL_DENSITY_CONSTANT | log2_size << VXL_DENSITY_SIZE_SHIFT |
                                        (word & VXL_DENSITY_SLOT);
                if (one) for_each([&](uint32_t& other) { other = joined; });
            }
}

/// Samples bricks, several at once, and writes those with varying density to their slots.
class BrickWriter {
  public:
    BrickWriter(const DensityLattice& lattice, ConstantTable& constants, size_t first_slot,
                DensityGrid& grid)
        : lattice_(lattice),
          constants_(constants),
          next_slot_(first_slot),
          grid_(grid),
          words_(lattice.brick_count()) {}

    /// The entry of each brick: its slot or its constant density.
    std::vector<uint32_t> write() {
        for (size_t number = 0; number < words_.size(); ++number) {
            if (const auto density = lattice_.constant_in(number))
                words_[number] = constants_.word(*density);
            else
                waiting_.push_back(number);
            if (waiting_.size() == kBricksAtOnce) write_waiting();
        }
        write_waiting();
        return std::move(words_);
    }

  private:
    std::span<float> values_of(size_t brick) {
        return std::span(values_).subspan(brick * kBrickCells, kBrickCells);
    }
    std::span<float> colors_of(size_t brick) {
        if (!lattice_.has_colors()) return {};
        return std::span(colors_).subspan(3 * brick * kBrickCells, 3 * kBrickCells);
    }

    /// True if a brick's density is constant. With colours, only bricks without density are: their
    /// colours are invisible.
    bool is_constant(std::span<const float> values) const {
        return (values.front() == 0 || !lattice_.has_colors()) &&
               std::ranges::all_of(values, [&](float value) { return value == values.front(); });
    }

    void write_waiting() {
        values_.resize(waiting_.size() * kBrickCells);
        if (lattice_.has_colors()) colors_.resize(3 * values_.size());
        for_ranges(int(waiting_.size()), values_.size(), [&](int first, int end) {
            for (size_t i = size_t(first); i < size_t(end); ++i)
                lattice_.sample(waiting_[i], values_of(i).first<kBrickCells>(), colors_of(i));
        });
        size_t kept = 0;
        for (size_t i = 0; i < waiting_.size(); ++i) {
            if (is_constant(values_of(i))) {
                words_[waiting_[i]] = constants_.word(values_of(i).front());
                continue;
            }
            words_[waiting_[i]] = uint32_t(next_slot_ + kept);
            if (kept != i) {
                std::ranges::copy(values_of(i), values_of(kept).begin());
                std::ranges::copy(colors_of(i), colors_of(kept).begin());
            }
            ++kept;
        }
        values_.resize(kept * kBrickCells);
        grid_.values.write(values_, next_slot_ * kBrickCells);
        if (lattice_.has_colors()) {
            colors_.resize(3 * values_.size());
            grid_.colors.write(colors_, 3 * next_slot_ * kBrickCells);
        }
        next_slot_ += kept;
        waiting_.clear();
    }

    const DensityLattice& lattice_;
    ConstantTable& constants_;
    size_t next_slot_;
    DensityGrid& grid_;
    std::vector<uint32_t> words_;
    std::vector<size_t> waiting_;         ///< numbers of bricks that are sampled together
    std::vector<float> values_, colors_;  ///< theirs
};

}  // namespace

void bind(KernelArguments& to, const DensityGrid& grid) {
    to.add(grid.shape, grid.bricks, grid.values);
}

bool has_no_medium(const World& world) {
    return has_density(world.medium) && DensityLattice(world).is_zero();
}

DensityPlan plan_density(const World& world, bool scatters) {
    if (!has_density(world.medium)) return {};
    if (!scatters && world.medium.absorption == glm::vec3(0)) return {};
    const DensityLattice lattice(world);
    if (lattice.is_zero()) return {.is_zero = true};
    const SlotCount slots = count_slots(lattice);
    if (double(slots.total()) > (lattice.has_colors() ? kMaxColoredSlots : kMaxSlots))
        throw Error(ErrorKind::limit,
                    "{}.medium: the density differs in more than 2^{} bricks of 16x16x16 voxels: "
                    "use larger voxels",
                    world.where, lattice.has_colors() ? 18 : 20);
    const Device counting = Device::counting({});
    const DensityGrid grid =
        allocate_density(counting, {slots.total(), lattice.brick_count(), lattice.has_colors()});
    const DeviceCounters& counters = counting.counters();
    return {
        lattice.bricks(),
        false,
        {slots.total(), lattice.brick_count(), lattice.has_colors()},
        double(slots.bricks),
        double(counters.largest_bytes),
        double(counters.bytes_in_use),
        double(lattice.brick_count() * sizeof(uint32_t)) + lattice.field_bytes() +
            double(kBricksAtOnce * kBrickCells) * (lattice.has_colors() ? 4 : 1) * sizeof(float)};
}

DensityGrid allocate_density(const Device& device, const DensitySize& size) {
    DensityGrid grid;
    grid.values = Buffer<float>(device, "medium densities", size.slots * kBrickCells);
    if (size.has_colors)
        grid.colors = Buffer<float>(device, "medium colors", 3 * size.slots * kBrickCells);
    grid.bricks = Buffer<uint32_t>(device, "medium bricks", size.bricks);
    return grid;
}

DensityGrid form_density_grid(const Device& device, const World& world,
                              const std::vector<Light>& lights) {
    const DensityLattice lattice(world, lights);
    const SlotCount slots = count_slots(lattice);
    DensityGrid grid =
        allocate_density(device, {slots.total(), lattice.brick_count(), lattice.has_colors()});
    ConstantTable constants;
    std::vector<uint32_t> words = BrickWriter(lattice, constants, slots.constants, grid).write();
    grid.values.write(constants.values());
    // Kernels read colours whenever another lane needs one; multiplied by 0 they must give 0.
    if (lattice.has_colors())
        grid.colors.write(std::vector<float>(3 * slots.constants * kBrickCells), 0);
    join_constants(words, lattice.bricks(), 4, 6);
    join_constants(words, lattice.bricks(), 16, 8);
    grid.bricks.write(words);
    const glm::ivec3 &bricks = lattice.bricks(), &shift = lattice.shift();
    grid.shape = {bricks.x, bricks.y, shift.x, shift.y, shift.z, {}};
    return grid;
}

}  // namespace voxelume
