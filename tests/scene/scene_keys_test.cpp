// SPDX-License-Identifier: Apache-2.0
// The parser's table of keys, the published schema and the manual have the same keys.
#include "runtime/scene_file/document/scene_keys.hpp"

#include <gmock/gmock.h>

#include <filesystem>
#include <map>
#include <nlohmann/json.hpp>
#include <set>

#include "tests/scene/small_scene.hpp"
#include "tests/support/file_fixture.hpp"

namespace voxelume {
namespace {

using nlohmann::json;
using KeySet = std::set<std::string>;

/// Adds the keys that a definition of the schema allows, by kind where it has kinds.
void collect_keys(const std::string& name, const json& definition,
                  std::map<std::string, KeySet>& tables) {
    const std::set<std::string> selected_by_kind = {"model",   "part",    "light",
                                                    "display", "density", "sky"};
    if (!selected_by_kind.contains(name)) {
        for (const auto& [key, value] : definition["properties"].items()) tables[name].insert(key);
        return;
    }
    for (const json& branch : definition["allOf"]) {
        if (!branch.contains("if") || !branch["then"].contains("propertyNames")) continue;
        const json& condition = branch["if"];
        const std::string kind = condition.contains("properties")
                                     ? condition["properties"].begin().value()["const"]
                                     : condition["required"][0];
        for (const json& key : branch["then"]["propertyNames"]["enum"]) {
            tables[name + ":" + kind].insert(key);
            EXPECT_TRUE(definition["properties"].contains(key))
                << name << " " << kind << " " << key;
        }
    }
}

}  // namespace

TEST(SceneKeys, AreExactlyThoseOfTheSchema) {
    const json schema = json::parse(bytes_of(kScenes / "voxelume.schema.json"));
    std::map<std::string, KeySet> of_schema;
    collect_keys("scene", schema, of_schema);
    for (const auto& [name, definition] : schema["definitions"].items()) {
        if (definition.contains("properties")) collect_keys(name, definition, of_schema);
    }
    std::map<std::string, KeySet> of_parser;
    for (const KeyTable& table : scene_key_tables()) {
        of_parser[table.name] = KeySet(table.keys.begin(), table.keys.end());
    }
    EXPECT_EQ(of_schema, of_parser);
}

TEST(SceneKeys, AreAllInTheManual) {
    const std::string manual = bytes_of(kScenes / "README.md");
    for (const KeyTable& table : scene_key_tables()) {
        for (const std::string_view key : table.keys) {
            const std::string quoted = fmt::format("`{}`", key);
            const std::string in_example = fmt::format("\"{}\": ", key);
            EXPECT_TRUE(manual.find(quoted) != manual.npos ||
                        manual.find(in_example) != manual.npos)
                << table.name << " " << key;
        }
    }
}

}  // namespace voxelume
