// SPDX-License-Identifier: Apache-2.0
// Volumetric image -> one HTML page in which the user turns and slices it with the mouse.
#pragma once

#include <filesystem>
#include <string_view>

#include "runtime/image/volume.hpp"
#include "runtime/image/volume_view.hpp"

namespace voxelume {

/// The maximum number of voxels in a page. More are merged into blocks of 2³, 4³ ... voxels.
inline constexpr size_t kMaxPageVoxels = 1 << 21;

struct PageOptions {
    ViewPoint view;      ///< the view when the page opens
    float exposure = 0;  ///< stops
};

/// Writes a page that needs no other file and no network, only a browser from 2023 or later.
///
/// Equal volumes give equal bytes. Throws Error::output.
void write_volume_page(const std::filesystem::path& path, const Volume& volume,
                       const PageOptions& options = {});

/// The text of runtime/io/volume/volume_page.html, and of volume_page.js.
std::string_view page_text();
std::string_view page_script();

}  // namespace voxelume
