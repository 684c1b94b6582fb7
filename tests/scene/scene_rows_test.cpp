// SPDX-License-Identifier: Apache-2.0
// The descriptor rows of the scene's values agree with the published schema and the manual.
#include <gmock/gmock.h>

#include <filesystem>
#include <map>
#include <nlohmann/json.hpp>
#include <set>

#include "runtime/scene/parts/light.hpp"
#include "runtime/scene/parts/material.hpp"
#include "runtime/scene/parts/object.hpp"
#include "runtime/scene/parts/observer.hpp"
#include "runtime/scene/parts/scene_affine.hpp"
#include "runtime/scene/parts/solid.hpp"
#include "runtime/scene/parts/world.hpp"
#include "tests/scene/small_scene.hpp"
#include "tests/support/file_fixture.hpp"

namespace voxelume {
namespace {

using nlohmann::json;

class SceneRows : public testing::Test {
  protected:
    /// The limits that a property of the schema gives for a number, or for each number of a list.
    json limits_of(const json& property) const {
        json limits = json::object();
        for (const char* key : {"minimum", "maximum", "exclusiveMinimum", "exclusiveMaximum"})
            if (property.contains(key)) limits[key] = property[key];
        for (const char* key : {"allOf", "anyOf", "oneOf"})
            if (property.contains(key)) limits.update(limits_of(property[key][0]));
        if (property.contains("items")) limits.update(limits_of(property["items"]));
        if (property.contains("$ref")) {
            const std::string name = property["$ref"];
            limits.update(limits_of(definitions[name.substr(name.rfind('/') + 1)]));
        }
        return limits;
    }

    static void expect_range(const json& limits, Range range, const std::string& value) {
        const auto expect_end = [&](const char* open, const char* closed, double end,
                                    bool is_open) {
            ASSERT_TRUE(limits.contains(is_open ? open : closed)) << value << " " << limits;
            EXPECT_EQ(limits[is_open ? open : closed], end) << value;
        };
        expect_end("exclusiveMinimum", "minimum", range.min, range.min_is_open);
        expect_end("exclusiveMaximum", "maximum", range.max, range.max_is_open);
    }

    /// True if a default part's value is that of the schema, or if the schema gives none.
    template <class Part>
    void expect_default(const json& property, const ValueRow<Part>& row) const {
        if (!property.contains("default")) return;
        Part part;
        const Slot slot = row.slot(part);
        const json& written = property["default"];
        const auto expect = [&](const auto& value) { EXPECT_EQ(written, value) << row.key; };
        if (const auto* number = std::get_if<double*>(&slot)) expect(**number);
        if (const auto* number = std::get_if<float*>(&slot)) expect(**number);
        if (const auto* number = std::get_if<int*>(&slot)) expect(**number);
        if (const auto* flag = std::get_if<bool*>(&slot)) expect(**flag);
    }

    template <class Part>
    void expect_rows(const std::string& definition, std::span<const ValueRow<Part>> rows) const {
        for (const ValueRow<Part>& row : rows) {
            const std::string key(row.key);
            ASSERT_TRUE(definitions[definition]["properties"].contains(key)) << definition << key;
            const json& property = definitions[definition]["properties"][key];
            expect_default(property, row);
            const json limits = limits_of(property);
            EXPECT_EQ(limits.empty(), row.range.min == row.range.max) << definition << " " << key;
            if (!limits.empty()) expect_range(limits, row.range, definition + " " + key);
        }
    }

    /// The branch of a definition that applies to a kind.
    const json& branch_of(const std::string& definition, std::string_view kind) const {
        for (const json& branch : definitions[definition]["allOf"]) {
            if (!branch.contains("if") || !branch["if"].contains("properties")) continue;
            if (branch["if"]["properties"].begin().value().value("const", "") == kind)
                return branch["then"];
        }
        throw std::runtime_error("no kind " + std::string(kind));
    }

    template <class Kind, class Part>
    void expect_kinds(const std::string& definition, std::span<const Kind> kinds,
                      std::span<const ValueRow<Part>> rows) const {
        for (const Kind& kind : kinds) {
            const json& branch = branch_of(definition, kind.name);
            std::set<std::string> required, written;
            if (branch.contains("required")) written = branch["required"];
            for (const KindKey& key : kind.keys) {
                if (key.is_required) required.emplace(key.key);
                const ValueRow<Part>* row = find_row(rows, key.key);
                if (row == nullptr || row->range.min == row->range.max) continue;
                const std::string name(key.key);
                json limits = limits_of(definitions[definition]["properties"][name]);
                if (branch.contains("properties") && branch["properties"].contains(name))
                    limits.update(limits_of(branch["properties"][name]));
                expect_range(limits, key.range.value_or(row->range), definition + " " + name);
            }
            EXPECT_EQ(required, written) << definition << " " << kind.name;
            EXPECT_THAT(manual, testing::HasSubstr(std::string(kind.name))) << definition;
        }
    }

    const json definitions = json::parse(bytes_of(kScenes / "voxelume.schema.json"))["definitions"];
    const std::string manual = bytes_of(kScenes / "README.md");
};

/// Rows that replace the display's rows, because those have different limits for each shape.
std::vector<ValueRow<DisplayParameters>> display_rows_alike() {
    std::vector<ValueRow<DisplayParameters>> rows;
    for (const ValueRow<DisplayParameters>& row : display_rows())
        if (row.key != "angle") rows.push_back(row);
    return rows;
}

}  // namespace

TEST_F(SceneRows, HaveTheLimitsAndDefaultsOfTheSchema) {
    expect_rows("world", world_rows());
    expect_rows("medium", medium_rows());
    expect_rows("sky", sky_rows());
    expect_rows("density", height_density_rows());
    expect_rows("density", ball_density_rows());
    expect_rows("density", factor_rows());
    expect_rows("material", material_rows());
    expect_rows("checker", checker_rows());
    expect_rows("morph", morph_rows());
    expect_rows("model", solid_rows());
    expect_rows("part", solid_rows());
    expect_rows("part", factor_rows());
    expect_rows("object", factor_rows());
    expect_rows("light", light_rows());
    expect_rows("observer", observer_rows());
    const auto alike = display_rows_alike();
    expect_rows("display", std::span<const ValueRow<DisplayParameters>>(alike));
}

TEST_F(SceneRows, OfEachKindAreThoseThatTheSchemaRequires) {
    expect_kinds("light", light_types(), light_rows());
    expect_kinds("display", display_shapes(), display_rows());
    expect_kinds("part", solid_types(), solid_rows());
    expect_kinds("density", density_kinds(), height_density_rows());
    expect_kinds("sky", sky_types(), sky_rows());
}

TEST_F(SceneRows, OfKindsHaveTheOrderOfTheirEnumerators) {
    for (size_t i = 0; i < light_types().size(); ++i) EXPECT_EQ(size_t(light_types()[i].kind), i);
    for (size_t i = 0; i < solid_types().size(); ++i) EXPECT_EQ(size_t(solid_types()[i].kind), i);
    for (size_t i = 0; i < display_shapes().size(); ++i)
        EXPECT_EQ(size_t(display_shapes()[i].shape), i);
    EXPECT_EQ(density_kinds().size() + 1, std::variant_size_v<Density>);
}

TEST(MaterialEffects, AreThoseOfValuesThatDifferFromTheDefaults) {
    Material material;
    material.color = {0, 0, 0};
    material.ior = 2;
    EXPECT_EQ(effects_of(material), 0);
    material.opacity = 0.5f;
    material.emission = {0, 0, 1};
    EXPECT_EQ(effects_of(material), kIsSeenThrough | kEmits);
    material = {};
    material.reflection = material.refraction = 1;
    material.fresnel = true;
    material.absorption.x = 1;
    EXPECT_EQ(effects_of(material), kReflects | kRefracts | kHasReflectance | kAbsorbs);
    material = {};
    material.roughness = 0.5;  // the one that counts without it, too
    EXPECT_EQ(effects_of(material), kIsPhysical);
    material.metallic = 1;
    EXPECT_EQ(effects_of(material), kIsPhysical | kReflects);
}

TEST(PhysicalMaterials, HaveThePlaceInWhittedsModelThatTheManualTells) {
    Material brass;
    brass.base_color = {0.9, 0.7, 0.25};
    brass.metallic = 0.75;
    brass.roughness = 0.5;
    brass.opacity = 0.5f;
    const Material shown = whitted_material(brass);
    EXPECT_FALSE(is_physical(shown));
    EXPECT_EQ(shown.color, glm::vec3(0.9f, 0.7f, 0.25f));
    EXPECT_NEAR(shown.diffuse, 0.25 + 0.75 * (1 - 0.25 - 0.8 * 8 / 37.6), 1e-6);
    EXPECT_DOUBLE_EQ(shown.specular.value(), 0.8 * 0.75 + 0.2 * 0.25 * 0.5);
    EXPECT_FLOAT_EQ(shown.shininess, 30);
    EXPECT_FLOAT_EQ(shown.reflection, 0.75f * 0.25f);
    EXPECT_DOUBLE_EQ(metal_tint(brass).highlight, 0.6 / 0.625);
    EXPECT_DOUBLE_EQ(metal_tint(brass).mirror, 1);
    brass.transmission = 0.5;
    EXPECT_DOUBLE_EQ(metal_tint(brass).mirror, 0.1875 / (0.1875 + 0.125));
    EXPECT_EQ(shown.refraction, 0);
    EXPECT_EQ(shown.opacity, 0.5f);
    Material lacquer;
    lacquer.roughness = 0.5;
    lacquer.specular = 0.25;
    EXPECT_DOUBLE_EQ(whitted_material(lacquer).specular.value(), 0.2 * 0.25 * 0.5);
    lacquer.coat = 0.5;
    lacquer.coat_roughness = 0.3;
    EXPECT_EQ(effects_of(lacquer), kIsPhysical | kHasCoat);
    EXPECT_DOUBLE_EQ(whitted_material(lacquer).specular.value(), 0.2 * 0.5 * 0.7);
    EXPECT_EQ(metal_tint(lacquer).highlight, 0);
    EXPECT_FLOAT_EQ(whitted_material(lacquer).shininess, float(2 / std::pow(0.3, 4) - 2));
    EXPECT_FALSE(is_physical(whitted_material(lacquer)));
    Material plain;
    plain.reflection = 0.25f;
    EXPECT_EQ(whitted_material(plain), plain);
}

}  // namespace voxelume
