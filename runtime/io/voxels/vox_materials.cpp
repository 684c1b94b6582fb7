// SPDX-License-Identifier: Apache-2.0
#include "runtime/io/voxels/vox_materials.hpp"

#include <algorithm>
#include <utility>

namespace voxelume {
namespace {

constexpr std::array<const char*, 6> kNames = {"diffuse", "metal", "glass",
                                               "emit",    "blend", "media"};

/// The entry of a material: some files number the last one 0, others 256.
VoxMaterial& entry_of(int number, const VoxContent& content,
                      std::array<VoxMaterial, 256>& materials) {
    if (number < 0 || number > 256)
        content.refuse(fmt::format("is of a palette entry {}, which there isn't", number));
    return materials[size_t(number) & 255];
}

VoxMaterialKind kind_named(const std::string& type) {
    for (size_t kind = 0; kind < kNames.size(); ++kind)
        if (type == std::string("_") + kNames[kind]) return VoxMaterialKind(kind);
    return type == "_cloud" ? VoxMaterialKind::media : VoxMaterialKind::diffuse;
}

/// The value of the first of these names that a dictionary has.
float first_in(const VoxDictionary& values, std::initializer_list<const char*> names,
               float otherwise) {
    for (const char* name : names)
        if (values.contains(name)) return number_in(values, name, otherwise);
    return otherwise;
}

}  // namespace

const char* name_of(VoxMaterialKind kind) {
    return kNames[size_t(kind)];
}

std::string material_name(const VoxFile& file, int entry) {
    const VoxMaterialKind kind = file.materials[size_t(entry)].kind;
    return kind == VoxMaterialKind::diffuse ? "" : fmt::format("{} {}", name_of(kind), entry);
}

void take_material(VoxContent& content, std::array<VoxMaterial, 256>& materials) {
    VoxMaterial& m = entry_of(content.take_int(), content, materials);
    const VoxDictionary values = content.take_dictionary();
    m = {};
    m.kind = kind_named(text_in(values, "_type"));
    switch (m.kind) {
        case VoxMaterialKind::metal:
            m.weight = first_in(values, {"_metal", "_weight"}, 1);
            break;
        case VoxMaterialKind::glass:
            m.weight = first_in(values, {"_trans", "_alpha", "_weight"}, 0.5f);
            break;
        case VoxMaterialKind::blend:
            m.weight = first_in(values, {"_trans", "_alpha"}, 0);
            break;
        case VoxMaterialKind::emit:
            m.weight = first_in(values, {"_emit", "_weight"}, 1);
            break;
        default:
            break;
    }
    const std::string medium = text_in(values, "_media_type");
    m.absorbs = text_in(values, "_type") != "_cloud" && (medium.empty() || medium == "_absorb");
    m.weight = std::clamp(m.weight, 0.0f, 1.0f);
    m.metal = std::clamp(number_in(values, "_metal", 0), 0.0f, 1.0f);
    m.rough = std::clamp(number_in(values, "_rough", m.rough), 0.0f, 1.0f);
    m.specular = std::clamp(first_in(values, {"_sp", "_spec"}, m.specular), 0.0f, 1.0f);
    m.ior = std::clamp(values.contains("_ri") ? number_in(values, "_ri", m.ior)
                                              : 1 + number_in(values, "_ior", 0.3f),
                       1.0f, 3.0f);
    m.density = std::clamp(first_in(values, {"_d", "_att"}, 0), 0.0f, 1.0f);
    const float flux = number_in(values, "_flux", 0);
    m.flux = std::clamp(flux, 0.0f, kMaxFlux);
    m.is_flux_cut = flux > kMaxFlux;
}

VoxDictionary values_of(const VoxMaterial& m) {
    if (m.kind == VoxMaterialKind::diffuse) return {};
    const auto text = [](float value) { return fmt::format("{}", value); };
    VoxDictionary values = {{"_type", std::string("_") + kNames[size_t(m.kind)]},
                            {"_weight", text(m.weight)},
                            {"_rough", text(m.rough)},
                            {"_sp", text(m.specular)},
                            {"_ri", text(m.ior)},
                            {"_ior", fmt::format("{:.4g}", m.ior - 1)},
                            {"_d", text(m.density)},
                            {"_att", text(m.density)},
                            {"_flux", text(m.flux)}};
    switch (m.kind) {
        case VoxMaterialKind::metal:
            values["_metal"] = text(m.weight);
            break;
        case VoxMaterialKind::emit:
            values["_emit"] = text(m.weight);
            break;
        case VoxMaterialKind::blend:
            values["_metal"] = text(m.metal);
            [[fallthrough]];
        case VoxMaterialKind::glass:
            values["_trans"] = values["_alpha"] = text(m.weight);
            break;
        case VoxMaterialKind::media:
            values["_media_type"] = m.absorbs ? "_absorb" : "_scatter";
            break;
        default:
            break;
    }
    return values;
}

void take_old_material(VoxContent& content, std::array<VoxMaterial, 256>& materials) {
    VoxMaterial& m = entry_of(content.take_int(), content, materials);
    const int kind = content.take_int();
    m = {};
    if (kind >= 0 && kind <= int(VoxMaterialKind::emit)) m.kind = VoxMaterialKind(kind);
    m.weight = std::clamp(content.take_float(), 0.0f, 1.0f);
    const int properties = content.take_int();
    // Bits for the values that follow, in their order; the last value has no bit.
    enum {
        plastic = 1,
        rough = 2,
        specular = 4,
        ior = 8,
        attenuation = 16,
        power = 32,
        emission = 64
    };
    for (const int property : {plastic, rough, specular, ior, attenuation, power, emission}) {
        if ((properties & property) == 0) continue;
        const float value = std::clamp(content.take_float(), 0.0f, 1.0f);
        if (property == rough) m.rough = value;
        if (property == specular) m.specular = value;
        if (property == ior) m.ior = 1 + value;
        if (property == attenuation) m.density = value;
        if (property == power) m.flux = 4 * value;
    }
}

const std::array<uint32_t, 256>& default_vox_palette() {
    static const std::array<uint32_t, 256> palette = [] {
        std::array<uint32_t, 256> colors{};
        constexpr uint32_t kOpaque = 0xFF000000;
        size_t next = 1;
        // Six levels of each colour, without black; then ten levels of red, green, blue and grey.
        for (uint32_t red = 0; red < 6; ++red)
            for (uint32_t green = 0; green < 6; ++green)
                for (uint32_t blue = 0; blue < 6; ++blue)
                    if (red + green + blue < 15)
                        colors[next++] = kOpaque | (255 - 51 * blue) << 16 |
                                         (255 - 51 * green) << 8 | (255 - 51 * red);
        for (const uint32_t channels : {0x000001u, 0x000100u, 0x010000u, 0x010101u})
            for (const uint32_t level :
                 {0xEEu, 0xDDu, 0xBBu, 0xAAu, 0x88u, 0x77u, 0x55u, 0x44u, 0x22u, 0x11u})
                colors[next++] = kOpaque | level * channels;
        return colors;
    }();
    return palette;
}

}  // namespace voxelume
