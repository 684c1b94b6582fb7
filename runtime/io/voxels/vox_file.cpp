// SPDX-License-Identifier: Apache-2.0
#include "runtime/io/voxels/vox_file.hpp"

#include <algorithm>
#include <cstring>

#include "runtime/io/voxels/vox_chunks.hpp"
#include "runtime/io/voxels/vox_graph.hpp"
#include "runtime/io/voxels/vox_materials.hpp"

namespace voxelume {
namespace {

constexpr size_t kHeader = 12;                        // letters and two sizes of a chunk
constexpr uint32_t kMaxContent = uint32_t{16} << 20;  // limit for chunks that don't hold voxels
constexpr size_t kMaxModels = 50'000;
constexpr int kMaxSide = 256;  // coordinates are bytes

struct Chunk {
    std::string letters;
    uint64_t content_at = 0;
    uint32_t content = 0, children = 0;
};

/// Reads the chunks of a file, one after the other, into `vox` and `graph`.
class VoxReader {
  public:
    VoxReader(const InputFile& file, VoxFile& vox) : file_(file), vox_(vox) {}

    void read() {
        uint64_t position = read_start();
        while (position < file_.size()) {
            const Chunk chunk = read_header(position);
            read_chunk(chunk);
            position = chunk.content_at + chunk.content;
            // Only the main chunk has chunks inside that are known.
            if (chunk.letters != "MAIN") position += chunk.children;
        }
        if (sizes_ > vox_.models.size())
            file_.refuse("a model has a size and no voxels; the file is truncated");
        vox_.objects = objects_of(graph_, vox_, file_);
        vox_.hidden_layers = int(graph_.hidden_layers.size());
        for (const VoxObject& object : vox_.objects) {
            vox_.frames = std::max(vox_.frames, object.poses.back().frame + 1);
            vox_.frames = std::max(vox_.frames, object.shown.back().frame + 1);
        }
    }

  private:
    uint64_t read_start() {
        char start[8];
        if (file_.size() < sizeof start) file_.refuse("too short for a MagicaVoxel file");
        file_.read(0, start, sizeof start);
        if (std::memcmp(start, "VOX ", 4) != 0) file_.refuse("not a MagicaVoxel file");
        std::memcpy(&vox_.version, start + 4, 4);
        if (vox_.version != 150 && vox_.version != 200)
            file_.refuse(fmt::format("a MagicaVoxel file of version {}; 150 and 200 can be read",
                                     vox_.version));
        return sizeof start;
    }

    Chunk read_header(uint64_t position) {
        char header[kHeader];
        if (file_.size() - position < kHeader) file_.refuse("it ends within a chunk; truncated");
        file_.read(position, header, sizeof header);
        Chunk chunk{std::string(header, 4), position + kHeader, 0, 0};
        std::memcpy(&chunk.content, header + 4, 4);
        std::memcpy(&chunk.children, header + 8, 4);
        const uint64_t left = file_.size() - chunk.content_at;
        const uint64_t inside = chunk.letters == "MAIN" ? 0 : chunk.children;
        if (chunk.content > left || inside > left - chunk.content)
            file_.refuse(fmt::format("it ends within a chunk {}; the file is truncated or damaged",
                                     printable(chunk.letters)));
        return chunk;
    }

    static std::string printable(std::string letters) {
        for (char& c : letters)
            if (c < ' ' || c > '~') c = '?';
        return letters;
    }

    VoxContent content_of(const Chunk& chunk) {
        if (chunk.content > kMaxContent)
            file_.refuse(fmt::format("a chunk {} has {} bytes, at most {} are possible",
                                     printable(chunk.letters), chunk.content, kMaxContent));
        std::string bytes(chunk.content, '\0');
        file_.read(chunk.content_at, bytes.data(), bytes.size());
        return {file_, chunk.letters, std::move(bytes)};
    }

    void read_chunk(const Chunk& chunk) {
        const std::string& letters = chunk.letters;
        if (letters == "MAIN" || letters == "PACK") return;
        if (letters == "XYZI") return read_voxels(chunk);
        const bool is_known = letters == "SIZE" || letters == "RGBA" || letters == "MATL" ||
                              letters == "MATT" || letters == "LAYR" || letters == "nTRN" ||
                              letters == "nGRP" || letters == "nSHP" || letters == "rCAM" ||
                              letters == "rOBJ";
        if (!is_known) {
            ++vox_.not_read[printable(letters)];
            return;
        }
        VoxContent content = content_of(chunk);
        if (letters == "SIZE") read_size(content);
        if (letters == "RGBA") read_palette(content);
        if (letters == "MATL") take_material(content, vox_.materials);
        if (letters == "MATT") take_old_material(content, vox_.materials);
        if (letters == "LAYR") read_layer(content);
        if (letters == "rCAM") read_camera(content);
        if (letters == "rOBJ") take_render_settings(content, vox_.render);
        if (letters == "nTRN") take_node(VoxNodeKind::transform, content, graph_);
        if (letters == "nGRP") take_node(VoxNodeKind::group, content, graph_);
        if (letters == "nSHP") take_node(VoxNodeKind::shape, content, graph_);
    }

    void read_size(VoxContent& content) {
        if (sizes_ > vox_.models.size()) content.refuse("follows another one");
        for (int axis = 0; axis < 3; ++axis) size_[axis] = content.take_int();
        for (int axis = 0; axis < 3; ++axis)
            if (size_[axis] < 0 || size_[axis] > kMaxSide)
                content.refuse(
                    fmt::format("says that a model has {} x {} x {} voxels; at most {} "
                                "along each axis are possible",
                                size_.x, size_.y, size_.z, kMaxSide));
        if (++sizes_ > kMaxModels)
            file_.refuse(fmt::format("it has more than {} models", kMaxModels));
    }

    void read_voxels(const Chunk& chunk) {
        if (sizes_ == vox_.models.size()) file_.refuse("a model has voxels and no size");
        VoxModel model{size_, chunk.content_at + 4, 0};
        if (chunk.content < 4) file_.refuse("a chunk XYZI ends before its values do");
        file_.read(chunk.content_at, &model.voxels, 4);
        if (model.voxels > (chunk.content - 4) / 4)
            file_.refuse("a chunk XYZI counts more voxels than it holds");
        vox_.models.push_back(model);
    }

    void read_palette(VoxContent& content) {
        if (content.bytes().size() < 4 * 256) content.refuse("has fewer than 256 colours");
        // The first colour has index 1; index 0 is an empty cell.
        std::memcpy(vox_.palette.data() + 1, content.bytes().data(), 4 * 255);
        vox_.has_palette = true;
    }

    void read_camera(VoxContent& content) {
        constexpr size_t kMaxCameras = 1000;  // MagicaVoxel has ten
        const VoxCamera camera = take_camera(content);
        if (vox_.cameras.size() < kMaxCameras) vox_.cameras.push_back(camera);
    }

    void read_layer(VoxContent& content) {
        const int number = content.take_int();
        ++vox_.layers;
        if (text_in(content.take_dictionary(), "_hidden") == "1")
            graph_.hidden_layers.insert(number);
    }

    const InputFile& file_;
    VoxFile& vox_;
    VoxGraph graph_;
    size_t sizes_ = 0;  ///< number of chunks SIZE so far
    glm::ivec3 size_{0};
};

}  // namespace

glm::ivec3 VoxRotation::operator*(const glm::ivec3& v) const {
    return {sign[0] * v[axis[0]], sign[1] * v[axis[1]], sign[2] * v[axis[2]]};
}

VoxRotation VoxRotation::operator*(const VoxRotation& inner) const {
    VoxRotation product;
    for (size_t row = 0; row < 3; ++row) {
        const size_t between = size_t(axis[row]);
        product.axis[row] = inner.axis[between];
        product.sign[row] = sign[row] * inner.sign[between];
    }
    return product;
}

bool VoxRotation::is_mirrored() const {
    const bool is_even = axis[1] == (axis[0] + 1) % 3;
    return (sign[0] * sign[1] * sign[2] < 0) == is_even;
}

VoxFile read_vox_file(const std::filesystem::path& path) {
    VoxFile vox;
    vox.path = path;
    vox.palette = default_vox_palette();
    const InputFile file(path);
    VoxReader(file, vox).read();
    return vox;
}

}  // namespace voxelume
