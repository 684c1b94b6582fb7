// SPDX-License-Identifier: Apache-2.0
// Names and ranks as Cryptomatte's readers expect them.
#include "runtime/image/cryptomatte.hpp"

#include <gmock/gmock.h>

#include <bit>

namespace voxelume {
namespace {

TEST(Cryptomatte, HashesAreThoseOfMurmurHash3) {
    EXPECT_EQ(murmur_hash(""), 0u);
    EXPECT_EQ(murmur_hash("hello"), 0x248bfa47u);
    EXPECT_EQ(murmur_hash("hello, world"), 0x149bbb7fu);
    EXPECT_EQ(murmur_hash("19 Jan 2038 at 3:14:07 AM"), 0xe31e8a70u);
    EXPECT_EQ(murmur_hash("The quick brown fox jumps over the lazy dog."), 0xd5c48bfcu);
}

TEST(Cryptomatte, BitsAreThoseOfNormalNumbers) {
    EXPECT_EQ(cryptomatte_bits("hello"), 0x248bfa47u);
    EXPECT_EQ(cryptomatte_bits(""), 0x00800000u);  // 0 would be nothing
    int changed = 0;
    for (int i = 0; i < 2000; ++i) {
        const std::string name = "object " + std::to_string(i);
        const uint32_t bits = cryptomatte_bits(name);
        EXPECT_TRUE(std::isnormal(std::bit_cast<float>(bits))) << name;
        changed += int(bits != murmur_hash(name));
    }
    EXPECT_GT(changed, 2);  // 2 exponents of 256 are no normal numbers'
    EXPECT_LT(changed, 40);
}

TEST(Cryptomatte, RanksAreChannelsAndNamesAManifest) {
    Image image{2, 1, {}, {}, {}};
    const std::vector<std::string> names = {"b\"ox", "ball\\"};
    add_cryptomatte("CryptoObject", names,
                    {{2, 1, 1, 0, 0, 0, 0, 0}, {0.75f, 1, 0.25f, 0, 0, 0, 0, 0}, 4}, image);
    ASSERT_EQ(image.planes.size(), 8u);
    const auto bits = [&](const char* channel, size_t pixel) {
        return std::bit_cast<uint32_t>(image.planes.at(channel)[pixel]);
    };
    EXPECT_EQ(bits("CryptoObject00.R", 0), cryptomatte_bits("ball\\"));
    EXPECT_EQ(bits("CryptoObject00.R", 1), cryptomatte_bits("b\"ox"));
    EXPECT_EQ(bits("CryptoObject00.B", 0), cryptomatte_bits("b\"ox"));
    EXPECT_EQ(bits("CryptoObject00.B", 1), 0u);
    EXPECT_EQ(image.planes.at("CryptoObject00.G"), (Plane<float>{0.75f, 1}));
    EXPECT_EQ(image.planes.at("CryptoObject00.A"), (Plane<float>{0.25f, 0}));
    EXPECT_EQ(image.planes.at("CryptoObject01.A"), (Plane<float>{0, 0}));
    // The key is the start of the layer's own hash.
    ASSERT_EQ(image.attributes.size(), 4u);
    const std::string name = image.attributes.rbegin()->first;
    EXPECT_THAT(name, testing::MatchesRegex("cryptomatte/[0-9a-f]{7}/name"));
    EXPECT_EQ(image.attributes.at(name), "CryptoObject");
    const std::string manifest = image.attributes.at(name.substr(0, name.size() - 4) + "manifest");
    EXPECT_THAT(manifest,
                testing::MatchesRegex(
                    "\\{\"b\\\\\"ox\":\"[0-9a-f]{8}\",\"ball\\\\\\\\\":\"[0-9a-f]{8}\"\\}"));
}

TEST(Cryptomatte, NumbersWithoutANameAreNothing) {
    Image image{2, 1, {}, {}, {}};
    add_cryptomatte("CryptoObject", {"box"}, {{2, ~0u, 1, 0}, {1, 1, 0, 0}, 2}, image);
    EXPECT_EQ(image.planes.at("CryptoObject00.R"), (Plane<float>{0, 0}));
    EXPECT_EQ(image.planes.at("CryptoObject00.B")[0],
              std::bit_cast<float>(cryptomatte_bits("box")));
}

}  // namespace
}  // namespace voxelume
