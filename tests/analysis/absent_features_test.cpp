// SPDX-License-Identifier: Apache-2.0
// The code of features that a scene doesn't use is absent from its kernels: the kernels are built
// although every function of those features calls one that doesn't exist.
#include <gtest/gtest.h>

#include <regex>
#include <set>
#include <sstream>

#include "kernels/shared/emitters.h"
#include "kernels/shared/sky.h"
#include "runtime/base/error.hpp"
#include "runtime/opencl/program.hpp"
#include "runtime/opencl/source/kernel_source.hpp"
#include "runtime/stages/features.hpp"
#include "tests/support/shared_device.hpp"

namespace voxelume {
namespace {

/// The text of a header after the body of every function is replaced by a call of a function that
/// nobody defines. Adds the number of replaced bodies to `functions`.
std::string gutted(const std::string& text, size_t& functions) {
    // A body is what stands between a line that ends in ") {" and the first line that is "}".
    static const std::regex body(R"(\) \{\n(?:[^}][^\n]*\n|\n)*\}\n)");
    std::string result;
    auto last = text.cbegin();
    for (std::sregex_iterator i(text.cbegin(), text.cend(), body), none; i != none; ++i) {
        result.append(last, (*i)[0].first);
        result += ") {\n    not_in_this_scene();\n    __builtin_unreachable();\n}\n";
        last = (*i)[0].second;
        ++functions;
    }
    return result.append(last, text.cend());
}

/// The text of a file without the kernels that aren't in `kept`.
std::string with_kernels(std::string text, const std::set<std::string>& kept) {
    constexpr std::string_view kKernel = "kernel void ";
    for (size_t at = text.find(kKernel); at != std::string::npos; at = text.find(kKernel, at)) {
        const size_t name = at + kKernel.size();
        if (kept.contains(text.substr(name, text.find('(', name) - name)))
            at = name;
        else
            text.erase(at, text.find("\n}\n", at) + 3 - at);
    }
    return text;
}

/// A file with only the named kernels and all that it includes. The `removed` files among these are
/// gutted.
class Source {
  public:
    Source(const std::string& file, std::set<std::string> kernels, std::set<std::string> removed)
        : kernels_(std::move(kernels)), removed_(std::move(removed)) {
        text_ = "void not_in_this_scene(void);\n";
        add(file);
    }
    const std::string& text() const { return text_; }
    size_t gutted_functions() const { return functions_; }

  private:
    void add(const std::string& file) {
        if (!seen_.insert(file).second) return;
        std::string text(embedded_kernels().at(file));
        text = with_kernels(std::move(text), kernels_);
        if (removed_.contains(file)) text = gutted(text, functions_);
        std::istringstream lines(text);
        for (std::string line; std::getline(lines, line);) {
            if (line.starts_with("#include \""))
                add(line.substr(10, line.rfind('"') - 10));
            else
                text_ += line + "\n";
        }
    }

    std::set<std::string> kernels_, removed_, seen_;
    std::string text_;
    size_t functions_ = 0;
};

/// Why a device can't say here that a kernel doesn't compile.
constexpr const char* kCompiledLater = "a kernel is compiled when it is launched";

/// The features of a scene of cubes with a light and shadows.
Features plain_features() {
    Features features;
    features.cubes = features.shadows = true;
    return features;
}

/// The headers to gut. medium_set.h, instances.h and cube_body.h stay, because the walk of all rays
/// uses parts of them.
const std::set<std::string> kRemoved = {
    "lib/surface/smooth.h",         "lib/surface/field.h",
    "lib/light/filter.h",           "lib/traverse/instance_hit.h",
    "lib/solid/solid_hit.h",        "lib/surface/triangle.h",
    "lib/surface/all_solids.h",     "lib/traverse/approach.h",
    "lib/surface/coincident.h",     "lib/solid/solid_ray.h",
    "lib/packets/begin_inside.h",   "lib/surface/glass_faces.h",
    "lib/surface/shading_normal.h", "lib/surface/paint.h",
    "lib/surface/source_mesh.h",    "lib/surface/texture_mean.h",
    "lib/surface/texture_alpha.h",  "lib/surface/texture_maps.h",
    "lib/light/mapped_layers.h",    "lib/surface/packed_normal.h",
    "lib/light/shading_point.h",    "lib/light/sky.h",
    "lib/light/sky_map.h",          "lib/light/rough_glass.h",
    "lib/light/light_rays.h",       "lib/lanes/exact_angle.h",
    "lib/sampling/sobol.h",         "lib/sampling/pixel_points.h",
    "lib/sampling/directions.h",    "lib/light/emitters.h",
    "lib/light/emission_share.h",   "lib/traverse/lens.h",
    "lib/light/path_samples.h",     "lib/light/ggx.h",
    "lib/light/physical.h",         "lib/light/physical_light.h"};

/// The kernels that frames of a plain scene launch, by file.
const std::map<std::string, std::set<std::string>> kLaunched = {
    {"sight.cl", {"cast_sight", "start_beams"}},
    {"trace.cl", {"trace_closest", "trace_shadows"}},
    {"shade.cl", {"shade_surface"}},
    {"light.cl", {"add_light"}}};

TEST(AbsentFeatures, AreNotInTheKernelsOfAPlainScene) {
    const Device& device = shared_device();
    size_t functions = 0;
    for (const auto& [file, kernels] : kLaunched) {
        const Source source(file, kernels, kRemoved);
        functions += source.gutted_functions();
        const Program program =
            Program::from_text(device, source.text(), plain_features().defines(device));
        for (const std::string& kernel : kernels) program.kernel(kernel);
    }
    EXPECT_GT(functions, 60u);
}

/// The number of a kernel's parameters, which the refusal of a launch without arguments tells.
int parameters_of(const char* file, const char* kernel, const Features& features) {
    const Device& device = shared_device();
    try {
        Program(device, file, features.defines(device)).kernel(kernel).launch(WorkItem::light, 1);
    } catch (const Error& error) {
        std::smatch number;
        const std::string text = error.what();
        if (std::regex_search(text, number, std::regex("has ([0-9]+) parameters")))
            return std::stoi(number[1]);
    }
    return -1;
}

TEST(AbsentFeatures, ArePhysicalSurfacesInGlobalLightWithoutThem) {
    if (!shared_device().is_cpu()) GTEST_SKIP() << kCompiledLater;
    Features features = plain_features();
    features.paths = features.global = features.area_samples = true;
    features.emitters = VXL_EMITTERS_BOTH;
    const std::set<std::string> removed = {"lib/light/ggx.h", "lib/light/physical.h",
                                           "lib/light/physical_light.h", "lib/light/rough_glass.h"};
    for (const auto& [file, kernel] : {std::pair("extend.cl", "extend_paths"),
                                       {"light.cl", "add_light"},
                                       {"area_light.cl", "add_area_light"}}) {
        const Source source(file, {kernel}, removed);
        EXPECT_GT(source.gutted_functions(), 8u) << file;
        Program::from_text(shared_device(), source.text(), features.defines(shared_device()))
            .kernel(kernel);
    }
    features.physical = true;
    const Source source("light.cl", {"add_light"}, removed);
    EXPECT_THROW(
        Program::from_text(shared_device(), source.text(), features.defines(shared_device())),
        Error);
}

TEST(AbsentFeatures, AreMapsOfTexturesInScenesWithoutThem) {
    if (!shared_device().is_cpu()) GTEST_SKIP() << kCompiledLater;
    Features features = plain_features();
    features.triangles = features.worn_triangles = true;
    const Source source("shade.cl", {"shade_surface"}, {"lib/surface/texture_maps.h"});
    EXPECT_GE(source.gutted_functions(), 4u);
    Program::from_text(shared_device(), source.text(), features.defines(shared_device()))
        .kernel("shade_surface");
    features.texture_maps = true;
    EXPECT_THROW(
        Program::from_text(shared_device(), source.text(), features.defines(shared_device())),
        Error);
}

TEST(AbsentFeatures, AreSourceMeshesInScenesOfExactTexturesAlone) {
    if (!shared_device().is_cpu()) GTEST_SKIP() << kCompiledLater;
    Features features = plain_features();
    features.triangles = features.smooth = features.worn_triangles = true;
    const Source source("shade.cl", {"shade_surface"}, {"lib/surface/source_mesh.h"});
    EXPECT_GE(source.gutted_functions(), 8u);
    Program::from_text(shared_device(), source.text(), features.defines(shared_device()))
        .kernel("shade_surface");
    const int fewer = parameters_of("shade.cl", "shade_surface", features);
    features.source_meshes = true;
    EXPECT_THROW(
        Program::from_text(shared_device(), source.text(), features.defines(shared_device())),
        Error);
    EXPECT_EQ(parameters_of("shade.cl", "shade_surface", features), fewer + 2);
}

TEST(AbsentFeatures, TakeNoArgumentsOfKernels) {
    Features with = plain_features();
    with.paths = with.global = true;
    const Features without = with;
    with.emitters = VXL_EMITTERS_BOTH;
    Features with_map = without;
    with_map.sky = VXL_SKY_MAP;
    with_map.sky_rays = VXL_EMITTERS_BOTH;
    constexpr int kEmitterParameters = 6, kMapParameters = 3;
    for (const auto& [file, kernel] :
         {std::pair("shade.cl", "shade_surface"), std::pair("extend.cl", "extend_paths")}) {
        const int fewer = parameters_of(file, kernel, without);
        EXPECT_GT(fewer, 20) << kernel;
        EXPECT_EQ(parameters_of(file, kernel, with), fewer + kEmitterParameters) << kernel;
        EXPECT_EQ(parameters_of(file, kernel, with_map), fewer + kMapParameters) << kernel;
    }
}

TEST(AbsentFeatures, WouldBeMissedWhereASceneHasThem) {
    if (!shared_device().is_cpu()) GTEST_SKIP() << kCompiledLater;
    Features smooth = plain_features();
    smooth.smooth = true;
    const Source source("trace.cl", kLaunched.at("trace.cl"), {"lib/surface/smooth.h"});
    EXPECT_THROW(
        Program::from_text(shared_device(), source.text(), smooth.defines(shared_device())), Error);
}

}  // namespace
}  // namespace voxelume
