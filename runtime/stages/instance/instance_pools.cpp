// SPDX-License-Identifier: Apache-2.0
#include "runtime/stages/instance/instance_pools.hpp"

#include <algorithm>

#include "kernels/shared/normal.h"
#include "kernels/shared/solid.h"
#include "kernels/shared/texture.h"
#include "kernels/shared/trace.h"
#include "kernels/shared/voxel.h"
#include "runtime/base/error.hpp"
#include "runtime/grid/sector_table.hpp"
#include "runtime/opencl/program.hpp"
#include "runtime/stages/place/joined_textures.hpp"

namespace voxelume {
namespace {

constexpr uint32_t kWhite = 0xFFFFFF;

/// The sizes of the joined buffers; while joining, the sizes of their filled parts.
struct Extent {
    uint64_t sectors = 0, records = 0, leaves = 0, voxels = 0, primitives = 0, triangles = 0,
             solids = 0;

    void add(const Pyramid& p) {
        sectors += p.sectors.size();
        records += p.bricks.size() / kWordsPerRecord;
        leaves += p.leaf_count;
        voxels += p.records();
        primitives += p.primitives.size();
        triangles += p.triangles.size() / kFloatsPerTriangle;
        solids += p.solids.size() / VXL_SOLID_WORDS;
    }
};

struct Parts {
    bool colors = false, fields = false, exact = false;
    bool voxel_normals = false, normals = false;  ///< normals of cubes, of triangles' corners
    JoinedTextures textures;
};

/// The result of joining pyramids.
class Total {
  public:
    Total(const Pyramid& world, std::span<const ModelPyramid> models) : frame_(world.frame) {
        add(world);
        for (const ModelPyramid& model : models) add(model.pyramid);
    }

    const Parts& parts() const { return parts_; }

    void check_numbers() const {
        const uint64_t maximum = std::max(
            {total_.sectors, total_.records, 2 * total_.leaves, total_.voxels, total_.primitives,
             total_.triangles * kFloatsPerTriangle, parts_.textures.words(),
             parts_.fields ? total_.voxels * VXL_FIELD_WORDS : 0});
        constexpr uint64_t kMaxEntries = uint64_t{1} << 31;  // kernels gather by signed indices
        if (maximum > kMaxEntries)
            throw Error(ErrorKind::limit,
                        "this world and the models of its instances need {} entries in one table, "
                        "at most {} can be numbered: use larger voxels",
                        maximum, kMaxEntries);
    }

    Pyramid allocate(const Device& device) const {
        Pyramid joined;
        joined.frame = frame_;
        joined.transparent = transparent_;
        joined.texture_alpha = texture_alpha_;
        joined.texture_maps = texture_maps_;
        joined.leaf_count = uint32_t(total_.leaves);
        joined.voxel_count = voxel_count_;
        joined.listed_fields = uint32_t(total_.voxels) - voxel_count_;
        joined.has_chains = has_chains_;
        joined.chain_depth = chain_depth_;
        joined.sectors = Buffer<uint32_t>(device, "sectors", total_.sectors);
        joined.bricks = Buffer<uint32_t>(device, "brick records", total_.records * kWordsPerRecord);
        joined.leaves = Buffer<uint32_t>(device, "leaves", total_.leaves * 2);
        joined.leaf_voxels = Buffer<uint32_t>(device, "leaf voxels", total_.leaves);
        joined.attributes = Buffer<uint32_t>(device, "voxel attributes", total_.voxels);
        if (parts_.colors) joined.colors = Buffer<uint32_t>(device, "voxel colors", total_.voxels);
        if (parts_.voxel_normals)
            joined.normals = Buffer<uint32_t>(device, "voxel normals", total_.voxels);
        if (parts_.fields)
            joined.fields =
                Buffer<uint32_t>(device, "voxel fields", total_.voxels * VXL_FIELD_WORDS);
        if (!parts_.exact) return joined;
        joined.primitive_first = Buffer<uint32_t>(device, "primitive starts", total_.voxels + 1);
        joined.primitives = Buffer<uint32_t>(device, "primitives", total_.primitives);
        joined.triangles =
            Buffer<float>(device, "triangles", total_.triangles * kFloatsPerTriangle);
        joined.triangle_attributes =
            Buffer<uint32_t>(device, "triangle attributes", total_.triangles);
        if (parts_.normals)
            joined.triangle_normals = Buffer<uint32_t>(device, "triangle normals",
                                                       total_.triangles * VXL_TRIANGLE_NORMALS);
        if (parts_.textures.words() > 0) {
            joined.triangle_textures =
                Buffer<uint32_t>(device, "triangle textures", total_.triangles * VXL_WORN_WORDS);
            joined.textures = Buffer<uint32_t>(device, "textures", parts_.textures.words());
        }
        joined.solids = Buffer<uint32_t>(device, "solids", total_.solids * VXL_SOLID_WORDS);
        return joined;
    }

  private:
    void add(const Pyramid& p) {
        total_.add(p);
        voxel_count_ += p.voxel_count;
        parts_.colors |= !p.colors.empty();
        parts_.voxel_normals |= !p.normals.empty();
        parts_.fields |= !p.fields.empty();
        parts_.exact |= !p.primitive_first.empty();
        parts_.normals |= !p.triangle_normals.empty();
        parts_.textures.add(p.texture_key, p.textures.size());
        has_chains_ |= p.has_chains;
        chain_depth_ = std::max(chain_depth_, p.chain_depth);
        transparent_ |= p.transparent;
        texture_alpha_ |= p.texture_alpha;
        texture_maps_ |= p.texture_maps;
    }

    GridFrame frame_;
    Extent total_;
    uint32_t voxel_count_ = 0, chain_depth_ = 0;
    Parts parts_;
    bool has_chains_ = false, transparent_ = false, texture_alpha_ = false, texture_maps_ = false;
};

class Joiner {
  public:
    Joiner(const Device& device, const Total& total)
        : program_(device, "instances.cl", {}),
          parts_(total.parts()),
          joined_(total.allocate(device)) {}

    void append(const Pyramid& p) {
        const auto first_block = uint32_t(full_.records / kRecordsPerSector);
        numbers(p.sectors, full_.sectors, first_block, kEmptyCube, joined_.sectors);
        program_.kernel("append_bricks")
            .launch(WorkItem::light, p.bricks.size() / kWordsPerRecord,
                    uint32_t(p.bricks.size() / kWordsPerRecord), uint32_t(full_.records),
                    uint32_t(full_.leaves), p.bricks, joined_.bricks);
        words(p.leaves, 2 * full_.leaves, joined_.leaves);
        numbers(p.leaf_voxels, full_.leaves, uint32_t(full_.voxels), 0, joined_.leaf_voxels);
        append_voxels(p);
        append_primitives(p);
        full_.add(p);
    }

    void append_model(const ModelPyramid& model) {
        const size_t triangles = model.pyramid.triangles.size() / kFloatsPerTriangle;
        joined_.instances.models.push_back({.frame = model.pyramid.frame,
                                            .first_sector = uint32_t(full_.sectors),
                                            .first_triangle = uint32_t(full_.triangles),
                                            .triangle_count = uint32_t(triangles),
                                            .first_solid = uint32_t(full_.solids),
                                            .low = model.low,
                                            .high = model.high});
        append(model.pyramid);
    }

    Pyramid take() {
        if (parts_.exact) {
            const auto end = uint32_t(full_.primitives);
            joined_.primitive_first.write(std::span(&end, 1), full_.voxels);
        }
        return std::move(joined_);
    }

  private:
    template <class T>
    void words(const Buffer<T>& from, uint64_t start, const Buffer<T>& to) {
        program_.kernel("append_instance_words")
            .launch(WorkItem::light, from.size(), uint32_t(from.size()), uint32_t(start),
                    Words(from), Words(to));
    }

    void copies(uint64_t count, uint64_t start, uint32_t word, const Buffer<uint32_t>& to) {
        program_.kernel("append_copies")
            .launch(WorkItem::light, count, uint32_t(count), uint32_t(start), word, to);
    }

    void numbers(const Buffer<uint32_t>& from, uint64_t start, uint32_t first, uint32_t kept,
                 const Buffer<uint32_t>& to) {
        program_.kernel("append_numbers")
            .launch(WorkItem::light, from.size(), uint32_t(from.size()), uint32_t(start), first,
                    kept, from, to);
    }

    void append_voxels(const Pyramid& p) {
        if (p.attributes.empty())
            copies(p.records(), full_.voxels, p.attribute, joined_.attributes);
        else
            words(p.attributes, full_.voxels, joined_.attributes);
        if (!p.colors.empty())
            words(p.colors, full_.voxels, joined_.colors);
        else if (parts_.colors)
            copies(p.records(), full_.voxels, kWhite, joined_.colors);
        if (!p.normals.empty())
            words(p.normals, full_.voxels, joined_.normals);
        else if (parts_.voxel_normals)
            copies(p.records(), full_.voxels, VXL_NO_NORMAL, joined_.normals);
        // An exact voxel may list fields; zeros mean that there are none.
        if (p.listed_fields > 0)
            program_.kernel("append_fields")
                .launch(WorkItem::light, p.records(), p.records(), uint32_t(full_.voxels),
                        p.attributes, p.fields, joined_.fields);
        else if (!p.fields.empty())
            words(p.fields, full_.voxels * VXL_FIELD_WORDS, joined_.fields);
        else if (parts_.fields)
            copies(uint64_t(p.records()) * VXL_FIELD_WORDS, full_.voxels * VXL_FIELD_WORDS, 0,
                   joined_.fields);
        if (p.primitive_first.empty()) {
            if (parts_.exact)
                copies(p.records(), full_.voxels, uint32_t(full_.primitives),
                       joined_.primitive_first);
            return;
        }
        // The end of a list is the start of the next one, unless listed fields lie between them.
        const uint32_t starts = p.voxel_count + (p.listed_fields > 0 ? 1 : 0);
        program_.kernel("append_numbers")
            .launch(WorkItem::light, starts, starts, uint32_t(full_.voxels),
                    uint32_t(full_.primitives), 0u, p.primitive_first, joined_.primitive_first);
    }

    void append_primitives(const Pyramid& p) {
        if (p.primitive_first.empty()) return;
        program_.kernel("append_instance_primitives")
            .launch(WorkItem::light, p.primitives.size(), uint32_t(p.primitives.size()),
                    uint32_t(full_.primitives), uint32_t(full_.triangles), uint32_t(full_.solids),
                    p.primitives, joined_.primitives);
        words(p.triangles, full_.triangles * kFloatsPerTriangle, joined_.triangles);
        if (p.triangle_attributes.empty())
            copies(p.triangles.size() / kFloatsPerTriangle, full_.triangles,
                   VXL_KIND_EXACT << VXL_KIND_SHIFT, joined_.triangle_attributes);
        else
            words(p.triangle_attributes, full_.triangles, joined_.triangle_attributes);
        const uint64_t normals = full_.triangles * VXL_TRIANGLE_NORMALS;
        if (!p.triangle_normals.empty())
            words(p.triangle_normals, normals, joined_.triangle_normals);
        else if (parts_.normals)
            copies(p.triangles.size() / kFloatsPerTriangle * VXL_TRIANGLE_NORMALS, normals,
                   VXL_NO_NORMAL, joined_.triangle_normals);
        append_textures(p);
        words(p.solids, full_.solids * VXL_SOLID_WORDS, joined_.solids);
    }

    void append_textures(const Pyramid& p) {
        const uint64_t start = full_.triangles * VXL_WORN_WORDS;
        const size_t worn = p.triangles.size() / kFloatsPerTriangle * VXL_WORN_WORDS;
        if (p.textures.empty()) {
            if (parts_.textures.words() > 0)
                copies(worn, start, VXL_NO_TEXTURE, joined_.triangle_textures);
            return;
        }
        const bool is_new = textures_.add(p.texture_key, p.textures.size());
        const uint64_t first_word = textures_.first_word(p.texture_key, p.textures.size());
        if (is_new) words(p.textures, first_word, joined_.textures);
        program_.kernel("append_instance_worn")
            .launch(WorkItem::light, worn, uint32_t(worn), uint32_t(start), uint32_t(first_word),
                    p.triangle_textures, joined_.triangle_textures);
    }

    Program program_;
    Parts parts_;
    Pyramid joined_;
    Extent full_;
    JoinedTextures textures_;  ///< textures of the appended models
};

}  // namespace

Pyramid allocate_joined(const Device& device, const Pyramid& world,
                        std::span<const ModelPyramid> models) {
    return Total(world, models).allocate(device);
}

Pyramid join_models(const Device& device, const Pyramid& world,
                    std::span<const ModelPyramid> models) {
    const Total total(world, models);
    total.check_numbers();
    Joiner joiner(device, total);
    joiner.append(world);
    for (const ModelPyramid& model : models) joiner.append_model(model);
    return joiner.take();
}

}  // namespace voxelume
