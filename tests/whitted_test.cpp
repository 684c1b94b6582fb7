// The picture of Whitted 1980 against an analytic tracer in double precision.
#include <filesystem>

#include "tests/analytic_comparison.hpp"

namespace voxelume {
namespace {

TEST(Whitted, ThePictureIsTheAnalyticOneBesideEdges) {
    expect_analytic_image(
        read_scene(std::filesystem::path(VXL_SOURCE_DIR) / "scenes/whitted.json", {}), 1e-4, 1e-2);
}

}  // namespace
}  // namespace voxelume
