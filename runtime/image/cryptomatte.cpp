// SPDX-License-Identifier: Apache-2.0
#include "runtime/image/cryptomatte.hpp"

#include <fmt/format.h>

#include <bit>
#include <cstring>
#include <map>

namespace voxelume {
namespace {

uint32_t mixed(uint32_t block) {
    return std::rotl(block * 0xcc9e2d51u, 15) * 0x1b873593u;
}

/// A text in quotes of JSON, with all but printable ASCII as it is in UTF-8.
std::string json_text(std::string_view text) {
    std::string result = "\"";
    for (const char c : text) {
        if (c == '"' || c == '\\') result += '\\';
        if (static_cast<unsigned char>(c) < 0x20)
            result += fmt::format("\\u{:04x}", int(c));
        else
            result += c;
    }
    return result + "\"";
}

/// The names and the hexadecimal digits of their bits, as a JSON object.
std::string manifest_of(const std::vector<std::string>& names) {
    std::map<std::string, uint32_t> bits;
    for (const std::string& name : names) bits[name] = cryptomatte_bits(name);
    std::string text;
    for (const auto& [name, value] : bits)
        text += fmt::format("{}{}:\"{:08x}\"", text.empty() ? "" : ",", json_text(name), value);
    return "{" + text + "}";
}

}  // namespace

uint32_t murmur_hash(std::string_view text) {
    uint32_t hash = 0;
    size_t i = 0;
    for (; i + 4 <= text.size(); i += 4) {
        uint32_t block = 0;
        for (size_t byte = 0; byte < 4; ++byte)
            block |= uint32_t(static_cast<unsigned char>(text[i + byte])) << 8 * byte;
        hash = std::rotl(hash ^ mixed(block), 13) * 5 + 0xe6546b64u;
    }
    uint32_t rest = 0;
    for (size_t byte = 0; i + byte < text.size(); ++byte)
        rest |= uint32_t(static_cast<unsigned char>(text[i + byte])) << 8 * byte;
    if (i < text.size()) hash ^= mixed(rest);
    hash ^= uint32_t(text.size());
    hash = (hash ^ hash >> 16) * 0x85ebca6bu;
    hash = (hash ^ hash >> 13) * 0xc2b2ae35u;
    return hash ^ hash >> 16;
}

uint32_t cryptomatte_bits(std::string_view name) {
    uint32_t bits = murmur_hash(name);
    const uint32_t exponent = bits >> 23 & 255;
    if (exponent == 0 || exponent == 255) bits ^= 1u << 23;  // a denormal number, infinity or NaN
    return bits;
}

void add_cryptomatte(const std::string& layer, const std::vector<std::string>& names,
                     const RankedCoverage& coverage, Image& image) {
    const size_t pixels = size_t(image.width) * size_t(image.height);
    std::vector<float> ids{0.0f};
    for (const std::string& name : names)
        ids.push_back(std::bit_cast<float>(cryptomatte_bits(name)));
    constexpr const char* kChannels[] = {"R", "G", "B", "A"};
    for (uint32_t rank = 0; rank < coverage.ranks; ++rank) {
        std::vector<float> id(pixels), share(pixels);
        for (size_t i = 0; i < pixels; ++i) {
            const uint32_t number = coverage.numbers[rank * pixels + i];
            id[i] = number < ids.size() ? ids[number] : 0.0f;
            share[i] = coverage.shares[rank * pixels + i];
        }
        const std::string start = fmt::format("{}{:02}.", layer, rank / 2);
        image.planes[start + kChannels[rank % 2 * 2]] = std::move(id);
        image.planes[start + kChannels[rank % 2 * 2 + 1]] = std::move(share);
    }
    const std::string key =
        fmt::format("{}{}/", kMatteKey, fmt::format("{:08x}", murmur_hash(layer)).substr(0, 7));
    image.attributes[key + "name"] = layer;
    image.attributes[key + "hash"] = "MurmurHash3_32";
    image.attributes[key + "conversion"] = "uint32_to_float32";
    image.attributes[key + "manifest"] = manifest_of(names);
}

}  // namespace voxelume
