// Beside vdb_density.cpp the only file that sees OpenVDB's headers, which take long to compile. It
// writes through a stream of ours: OpenVDB's own file reports success on a full disk.
#include "runtime/io/vdb.hpp"

#include <openvdb/io/Stream.h>
#include <openvdb/openvdb.h>
#include <openvdb/tools/SignedFloodFill.h>
#include <xxhash.h>

#include <array>
#include <memory>
#include <ostream>
#include <streambuf>

#include "runtime/io/atomic_file.hpp"
#include "runtime/io/input_file.hpp"

namespace voxelume {

namespace {

/// Where the file's identifier stands, in text: after magic, three version numbers and a flag.
constexpr uint64_t kUuidStart = 21;
constexpr uint64_t kUuidLength = 36;

/// Passes bytes on to an AtomicFile in blocks and hashes all but the identifier.
class VdbStreamBuffer : public std::streambuf {
  public:
    explicit VdbStreamBuffer(AtomicFile& file)
        : file_(file), state_(XXH3_createState(), XXH3_freeState) {
        XXH3_128bits_reset(state_.get());
        setp(block_.data(), block_.data() + block_.size());
    }
    XXH128_hash_t content_hash() const { return XXH3_128bits_digest(state_.get()); }

  protected:
    int_type overflow(int_type next) override {
        sync();
        if (!traits_type::eq_int_type(next, traits_type::eof()))
            sputc(traits_type::to_char_type(next));
        return traits_type::not_eof(next);
    }
    int sync() override {
        const auto size = static_cast<size_t>(pptr() - pbase());
        // The first block holds the identifier whole: it is far longer than the file's head.
        if (file_.position() == 0 && size >= kUuidStart + kUuidLength) {
            update(pbase(), kUuidStart);
            update(pbase() + kUuidStart + kUuidLength, size - kUuidStart - kUuidLength);
        } else {
            update(pbase(), size);
        }
        file_.write(pbase(), size);
        setp(block_.data(), block_.data() + block_.size());
        return 0;
    }

  private:
    void update(const char* bytes, size_t size) { XXH3_128bits_update(state_.get(), bytes, size); }

    AtomicFile& file_;
    std::unique_ptr<XXH3_state_t, decltype(&XXH3_freeState)> state_;
    std::array<char, 1 << 16> block_{};
};

/// 128 bits in the form of a version 5 (from a hash) identifier.
std::string uuid_from(XXH128_hash_t hash) {
    const uint64_t high = (hash.high64 & ~uint64_t{0xf000}) | 0x5000;
    const uint64_t low = (hash.low64 & ~(uint64_t{3} << 62)) | (uint64_t{2} << 62);
    return fmt::format("{:08x}-{:04x}-{:04x}-{:04x}-{:012x}", high >> 32, high >> 16 & 0xffff,
                       high & 0xffff, low >> 48, low & 0xffffffffffff);
}

openvdb::math::Transform::Ptr make_transform(const VdbVolume& volume) {
    const glm::dvec3& edges = volume.voxel_edges;
    const glm::dvec3& origin = volume.origin;
    const bool cube = edges.x == edges.y && edges.x == edges.z;
    auto transform = cube ? openvdb::math::Transform::createLinearTransform(edges.x)
                          : openvdb::math::Transform::createLinearTransform();
    if (!cube) transform->preScale(openvdb::Vec3d(edges.x, edges.y, edges.z));
    transform->postTranslate(openvdb::Vec3d(origin.x, origin.y, origin.z));
    return transform;
}

template <class Grid, class Value, class Convert>
typename Grid::Ptr make_grid(const VdbVolume& volume, std::span<const Value> values,
                             typename Grid::ValueType background, Convert convert) {
    auto grid = Grid::create(background);
    auto accessor = grid->getAccessor();
    for (size_t i = 0; i < volume.cells.size(); ++i) {
        const glm::ivec3& cell = volume.cells[i];
        accessor.setValue(openvdb::Coord(cell.x, cell.y, cell.z), convert(values[i]));
    }
    grid->setTransform(make_transform(volume));
    return grid;
}

openvdb::GridCPtrVec make_grids(const VdbVolume& volume) {
    auto values = make_grid<openvdb::FloatGrid>(volume, volume.values, volume.background,
                                                [](float value) { return value; });
    if (volume.grid_class == VdbClass::level_set)  // what lies inside has no value yet
        openvdb::tools::signedFloodFill(values->tree());
    values->setName(volume.name);
    values->setGridClass(volume.grid_class == VdbClass::level_set ? openvdb::GRID_LEVEL_SET
                                                                  : openvdb::GRID_FOG_VOLUME);
    openvdb::GridCPtrVec grids = {values};
    if (volume.colors.empty()) return grids;
    auto colors = make_grid<openvdb::Vec3SGrid>(
        volume, volume.colors, openvdb::Vec3s(0.0f),
        [](const glm::vec3& color) { return openvdb::Vec3s(color.r, color.g, color.b); });
    colors->setName("Cd");
    colors->setVectorType(openvdb::VEC_INVARIANT);
    grids.push_back(colors);
    return grids;
}

void check_volume(AtomicFile& file, const VdbVolume& volume) {
    const size_t count = volume.cells.size();
    if (volume.values.size() != count) file.fail("not every voxel has a value");
    if (!volume.colors.empty() && volume.colors.size() != count)
        file.fail("not every voxel has a colour");
    if (!(volume.voxel_edges.x > 0 && volume.voxel_edges.y > 0 && volume.voxel_edges.z > 0))
        file.fail("the voxels have no size");
}

void write_grids(AtomicFile& file, const VdbVolume& volume) {
    openvdb::MetaMap metadata;
    for (const auto& [key, text] : volume.metadata)
        metadata.insertMeta(key, openvdb::StringMetadata(text));
    VdbStreamBuffer buffer(file);
    std::ostream stream(&buffer);
    stream.exceptions(std::ios::badbit);  // hands the file's own error on
    openvdb::io::Stream(stream).write(make_grids(volume), metadata);
    stream.flush();
    const std::string uuid = uuid_from(buffer.content_hash());
    file.seek(kUuidStart);
    file.write(uuid.data(), uuid.size());
}

VdbSummary summarize(const openvdb::GridBase& grid) {
    VdbSummary summary;
    summary.name = grid.getName();
    summary.value_type = grid.valueType();
    summary.grid_class = openvdb::GridBase::gridClassToString(grid.getGridClass());
    summary.active_voxels = grid.activeVoxelCount();
    if (summary.active_voxels > 0) {
        const openvdb::CoordBBox box = grid.evalActiveVoxelBoundingBox();
        summary.min = {box.min().x(), box.min().y(), box.min().z()};
        summary.max = {box.max().x(), box.max().y(), box.max().z()};
    }
    const openvdb::Vec3d edges = grid.voxelSize();
    summary.voxel_edges = {edges.x(), edges.y(), edges.z()};
    return summary;
}

}  // namespace

void write_vdb(const std::filesystem::path& path, const VdbVolume& volume) {
    AtomicFile file(path);
    check_volume(file, volume);
    try {
        openvdb::initialize();
        write_grids(file, volume);
    } catch (const openvdb::Exception& error) {
        file.fail(error.what());
    } catch (const std::ios_base::failure& error) {
        file.fail(error.what());
    }
    file.commit();
}

std::vector<VdbSummary> read_vdb_summary(const std::filesystem::path& path) {
    const InputFile readable(path);
    try {
        openvdb::initialize();
        openvdb::io::File file(path.string());
        file.open(
            false);  // whole: delayed loading would map the file for as long as the grids live
        std::vector<VdbSummary> summaries;
        for (const openvdb::GridBase::Ptr& grid : *file.getGrids())
            summaries.push_back(summarize(*grid));
        return summaries;
    } catch (const std::bad_alloc&) {
        readable.refuse("not a readable OpenVDB file: it declares more than there is memory");
    } catch (const std::exception& error) {
        readable.refuse(fmt::format("not a readable OpenVDB file: {}", error.what()));
    }
}

}  // namespace voxelume
