// SPDX-License-Identifier: Apache-2.0
// Minecraft's schematics: named binary tags, most of them in gzip. Cells are numbered x fastest,
// then z, then y. X is east, Y up, Z south.
//
// MCEdit's .schematic has a number of 8 bits for each block, 4 more in AddBlocks, and 4 bits of
// data. Sponge's .schem has a palette of names and numbers of 7 bits a byte. Litematica's
// .litematic has regions, each with a list of names, and numbers with just enough bits for the
// list, packed in longs.
#include <algorithm>
#include <bit>
#include <glm/common.hpp>
#include <set>

#include "runtime/io/voxel_art/block_colors.hpp"
#include "runtime/io/voxel_art/byte_reader.hpp"
#include "runtime/io/voxel_art/cell_bricks.hpp"
#include "runtime/io/voxel_art/nbt.hpp"
#include "runtime/io/voxel_art/voxel_art.hpp"

namespace voxelume {
namespace {

using Kind = NbtValue::Kind;

constexpr size_t kMaxTags = size_t{1} << 29;             // bytes
constexpr uint64_t kMaxRegionCells = uint64_t{1} << 30;  // over all regions
constexpr size_t kMaxBlockName = 256;                    // bytes
constexpr int64_t kMaxSide = 65536, kFarthestRegion = 1'000'000;
constexpr uint32_t kNoBlock = 0xFFFFFFFF;

/// A box of blocks whose numbers come from a function.
struct Region {
    glm::ivec3 first{0}, size{0};
    std::vector<uint32_t> colors;  ///< by the number; kNoBlock for air
    const NbtValue* data = nullptr;
    bool is_air() const {
        return std::ranges::all_of(colors, [](uint32_t color) { return color == kNoBlock; });
    }
    uint64_t cells() const { return uint64_t(size.x) * uint64_t(size.y) * uint64_t(size.z); }
};

class SchematicReader {
  public:
    explicit SchematicReader(const std::filesystem::path& path)
        : file_(path),
          bytes_(read_all_inflated(file_, kMaxTags)),
          root_(parse_nbt(bytes_, file_)) {}

    VoxelArt read() {
        const NbtValue* inner = root_.find("Schematic");
        const NbtValue& schematic = inner && inner->kind == Kind::compound ? *inner : root_;
        if (root_.find("Regions"))
            read_regions();
        else if (schematic.find("Palette") || schematic.find("Blocks") == nullptr ||
                 schematic.find("Blocks")->kind == Kind::compound)
            read_sponge(schematic);
        else
            read_mcedit(schematic);
        return finish();
    }

  private:
    /// Allocates memory for the regions, and calls the function that sets their blocks.
    template <class SetAll>
    void set_regions(const SetAll& set_all) {
        glm::ivec3 low(1 << 30), high(-(1 << 30));
        for (const Region& region : regions_) {
            if (region.cells() == 0) continue;
            low = glm::min(low, region.first);
            high = glm::max(high, region.first + region.size);
        }
        if (low.x >= high.x ||
            std::ranges::all_of(regions_, [](const Region& region) { return region.is_air(); }))
            file_.refuse("has no voxels to show");
        size_ = high - low;
        CellBricks bricks({0, 0, 0}, size_, file_);
        bricks.fill([&] {
            for (const Region& region : regions_) {
                origin_ = region.first - low;
                if (!region.is_air()) set_all(region, bricks);
            }
        });
        model_ = bricks.model();
    }

    glm::ivec3 size_of(const NbtValue& of) const {
        glm::ivec3 size;
        constexpr std::array<std::string_view, 3> kNames = {"Width", "Height", "Length"};
        for (int axis = 0; axis < 3; ++axis) {
            // Lengths are unsigned in this format.
            const int64_t n = of.whole(kNames[size_t(axis)], file_) & 0xFFFF;
            if (n < 1) file_.refuse("has no blocks");
            size[axis] = int(n);
        }
        return size;
    }

    void check(const Region& region) {
        cells_ += region.cells();
        if (cells_ > kMaxRegionCells)
            file_.refuse(
                fmt::format("has {} cells, {} at most are possible", cells_, kMaxRegionCells));
    }

    void set(const Region& region, uint64_t cell, uint64_t number, CellBricks& bricks) const {
        if (number >= region.colors.size()) file_.refuse("a block isn't in the palette");
        const uint32_t color = region.colors[size_t(number)];
        if (color == kNoBlock) return;
        const auto width = uint64_t(region.size.x), length = uint64_t(region.size.z);
        bricks.set(origin_ + glm::ivec3(int(cell % width), int(cell / width / length),
                                        int(cell / width % length)),
                   color);
    }

    uint32_t color_of(std::string_view name) {
        if (name.size() > kMaxBlockName)
            file_.refuse(fmt::format("a block's name has more than {} bytes", kMaxBlockName));
        const BlockColor block = block_color(name);
        if (block.is_air) return kNoBlock;
        if (!block.is_known) unknown_.insert(std::string(name.substr(0, name.find('['))));
        return block.color;
    }

    void read_mcedit(const NbtValue& root) {
        Region region;
        region.size = size_of(root);
        check(region);
        const std::string_view blocks = root.get("Blocks", Kind::bytes, file_).content,
                               data = root.get("Data", Kind::bytes, file_).content;
        const NbtValue* more = root.find("AddBlocks");
        const std::string_view high = more ? more->content : std::string_view();
        if (blocks.size() < region.cells() || data.size() < region.cells())
            file_.refuse("has fewer blocks than its size; it is damaged");
        // A number consists of the block's number, 12 bits, and its data, 4 bits.
        region.colors.assign(1 << 16, kNoBlock);
        std::vector<bool> is_seen(1 << 16);
        regions_.push_back(std::move(region));
        Region& only = regions_[0];
        const auto number_at = [&](size_t i) {
            const uint32_t half = i / 2 < high.size() ? uint8_t(high[i / 2]) : 0;
            return uint32_t(uint8_t(blocks[i])) | ((half >> (i % 2 ? 0 : 4)) & 15) << 8 |
                   uint32_t(data[i] & 15) << 12;
        };
        for (size_t i = 0; i < only.cells(); ++i) {
            const uint32_t number = number_at(i);
            if (is_seen[number]) continue;
            is_seen[number] = true;
            const std::string_view name = name_of_block(int(number & 4095), int(number >> 12));
            only.colors[number] =
                color_of(name.empty() ? fmt::format("block {}", number & 4095) : std::string(name));
        }
        set_regions([&](const Region& of, CellBricks& bricks) {
            for (size_t i = 0; i < of.cells(); ++i) set(of, i, number_at(i), bricks);
        });
    }

    void read_sponge(const NbtValue& root) {
        Region region;
        region.size = size_of(root);
        check(region);
        const NbtValue* blocks = root.find("Blocks");
        const bool is_third = blocks && blocks->kind == Kind::compound;
        const NbtValue& of = is_third ? *blocks : root;
        for (const auto& [name, number] : of.get("Palette", Kind::compound, file_).members) {
            if (number.number < 0 || number.number > 1 << 20)
                file_.refuse("its palette has a wrong number");
            if (size_t(number.number) >= region.colors.size())
                region.colors.resize(size_t(number.number) + 1, kNoBlock);
            region.colors[size_t(number.number)] = color_of(name);
        }
        const std::string_view data =
            of.get(is_third ? "Data" : "BlockData", Kind::bytes, file_).content;
        regions_.push_back(std::move(region));
        set_regions([&](const Region& only, CellBricks& bricks) {
            ByteReader reader(data, file_);
            for (uint64_t i = 0; i < only.cells(); ++i) {
                uint64_t number = 0;
                uint8_t byte = 0x80;
                for (int shift = 0; byte & 0x80; shift += 7) {
                    if (shift > 28) file_.refuse("a block's number has no end; it is damaged");
                    byte = reader.take<uint8_t>();
                    number |= uint64_t(byte & 0x7F) << shift;
                }
                set(only, i, number, bricks);
            }
        });
    }

    void read_regions() {
        for (const auto& [name, value] : root_.get("Regions", Kind::compound, file_).members) {
            Region region;
            const NbtValue &position = value.get("Position", Kind::compound, file_),
                           &size = value.get("Size", Kind::compound, file_);
            constexpr std::array<std::string_view, 3> kAxes = {"x", "y", "z"};
            for (int axis = 0; axis < 3; ++axis) {
                const int64_t at = position.whole(kAxes[size_t(axis)], file_),
                              n = size.whole(kAxes[size_t(axis)], file_);
                if (std::abs(at) > kFarthestRegion || std::abs(n) > kMaxSide)
                    file_.refuse("a region is too large or too far away");
                // A negative size counts back from the position, which is then that of the last
                // block.
                region.first[axis] = int(n < 0 ? at + n + 1 : at);
                region.size[axis] = int(std::abs(n));
            }
            check(region);
            const std::vector<NbtValue>& palette =
                value.get("BlockStatePalette", Kind::list, file_).items;
            if (palette.empty()) file_.refuse("a region has no palette");
            region.data = &value.get("BlockStates", Kind::longs, file_);
            if (region.data->longs() < (region.cells() * bits_for(palette.size()) + 63) / 64)
                file_.refuse("a region has fewer blocks than its size; it is damaged");
            for (const NbtValue& entry : palette)
                region.colors.push_back(color_of(entry.get("Name", Kind::text, file_).content));
            regions_.push_back(std::move(region));
        }
        set_regions([&](const Region& of, CellBricks& bricks) { set_packed(of, bricks); });
    }

    /// The number of bits of an index into a palette.
    static uint64_t bits_for(size_t names) {
        return uint64_t(std::max(2, int(std::bit_width(names - 1))));
    }

    void set_packed(const Region& region, CellBricks& bricks) const {
        const uint64_t bits = bits_for(region.colors.size());
        const bool begins_with_air = region.colors[0] == kNoBlock;
        for (uint64_t i = 0; i < region.cells();) {
            const uint64_t bit = i * bits, at = bit / 64, shift = bit % 64;
            const uint64_t word = region.data->long_at(size_t(at));
            if (word == 0 && begins_with_air && shift + bits <= 64) {
                i += (64 - shift) / bits;  // most of a large region is air
                continue;
            }
            uint64_t number = word >> shift;
            if (shift + bits > 64) number |= region.data->long_at(size_t(at + 1)) << (64 - shift);
            set(region, i++, number & ((uint64_t{1} << bits) - 1), bricks);
        }
    }

    VoxelArt finish() {
        VoxelArt art{std::move(model_), size_, {}};
        if (regions_.size() > 1)
            art.notes.push_back(fmt::format("{} regions, shown as one", regions_.size()));
        constexpr size_t kMaxNamed = 20;
        std::vector<std::string> names(unknown_.begin(), unknown_.end());
        if (names.size() > kMaxNamed) names.resize(kMaxNamed);
        if (!names.empty())
            art.notes.push_back(fmt::format(
                "{} a colour made of {} name: {}{}",
                unknown_.size() == 1 ? "1 kind of block has"
                                     : fmt::format("{} kinds of blocks have", unknown_.size()),
                unknown_.size() == 1 ? "its" : "their", fmt::join(names, ", "),
                unknown_.size() > kMaxNamed ? ", ..." : ""));
        return art;
    }

    const InputFile file_;
    std::string bytes_;
    NbtValue root_;
    std::vector<Region> regions_;
    glm::ivec3 origin_{0}, size_{0};
    std::set<std::string> unknown_;
    uint64_t cells_ = 0;  ///< sum over all regions
    VoxelModel model_;
};

}  // namespace

VoxelArt read_schematic(const std::filesystem::path& path) {
    return SchematicReader(path).read();
}

}  // namespace voxelume
