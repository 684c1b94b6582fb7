// SPDX-License-Identifier: Apache-2.0
#include <draco/compression/decode.h>
#include <draco/compression/point_cloud/point_cloud_decoder.h>
#include <draco/core/varint_decoding.h>
#include <draco/metadata/metadata_decoder.h>
#include <fmt/format.h>

#include <cstring>
#include <stdexcept>

#include "runtime/io/mesh_codec/mesh_decoders.hpp"

namespace voxelume {
namespace {

[[noreturn]] void refuse(const std::string& clause) {
    throw std::runtime_error(clause);
}

/// The number of faces that the data declare. The library takes memory for them before it reads
/// any, so data that declare more than glTF's accessors have room for are refused before.
uint32_t declared_faces(draco::DecoderBuffer buffer) {
    draco::DracoHeader header{};
    if (!draco::PointCloudDecoder::DecodeHeader(&buffer, &header).ok() ||
        header.encoder_type != draco::TRIANGULAR_MESH)
        refuse("its Draco data aren't those of a mesh; the file is damaged");
    if (header.version_major != draco::kDracoMeshBitstreamVersionMajor ||
        header.version_minor != draco::kDracoMeshBitstreamVersionMinor)
        refuse(fmt::format(
            "its Draco data have version {}.{}, and glTF's have {}.{}; compress the "
            "model again",
            header.version_major, header.version_minor, draco::kDracoMeshBitstreamVersionMajor,
            draco::kDracoMeshBitstreamVersionMinor));
    buffer.set_bitstream_version(draco::kDracoMeshBitstreamVersion);
    draco::GeometryMetadata metadata;
    bool is_read = !(header.flags & METADATA_FLAG_MASK) ||
                   draco::MetadataDecoder().DecodeGeometryMetadata(&buffer, &metadata);
    uint32_t faces = 0;
    if (header.encoder_method == draco::MESH_EDGEBREAKER_ENCODING) {
        uint8_t traversal = 0;
        uint32_t vertices = 0;
        is_read = is_read && buffer.Decode(&traversal) && draco::DecodeVarint(&vertices, &buffer);
    }
    is_read = is_read && draco::DecodeVarint(&faces, &buffer);
    if (!is_read) refuse("its Draco data end early; the file is damaged");
    return faces;
}

std::unique_ptr<draco::Mesh> mesh_of(const CodecTask& task, std::span<const uint8_t> input) {
    draco::DecoderBuffer buffer;
    buffer.Init(reinterpret_cast<const char*>(input.data()), input.size());
    if (const uint64_t indices = uint64_t{declared_faces(buffer)} * 3; indices > task.indices)
        refuse(fmt::format("its Draco data have {} indices, and its accessor {}", indices,
                           task.indices));
    draco::Decoder decoder;
    auto mesh = decoder.DecodeMeshFromBuffer(&buffer);
    if (!mesh.ok())
        refuse(fmt::format("its Draco data can't be decoded: {}; the file is damaged",
                           mesh.status().error_msg_string().substr(0, 200)));
    return std::move(mesh).value();
}

std::vector<uint8_t> indices_of(const draco::Mesh& mesh) {
    std::vector<uint8_t> bytes(size_t{mesh.num_faces()} * 12);
    for (uint32_t i = 0; i < mesh.num_faces(); ++i) {
        const draco::Mesh::Face& face = mesh.face(draco::FaceIndex(i));
        for (size_t corner = 0; corner < 3; ++corner) {
            const uint32_t point = face[corner].value();
            std::memcpy(&bytes[(3 * size_t{i} + corner) * 4], &point, 4);
        }
    }
    return bytes;
}

template <class Number>
std::vector<uint8_t> values_of(const draco::PointAttribute& attribute, uint32_t points,
                               const DracoAttribute& wanted) {
    std::vector<uint8_t> bytes(points * wanted.bytes());
    std::array<Number, 16> row{};
    for (uint32_t i = 0; i < points; ++i) {
        const draco::AttributeValueIndex index = attribute.mapped_index(draco::PointIndex(i));
        if (index.value() >= attribute.size() ||
            !attribute.ConvertValue<Number>(index, int8_t(wanted.components), row.data()))
            refuse(fmt::format("vertex {} has no value of attribute {}; the file is damaged", i,
                               wanted.id));
        std::memcpy(&bytes[i * wanted.bytes()], row.data(), wanted.bytes());
    }
    return bytes;
}

std::vector<uint8_t> values_of(const draco::Mesh& mesh, const DracoAttribute& wanted) {
    const draco::PointAttribute* const attribute = mesh.GetAttributeByUniqueId(wanted.id);
    if (!attribute) refuse(fmt::format("its Draco data have no attribute {}", wanted.id));
    if (attribute->num_components() != wanted.components)
        refuse(fmt::format("attribute {} of its Draco data has {} components, and its accessor {}",
                           wanted.id, attribute->num_components(), wanted.components));
    // glTF has no boolean type, and the library reads damaged values as neither true nor false.
    if (attribute->data_type() == draco::DT_BOOL)
        refuse(
            fmt::format("attribute {} of its Draco data has truth values, not numbers", wanted.id));
    switch (wanted.component_type) {
        case 5120:
            return values_of<int8_t>(*attribute, mesh.num_points(), wanted);
        case 5121:
            return values_of<uint8_t>(*attribute, mesh.num_points(), wanted);
        case 5122:
            return values_of<int16_t>(*attribute, mesh.num_points(), wanted);
        case 5123:
            return values_of<uint16_t>(*attribute, mesh.num_points(), wanted);
        case 5125:
            return values_of<uint32_t>(*attribute, mesh.num_points(), wanted);
        default:
            return values_of<float>(*attribute, mesh.num_points(), wanted);
    }
}

}  // namespace

CodecArrays decode_draco(const CodecTask& task, std::span<const uint8_t> input) {
    const std::unique_ptr<draco::Mesh> mesh = mesh_of(task, input);
    if (mesh->num_points() != task.count || uint64_t{mesh->num_faces()} * 3 > task.indices)
        refuse(fmt::format(
            "its Draco data have {} vertices and {} indices, and its accessors {} "
            "and {}",
            mesh->num_points(), uint64_t{mesh->num_faces()} * 3, task.count, task.indices));
    CodecArrays arrays = {indices_of(*mesh)};
    for (size_t i = 0; i < task.attribute_count; ++i)
        arrays.push_back(values_of(*mesh, task.attributes[i]));
    return arrays;
}

}  // namespace voxelume
