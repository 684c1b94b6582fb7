// SPDX-License-Identifier: Apache-2.0
// The published schema of `render --stats-json` accepts what the program writes, and the manual
// names the schema's keys.
#include <gtest/gtest.h>

// GCC 12 sees an overlap in std::string::replace where there is none (its PR 105651).
#pragma GCC diagnostic ignored "-Wrestrict"
#include <valijson/adapters/nlohmann_json_adapter.hpp>
#include <valijson/schema.hpp>
#include <valijson/schema_parser.hpp>
#include <valijson/validation_results.hpp>
#include <valijson/validator.hpp>

#include <filesystem>
#include <string>

#include "tests/cli/scene_program.hpp"

namespace voxelume {
namespace {

namespace fs = std::filesystem;
const fs::path kManual = fs::path(VXL_SOURCE_DIR) / "cli";

class StatisticsSchemaTest : public SceneProgramTest {
  protected:
    void SetUp() override {
        SceneProgramTest::SetUp();
        text_ = Json::parse(bytes_of(kManual / "statistics.schema.json"));
        valijson::SchemaParser parser;
        parser.populateSchema(valijson::adapters::NlohmannJsonAdapter(text_), schema_);
    }

    /// The faults of a document; empty if there are none.
    std::string faults(const Json& document) {
        valijson::Validator validator;
        valijson::ValidationResults results;
        validator.validate(schema_, valijson::adapters::NlohmannJsonAdapter(document), &results);
        std::string text;
        for (const valijson::ValidationResults::Error& error : results) {
            for (const std::string& step : error.context) text += step;
            text += ": " + error.description + "\n";
        }
        return text;
    }

    /// The statistics that the program writes for `render` with these options.
    Json statistics(const std::string& options) {
        const ProgramResult result =
            run("render scene.json --no-cache --stats-json stats.json " + options);
        EXPECT_EQ(result.exit_code, 0) << result.err;
        return Json::parse(bytes_of(folder / "stats.json"));
    }

    Json text_;

  private:
    valijson::Schema schema_;
};

/// Adds every key that a schema names, at its top and in its parts.
void list_keys(const Json& schema, std::vector<std::string>& keys) {
    if (schema.contains("items") && schema["items"].is_object()) list_keys(schema["items"], keys);
    if (!schema.contains("properties")) return;
    for (const auto& [key, value] : schema["properties"].items()) {
        keys.push_back(key);
        list_keys(value, keys);
    }
}

TEST_F(StatisticsSchemaTest, HoldsForAnImage) {
    EXPECT_EQ(faults(statistics("-o a.exr -o a.png")), "");
}

TEST_F(StatisticsSchemaTest, HoldsForFramesWithInstances) {
    write_scene([](Json& scene) {
        scene["animation"] = Json::parse(R"({"frames": 2, "tracks": [
            {"target": "objects[0].turn", "keys": [{"frame": 1, "value": [0, 0, 0]},
                                                   {"frame": 2, "value": [90, 40, 0]}]}]})");
    });
    const Json frames = statistics("-o f.#.exr --frames 1-3");
    EXPECT_EQ(faults(frames), "");
    EXPECT_TRUE(frames.contains("instances"));
    ASSERT_EQ(frames["frames"].size(), 3u);
    EXPECT_EQ(frames["frames"][1]["world"], "instances moved");
    EXPECT_EQ(frames["frames"][2]["world"], "kept");
}

TEST_F(StatisticsSchemaTest, HoldsForAVolumeAndForSeveralDevices) {
    EXPECT_EQ(faults(statistics("--volume v.nrrd")), "");
    const Json shared = statistics("-o a.exr --size 512x128 --device all/2");
    EXPECT_EQ(faults(shared), "");
    EXPECT_EQ(shared["devices"].size(), 2u);
}

TEST_F(StatisticsSchemaTest, HasTheNoiseThatAnImageWithATargetReached) {
    write_scene([](Json& scene) { scene["world"]["background"] = {1, 0.5, 0.25}; });
    const Json noisy = statistics("-o a.exr --light global --noise 0.01 --samples 64");
    EXPECT_EQ(faults(noisy), "");
    ASSERT_TRUE(noisy.contains("noise"));
    EXPECT_GT(noisy["noise"], 0);
    EXPECT_LT(noisy["noise"], 0.5);
    const ProgramResult info = run("info a.exr");
    EXPECT_NE(info.out.find("noise"), info.out.npos) << info.out;
    const Json timed = statistics("-o a.exr --light global --time 30s --samples 128");
    EXPECT_GT(timed["noise"], 0);
    const Json dark = statistics(
        "-o a.exr --noise 0.01 --samples 64 --set 'lights=[]' --set world.ambient=0,0,0 "
        "--set world.background=0,0,0");
    EXPECT_EQ(dark["noise"], 0);
    EXPECT_FALSE(statistics("-o a.exr --light global --samples 4").contains("noise"));
    EXPECT_EQ(run("render scene.json -o a.exr --noise 0.1 --samples 16").exit_code, 2);
}

TEST_F(StatisticsSchemaTest, HasTheNoiseThatAVolumetricImageReached) {
    write_scene(lit_by_disk);
    const std::string options = "--light global --noise 0.05 --samples 64 ";
    const Json both = statistics(options + "-o a.exr --volume v.json");
    EXPECT_EQ(faults(both), "");
    ASSERT_TRUE(both.contains("volume_noise"));
    EXPECT_GT(both["volume_noise"], 0);
    EXPECT_NE(both["volume_noise"], both["noise"]);
    const Json volume = Json::parse(bytes_of(folder / "v.json"));
    EXPECT_EQ(volume["attributes"]["noise"],
              fmt::format("{:.5f}", both["volume_noise"].get<double>()));
    const Json alone = statistics(options + "--volume v.json");
    EXPECT_FALSE(alone.contains("noise"));
    EXPECT_EQ(alone["volume_noise"], both["volume_noise"]);
    EXPECT_FALSE(statistics("--volume v.json --light global --samples 4").contains("volume_noise"));
}

TEST_F(StatisticsSchemaTest, RefusesAMissingKeyAndOneTooMany) {
    const Json good = statistics("-o a.png");
    for (const auto& [key, value] : good.items()) {
        Json less = good;
        less.erase(key);
        EXPECT_NE(faults(less), "") << key;
    }
    Json more = good;
    more["frames"][0]["stray"] = 1;
    EXPECT_NE(faults(more), "");
}

TEST_F(StatisticsSchemaTest, HasItsKeysInTheManual) {
    const std::string manual = bytes_of(kManual / "STATISTICS.md");
    std::vector<std::string> keys;
    list_keys(text_, keys);
    EXPECT_GT(keys.size(), 60u);
    for (const std::string& key : keys)
        EXPECT_NE(manual.find("| `" + key + "` |"), manual.npos) << key;
}

}  // namespace
}  // namespace voxelume
