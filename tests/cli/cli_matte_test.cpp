// SPDX-License-Identifier: Apache-2.0
// Mattes as a compositor reads them: from the file alone.
#include <gmock/gmock.h>

#include <bit>

#include "runtime/io/image/exr.hpp"
#include "tests/cli/scene_program.hpp"

namespace voxelume {
namespace {

using testing::HasSubstr;
using namespace std::string_literals;

class CliMatteTest : public SceneProgramTest {
  protected:
    static constexpr const char* kMattes =
        "render scene.json -q -o m.exr --samples 4 --channels RGBA,CryptoObject,CryptoMaterial ";

    void SetUp() override {
        SceneProgramTest::SetUp();
        write_scene([](Json& scene) {
            scene["materials"]["moss"] = {{"color", {0.2, 0.5, 0.1}}};
            scene["objects"].push_back({{"name", "Würfel \"2\""},
                                        {"model", "thing"},
                                        {"material", "moss"},
                                        {"position", {2.1, 1.2, 0.6}}});
        });
    }

    /// The names of a layer's manifest with the floats that stand for them.
    static std::map<std::string, float> names_of(const Image& image, const std::string& layer) {
        for (const auto& [key, value] : image.attributes) {
            if (!key.starts_with("cryptomatte/") || !key.ends_with("/name") || value != layer)
                continue;
            const std::string start = key.substr(0, key.size() - 4);
            EXPECT_EQ(image.attributes.at(start + "hash"), "MurmurHash3_32");
            EXPECT_EQ(image.attributes.at(start + "conversion"), "uint32_to_float32");
            std::map<std::string, float> names;
            const Json manifest = Json::parse(image.attributes.at(start + "manifest"));
            for (const auto& [name, bits] : manifest.items())
                names[name] = std::bit_cast<float>(
                    uint32_t(std::stoul(bits.get<std::string>(), nullptr, 16)));
            return names;
        }
        ADD_FAILURE() << "there is no " << layer;
        return {};
    }
};

TEST_F(CliMatteTest, AFileNamesWhatCoversItsPixels) {
    ASSERT_EQ(run(kMattes).exit_code, 0);
    const Image image = read_exr(folder / "m.exr");
    for (const std::string layer : {"CryptoObject", "CryptoMaterial"}) {
        const std::map<std::string, float> names = names_of(image, layer);
        std::map<float, std::string> by_id;
        for (const auto& [name, id] : names) by_id[id] = name;
        std::map<std::string, double> covered;
        for (size_t i = 0; i < image.planes.at("A").size(); ++i) {
            double sum = 0;
            for (const std::string rank : {"00.RG", "00.BA", "01.RG", "01.BA", "02.RG", "02.BA"}) {
                const auto value = [&](size_t channel) {
                    return image.planes.at(layer + rank.substr(0, 3) + rank[channel])[i];
                };
                if (value(4) == 0) continue;
                ASSERT_TRUE(by_id.contains(value(3))) << layer << rank << i;
                covered[by_id[value(3)]] += double(value(4));
                sum += double(value(4));
            }
            EXPECT_NEAR(sum, image.planes.at("A")[i], 1e-3) << i;  // A is a half
        }
        ASSERT_EQ(covered.size(), 2u) << layer;
        for (const auto& [name, pixels] : covered) EXPECT_GT(pixels, 5) << name;
    }
    EXPECT_TRUE(names_of(image, "CryptoObject").contains("Würfel \"2\""));
    EXPECT_TRUE(names_of(image, "CryptoMaterial").contains("moss"));
}

TEST_F(CliMatteTest, PartsHaveTheBytesOfTheWhole) {
    ASSERT_EQ(run(kMattes).exit_code, 0);
    const std::string whole = bytes_of(folder / "m.exr");
    std::filesystem::remove(folder / "m.exr");
    for (const char* shard : {"1/2", "2/2"})
        ASSERT_EQ(run(std::string(kMattes) + "--shard " + shard).exit_code, 0);
    ASSERT_EQ(run("merge m.exr.*.shard").exit_code, 0);
    EXPECT_EQ(bytes_of(folder / "m.exr"), whole);
}

TEST_F(CliMatteTest, AFileWithoutThemHasNoManifest) {
    ASSERT_EQ(run("render scene.json -q -o m.exr --channels RGBA,materialId").exit_code, 0);
    const Image image = read_exr(folder / "m.exr");
    EXPECT_EQ(image.planes.size(), 4u);
    EXPECT_TRUE(image.id_planes.contains("materialId"));
    for (const auto& [key, value] : image.attributes)
        EXPECT_FALSE(key.starts_with("crypto")) << key;
    EXPECT_THAT(expect_failure(2, "render scene.json -o x.exr --channels cryptoobject"),
                HasSubstr("did you mean \"CryptoObject\"?"));
    for (const auto& [channel, group] : {std::pair("R", "RGBA"), std::pair("N.X", "N")})
        EXPECT_THAT(
            expect_failure(2, fmt::format("render scene.json -o x.exr --channels {}", channel)),
            HasSubstr(fmt::format("ask for {}", group)));
}

TEST_F(CliMatteTest, PartsOfTheLightHaveTheBytesOfTheWholeToo) {
    write_scene([](Json& scene) {
        scene["lights"][0]["group"] = "key";
        scene["animation"] = Json::parse(R"({"frames": 2, "tracks": [{
            "target": "objects.thing.turn", "keys": [{"frame": 1, "value": [0, 0, 0]},
                                                     {"frame": 2, "value": [0, 9, 0]}]}]})");
    });
    const std::string line =
        "render scene.json -q -o l.exr --frames 1 --channels motion,albedo,indirect,shadow,lights ";
    ASSERT_EQ(run(line).exit_code, 0);
    const Image image = read_exr(folder / "l0001.exr");
    std::string names;
    for (const auto& [name, plane] : image.planes)
        if (name.ends_with(".R") || name.ends_with(".u")) names += name + " ";
    EXPECT_EQ(names, "albedo.R backward.u forward.u indirect.R light_key.R light_rest.R shadow.R ");
    EXPECT_EQ(image.planes.size(), 5u * 3 + 4);
    EXPECT_TRUE(image.id_planes.empty());
    const std::string whole = bytes_of(folder / "l0001.exr");
    std::filesystem::remove(folder / "l0001.exr");
    for (const char* shard : {"1/2", "2/2"}) ASSERT_EQ(run(line + "--shard " + shard).exit_code, 0);
    ASSERT_EQ(run("merge l.exr.*.shard").exit_code, 0);
    EXPECT_EQ(bytes_of(folder / "l0001.exr"), whole);
    ASSERT_EQ(run(line + "--device all/2").exit_code, 0);
    EXPECT_EQ(bytes_of(folder / "l0001.exr"), whole);
}

TEST_F(CliMatteTest, ShadowsOfVoxelsWithColorsAreThoseOfWhiteOnes) {
    put_bytes(folder / "red.ply",
              "ply\nformat ascii 1.0\nelement vertex 3\nproperty float x\nproperty float y\n"
              "property float z\nproperty uchar red\nproperty uchar green\nproperty uchar blue\n"
              "element face 1\nproperty list uchar int vertex_indices\nend_header\n"
              "0 0 0 255 0 0\n1 0 0 255 0 0\n0 0.7 0 255 0 0\n3 0 1 2\n");
    write_scene([](Json& scene) {
        scene["models"]["red"] = {{"mesh", "red.ply"}, {"surface", "cubes"}};
        scene["objects"][0]["model"] = "red";
        scene["objects"].push_back({{"model", "thing"}, {"position", {1.3, 1.2, 0.8}}});
        scene["lights"][0]["direction"] = {1, 0, -0.4};
    });
    ASSERT_EQ(run("render scene.json -q -o s.exr --channels albedo,shadow,objectId").exit_code, 0);
    const Image image = read_exr(folder / "s.exr");
    double hidden = 0, red = 0;
    for (size_t i = 0; i < image.planes.at("shadow.R").size(); ++i) {
        const float shadow = image.planes.at("shadow.R")[i];
        EXPECT_EQ(image.planes.at("shadow.G")[i], shadow) << i;
        EXPECT_EQ(image.planes.at("shadow.B")[i], shadow) << i;
        if (image.id_planes.at("objectId")[i] != 1) continue;
        hidden += double(shadow);
        red += double(image.planes.at("albedo.R")[i] - image.planes.at("albedo.G")[i]);
    }
    EXPECT_GT(hidden, 1);
    EXPECT_GT(red, 1);
}

TEST_F(CliMatteTest, AFileIsTheSameWhicheverOthersAreWritten) {
    write_scene([](Json& scene) {
        scene["materials"]["brick"]["opacity"] = 0.1;
        scene["lights"] = Json::array();
    });
    const std::string line = "render scene.json -q -o m.exr --channels CryptoObject ";
    ASSERT_EQ(run(line).exit_code, 0);
    const std::string alone = bytes_of(folder / "m.exr");
    ASSERT_EQ(run(line + "-o m.png").exit_code, 0);
    EXPECT_EQ(bytes_of(folder / "m.exr"), alone);
    float max = 0;
    const Image image = read_exr(folder / "m.exr");
    for (const float share : image.planes.at("CryptoObject00.G")) max = std::max(max, share);
    EXPECT_GT(max, 0.2f);
    EXPECT_LT(max, 0.9f);
}

TEST_F(CliMatteTest, AGroupsNameIsThatOfAChannel) {
    for (const std::string& name : {"a.b"s, "rest"s, "k ey"s, std::string(201, 'x')}) {
        write_scene([&](Json& scene) { scene["lights"][0]["group"] = name; });
        EXPECT_THAT(expect_render_failure(3), HasSubstr("scene.json:")) << name;
    }
    for (const size_t length : {26u, 200u}) {
        const std::string name(length, 'x');
        write_scene([&](Json& scene) { scene["lights"][0]["group"] = name; });
        ASSERT_EQ(run("render scene.json -q -o g.exr --channels lights").exit_code, 0);
        EXPECT_TRUE(read_exr(folder / "g.exr").planes.contains("light_" + name + ".R"));
    }
}

TEST_F(CliMatteTest, OtherProgramsFindTheMatteOfACrop) {
    if (run_line("oiiotool --version").exit_code != 0) GTEST_SKIP() << "there is no oiiotool";
    ASSERT_EQ(run(std::string(kMattes) + "--crop 2,3,15,8").exit_code, 0);
    const ProgramResult info = run_line("oiiotool --info -v m.exr");
    EXPECT_THAT(info.out, testing::AllOf(HasSubstr("CryptoMaterial00.R"), HasSubstr("manifest"),
                                         HasSubstr("full/display size: 20 x 12"),
                                         HasSubstr("pixel data origin: x=2, y=3")));
    EXPECT_EQ(info.err, "");
    ASSERT_EQ(
        run_line("oiiotool m.exr --ch CryptoObject00.R,CryptoMaterial02.A -o c.exr").exit_code, 0);
    const Image chosen = read_exr(folder / "c.exr"), image = read_exr(folder / "m.exr");
    EXPECT_EQ(chosen.first, glm::ivec2(2, 3));
    for (const auto& [name, plane] : chosen.planes) EXPECT_EQ(plane, image.planes.at(name)) << name;
}

}  // namespace
}  // namespace voxelume
