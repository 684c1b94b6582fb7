// SPDX-License-Identifier: Apache-2.0
// Images that are larger than a device's memory, rendered in bands.
#include <gmock/gmock.h>

#include <cstring>

#include "runtime/batch/render_frames.hpp"
#include "tests/batch/moving_frames.hpp"
#include "tests/support/file_fixture.hpp"

namespace voxelume {
namespace {

using testing::HasSubstr;

constexpr uint64_t kMegabytes = 24;  // a third of what the image takes

/// Puts bands together again.
class Joined final : public BandSink {
  public:
    void add(const std::shared_ptr<const Image>& band) override {
        EXPECT_EQ(band->first.y, rows);
        rows += band->height;
        for (const auto& [name, plane] : band->planes) append(plane, planes[name]);
        for (const auto& [name, plane] : band->id_planes) append(plane, planes[name]);
        if (after_band) after_band();
    }
    void finish(const RenderReport& report) override {
        is_finished = true;
        sight_rays = report.sight_rays;
    }

    void expect_like(const Image& whole) const {
        EXPECT_TRUE(is_finished);
        EXPECT_EQ(rows, whole.height);
        EXPECT_EQ(planes.size(), whole.planes.size() + whole.id_planes.size());
        const auto expect_equal = [this](const auto& named) {
            std::string bytes;
            append(named.second, bytes);
            EXPECT_TRUE(planes.at(named.first) == bytes) << named.first;
        };
        for (const auto& plane : whole.planes) expect_equal(plane);
        for (const auto& plane : whole.id_planes) expect_equal(plane);
    }

    int rows = 0;
    uint64_t sight_rays = 0;
    bool is_finished = false;
    std::function<void()> after_band;

  private:
    template <class Value>
    static void append(const Plane<Value>& plane, std::string& bytes) {
        bytes.append(reinterpret_cast<const char*>(plane.data()), plane.size() * sizeof(Value));
    }

    std::map<std::string, std::string> planes;  ///< the bytes of each
};

/// A picture of 72 MB whose last band is a part of one.
Scene large_scene() {
    Scene scene = moving_scene();
    resize(scene, {1501, 997});
    return scene;
}

/// Devices of 24 MB, or of as many as asked for, each with memory of its own.
std::vector<Device> small_devices(size_t count, uint64_t megabytes = kMegabytes) {
    std::vector<Device> devices;
    while (devices.size() < count) devices.push_back(device_with_memory(megabytes));
    return devices;
}

/// Runs the frames; each must end in bands.
std::map<int, std::shared_ptr<Joined>> run_in_bands(const std::vector<Device>& devices,
                                                    const Scene& scene, BatchOptions options) {
    std::map<int, std::shared_ptr<Joined>> joined;
    std::mutex mutex;
    options.bands = [&](size_t n) {
        const std::lock_guard lock(mutex);
        return joined[options.frames[n]] = std::make_shared<Joined>();
    };
    int last = 0;
    const BatchOutcome outcome =
        render_frames(devices, scene, options, [&](const FrameResult& result) {
            EXPECT_EQ(result.image, nullptr);
            EXPECT_TRUE(joined.at(result.report.frame)->is_finished);
            EXPECT_GT(result.report.frame, last);
            last = result.report.frame;
        });
    EXPECT_EQ(outcome.frames_done, options.frames.size());
    EXPECT_GT(outcome.bands, 2);
    return joined;
}

Image whole_image(const Scene& scene, int frame) {
    RenderReport report;
    return render(test_device(), scene_at(scene, frame), report);
}

TEST(BandedImage, HasTheBitsOfTheWholeInLittleMemoryAndOneWorld) {
    const Scene scene = large_scene();
    const Device small = device_with_memory(kMegabytes);
    const auto joined = run_in_bands({small}, scene, {.frames = {3}});
    const DeviceCounters counters = small.counters();
    EXPECT_LE(counters.peak_bytes, kMegabytes << 20);
    const Image whole = whole_image(scene, 3);
    joined.at(3)->expect_like(whole);
    EXPECT_EQ(joined.at(3)->sight_rays, 16u * 376 * 250);
    // One world was built, of one model, and no program was made for each band.
    const Device large = test_device();
    RenderReport report;
    render(large, scene_at(scene, 3), report);
    EXPECT_LE(counters.programs_built, large.counters().programs_built);
    for (const auto& [kernel, launches] : large.counters().launches) {
        const bool is_of_worlds =
            kernel.find("voxel") != std::string::npos || kernel.find("place") != std::string::npos;
        if (!is_of_worlds) continue;
        EXPECT_EQ(counters.launches.at(kernel), launches) << kernel;
    }
}

TEST(BandedImage, ThatDevicesShareHasTheBitsOfTheWhole) {
    const Scene scene = large_scene();
    const std::vector<Device> devices = {device_with_memory(kMegabytes),
                                         device_with_memory(kMegabytes)};
    run_in_bands(devices, scene, {.frames = {3}}).at(3)->expect_like(whole_image(scene, 3));
}

TEST(BandedImage, OfEachFrameHasTheBitsOfTheWhole) {
    const Scene scene = large_scene();
    for (const size_t devices : {1, 2}) {
        const auto joined = run_in_bands(small_devices(devices), scene, {.frames = {1, 4}});
        for (const int frame : {1, 4}) joined.at(frame)->expect_like(whole_image(scene, frame));
    }
}

TEST(BandedImage, OfPixelsThatContrastAndAreBlurredHasTheBitsOfTheWhole) {
    Scene scene = large_scene();
    scene.render.samples = 4;
    scene.render.adaptive = 0.05;
    scene.render.filter.width = 3.5;
    scene.render.channels.object_matte = scene.render.channels.albedo = true;
    for (const size_t devices : {1, 2}) {
        const auto joined = run_in_bands(small_devices(devices, 40), scene, {.frames = {2}});
        joined.at(2)->expect_like(whole_image(scene, 2));
    }
}

TEST(BandedImage, OfSeveralMomentsHasTheBitsOfTheWhole) {
    Scene scene = large_scene();
    scene.render.samples = 3;
    scene.observer.shutter = 0.5;
    std::shared_ptr<const Image> whole;
    render_frames({test_device()}, scene, {.frames = {3}}, [&](const FrameResult& result) {
        EXPECT_EQ(result.report.report.moments, 3u);
        whole = result.image;
    });
    ASSERT_TRUE(whole);
    for (const size_t devices : {1, 2}) {
        const auto joined = run_in_bands(small_devices(devices), scene, {.frames = {3}});
        joined.at(3)->expect_like(*whole);
    }
}

TEST(BandedImage, WarnsOfWhatTheWholeLacks) {
    Scene scene = large_scene();
    std::vector<WarningKind> kinds;
    BatchOptions options{.frames = {3}};
    options.warn = [&](std::span<const Warning> found) {
        for (const Warning& warning : found) kinds.push_back(warning.kind);
    };
    run_in_bands({device_with_memory(kMegabytes)}, scene, options);
    EXPECT_THAT(kinds, testing::IsEmpty()) << "the first band shows no object";
    scene.observer.position.y += 100;
    run_in_bands({device_with_memory(kMegabytes)}, scene, options);
    EXPECT_THAT(kinds, testing::ElementsAre(WarningKind::nothing_in_view));
}

TEST(BandedImage, ThatIsCancelledOrFailsIsNeverFinished) {
    const Scene scene = large_scene();
    for (const size_t devices : {1, 2})
        for (const bool fails : {false, true}) {
            std::stop_source stop;
            const auto sink = std::make_shared<Joined>();
            sink->after_band = [&] {
                if (fails) throw Error(ErrorKind::output, "the disk is full");
                stop.request_stop();
            };
            BatchOptions options{.frames = {3}};
            options.bands = [&](size_t) { return sink; };
            options.stop = stop.get_token();
            bool is_output = false;
            const auto run = [&] {
                return render_frames(small_devices(devices), scene, options,
                                     [&](const FrameResult&) { is_output = true; });
            };
            if (fails) {
                EXPECT_THAT(error_of(run).what(), HasSubstr("the disk is full"));
            } else {
                EXPECT_TRUE(run().is_cancelled);
            }
            EXPECT_FALSE(sink->is_finished);
            EXPECT_FALSE(is_output);
            EXPECT_LT(sink->rows, 997);
        }
}

TEST(BandedImage, IsRefusedWhereNobodyTakesBands) {
    const Error error = error_of([&] {
        render_frames({device_with_memory(kMegabytes)}, large_scene(), {.frames = {3}},
                      [](const FrameResult&) {});
    });
    EXPECT_EQ(error.kind(), ErrorKind::limit);
    EXPECT_THAT(error.what(), HasSubstr("an image of 1501x997 pixels doesn't fit the memory of "));
    EXPECT_THAT(error.what(), HasSubstr("only files are written in bands: write it to a file"));
}

}  // namespace
}  // namespace voxelume
