// SPDX-License-Identifier: Apache-2.0
// Qubicle's .qb. A header of six words: version, order of the colours, whether Z points towards the
// observer, whether the matrices are compressed, whether the fourth byte of a colour tells which
// faces are visible, and the number of matrices. Each matrix has a name, sizes, a position and its
// cells, x fastest, then y. In compressed files, each slice is a list of words: 6 ends it, and 2 is
// followed by a count and the word that is repeated.
#include <algorithm>
#include <glm/common.hpp>

#include "runtime/io/voxel_art/byte_reader.hpp"
#include "runtime/io/voxel_art/cell_bricks.hpp"
#include "runtime/io/voxel_art/voxel_art.hpp"

namespace voxelume {
namespace {

constexpr uint32_t kRepeat = 2, kNextSlice = 6;
constexpr uint32_t kMaxMatrices = 100'000;
constexpr uint64_t kMaxColored = uint64_t{1} << 28;
constexpr int kFarthest = 1'000'000;  // voxels

struct QbHeader {
    uint32_t version, colors, towards_observer, is_compressed, has_masks, matrices;
};
static_assert(sizeof(QbHeader) == 24);

/// Reads the matrices twice: first to measure them and then to set their voxels.
class QbReader {
  public:
    explicit QbReader(const std::filesystem::path& path) : file_(path), bytes_(read_all(file_)) {}

    VoxelArt read() {
        read_matrices(true);
        if (low_.x >= high_.x) file_.refuse("has no voxels to show");
        CellBricks bricks(low_, high_, file_);
        bricks_ = &bricks;
        bricks.fill([&] { read_matrices(false); });
        VoxelArt art{bricks.model(), high_ - low_, {}};
        if (header_.matrices > 1)
            art.notes.push_back(fmt::format("{} matrices, shown as one", header_.matrices));
        return art;
    }

  private:
    void read_matrices(bool measures) {
        ByteReader reader(bytes_, file_);
        header_ = reader.take<QbHeader>();
        if (header_.colors > 1 || header_.towards_observer > 1 || header_.is_compressed > 1 ||
            header_.has_masks > 1)
            file_.refuse("not a Qubicle file of a kind that is read");
        if (header_.matrices > kMaxMatrices)
            file_.refuse(fmt::format("has {} matrices, {} at most are possible", header_.matrices,
                                     kMaxMatrices));
        for (uint32_t i = 0; i < header_.matrices; ++i) read_matrix(reader, measures);
    }

    void read_matrix(ByteReader& reader, bool measures) {
        reader.take_bytes(reader.take<uint8_t>());
        const auto size = reader.take<std::array<uint32_t, 3>>();
        const auto position = reader.take<std::array<int32_t, 3>>();
        for (size_t axis = 0; axis < 3; ++axis)
            if (size[axis] > 65536 || std::abs(int64_t(position[axis])) > kFarthest)
                file_.refuse("a matrix is too large or too far away; it is damaged");
        size_ = glm::ivec3(int(size[0]), int(size[1]), int(size[2]));
        first_ = glm::ivec3(position[0], position[1], position[2]);
        if (measures && std::min({size_.x, size_.y, size_.z}) > 0) {
            low_ = glm::min(low_, cell(glm::ivec3(0)));
            low_ = glm::min(low_, cell(size_ - 1));
            high_ = glm::max(high_, cell(glm::ivec3(0)) + 1);
            high_ = glm::max(high_, cell(size_ - 1) + 1);
        }
        if ((size_.x == 0 || size_.y == 0) && !header_.is_compressed) return;
        for (int z = 0; z < size_.z; ++z)
            header_.is_compressed ? read_compressed_slice(reader, z, measures)
                                  : read_slice(reader, z, measures);
    }

    /// Maps a cell: Z points towards the observer, as in scenes, or away.
    glm::ivec3 cell(const glm::ivec3& v) const {
        const glm::ivec3 at = first_ + v;
        return {at.x, at.y, header_.towards_observer ? at.z : -1 - at.z};
    }

    void read_slice(ByteReader& reader, int z, bool measures) {
        const size_t count = size_t(size_.x) * size_t(size_.y);
        if (count > reader.left() / 4) file_.refuse("the file ends too early; it is truncated");
        const std::string_view words = reader.take_bytes(4 * count);
        if (measures) return;
        for (size_t i = 0; i < count; ++i) {
            uint32_t word = 0;
            std::memcpy(&word, words.data() + 4 * i, 4);
            set(i, z, word);
        }
    }

    void read_compressed_slice(ByteReader& reader, int z, bool measures) {
        const uint64_t count = uint64_t(size_.x) * uint64_t(size_.y);
        uint64_t at = 0;
        for (uint32_t word = reader.take<uint32_t>(); word != kNextSlice;
             word = reader.take<uint32_t>()) {
            uint32_t repeats = 1;
            if (word == kRepeat) {
                repeats = reader.take<uint32_t>();
                word = reader.take<uint32_t>();
            }
            if (repeats > count - at) file_.refuse("a slice has more cells than its matrix");
            if (measures && word >> 24 != 0) colored_ += repeats;
            if (colored_ > kMaxColored)
                file_.refuse(fmt::format("has more than {} cells with a colour", kMaxColored));
            for (uint32_t i = 0; i < repeats && !measures && word >> 24 != 0; ++i)
                set(at + i, z, word);
            at += repeats;
        }
    }

    void set(uint64_t index, int z, uint32_t word) {
        if (word >> 24 == 0) return;
        const int x = int(index % uint64_t(size_.x)), y = int(index / uint64_t(size_.x));
        const uint32_t color = header_.colors == 0
                                   ? word & 0xFFFFFF
                                   : (word & 0xFF) << 16 | (word & 0xFF00) | (word >> 16 & 0xFF);
        bricks_->set(cell({x, y, z}), color);
    }

    const InputFile file_;
    std::string bytes_;
    QbHeader header_{};
    glm::ivec3 size_{0}, first_{0};  ///< box of the current matrix
    glm::ivec3 low_{1 << 30}, high_{-(1 << 30)};
    uint64_t colored_ = 0;  ///< cells of compressed matrices, which may be many for few bytes
    CellBricks* bricks_ = nullptr;
};

}  // namespace

VoxelArt read_qb(const std::filesystem::path& path) {
    return QbReader(path).read();
}

}  // namespace voxelume
