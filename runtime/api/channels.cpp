// SPDX-License-Identifier: Apache-2.0
// The table of the channels that images may have.
#include <array>

#include "runtime/voxelume/image.hpp"

namespace voxelume::v1 {
namespace {

constexpr std::array kColor = {"R", "G", "B", "A"};
constexpr std::array kDepth = {"Z"};
constexpr std::array kDistance = {"distance"};
constexpr std::array kPosition = {"P.X", "P.Y", "P.Z"};
constexpr std::array kNormal = {"N.X", "N.Y", "N.Z"};
constexpr std::array kObject = {"objectId"};
constexpr std::array kMaterial = {"materialId"};
constexpr std::array kObjectMatte = {"CryptoObject00.R", "CryptoObject00.G", "CryptoObject00.B",
                                     "CryptoObject00.A", "CryptoObject01.R", "CryptoObject01.G",
                                     "CryptoObject01.B", "CryptoObject01.A", "CryptoObject02.R",
                                     "CryptoObject02.G", "CryptoObject02.B", "CryptoObject02.A"};
constexpr std::array kMaterialMatte = {
    "CryptoMaterial00.R", "CryptoMaterial00.G", "CryptoMaterial00.B", "CryptoMaterial00.A",
    "CryptoMaterial01.R", "CryptoMaterial01.G", "CryptoMaterial01.B", "CryptoMaterial01.A",
    "CryptoMaterial02.R", "CryptoMaterial02.G", "CryptoMaterial02.B", "CryptoMaterial02.A"};

constexpr std::array kAlbedo = {"albedo.R", "albedo.G", "albedo.B"};
constexpr std::array kDirect = {"direct.R", "direct.G", "direct.B"};
constexpr std::array kIndirect = {"indirect.R", "indirect.G", "indirect.B"};
constexpr std::array kShadow = {"shadow.R", "shadow.G", "shadow.B"};
constexpr std::array kLights = {"light_"};
constexpr std::array kSamples = {"samples"};
constexpr std::array kNoise = {"noise"};
constexpr std::array kVariance = {"variance.R", "variance.G", "variance.B"};
constexpr std::array kMotion = {"forward.u", "forward.v", "backward.u", "backward.v"};

constexpr std::array<ChannelRow, 18> kTable = {
    {{"RGBA", &Channels::color, kColor},
     {"Z", &Channels::depth, kDepth},
     {"distance", &Channels::distance, kDistance},
     {"P", &Channels::position, kPosition},
     {"N", &Channels::normal, kNormal},
     {"objectId", &Channels::object, kObject},
     {"materialId", &Channels::material, kMaterial},
     {"CryptoObject", &Channels::object_matte, kObjectMatte},
     {"CryptoMaterial", &Channels::material_matte, kMaterialMatte},
     {"albedo", &Channels::albedo, kAlbedo},
     {"direct", &Channels::direct, kDirect},
     {"indirect", &Channels::indirect, kIndirect},
     {"shadow", &Channels::shadow, kShadow},
     {"lights", &Channels::light_groups, kLights},
     {"motion", &Channels::motion, kMotion},
     {"samples", &Channels::samples, kSamples},
     {"noise", &Channels::noise, kNoise},
     {"variance", &Channels::variance, kVariance}}};

}  // namespace

std::span<const ChannelRow> channel_table() {
    return kTable;
}

}  // namespace voxelume::v1
