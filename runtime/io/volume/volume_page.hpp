// Volumetric image -> one page in which it can be turned and sliced with the mouse.
#pragma once

#include <filesystem>
#include <string_view>

#include "runtime/image/volume.hpp"
#include "runtime/image/volume_view.hpp"

namespace voxelume {

/// More voxels than this are merged to blocks of 2³, 4³ ... in a page.
inline constexpr size_t kMaxPageVoxels = 1 << 21;

struct PageOptions {
    ViewPoint view;      ///< at first
    float exposure = 0;  ///< stops
};

/// Writes a page that needs no other file and no network, only a browser from 2023 or later.
///
/// The same volume gives the same bytes. Throws Error::output.
void write_volume_page(const std::filesystem::path& path, const Volume& volume,
                       const PageOptions& options = {});

/// runtime/io/volume/volume_page.html and .js.
std::string_view page_text();
std::string_view page_script();

}  // namespace voxelume
