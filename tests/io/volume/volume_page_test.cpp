// SPDX-License-Identifier: Apache-2.0
// The page that shows a volumetric image, in a browser: what it paints, turns and cuts.
#include "runtime/io/volume/volume_page.hpp"

#include <gmock/gmock.h>

#include "runtime/image/volume_geometry.hpp"
#include "tests/io/volume/browser.hpp"
#include "tests/support/volume_samples.hpp"

namespace voxelume {

using testing::HasSubstr;

namespace {

/// A box of opaque voxels: the layer that the observer sees first is red, the layers behind are
/// blue.
Volume two_layers() {
    Volume volume = lattice_volume({12, 10, 8}, 0);
    volume.frame.edge = glm::dvec3(0.25);
    for (int z = 0; z < 8; ++z)
        for (int y = 0; y < 10; ++y)
            for (int x = 0; x < 12; ++x) {
                volume.indices.push_back(uint64_t(x + 12 * (y + 10 * z)));
                volume.colors.emplace_back(z == 0, 0, z > 0);
                volume.opacities.push_back(1);
                volume.depths.push_back(1);
                volume.objects.push_back(1);
                volume.kinds.push_back(VoxelKind::object);
            }
    return volume;
}

size_t count_of(const Picture& picture, bool (*is_one)(const std::array<uint8_t, 4>&)) {
    return size_t(std::ranges::count_if(picture.pixels, is_one));
}
bool is_red(const std::array<uint8_t, 4>& p) {
    return p[0] > 200 && p[2] < 60;
}
bool is_blue(const std::array<uint8_t, 4>& p) {
    return p[2] > 200 && p[0] < 60;
}

size_t changed_pixels(const Picture& a, const Picture& b) {
    size_t changed = 0;
    for (size_t i = 0; i < a.pixels.size(); ++i) changed += a.pixels[i] != b.pixels[i];
    return changed;
}

}  // namespace

class VolumePageTest : public FileTest {};

TEST_F(VolumePageTest, ADragOfTheMouseTurnsAndCutsTheVolume) {
    write_volume_page(folder / "a.html", two_layers());
    Browser browser(folder);
    browser.open_page(folder / "a.html");
    EXPECT_EQ(browser.requests(), 1) << "the page asks for more than itself";

    const Picture front = browser.screenshot();
    ASSERT_EQ(front.width, 640);
    ASSERT_EQ(front.height, 480);
    EXPECT_GT(count_of(front, is_red), 20000u);
    EXPECT_LT(count_of(front, is_blue), count_of(front, is_red) / 10);
    EXPECT_TRUE(is_red(front.pixels[240 * 640 + 320]));

    // A drag over half the height is a quarter of a turn, so what was on the left comes to the
    // front.
    auto drawn_again = [&, times = 1]() mutable {
        browser.wait_for(fmt::format("Number(document.body.dataset.drawn) > {}", times));
        times = browser.evaluate("Number(document.body.dataset.drawn)").get<int>();
    };
    browser.drag(200, 200, 240, 0);
    drawn_again();
    const Picture side = browser.screenshot();
    EXPECT_GT(changed_pixels(front, side), 20000u);
    EXPECT_TRUE(is_blue(side.pixels[240 * 640 + 320]));
    EXPECT_LT(count_of(side, is_red), count_of(side, is_blue) / 3);
    EXPECT_NEAR(browser.evaluate("view.around").get<double>(), -M_PI / 2, 1e-6);

    browser.drag(200, 200, -240, 0);
    drawn_again();
    browser.drag(200, 400, 0, -240, MouseButton::right);
    drawn_again();
    const Picture cut = browser.screenshot();
    EXPECT_TRUE(is_blue(cut.pixels[240 * 640 + 320])) << "the red layer is still there";
    EXPECT_EQ(count_of(cut, is_red), 0u);

    browser.evaluate(
        "const slider = document.querySelector('#cuts input'); slider.value = 6;"
        "slider.dispatchEvent(new Event('input'))");
    drawn_again();
    EXPECT_LT(count_of(browser.screenshot(), is_blue), 2 * count_of(cut, is_blue) / 3);
}

TEST_F(VolumePageTest, EveryShapeStandsWhereTheVolumeSays) {
    Browser browser(folder);
    for (const DisplayShape shape :
         {DisplayShape::pyramid, DisplayShape::sector, DisplayShape::ball, DisplayShape::box}) {
        const Volume volume = rays_volume(shape);
        write_volume_page(folder / "a.html", volume);
        browser.open_page(folder / "a.html");
        // The points are compared in the world; the page has them in the observer's coordinates.
        const auto p = browser.evaluate("JSON.stringify(point(2.5, 4.5, 6.5))");
        const auto found = nlohmann::json::parse(p.get<std::string>());
        const glm::dvec4 world =
            volume.frame.world_from_observer * glm::dvec4(found[0], found[1], found[2], 1);
        EXPECT_LT(glm::length(glm::dvec3(world) - voxel_center(volume.frame, {2, 4, 6})), 1e-12);
        EXPECT_EQ(browser.evaluate("frame.count"),
                  std::ranges::count_if(volume.opacities, [](float o) { return o > 0; }));
    }
}

TEST_F(VolumePageTest, TheSameVolumeGivesTheSameBytesAndAFullDiskNone) {
    const Volume volume = lattice_volume();
    write_volume_page(folder / "a.html", volume);
    write_volume_page(folder / "b.html", volume);
    EXPECT_TRUE(bytes_of(folder / "a.html") == bytes_of(folder / "b.html"));
    std::filesystem::remove(folder / "b.html");
    const FileSizeLimit full(3000);
    EXPECT_EQ(error_of([&] { write_volume_page(folder / "b.html", volume); }).exit_code(), 5);
    EXPECT_FALSE(std::filesystem::exists(folder / "b.html"));
}

TEST_F(VolumePageTest, ItLetsNothingInFromElsewhere) {
    Volume volume = lattice_volume();
    volume.attributes["scene"] = "</title><script>alert(1)</script>";
    write_volume_page(folder / "a.html", volume);
    const std::string text = bytes_of(folder / "a.html");
    EXPECT_THAT(text, HasSubstr("default-src 'none'"));
    EXPECT_EQ(text.find("<script>alert"), std::string::npos);
    for (const char* sign : {"http:", "https:", "src=", "@FRAME@", "@VOXELS@", "@SCRIPT@"})
        EXPECT_EQ(text.find(sign), std::string::npos) << sign;
}

TEST_F(VolumePageTest, MoreVoxelsThanAPageTakesAreMerged) {
    Volume volume = lattice_volume({256, 256, 40}, 0);
    for (uint64_t index = 0; index < 256 * 256 * 40; ++index) {
        volume.indices.push_back(index);
        volume.colors.emplace_back(0.25f, 0.5f, 1.0f);
        volume.opacities.push_back(0.5f);
        volume.depths.push_back(1);
        volume.objects.push_back(1);
        volume.kinds.push_back(VoxelKind::object);
    }
    ASSERT_GT(volume.indices.size(), kMaxPageVoxels);
    write_volume_page(folder / "a.html", volume);
    EXPECT_THAT(bytes_of(folder / "a.html"), HasSubstr(R"("count":327680,"merged":2)"));
}

}  // namespace voxelume
