// SPDX-License-Identifier: Apache-2.0
// .raw and .json of voxelume -> volumetric image.
#include <xxhash.h>

#include <memory>

#include "runtime/base/files/input_file.hpp"
#include "runtime/base/json_text.hpp"
#include "runtime/base/text.hpp"
#include "runtime/image/volume_geometry.hpp"
#include "runtime/io/volume/volume_frame_text.hpp"
#include "runtime/io/volume/volume_json.hpp"

namespace voxelume {

namespace {

VolumeJson read_header(const VolumePath& path) {
    constexpr uint64_t kLongestHeader = uint64_t{1} << 24;
    const InputFile file(path);
    if (file.size() > kLongestHeader) file.refuse("too long for a header");
    auto header = parse_json_text<VolumeJson>(file.read_all(kLongestHeader));
    if (!header.is_object() || !header.contains("voxelume_volume"))
        file.refuse("not the header of a volume");
    if (header["voxelume_volume"] != 1) file.refuse("a volume of a later version; update voxelume");
    if (header.value("format", VolumeJson()) != "raw")
        file.refuse("the header of a display's own format, which isn't read back");
    return header;
}

/// One array as the header describes it. It is verified while it is read.
class RawArray {
  public:
    RawArray(const InputFile& file, const VolumeJson& entry, const char* name, uint64_t bytes)
        : file_(file), state_(XXH3_createState(), XXH3_freeState) {
        XXH3_64bits_reset(state_.get());
        const VolumeJson& offset = entry.at("offset");
        if (!offset.is_number_unsigned())
            file.refuse(fmt::format("no array begins at {}", offset.dump()));
        position_ = json_integer<uint64_t>(offset);
        checksum_ = entry.at("xxh3_64").get<std::string>();
        if (entry.at("name") != name || entry.at("bytes") != bytes || position_ > file.size() ||
            bytes > file.size() - position_)
            file.refuse(fmt::format("it doesn't hold the array {} that its header names", name));
    }
    template <class Value>
    void read(std::vector<Value>& row) {
        const size_t size = row.size() * sizeof(Value);
        file_.read(position_, row.data(), size);
        XXH3_64bits_update(state_.get(), row.data(), size);
        position_ += size;
    }
    void verify() const {
        if (fmt::format("{:016x}", XXH3_64bits_digest(state_.get())) != checksum_)
            file_.refuse("damaged: a checksum in its header differs");
    }

  private:
    const InputFile& file_;
    std::unique_ptr<XXH3_state_t, decltype(&XXH3_freeState)> state_;
    uint64_t position_ = 0;
    std::string checksum_;
};

/// The arrays of the file, in its order.
struct RawFile {
    const InputFile& data;
    const VolumeJson& arrays;
    VolumeFrame frame;

    /// Calls `take(index, values)` with the values of every voxel.
    template <class Value, class Take>
    void read(size_t number, const char* name, size_t components, Take take) const {
        const uint64_t count = voxel_count(frame);
        RawArray array(data, arrays.at(number), name, count * components * sizeof(Value));
        const auto width = size_t(frame.size.x);
        std::vector<Value> row(width * components);
        for (uint64_t start = 0; start < count; start += width) {
            array.read(row);
            for (size_t x = 0; x < width; ++x) take(start + x, &row[x * components]);
        }
        array.verify();
    }
    /// Calls `take(index, values)` with the values of the voxels that `indices` lists.
    template <class Value, class Take>
    void read_listed(const std::vector<uint64_t>& indices, size_t number, const char* name,
                     size_t components, Take take) const {
        size_t next = 0;
        read<Value>(number, name, components, [&](uint64_t index, const Value* values) {
            if (next == indices.size() || indices[next] != index) return;
            ++next;
            take(values);
        });
    }
};

void read_voxels(const RawFile& file, Volume& volume) {
    const double bytes = double(voxel_count(file.frame)) * 25;
    if (double(file.data.size()) > bytes) file.data.refuse("it has more data than its arrays");
    file.read<uint8_t>(3, "kind", 1, [&](uint64_t index, const uint8_t* kind) {
        if (*kind == 0) return;
        if (*kind > 3) file.data.refuse("a voxel has an unknown kind");
        volume.indices.push_back(index);
        volume.kinds.push_back(static_cast<VoxelKind>(*kind - 1));
    });
    const std::vector<uint64_t>& indices = volume.indices;
    file.read_listed<float>(indices, 0, "rgba", 4, [&](const float* values) {
        volume.colors.emplace_back(values[0], values[1], values[2]);
        volume.opacities.push_back(values[3]);
    });
    file.read_listed<float>(indices, 1, "depth", 1,
                            [&](const float* value) { volume.depths.push_back(*value); });
    file.read_listed<uint32_t>(indices, 2, "object", 1,
                               [&](const uint32_t* value) { volume.objects.push_back(*value); });
}

}  // namespace

Volume read_volume_raw(const VolumePath& path) {
    const VolumePath header_path = ending_of(path) == ".json" ? path : header_path_of(path);
    const VolumeJson header = read_header(header_path);
    const auto damaged = [&](const std::string& reason) {
        return Error(ErrorKind::input, "{}: damaged: {}", header_path.string(), reason);
    };
    try {
        Volume volume;
        volume.frame = read_frame_text(header.at(kFrameKey).dump(), header_path.string());
        volume.attributes = header.at("attributes").get<std::map<std::string, std::string>>();
        const VolumePath name = header.at("data").get<std::string>();
        if (name.has_parent_path() || !name.has_filename() || name == "..")
            throw damaged("its data file isn't in its folder");
        const InputFile data(header_path.parent_path() / name);
        read_voxels(RawFile{data, header.at("arrays"), volume.frame}, volume);
        return volume;
    } catch (const VolumeJson::exception& error) {
        throw damaged(error.what());
    }
}

}  // namespace voxelume
