// SPDX-License-Identifier: Apache-2.0
// The tables of what rough surfaces return, against sums over all their facets.
#include "runtime/stages/light/tables/albedo_table.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "tests/oracles/physical_surface.hpp"

namespace voxelume {
namespace {

TEST(AlbedoTable, IsThatOfAllFacetsAtEveryRoughnessAndAngle) {
    for (const double roughness : {0.05, 0.1, 0.2, 0.35, 0.5, 0.7, 0.85, 1.0}) {
        const AlbedoTable table = albedo_table(width_of(roughness));
        for (const double cosine : {0.003, 0.03, 0.3, 0.9}) {
            const double width = width_of(roughness);
            const double at =
                std::sqrt(cosine * (1 + width) / (cosine + width)) * (VXL_ALBEDO_ENTRIES - 1);
            const auto entry = std::min(size_t(at), size_t{VXL_ALBEDO_ENTRIES - 2});
            const double part = at - double(entry);
            const double missing =
                table.values[2 * entry] * (1 - part) + table.values[2 * entry + 2] * part;
            EXPECT_NEAR(1 - missing, oracle::facet_albedo(cosine, width, 1), 5e-4)
                << roughness << " " << cosine;
        }
    }
}

TEST(AlbedoTable, LeavesNothingOutOfAFurnace) {
    // Light that facets don't return at once returns later: for white metal, the two shares add up
    // to one.
    for (const double roughness : {0.05, 0.3, 1.0}) {
        const AlbedoTable table = albedo_table(width_of(roughness));
        EXPECT_DOUBLE_EQ(multiple_share(1, table.missing), 1);
        EXPECT_GT(passed_share(0.04, table), 0.85);
        EXPECT_LT(passed_share(0.04, table), 0.99);
    }
}

}  // namespace
}  // namespace voxelume
