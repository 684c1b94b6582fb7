// SPDX-License-Identifier: Apache-2.0
// The contents of slices; compilers accept the slices of all kernels.
#include "runtime/opencl/source/kernel_slice.hpp"

#include <fmt/format.h>
#include <gmock/gmock.h>

#include <set>
#include <sstream>

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
              "typedef struct { int a, b; } Pair;\n"
              "#define PLUS(x, y) ((x) + (y))\n"
              "#define TWICE(x)     PLUS(x, x)\n"
              "constant int kTwo[1] = {2};\n"
              "kernel void f(global Pair* x) { x->a = TWICE(kTwo[0]); }\n");
}

TEST(KernelSlice, BeginsWithTheConstantsOfTheOptionsThatItMentions) {
    EXPECT_EQ(slice("int g() { return OTHER; }\nkernel void f(global int* x) { *x = VALUE; }\n",
                    "-w -DOTHER=1 -DVALUE=3 -DVALUES=4"),
              "#define VALUE 3\nkernel void f(global int* x) { *x = VALUE; }\n");
}

TEST(KernelSlice, IsInAnOrderThatTheSourcesOrderDoesNotChange) {
    const std::string a = "int a() { return 1; }\n", b = "int b() { return 2; }\n",
                      kernel = "kernel void f(global int* x) { *x = b() - a(); }\n";
    EXPECT_EQ(slice(a + b + kernel), b + a + kernel);
    EXPECT_EQ(slice(b + a + kernel), b + a + kernel);
}

TEST(KernelSlice, HasTheCheckOfATypeThatItHas) {
    const std::string macro = "#define SIZE_IS(type, size) typedef char size_of_##type[size]\n",
                      kernel = "kernel void f(global Used* x) { x->a = 1; }\n",
                      used = "typedef struct Used { int a; } Used;\n";
    EXPECT_EQ(slice(macro + used + "SIZE_IS(Used, 4);\ntypedef int Other;\nSIZE_IS(Other, 4);\n" +
                    kernel),
              used + macro + "SIZE_IS(Used, 4);\n" + kernel);
}

TEST(KernelSlice, HasNoFunctionWhoseNameAVariableOrAMemberHas) {
    const std::string functions =
        "int a() { return 1; }\nint b() { return 2; }\nint c() { return 3; }\n"
        "int d() { return 4; }\n#define E() 5\n";
    for (const std::string body :
         {"int a = 2; *x = a;", "int o, a = 2; *x = a;", "int o, a; *x = a;", "*x = p->a;",
          "*x = p.a + p . x;", "global int* a = x; *a = 1;",
          "for (int a = 0; a < 3; ++a) *x = a;"}) {
        const std::string kernel = "kernel void f(global int* x) { " + body + " }\n";
        EXPECT_EQ(slice(functions + kernel), kernel);
    }
    // What may be a function, as the argument of a macro can, is one.
    for (const std::string body : {"*x = (a)();", "*x = CALL(a);", "*x = p * a;", "return a;"}) {
        const std::string kernel = "kernel void f(global int* x) { " + body + " }\n";
        EXPECT_EQ(slice(functions + kernel), "int a() { return 1; }\n" + kernel);
    }
}

TEST(KernelSlice, HasWhatOtherNamesStandFor) {
    const std::string g = "int g() { return 1; }\n";
    const auto kernel = [](const std::string& body) {
        return "kernel void f(global int* x) { " + body + " }\n";
    };
    for (const auto& [parts, body] : {
             std::pair(g + "#define h g\n", "*x = h();"),
             std::pair(std::string("typedef enum { kA = 3, kB } Kind;\n"), "*x = kB;"),
             std::pair(std::string("typedef struct Node { int a; } NodeRecord;\n"),
                       "struct Node n; *x = n.a;"),
             std::pair(std::string("#define AXIS x\n"), "*x = p.AXIS;"),
             std::pair(std::string("#define LANE(i) s##i\n"), "*x = p->LANE(1);"),
             std::pair(std::string("#define READ(t) t read_##t(t p) { return p; }\nREAD(int)\n;\n"),
                       "*x = read_int(2);"),
         })
        EXPECT_EQ(slice(parts + kernel(body)), parts + kernel(body));
}

TEST(KernelSlice, HasAllOfASourceWhoseOrderCounts) {
    const std::string source =
        "#define A 1\nkernel void f(global int* x) { *x = A; }\n#undef A\n#define A 2\n"
        "kernel void g(global int* x) { *x = A + VXL_B; }\n";
    for (const KernelSlice& slice : slice_kernels(source, "-DVXL_B=3 -DVXL_C=4"))
        EXPECT_EQ(slice.text, "#define VXL_B 3\n" + source) << slice.kernel;
    const std::string kernel = "kernel void f(global int* x) { *x = g(1); }\n",
                      g = "int g(int x) { return x; }\n",
                      pragma = "#pragma OPENCL FP_CONTRACT OFF\n";
    for (const std::string& other : {g + pragma, "float g(float x) { return x; }\n" + g})
        EXPECT_EQ(slice("int unused() { return 1; }\n" + other + kernel),
                  "int unused() { return 1; }\n" + other + kernel);
}

TEST(KernelSlice, HasTheBranchesThatItsConstantsChoose) {
    constexpr std::string_view kSource =
        "#ifndef VXL_A\n#define VXL_A 3\n#endif\n#define VXL_B(x) (VXL_A == 2 && (x) > 0x1u)\n"
        "#if VXL_A == 3\nint g() { return 3; }\n#elif VXL_B(VXL_A)\nint g() { return 2; }\n"
        "#else\n#if VXL_UNKNOWN\nint g() { return 0; }\n#else\nint g() { return 1; "
        "}\n#endif\n#endif\n"
        "kernel void f(global int* x) { *x = g(); }\n";
    constexpr std::string_view kKernel = "kernel void f(global int* x) { *x = g(); }\n";
    for (const auto& [options, value] :
         {std::pair("", "3"), std::pair("-DVXL_A=2", "2"), std::pair("-w -DVXL_A", "1")})
        EXPECT_EQ(slice(kSource, options),
                  fmt::format("int g() {{ return {}; }}\n{}", value, kKernel));
}

TEST(KernelSlice, ComputesConditionsAsCompilersDo) {
    for (const auto& [condition, holds] :
         {std::pair("1 + 2 * 3 == 7", true), std::pair("(1 + 2) * 3 == 7", false),
          std::pair("1 << 2 + 1 == 8", true), std::pair("2 | 4 & 1", true),
          std::pair("!1 || 0 && 1", false), std::pair("6 ^ 3 ^ 5", false),
          std::pair("-1 < 0 && ~0 == -1", true), std::pair("0 ? 1 : 1 ? 0 : 1", false),
          std::pair("10 - 3 - 7", false), std::pair("0x10u >> 2 != 4", false)})
        EXPECT_EQ(slice(fmt::format(
                      "kernel void f(global int* x) {{\n#if {}\n*x = 1;\n#endif\n}}\n", condition)),
                  fmt::format("kernel void f(global int* x) {{\n{}}}\n", holds ? "*x = 1;\n" : ""))
            << condition;
}

TEST(KernelSlice, KeepsConditionsThatOnlyACompilerKnows) {
    const std::string kernel = "kernel void f(global int* x) { *x = g(); }\n",
                      macros =
                          "#if defined(__clang__) && VXL_A\n#define g() 1\n#else\n"
                          "#define g() 2\n#endif\n",
                      functions =
                          "#ifdef FAST\nint g() { return 1; }\n#else\n"
                          "int g() { return 2; }\n#endif\n";
    EXPECT_EQ(slice(macros + kernel, "-DVXL_A=1 -DVXL_B=1"), "#define VXL_A 1\n" + macros + kernel);
    EXPECT_EQ(slice(functions + kernel), functions + kernel);
    const std::string other = "kernel void f(global int* x) { *x = 1; }\n";
    EXPECT_EQ(slice(macros + other, "-DVXL_A=1"), other);
    EXPECT_EQ(
        slice("#if VXL_A\n#elif __FAST_MATH__\n#define g() 1\n#else\n#define g() 2\n#endif\n" +
              kernel),
        "#if __FAST_MATH__\n#define g() 1\n#else\n#define g() 2\n#endif\n" + kernel);
    // What is defined in such a condition isn't known behind it.
    EXPECT_THAT(slice(macros + "#if g()\n#define h() 1\n#endif\n" +
                      "kernel void f(global int* x) { *x = h(); }\n"),
                testing::HasSubstr("#if g()"));
}

TEST(KernelSlice, HasTheNumberThatAMacroOfNumbersStandsFor) {
    const std::string kernel = "kernel void f(global int* x) { *x = VXL_BOTH; }\n";
    EXPECT_EQ(slice("#define VXL_BOTH (VXL_A && !VXL_B)\n" + kernel, "-DVXL_A=1 -DVXL_B=0"),
              "#define VXL_BOTH 1\n" + kernel);
    EXPECT_EQ(slice("#define VXL_BOTH (1 - VXL_A)\n" + kernel, "-DVXL_A=4"),
              "#define VXL_BOTH (-3)\n" + kernel);
    // An unsigned number makes others unsigned, and what isn't defined here may be further down.
    for (const std::string line :
         {"#define VXL_BOTH (VXL_A ? 1u : 2u)\n", "#define VXL_BOTH (VXL_A + VXL_LATER)\n",
          "#define VXL_BOTH x[VXL_A]\n", "#define VXL_BOTH VXL_A + 1\n",
          "#define VXL_BOTH (VXL_A) + (1)\n", "#define VXL_BOTH (VXL_A << 31)\n",
          "#define VXL_BOTH (VXL_A * 010)\n", "#define VXL_BOTH (-2147483647 - VXL_A - VXL_A)\n"})
        EXPECT_EQ(slice(line + kernel, "-DVXL_A=1"), "#define VXL_A 1\n" + line + kernel);
}

TEST(KernelSlice, HasNoConditionInsideOfADeclaration) {
    EXPECT_EQ(slice("kernel void f(global int* x\n#if VXL_MORE\n, int y\n#endif\n) { *x = 1; }\n",
                    "-DVXL_MORE=1"),
              "kernel void f(global int* x\n, int y\n) { *x = 1; }\n");
    constexpr std::string_view kKernel =
        "kernel void f(global int* x\n#if MORE\n, int y\n#endif\n) { *x = 1; }\n";
    EXPECT_EQ(slice(kKernel), kKernel);
}

TEST(KernelSlice, ReadsDirectivesWithBlanksAndParentheses) {
    const std::string kernel = "kernel void f(global int* x) { *x = g(); }\n";
    EXPECT_EQ(slice("  # if(VXL_A)\n\t#define h 1\n#elif(VXL_B == 2)\n  #define g() 2\n# endif\n" +
                        kernel,
                    "-DVXL_B=2"),
              "#define g() 2\n" + kernel);
    EXPECT_EQ(slice("int/* a */g() { return 1; }\n" + kernel), "int g() { return 1; }\n" + kernel);
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
              "int g() { return 1; }\nkernel void f(global int* x) { *x = g(); }\n");
}

TEST(KernelSlice, KeepsACallOfAMacroThatMayDefineAnything) {
    EXPECT_EQ(slice("#define MAKE(name) int name() { return 1; }\nMAKE(g)\n;\n"
                    "kernel void f(global int* x) { *x = g(); }\n"),
              "#define MAKE(name) int name() { return 1; }\nMAKE(g)\n;\n"
              "kernel void f(global int* x) { *x = g(); }\n");
}

/// The names of macros that kernel files define, under whatever conditions.
std::set<std::string> defined_names() {
    std::set<std::string> names;
    for (const auto& [file, text] : embedded_kernels()) {
        std::istringstream lines{std::string(text)};
        for (std::string line; std::getline(lines, line);)
            if (line.starts_with("#define ")) names.emplace(identifiers(line).at(1));
    }
    return names;
}

/// The constants of a source that no kernel file defines, so that hosts do, each with `value`.
Defines constants_of(const std::string& source, int value) {
    static const std::set<std::string> defined = defined_names();
    std::set<std::string> names;
    for (const std::string_view word : identifiers(source))
        if (word.starts_with("VXL_") && !word.ends_with("_") &&
            !defined.contains(std::string(word)))
            names.emplace(word);
    Defines constants;
    for (const std::string& name : names) constants.emplace_back(name, value);
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
