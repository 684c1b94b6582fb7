// SPDX-License-Identifier: Apache-2.0
// Reads the summary of a KV6 file of any program and checks it against all bytes of the file; see
// volume_kv6.cpp for the format. Some programs add "SPal" and a palette of 256 colours of 6 bits.
#include "runtime/io/volume/volume_kv6_read.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstring>
#include <vector>

#include "runtime/base/files/input_file.hpp"

namespace voxelume {
namespace {

constexpr uint64_t kHeadBytes = 32, kVoxelBytes = 8, kPaletteBytes = 4 + 768;
constexpr int32_t kMaxEdge = 1 << 16;  // z has 16 bits

/// Reads values one after another, a block at a time.
template <class Value>
class ValueReader {
  public:
    ValueReader(const InputFile& file, uint64_t position) : file_(file), position_(position) {}

    Value next() {
        if (at_ == block_.size()) refill();
        return block_[at_++];
    }

  private:
    void refill() {
        const uint64_t left = (file_.size() - position_) / sizeof(Value);
        block_.resize(std::min<uint64_t>(left, (1 << 16) / sizeof(Value)));
        if (block_.empty()) file_.refuse("the file ends too early; it is truncated");
        file_.read(position_, block_.data(), block_.size() * sizeof(Value));
        position_ += block_.size() * sizeof(Value);
        at_ = 0;
    }

    const InputFile& file_;
    uint64_t position_;
    std::vector<Value> block_;
    size_t at_ = 0;
};

struct Voxel {
    std::array<uint8_t, 4> color;
    uint16_t z;
    uint8_t faces, normal;
};
static_assert(sizeof(Voxel) == kVoxelBytes);

Kv6Summary read_head(const InputFile& file) {
    std::array<int32_t, 8> words{};  // magic, sizes, pivot, voxels
    file.read(0, words.data(), std::min<uint64_t>(file.size(), sizeof words));
    if (std::memcmp(words.data(), "Kvxl", 4) != 0) file.refuse("not a KV6 file");
    if (file.size() < kHeadBytes) file.refuse("the file ends too early; it is truncated");
    std::array<float, 3> pivot{};
    std::memcpy(pivot.data(), &words[4], sizeof pivot);
    for (int axis = 0; axis < 3; ++axis) {
        if (words[size_t(axis) + 1] < 1 || words[size_t(axis) + 1] > kMaxEdge)
            file.refuse(fmt::format("its size along {} is {}; it is damaged", "xyz"[axis],
                                    words[size_t(axis) + 1]));
        if (!std::isfinite(pivot[size_t(axis)])) file.refuse("its pivot is no number");
    }
    if (words[7] < 0) file.refuse(fmt::format("it has {} voxels; it is damaged", words[7]));
    return {{words[1], words[2], words[3]}, uint64_t(words[7]), false};
}

/// Checks that the file has the bytes that its head declares, and nothing else but a palette.
void check_size(const InputFile& file, Kv6Summary& kv6) {
    const auto [x, y, z] = kv6.size;
    const uint64_t bytes =
        kHeadBytes + kv6.voxels * kVoxelBytes + 4 * uint64_t(x) + 2 * uint64_t(x) * uint64_t(y);
    kv6.has_palette = file.size() == bytes + kPaletteBytes;
    if (file.size() != bytes && !kv6.has_palette)
        file.refuse(
            fmt::format("its {} x {} columns and {} voxels take {} bytes, and it has {}; it is "
                        "damaged",
                        x, y, kv6.voxels, bytes, file.size()));
    if (!kv6.has_palette) return;
    std::array<uint8_t, kPaletteBytes> palette{};
    file.read(bytes, palette.data(), palette.size());
    if (std::memcmp(palette.data(), "SPal", 4) != 0)
        file.refuse("what follows its columns is no palette");
    if (std::any_of(palette.begin() + 4, palette.end(), [](uint8_t code) { return code > 63; }))
        file.refuse("its palette has colours of more than 6 bits");
}

/// Checks one column's voxels: they lie inside the model, from top to bottom, with a visible face.
void check_column(const InputFile& file, const Kv6Summary& kv6, uint16_t count,
                  ValueReader<Voxel>& voxels) {
    int last = -1;
    for (uint16_t i = 0; i < count; ++i) {
        const Voxel voxel = voxels.next();
        if (voxel.z >= kv6.size[2])
            file.refuse(
                fmt::format("a voxel has z {}, and the model ends at {}", voxel.z, kv6.size[2]));
        if (voxel.z <= last) file.refuse("the voxels of a column aren't in order");
        if (voxel.faces > 63) file.refuse("a voxel has more than six faces");
        last = voxel.z;
    }
}

void check_columns(const InputFile& file, const Kv6Summary& kv6) {
    const auto [x, y, z] = kv6.size;
    ValueReader<Voxel> voxels(file, kHeadBytes);
    ValueReader<uint32_t> of_x(file, kHeadBytes + kv6.voxels * kVoxelBytes);
    ValueReader<uint16_t> of_xy(file, kHeadBytes + kv6.voxels * kVoxelBytes + 4 * uint64_t(x));
    uint64_t total = 0;
    for (int32_t i = 0; i < x; ++i) {
        uint64_t sum = 0;
        for (int32_t j = 0; j < y; ++j) {
            const uint16_t count = of_xy.next();
            sum += count;
            if (total + sum > kv6.voxels) file.refuse("its columns have more voxels than it");
            check_column(file, kv6, count, voxels);
        }
        if (sum != of_x.next()) file.refuse("the counts of its voxels don't agree");
        total += sum;
    }
    if (total != kv6.voxels) file.refuse("its columns have fewer voxels than it");
}

}  // namespace

Kv6Summary read_kv6_summary(const std::filesystem::path& path) {
    const InputFile file(path);
    Kv6Summary kv6 = read_head(file);
    check_size(file, kv6);
    check_columns(file, kv6);
    return kv6;
}

}  // namespace voxelume
