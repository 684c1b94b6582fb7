// SPDX-License-Identifier: Apache-2.0
#include "runtime/io/vdb/vdb_tree.hpp"

#include <array>
#include <bit>
#include <cmath>
#include <cstring>

namespace voxelume::vdb {
namespace {

using openvdb::Coord;
using openvdb::FloatGrid;
using openvdb::Vec3d;
using Tree = FloatGrid::TreeType;
using Leaf = Tree::LeafNodeType;
using Map = openvdb::math::MapBase::Ptr;

constexpr int kMaskWords = 8;
static_assert(Leaf::SIZE == 64 * kMaskWords);

/// The types of maps. A grid keeps its map's type, because maps of different types round
/// differently.
enum class MapType : int32_t { uniform, scale, shift, uniform_shifted, scale_shifted, affine };

struct MapNumbers {
    MapType type = MapType::affine;
    int32_t padding = 0;
    std::array<double, 16> matrix{};  ///< rows; points are rows in front of it
};

struct TileNumbers {
    int32_t x = 0, y = 0, z = 0;
    uint32_t level = 0;  ///< 1: of a leaf's size, up to 3: of a child of the root
    float value = 0;
    uint32_t is_active = 0;
};

struct LeafNumbers {
    int32_t x = 0, y = 0, z = 0, padding = 0;
    std::array<uint64_t, kMaskWords> active{};
    std::array<float, Leaf::SIZE> values{};
};

MapType type_of(const openvdb::math::MapBase& map) {
    namespace math = openvdb::math;
    if (map.isType<math::UniformScaleMap>()) return MapType::uniform;
    if (map.isType<math::ScaleMap>()) return MapType::scale;
    if (map.isType<math::TranslationMap>()) return MapType::shift;
    if (map.isType<math::UniformScaleTranslateMap>()) return MapType::uniform_shifted;
    if (map.isType<math::ScaleTranslateMap>()) return MapType::scale_shifted;
    return MapType::affine;
}

MapNumbers numbers_of(const openvdb::math::MapBase& map) {
    MapNumbers numbers;
    numbers.type = type_of(map);
    const openvdb::Mat4d matrix = map.getAffineMap()->getMat4();
    std::copy_n(matrix.asPointer(), 16, numbers.matrix.begin());
    return numbers;
}

Map map_of(const MapNumbers& numbers) {
    namespace math = openvdb::math;
    const openvdb::Mat4d matrix(numbers.matrix.data());
    const openvdb::Vec3d scale(matrix(0, 0), matrix(1, 1), matrix(2, 2));
    const openvdb::Vec3d shift = matrix.getTranslation();
    switch (numbers.type) {
        case MapType::uniform:
            return std::make_shared<math::UniformScaleMap>(scale.x());
        case MapType::scale:
            return std::make_shared<math::ScaleMap>(scale);
        case MapType::shift:
            return std::make_shared<math::TranslationMap>(shift);
        case MapType::uniform_shifted:
            return std::make_shared<math::UniformScaleTranslateMap>(scale.x(), shift);
        case MapType::scale_shifted:
            return std::make_shared<math::ScaleTranslateMap>(scale, shift);
        case MapType::affine:
            return std::make_shared<math::AffineMap>(matrix);
    }
    WireReceiver::fail();
}

openvdb::math::Transform::Ptr receive_transform(WireReceiver& receiver) {
    const auto numbers = receiver.value<MapNumbers>();
    for (const double number : numbers.matrix)
        if (!std::isfinite(number)) WireReceiver::fail();
    try {
        return std::make_shared<openvdb::math::Transform>(map_of(numbers));
    } catch (const openvdb::Exception&) {
        WireReceiver::fail();  // a map without an inverse
    }
}

/// All tiles except those that every new tree has.
std::vector<TileNumbers> tiles_of(const FloatGrid& grid) {
    const auto background = std::bit_cast<uint32_t>(grid.background());
    std::vector<TileNumbers> tiles;
    auto value = grid.tree().cbeginValueAll();
    value.setMaxDepth(Tree::ValueAllCIter::LEAF_DEPTH - 1);
    for (; value; ++value) {
        const bool is_active = value.isValueOn();
        if (!is_active && std::bit_cast<uint32_t>(*value) == background) continue;
        const Coord c = value.getCoord();
        tiles.push_back({c.x(), c.y(), c.z(), value.getLevel(), *value, is_active});
    }
    return tiles;
}

float finite(float value) {
    if (!std::isfinite(value)) WireReceiver::fail();
    return value;
}

/// Fails where a tree outgrows a limit.
class TreeLimit {
  public:
    TreeLimit(const Tree& tree, uint64_t max_bytes) : tree_(tree), max_bytes_(max_bytes) {}

    /// Call it before each tile and leaf. It looks at the tree again where those that were added
    /// since it did so may have reached the limit.
    void check() {
        if (bytes_ + kLargest * ++added_ <= max_bytes_) return;
        bytes_ = tree_.memUsage();
        added_ = 1;
        if (bytes_ + kLargest > max_bytes_) WireReceiver::fail();
    }

  private:
    /// The most that a tile or leaf adds, in bytes: its branch has nodes of 32^3, 16^3 and 8^3
    /// entries, of 8, 8 and 4 bytes, and their masks.
    static constexpr uint64_t kLargest = 320'000;

    const Tree& tree_;
    uint64_t max_bytes_, bytes_ = 0, added_ = 0;
};

void receive_leaf(WireReceiver& receiver, Tree& tree) {
    const auto numbers = receiver.value<LeafNumbers>();
    for (const float value : numbers.values) finite(value);
    Leaf& leaf = *tree.touchLeaf(Coord(numbers.x, numbers.y, numbers.z));
    std::copy(numbers.values.begin(), numbers.values.end(), leaf.buffer().data());
    Leaf::NodeMaskType mask;
    for (int word = 0; word < kMaskWords; ++word)
        mask.getWord<uint64_t>(word) = numbers.active[word];
    leaf.setValueMask(mask);
}

}  // namespace

void send_grid(WireSender& sender, const FloatGrid& grid) {
    sender.value(grid.background());
    sender.value(numbers_of(*grid.transform().baseMap()));
    sender.values(tiles_of(grid));
    sender.value(uint64_t{grid.tree().leafCount()});
    LeafNumbers numbers;
    for (auto leaf = grid.tree().cbeginLeaf(); leaf; ++leaf) {
        const Coord origin = leaf->origin();
        numbers.x = origin.x(), numbers.y = origin.y(), numbers.z = origin.z();
        for (int word = 0; word < kMaskWords; ++word)
            numbers.active[word] = leaf->valueMask().getWord<uint64_t>(word);
        std::copy_n(leaf->buffer().data(), Leaf::SIZE, numbers.values.begin());
        sender.value(numbers);
    }
}

FloatGrid::Ptr receive_grid(WireReceiver& receiver, uint64_t max_bytes) {
    constexpr uint64_t kMaxCount = uint64_t{1} << 32;
    FloatGrid::Ptr grid = FloatGrid::create(finite(receiver.value<float>()));
    grid->setTransform(receive_transform(receiver));
    TreeLimit limit(grid->tree(), max_bytes);
    for (const TileNumbers& tile : receiver.values<TileNumbers>(kMaxCount)) {
        if (tile.level < 1 || tile.level > Tree::RootNodeType::LEVEL) WireReceiver::fail();
        limit.check();
        grid->tree().addTile(tile.level, Coord(tile.x, tile.y, tile.z), finite(tile.value),
                             tile.is_active != 0);
    }
    for (uint64_t left = receiver.count(kMaxCount); left > 0; --left) {
        limit.check();
        receive_leaf(receiver, grid->tree());
    }
    return grid;
}

}  // namespace voxelume::vdb
