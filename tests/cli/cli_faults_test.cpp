// SPDX-License-Identifier: Apache-2.0
// Every OpenCL call of some renders fails once, with statuses that it may return: the program ends
// with a documented code, one sentence and no file but those of earlier frames, or does without the
// call and makes the same file. It releases all objects of OpenCL in either case.
#include <gmock/gmock.h>

#include <fstream>
#include <map>
#include <set>

#include "tests/cli/scene_program.hpp"
#include "tests/support/exhaustive.hpp"

namespace voxelume {

class CliFaultsTest : public SceneProgramTest {
  protected:
    /// Renders, with environment variables of the preloaded library.
    ProgramResult render(const std::string& environment) const {
        return run_line(fmt::format("env LD_PRELOAD='{}' {} timeout 60 voxelume {} -q", VXL_FAULTS,
                                    environment, command_));
    }

    using Numbers = std::vector<long>;

    /// The numbers of each function's calls that are to fail, in an exhaustive run in their order.
    std::map<std::string, Numbers> calls() const {
        const ProgramResult result =
            render(is_exhaustive() ? "VXL_FAULT_COUNTS=counts VXL_FAULT_SITES=sites"
                                   : "VXL_FAULT_COUNTS=counts");
        EXPECT_EQ(result.exit_code, 0) << result.err;
        std::map<std::string, Numbers> calls;
        std::string name;
        std::ifstream counts(folder / "counts"), sites(folder / "sites");
        for (long count = 0; counts >> name >> count;) calls[name] = {1, (count + 1) / 2, count};
        EXPECT_TRUE(calls.contains("clEnqueueNDRangeKernel"));
        for (const char* file : {"counts", "sites"}) std::filesystem::remove(folder / file);
        if (!is_exhaustive()) return calls;
        for (long number = 0; sites >> name >> number;) calls[name].push_back(number);
        for (auto& [function, numbers] : calls) {
            const std::set<long> each(numbers.begin(), numbers.end());
            numbers.assign(each.begin(), each.end());
        }
        return calls;
    }

    std::map<std::string, std::string> files() const {
        std::map<std::string, std::string> files;
        for (const auto& entry : std::filesystem::directory_iterator(folder / "out"))
            files[entry.path().filename()] = bytes_of(entry.path());
        return files;
    }

    void remove_files() const {
        std::filesystem::remove_all(folder / "out");
        std::filesystem::create_directory(folder / "out");
    }

    /// The program has released all objects of OpenCL that it made.
    void expect_nothing_left() const {
        std::ifstream file(folder / "left");
        EXPECT_TRUE(file.is_open());
        std::string kind;
        for (long count = 0; file >> kind >> count;) EXPECT_EQ(count, 0) << kind;
        std::filesystem::remove(folder / "left");
    }

    /// The `number`-th call of the function fails.
    void expect_handled(const std::string& function, long number, int status,
                        const std::map<std::string, std::string>& expected) const {
        const std::string fault = fmt::format("{}:{}:{}", function, number, status);
        SCOPED_TRACE(fault);
        remove_files();
        const ProgramResult result = render("VXL_FAULT_LEFT=left VXL_FAULT=" + fault);
        expect_nothing_left();
        if (result.exit_code == 0) {
            EXPECT_TRUE(files() == expected);
            return;
        }
        EXPECT_THAT(result.exit_code, testing::AnyOf(1, 6, 7, 8)) << result.err;
        EXPECT_THAT(result.err, testing::MatchesRegex("voxelume: [^\n]+\n"));
        EXPECT_THAT(result.err,
                    testing::AnyOf(testing::HasSubstr("device"), testing::HasSubstr("while ")));
        // Frames that were finished before stay, whole; the one that failed leaves nothing.
        const std::map<std::string, std::string> left = files();
        EXPECT_LT(left.size(), expected.size());
        for (const auto& [name, bytes] : left) EXPECT_TRUE(bytes == expected.at(name)) << name;
    }

    /// Has calls of all functions fail: of every other one the first, the last or one between by
    /// turns; in an exhaustive run of each one all three and the first from each place that calls
    /// it, each with all statuses; of those that set an argument, which one function does for
    /// hundreds of places, each with one status.
    void expect_all_handled(const std::string& arguments, size_t turn) {
        command_ = "render scene.json --no-cache " + arguments;
        remove_files();
        ASSERT_EQ(render("").exit_code, 0);  // compiles
        const std::map<std::string, std::string> expected = files();
        ASSERT_FALSE(expected.empty());
        // Faults of memory, of a dead queue, of an event, and one that no list has.
        const std::vector statuses = {-5, -6, -4, -36, -14, -9999};
        long tried = 0;
        for (const auto& [function, numbers] : calls()) {
            // By default, each render makes every other function fail; different renders take
            // different ones.
            if (!is_exhaustive() && turn % 2 != 0) {
                ++turn;
                continue;
            }
            for (const long number : in_turn(numbers, turn))
                for (const int status :
                     function == "clSetKernelArg"
                         ? std::vector{statuses[size_t(number) % statuses.size()]}
                         : in_turn(statuses, turn)) {
                    expect_handled(function, number, status, expected);
                    ++tried;
                }
            ++turn;
        }
        fmt::print("{} faults tried\n", tried);
    }

    std::string command_;
};

TEST_F(CliFaultsTest, InAnImageWithShadowsAreTold) {
    expect_all_handled("-o out/a.exr", 0);
}

TEST_F(CliFaultsTest, InPathsThroughGlassAreTold) {
    write_scene([](Json& scene) {
        scene["materials"]["brick"] = {{"refraction", 0.9}, {"ior", 1.4}, {"reflection", 0.1}};
        scene["models"]["thing"] = {{"shape", "sphere"}, {"radius", 0.4}, {"surface", "smooth"}};
    });
    expect_all_handled("-o out/a.png", 1);
}

TEST_F(CliFaultsTest, InVolumetricImagesAreTold) {
    write_scene([](Json& scene) {
        scene["world"]["medium"] = {{"absorption", {0.1, 0.2, 0.3}}};
        scene["observer"]["display"]["layout"] = "lattice";
    });
    expect_all_handled("--volume out/v.nrrd", 2);
}

TEST_F(CliFaultsTest, InFramesAreTold) {
    write_scene([](Json& scene) {
        scene["animation"] = {{"tracks",
                               {{{"target", "objects.thing.position"},
                                 {"keys",
                                  {{{"frame", 1}, {"value", {1, 1, 0.5}}},
                                   {{"frame", 3}, {"value", {2, 1, 0.5}}}}}}}}};
    });
    expect_all_handled("--frames 1-3 -o out/a.##.exr", 3);
}

TEST_F(CliFaultsTest, OnTwoDevicesAreTold) {
    expect_all_handled("--device all/2 -o out/a.exr", 4);
}

TEST_F(CliFaultsTest, AFallbackTakesOverWithTheSameBits) {
    write_scene([](Json& scene) {
        scene["animation"] = {{"tracks",
                               {{{"target", "objects.thing.position"},
                                 {"keys",
                                  {{{"frame", 1}, {"value", {1, 1, 0.5}}},
                                   {{"frame", 3}, {"value", {2, 1, 0.5}}}}}}}}};
    });
    const std::string command = "render scene.json -q --frames 1-3 --no-overlap -o out/a.##.exr";
    remove_files();
    ASSERT_EQ(run(command).exit_code, 0);
    const std::map<std::string, std::string> expected = files();
    ASSERT_EQ(expected.size(), 3u);
    for (const char* fault : {"clCreateContext:1:-6", "clEnqueueNDRangeKernel:5:-36",
                              "clEnqueueNDRangeKernel:15:-36", "clFinish:3:-36"}) {
        remove_files();
        const ProgramResult result =
            run_line(fmt::format("env LD_PRELOAD='{}' VXL_FAULT={} timeout 60 voxelume {} "
                                 "--fallback cpu",
                                 VXL_FAULTS, fault, command));
        EXPECT_EQ(result.exit_code, 0) << fault << result.err;
        EXPECT_THAT(result.err, testing::HasSubstr("the device of --fallback takes over")) << fault;
        EXPECT_TRUE(files() == expected) << fault;
    }
    remove_files();
    EXPECT_EQ(run(command + " --device no-such-device --fallback cpu").exit_code, 0);
    EXPECT_TRUE(files() == expected);
    remove_files();
    EXPECT_EQ(run(command + " --device no-such-device --fallback no-such-either").exit_code, 6);
    // A mistake in a scene is a mistake on every device.
    const ProgramResult wrong = run("render none.json -o out/b.exr --fallback cpu");
    EXPECT_EQ(wrong.exit_code, 4);
    EXPECT_THAT(wrong.err, testing::Not(testing::HasSubstr("takes over")));
}

/// Batches of 131,072 rays have buffers of 3 MB; others are smaller than 1 MB.
TEST_F(CliFaultsTest, MemoryThatIsShortIsEnoughForSmallerBatches) {
    write_scene([](Json& scene) { scene["observer"]["display"]["layout"] = "lattice"; });
    // Devices that share an image take smaller parts of it.
    for (const char* output : {"-o out/a.exr --size 80x60 --samples 32", "--volume out/v.nrrd",
                               "--device all/2 -o out/a.exr --size 160x120 --samples 64"}) {
        command_ = fmt::format("render scene.json --no-cache {}", output);
        remove_files();
        ASSERT_EQ(render("").exit_code, 0);
        const std::map<std::string, std::string> expected = files();
        remove_files();
        const ProgramResult smaller =
            render("VXL_FAULT_COUNTS=counts VXL_FAULT=clCreateBuffer:1000000:large");
        EXPECT_EQ(smaller.exit_code, 0) << smaller.err;
        EXPECT_THAT(bytes_of(folder / "counts"), testing::HasSubstr("\nlarge "));
        EXPECT_TRUE(files() == expected);
        remove_files();
        const ProgramResult none =
            render("VXL_FAULT_LEFT=left VXL_FAULT=clCreateBuffer:1000:large");
        EXPECT_EQ(none.exit_code, 8);
        EXPECT_THAT(none.err, testing::HasSubstr("ran out of memory while allocating"));
        EXPECT_TRUE(files().empty());
        expect_nothing_left();
    }
}

/// A launch that fails has tiles in work, which no other device takes.
TEST_F(CliFaultsTest, LaunchesThatLackMemoryLoseNoTilesOfASharedImage) {
    command_ =
        "render scene.json --no-cache -o out/a.exr --device all/2 --size 160x120 --samples 4";
    remove_files();
    ASSERT_EQ(render("").exit_code, 0);
    const std::map<std::string, std::string> expected = files();
    int again = 0;
    for (int number = 1; number < 80; number += number < 15 ? 7 : 2) {
        remove_files();
        const ProgramResult result =
            render(fmt::format("VXL_FAULT=clEnqueueNDRangeKernel:{}:-5", number));
        EXPECT_EQ(result.exit_code, result.exit_code == 0 ? 0 : 8) << number << result.err;
        EXPECT_TRUE(result.exit_code == 0 ? files() == expected : files().empty()) << number;
        again += result.exit_code == 0;
    }
    // Only those are made again before which no tile was done: how many depends on the devices'
    // turns.
    EXPECT_GT(again, 0) << "launches that failed and were made again";
}

TEST_F(CliFaultsTest, CallsThatAreLateChangeNothing) {
    command_ = "render scene.json --no-cache -o out/a.exr";
    remove_files();
    ASSERT_EQ(render("").exit_code, 0);
    const std::map<std::string, std::string> expected = files();
    for (const char* function : {"clEnqueueReadBuffer", "clEnqueueNDRangeKernel", "clFinish"}) {
        remove_files();
        EXPECT_EQ(render(fmt::format("VXL_FAULT={}:2:delay", function)).exit_code, 0) << function;
        EXPECT_TRUE(files() == expected) << function;
    }
}

TEST_F(CliFaultsTest, CallsThatNeverReturnEndTheRunInTime) {
    const std::string command = "voxelume render scene.json -q -o a.exr --device-timeout 2";
    ASSERT_EQ(run("render scene.json -q -o a.exr").exit_code, 0);  // compiles
    std::filesystem::remove(folder / "a.exr");
    const std::vector<std::string> before = names();
    std::map<std::string, std::string> calls = {{"clFinish", "waiting for its kernels"},
                                                {"clBuildProgram", "compiling kernels/.+"}};
    if (is_exhaustive())
        calls.insert({{"clCreateBuffer", "allocating the [a-z ]+ buffer"},
                      {"clEnqueueReadBuffer", "reading the [a-z ]+ buffer"},
                      {"clEnqueueNDRangeKernel", "launching [a-z_]+"}});
    for (const auto& [function, what] : calls) {
        const ProgramResult result =
            run_line(fmt::format("env LD_PRELOAD='{}' VXL_FAULT={}:1:hang timeout 60 {}",
                                 VXL_FAULTS, function, command));
        EXPECT_EQ(result.exit_code, 1) << function;
        EXPECT_THAT(result.err, testing::MatchesRegex(fmt::format(
                                    "voxelume: \"[^\"]+\" has not answered for [0-9.]+ seconds "
                                    "while {}: it hangs, or needs more time than it was given\n",
                                    what)));
        EXPECT_EQ(names(), before) << function;
    }
}

}  // namespace voxelume
