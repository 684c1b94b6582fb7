// SPDX-License-Identifier: Apache-2.0
// The published schema and the parser give the same verdict on thousands of scenes.
#include <gtest/gtest.h>

// GCC 12 sees an overlap in std::string::replace where there is none (its PR 105651).
#pragma GCC diagnostic ignored "-Wrestrict"
#include <valijson/adapters/nlohmann_json_adapter.hpp>
#include <valijson/schema.hpp>
#include <valijson/schema_parser.hpp>
#include <valijson/validator.hpp>

#include <filesystem>
#include <fstream>
#include <functional>
#include <map>
#include <nlohmann/json.hpp>
#include <set>

#include "runtime/scene/scene.hpp"
#include "runtime/scene_file/document/scene_keys.hpp"
#include "runtime/scene_file/read_scene.hpp"
#include "tests/scene/full_scenes.hpp"
#include "tests/scene/small_scene.hpp"
#include "tests/support/exhaustive.hpp"
#include "tests/support/file_fixture.hpp"

namespace voxelume {
namespace {

using nlohmann::json;
using KeySet = std::set<std::string>;

json read_file(const std::filesystem::path& file) {
    std::ifstream stream(file);
    return json::parse(stream, nullptr, true, true);
}

class Schema {
  public:
    Schema() : text_(read_file(kScenes / "voxelume.schema.json")) {
        valijson::SchemaParser parser;
        parser.populateSchema(valijson::adapters::NlohmannJsonAdapter(text_), schema_);
    }
    bool accepts(const json& document) {
        valijson::Validator validator;
        return validator.validate(schema_, valijson::adapters::NlohmannJsonAdapter(document),
                                  nullptr);
    }

  private:
    json text_;
    valijson::Schema schema_;
};

/// A folder with the meshes that the scenes name.
class SceneSchema : public FileTest {
  protected:
    void SetUp() override {
        FileTest::SetUp();
        for (const char* file :
             {"bunny.obj", "m.obj", "m.glb", "around.hdr", "smoke.vdb", "s.1.vdb", "s.2.vdb"})
            put_bytes(folder / file, "v 0 0 0\n");
    }

    /// The parser's objection; empty if it accepts the scene.
    std::string objection(const json& document) {
        try {
            parse_scene(document.dump(), "s.json", {folder}, [](const Model&, bool) {
                return Bounds{{-1, -2, -3}, {1, 2, 3}};
            });
            return "";
        } catch (const Error& error) {
            return error.what();
        }
    }

    Schema schema_;
};

}  // namespace

TEST_F(SceneSchema, AcceptsEveryShippedSceneAsTheParserDoes) {
    int count = 0;
    for (const auto& entry : std::filesystem::directory_iterator(kScenes)) {
        if (entry.path().extension() != ".json" || entry.path().stem().extension() == ".schema")
            continue;
        SCOPED_TRACE(entry.path());
        EXPECT_TRUE(schema_.accepts(read_file(entry.path())));
        EXPECT_NO_THROW(read_scene(entry.path(), {folder}));
        ++count;
    }
    EXPECT_GE(count, 3);
}

namespace {

/// True for objections that a schema can't express: names and files, relations between values,
/// geometry.
bool is_beyond_a_schema(const std::string& objection) {
    for (const char* part : {"no material named",
                             "no model named",
                             "there is no file",
                             "empty along",
                             "voxels along",
                             "singular",
                             "parallel to",
                             "must not be zero",
                             "travels downwards",
                             "the position itself",
                             "nothing lies between",
                             "not be larger than",
                             "times as wide as",
                             "already",
                             "is an absolute path",
                             "only a mesh has groups",
                             "is not a file",
                             "above 0 along some axis",
                             "none of the object's materials",
                             "(at frame",
                             "that can change",
                             "has no place for",
                             "must not be smaller",
                             "files are missing",
                             "named \"o\"",
                             "there is no lights[0]",
                             "to change",
                             "not after the key before",
                             "has another form",
                             "there is nothing between",
                             "is for turns",
                             "not above that of the point before it",
                             "give the density a \"transfer\"",
                             "name its \"part\"",
                             "is a slope of a spline",
                             "numbers, and the key's value has",
                             "is no way between quaternions",
                             "is no quaternion",
                             "goes on behind",
                             "changes this value already",
                             "so nothing tells how large the world is",
                             "one point",
                             "farther than"}) {
        if (objection.find(part) != objection.npos) return true;
    }
    return false;
}

std::vector<json::json_pointer> places_in(const json& document) {
    std::vector<json::json_pointer> places;
    const std::function<void(const json&, const json::json_pointer&)> visit = [&](const json& value,
                                                                                  const auto& at) {
        places.push_back(at);
        if (value.is_object()) {
            for (const auto& [key, member] : value.items()) visit(member, at / key);
        } else if (value.is_array()) {
            for (size_t i = 0; i < value.size(); ++i) visit(value[i], at / i);
        }
    };
    visit(document, json::json_pointer());
    return places;
}

}  // namespace

class SceneVerdicts : public SceneSchema {
  protected:
    /// By default, one of four changes is tried at each path. Neighbouring paths get different
    /// changes, so that every path is changed and every change occurs at some paths.
    bool is_left_out() { return !is_exhaustive() && turn_++ % 4 != 0; }

    void expect_same_verdict(const json& document, const std::string& change) {
        const std::string refused = objection(document);
        const bool accepted = schema_.accepts(document);
        ++count_;
        if (accepted == refused.empty() || (accepted && is_beyond_a_schema(refused))) return;
        ADD_FAILURE() << change << ": the schema " << (accepted ? "accepts" : "refuses")
                      << " it, the parser says: " << (refused.empty() ? "fine" : refused);
    }
    size_t count_ = 0, turn_ = 0;
};

TEST_F(SceneVerdicts, AgreeOnScenesWithEveryKey) {
    KeySet seen;
    for (const json& scene : full_scenes()) {
        EXPECT_EQ(objection(scene), "");
        EXPECT_TRUE(schema_.accepts(scene));
        for (const auto& at : places_in(scene)) {
            if (!at.empty()) seen.insert(at.back());
        }
    }
    for (const KeyTable& table : scene_key_tables()) {
        for (const std::string_view key : table.keys)
            EXPECT_TRUE(seen.contains(std::string(key))) << key;
    }
}

TEST_F(SceneVerdicts, AgreeWhenAnyValueIsReplaced) {
    const json replacements = json::parse(
        R"([null, true, -1, 0, 0.5, 3, 1000000, 10000000, 2e9, -2e9, 179, 180, 361, "", "a", "nothing",
            "cubes", "box", [], {}, [1, 2], [1, 2, 3], [0, 0, 0], [-1, 2, 3], [1, 2, 3, 4], {"x": 1},
            {"": "a"}])");
    for (const json& scene : full_scenes()) {
        for (const auto& at : places_in(scene)) {
            for (const json& replacement : replacements) {
                if (is_left_out()) continue;
                json changed = scene;
                changed[at] = replacement;
                expect_same_verdict(changed, at.to_string() + " = " + replacement.dump());
            }
        }
    }
    EXPECT_GT(count_, 5000u);
}

TEST_F(SceneVerdicts, AgreeWhenAnyKeyOrItemIsTakenOutOrTwice) {
    for (const json& scene : full_scenes()) {
        for (const auto& at : places_in(scene)) {
            if (at.empty()) continue;
            json changed = scene;
            json& parent = changed[at.parent_pointer()];
            if (parent.is_object()) {
                parent.erase(at.back());
            } else {
                parent.erase(std::stoul(at.back()));
            }
            expect_same_verdict(changed, "without " + at.to_string());
            if (!scene[at.parent_pointer()].is_array()) continue;
            changed = scene;
            changed[at.parent_pointer()].push_back(scene[at]);
            expect_same_verdict(changed, "twice " + at.to_string());
        }
    }
}

TEST_F(SceneVerdicts, AgreeWhenAnyKeyIsAddedToAnyObject) {
    const json values = json::parse(
        R"({"position": [1, 2, 3], "turn": [1, 2, 3], "look_at": [4, 5, 6], "up": [1, 3, 2], "scale": 2,
            "direction": [1, 2, 3], "matrix": [[1, 0, 0, 0], [0, 1, 0, 0], [0, 0, 1, 0]],
            "mesh": "m.obj", "shape": "sphere", "voxel_size": 1, "resolution": 5, "surface": "smooth",
            "set": "solid", "angles": [10, 20], "angle": 30, "size": [1, 2, 3], "name": "fresh",
            "material": "default"})");
    for (const json& scene : full_scenes()) {
        for (const auto& at : places_in(scene)) {
            if (!scene[at].is_object()) continue;
            for (const KeyTable& table : scene_key_tables()) {
                for (const std::string_view key : table.keys) {
                    if (scene[at].contains(key) || is_left_out()) continue;
                    json changed = scene;
                    changed[at][std::string(key)] = values.value(std::string(key), json(0.5));
                    expect_same_verdict(changed, "with " + (at / std::string(key)).to_string());
                }
            }
        }
    }
}

}  // namespace voxelume
