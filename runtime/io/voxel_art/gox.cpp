// SPDX-License-Identifier: Apache-2.0
// Goxel's .gox: "GOX ", a version, then chunks: four letters, a length, the content and a checksum.
// BL16 is a block of 16 x 16 x 16 voxels as a PNG picture of 64 x 64 pixels, x fastest, then y.
// LAYR is a layer: blocks by their numbers and positions, then entries of a key and a value. Z is
// up.
#include <algorithm>
#include <map>
#include <set>

#include "runtime/io/image/png.hpp"
#include "runtime/io/voxel_art/byte_reader.hpp"
#include "runtime/io/voxel_art/cell_bricks.hpp"
#include "runtime/io/voxel_art/voxel_art.hpp"

namespace voxelume {
namespace {

constexpr size_t kBlockPixels = 64 * 64;
constexpr int kFarthestBlock = 1'000'000;  // voxels
constexpr size_t kMaxBlocks = 1 << 17;
constexpr size_t kBatch = 4096;  // pictures that are decoded together

using Pixels = std::vector<std::array<uint8_t, 4>>;

struct GoxBlock {
    size_t picture;  ///< number of the chunk BL16
    glm::ivec3 first;
};

class GoxReader {
  public:
    explicit GoxReader(const std::filesystem::path& path)
        : path_(path), file_(path), bytes_(read_all(file_)) {}

    VoxelArt read() {
        read_chunks();
        glm::ivec3 low(1 << 30), high(-(1 << 30));
        for (const GoxBlock& block : blocks_) {
            low = glm::min(low, block.first);
            high = glm::max(high, block.first + 16);
        }
        if (blocks_.empty()) file_.refuse("has no voxels to show");
        // Z up becomes Y up.
        CellBricks bricks({low.x, low.z, -high.y}, {high.x, high.z, -low.y}, file_);
        decoded_.resize(pictures_.size());
        decode_pictures();
        bricks.fill([&] {
            for (const GoxBlock& block : blocks_) set_block(block, bricks);
        });
        VoxelArt art{bricks.model(), high - low, {}};
        if (hidden_ > 0) art.notes.push_back(fmt::format("{} hidden layers, not shown", hidden_));
        if (layers_ > 1) art.notes.push_back(fmt::format("{} layers, shown as one", layers_));
        for (const auto& [letters, count] : others_)
            art.notes.push_back(fmt::format("{} chunks {}, not shown", count, letters));
        return art;
    }

  private:
    void read_chunks() {
        ByteReader reader(bytes_, file_);
        if (reader.take_bytes(4) != "GOX ") file_.refuse("not a Goxel file");
        const auto version = reader.take<int32_t>();
        if (version < 1 || version > 12)
            file_.refuse(fmt::format("a Goxel file of version {}, which isn't read", version));
        while (reader.left() > 0) {
            const std::string_view letters = reader.take_bytes(4);
            const std::string_view content = reader.take_bytes(reader.take<uint32_t>());
            reader.take<uint32_t>();  // the checksum, which Goxel writes as 0
            if (letters == "BL16") pictures_.push_back(content);
            if (letters == "LAYR") read_layer(ByteReader(content, file_));
            if (letters == "CAMR" || letters == "LIGH") ++others_[std::string(letters)];
        }
    }

    void read_layer(ByteReader reader) {
        const auto count = reader.take<uint32_t>();
        const size_t before = blocks_.size();
        std::set<std::array<int32_t, 3>> positions;
        for (uint32_t i = 0; i < count; ++i) {
            const auto numbers = reader.take<std::array<int32_t, 5>>();
            if (numbers[0] < 0 || size_t(numbers[0]) >= pictures_.size())
                file_.refuse("a layer has a block that the file lacks");
            const glm::ivec3 first(numbers[1], numbers[2], numbers[3]);
            for (int axis = 0; axis < 3; ++axis)
                if (first[axis] < -kFarthestBlock || first[axis] > kFarthestBlock)
                    file_.refuse("a block is too far away");
            if (!positions.insert({numbers[1], numbers[2], numbers[3]}).second)
                file_.refuse("a layer has two blocks at one place");
            if (blocks_.size() == kMaxBlocks)
                file_.refuse(fmt::format("has more than {} blocks", kMaxBlocks));
            blocks_.push_back({size_t(numbers[0]), first});
        }
        ++layers_;
        if (is_visible(reader)) return;
        ++hidden_;
        blocks_.resize(before);
    }

    static bool is_visible(ByteReader& reader) {
        while (reader.left() >= 4) {
            const std::string_view key = reader.take_bytes(reader.take<uint32_t>());
            if (key.empty()) break;
            const std::string_view value = reader.take_bytes(reader.take<uint32_t>());
            if (key == "visible" && !value.empty() && value[0] == 0) return false;
        }
        return true;
    }

    /// Decodes the pictures of visible layers, each once. Pictures without voxels are left out.
    void decode_pictures() {
        std::set<size_t> used;
        for (const GoxBlock& block : blocks_) used.insert(block.picture);
        const std::vector<size_t> numbers(used.begin(), used.end());
        for (size_t first = 0; first < numbers.size(); first += kBatch) {
            std::vector<std::span<const uint8_t>> pngs;
            pngs.reserve(kBatch);
            for (size_t i = first; i < std::min(first + kBatch, numbers.size()); ++i) {
                const std::string_view png = pictures_[numbers[i]];
                pngs.emplace_back(reinterpret_cast<const uint8_t*>(png.data()), png.size());
            }
            std::vector<Picture> pictures = parse_pngs(pngs, path_, kBlockPixels);
            for (size_t i = 0; i < pictures.size(); ++i)
                take_pixels(pictures[i].pixels, decoded_[numbers[first + i]]);
        }
    }

    void take_pixels(Pixels& from, Pixels& to) const {
        if (from.size() != kBlockPixels) file_.refuse("a block isn't a picture of 64 x 64 pixels");
        if (std::ranges::any_of(from, [](const auto& pixel) { return pixel[3] != 0; }))
            to = std::move(from);
    }

    void set_block(const GoxBlock& block, CellBricks& bricks) {
        const Pixels& pixels = decoded_[block.picture];
        for (size_t i = 0; i < pixels.size(); ++i) {
            const auto& [red, green, blue, alpha] = pixels[i];
            if (alpha == 0) continue;
            const glm::ivec3 v =
                block.first + glm::ivec3(int(i & 15), int(i >> 4 & 15), int(i >> 8));
            bricks.set({v.x, v.z, -1 - v.y},
                       uint32_t(red | green << 8 | blue << 16) | uint32_t(255 - alpha) << 24);
        }
    }

    const std::filesystem::path& path_;
    const InputFile file_;
    std::string bytes_;
    std::vector<std::string_view> pictures_;
    std::vector<Pixels> decoded_;  ///< by picture
    std::vector<GoxBlock> blocks_;
    std::map<std::string, int> others_;
    int layers_ = 0, hidden_ = 0;
};

}  // namespace

VoxelArt read_gox(const std::filesystem::path& path) {
    return GoxReader(path).read();
}

}  // namespace voxelume
