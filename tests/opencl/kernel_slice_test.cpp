// SPDX-License-Identifier: Apache-2.0
// The contents of slices; compilers accept the slices of all kernels.
#include "runtime/opencl/source/kernel_slice.hpp"

#include <gmock/gmock.h>

#include <set>

#include "runtime/opencl/program.hpp"
#include "runtime/opencl/source/kernel_source.hpp"
#include "runtime/opencl/source/source_parts.hpp"
#include "tests/support/test_device.hpp"

namespace voxelume {
namespace {

/// The text of the first slice of a source.
std::string slice(std::string_view source, std::string_view options = "") {
    return slice_kernels(source, options).at(0).text;
}

TEST(KernelSlice, HasWhatItsKernelMentionsAndWhatThatMentions) {
    const std::vector<KernelSlice> slices = slice_kernels(
        "#pragma OPENCL FP_CONTRACT OFF\n"
        "int third(int x) { return x; }\n"
        "static inline __attribute__((always_inline)) int second(int x) { return third(x); }\n"
        "int other(int x) { return x; }\n"
        "kernel void f(global int* x) { *x = second(2); }\n"
        "kernel void g(global int* x) { *x = other(2); }\n",
        "");
    ASSERT_EQ(slices.size(), 2u);
    EXPECT_EQ(slices[0].kernel, "f");
    EXPECT_EQ(
        slices[0].text,
        "#pragma OPENCL FP_CONTRACT OFF\n"
        "int third(int x) { return x; }\n"
        "static inline __attribute__((always_inline)) int second(int x) { return third(x); }\n"
        "kernel void f(global int* x) { *x = second(2); }\n");
    EXPECT_EQ(slices[1].kernel, "g");
    EXPECT_EQ(slices[1].text,
              "#pragma OPENCL FP_CONTRACT OFF\n"
              "int other(int x) { return x; }\n"
              "kernel void g(global int* x) { *x = other(2); }\n");
}

TEST(KernelSlice, HasMacrosTypesAndConstantsThatAreMentioned) {
    EXPECT_EQ(slice("#define TWICE(x) \\\n    PLUS(x, x)\n"
                    "#define PLUS(x, y) ((x) + (y))\n"
                    "#define MINUS(x, y) ((x) - (y))\n"
                    "typedef struct { int a, b; } Pair;\n"
                    "typedef int Other[3];\n"
                    "constant int kTwo[1] = {2};\n"
                    "constant int kThree[1] = {3};\n"
                    "enum { kFour = 4 };\n"
                    "kernel void f(global Pair* x) { x->a = TWICE(kTwo[0]); }\n"),
              "#define TWICE(x)     PLUS(x, x)\n"
              "#define PLUS(x, y) ((x) + (y))\n"
              "typedef struct { int a, b; } Pair;\n"
              "constant int kTwo[1] = {2};\n"
              "enum { kFour = 4 };\n"
              "kernel void f(global Pair* x) { x->a = TWICE(kTwo[0]); }\n");
}

TEST(KernelSlice, BeginsWithTheConstantsOfTheOptionsThatItMentions) {
    EXPECT_EQ(slice("int g() { return OTHER; }\nkernel void f(global int* x) { *x = VALUE; }\n",
                    "-w -DOTHER=1 -DVALUE=3 -DVALUES=4"),
              "#define VALUE 3\nkernel void f(global int* x) { *x = VALUE; }\n");
}

TEST(KernelSlice, HasTheDirectivesAroundWhatItHolds) {
    constexpr std::string_view kSource =
        "#if OUTER\n#if INNER\nint g() { return 1; }\n#elif THIRD\nint g() { return 2; }\n"
        "#else\nint h() { return 3; }\n#endif\n#endif\n"
        "#ifdef EMPTY\nint i() { return 4; }\n#endif\n"
        "kernel void f(global int* x) { *x = g(); }\n";
    EXPECT_EQ(slice(kSource, "-DTHIRD=1 -DEMPTY=1 -DOUTER=1"),
              "#define OUTER 1\n#define THIRD 1\n"
              "#if OUTER\n#if INNER\nint g() { return 1; }\n#elif THIRD\nint g() { return 2; }\n"
              "#else\n#endif\n#endif\n"
              "kernel void f(global int* x) { *x = g(); }\n");
}

TEST(KernelSlice, HasADirectiveInsideOfADeclarationWithIt) {
    constexpr std::string_view kKernel =
        "kernel void f(global int* x\n#if MORE\n, int y\n#endif\n) { *x = 1; }\n";
    EXPECT_EQ(slice(kKernel, " -DMORE=1"), "#define MORE 1\n" + std::string(kKernel));
}

TEST(KernelSlice, DoesNotChangeWithCommentsAndNumbersOfLines) {
    const std::string plain =
        slice("int g() { return 1; }\nkernel void f(global int* x) { *x = g(); }\n");
    EXPECT_EQ(slice("#line 7 \"a\"\n/* one */int g() { return 1; }// ;{\n\n#line 9 \"b\"\n\n"
                    "kernel void f(global int* x) { *x = g(); }\n"),
              plain);
}

TEST(KernelSlice, LeavesOutWhatIsForCplusplus) {
    EXPECT_EQ(slice("#ifdef __cplusplus\n#if A\nnamespace b {\n#endif\n#else\nint g() { return 1; "
                    "}\n#endif\n"
                    "kernel void f(global int* x) { *x = g(); }\n"
                    "#ifdef __cplusplus\n}\n#endif\n"),
              "#if 1\nint g() { return 1; }\n#endif\nkernel void f(global int* x) { *x = g(); }\n");
}

TEST(KernelSlice, KeepsACallOfAMacroThatMayDefineAnything) {
    EXPECT_EQ(slice("#define MAKE(name) int name() { return 1; }\nMAKE(g)\n;\n"
                    "kernel void f(global int* x) { *x = g(); }\n"),
              "#define MAKE(name) int name() { return 1; }\nMAKE(g)\n;\n"
              "kernel void f(global int* x) { *x = g(); }\n");
}

/// The constants of a source that no kernel file defines, so that hosts do, each with `value`.
Defines constants_of(const std::string& source, int value) {
    static const std::set<std::string> defined = [] {
        std::set<std::string> names;
        for (const auto& [file, text] : embedded_kernels())
            for (const SourcePart& part : source_parts(text, {}))
                names.insert(part.names.begin(), part.names.end());
        return names;
    }();
    std::set<std::string> names;
    for (const SourcePart& part : source_parts(source, {}))
        for (const std::string_view word : identifiers(part.text))
            if (word.starts_with("VXL_") && !word.ends_with("_")) names.emplace(word);
    Defines constants;
    for (const std::string& name : names)
        if (!defined.contains(name)) constants.emplace_back(name, value);
    return constants;
}

/// A slice that lacks what its kernel needs doesn't compile.
class SlicesOfAllKernels : public testing::TestWithParam<int> {};

TEST_P(SlicesOfAllKernels, Compile) {
    const Device device = test_device();
    size_t kernels = 0;
    for (const auto& [file, text] : embedded_kernels()) {
        if (!file.ends_with(".cl")) continue;
        const std::string& source = kernel_source(file).text();
        Defines defines = constants_of(source, GetParam());
        std::erase_if(defines, [](const auto& define) { return define.first == "VXL_LANES"; });
        defines.emplace_back("VXL_LANES", GetParam() == 0 ? 1 : device.lanes());
        std::string options;
        for (const auto& [name, value] : defines) options += fmt::format(" -D{}={}", name, value);
        const std::vector<KernelSlice> slices = slice_kernels(source, options);
        EXPECT_FALSE(slices.empty()) << file;
        for (const KernelSlice& slice : slices) {
            // By default, each kernel has one of the two values.
            ++kernels;
            if (!is_exhaustive() && int(kernels % 2) != GetParam()) continue;
            EXPECT_NO_THROW(Program::from_text(device, slice.text, defines))
                << file << ": " << slice.kernel;
        }
    }
    EXPECT_GT(kernels, 80u);
}

INSTANTIATE_TEST_SUITE_P(Constants, SlicesOfAllKernels, testing::Values(0, 1));

}  // namespace
}  // namespace voxelume
