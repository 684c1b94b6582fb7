// SPDX-License-Identifier: Apache-2.0
// Volumetric image -> a PNG for each slice k, as the observer sees it, and a JSON header.
#include <algorithm>

#include "runtime/base/frame_path.hpp"
#include "runtime/base/json_text.hpp"
#include "runtime/image/volume_geometry.hpp"
#include "runtime/io/image/png.hpp"
#include "runtime/io/volume/volume_json.hpp"
#include "runtime/io/volume/volume_rows.hpp"

namespace voxelume {

namespace {

/// Makes the next slice. Columns go to the image's right and rows down; a lattice's X_E and Y_E run
/// the other way.
Image make_slice(const Volume& volume, VolumeRows& rows) {
    const glm::ivec3& size = volume.frame.size;
    const bool lattice = volume.frame.layout == VolumeLayout::lattice;
    Image image{size.x, size.y, {}, {}, {}};
    const size_t width = size_t(size.x), pixels = width * size_t(size.y);
    for (const char* name : {"R", "G", "B", "A"}) image.planes[name] = std::vector<float>(pixels);
    auto& planes = image.planes;
    for (size_t y = 0; y < size_t(size.y); ++y) {
        const auto [first, last] = rows.next();
        for (size_t i = first; i < last; ++i) {
            const size_t x = rows.column(i);
            const size_t pixel = lattice ? pixels - 1 - (y * width + x) : y * width + x;
            const glm::vec3 color = volume.colors[i] * volume.opacities[i];
            planes["R"][pixel] = color.r;
            planes["G"][pixel] = color.g;
            planes["B"][pixel] = color.b;
            planes["A"][pixel] = volume.opacities[i];
        }
    }
    return image;
}

/// The slices that were written, which are deleted if the stack isn't completed.
class WrittenSlices {
  public:
    WrittenSlices() = default;
    ~WrittenSlices() {
        std::error_code ignored;
        for (const VolumePath& slice : slices_) std::filesystem::remove(slice, ignored);
    }
    WrittenSlices(const WrittenSlices&) = delete;
    WrittenSlices& operator=(const WrittenSlices&) = delete;

    void add(const VolumePath& slice) { slices_.push_back(slice); }
    void keep() { slices_.clear(); }

  private:
    std::vector<VolumePath> slices_;
};

/// True if a name is the pattern with some slice's number in it.
bool has_number_in(const std::string& pattern, const std::string& name) {
    constexpr size_t kMaxDigits = 9;
    const auto is_digit = [](char c) { return c >= '0' && c <= '9'; };
    for (size_t i = 0, end = 0; i < name.size(); i = std::max(end, i + 1)) {
        for (end = i; end < name.size() && is_digit(name[end]);) ++end;
        if (end == i || end - i > kMaxDigits) continue;
        if (frame_path(pattern, std::stoi(name.substr(i, end - i)), true) == name) return true;
    }
    return false;
}

}  // namespace

VolumePath slices_header_of(const VolumePath& pattern) {
    std::string name = pattern.filename().string();
    const size_t number = name.find_first_of("#%");
    name.resize(number == std::string::npos ? 0 : number);
    while (name.ends_with('.') || name.ends_with('_') || name.ends_with('-')) name.pop_back();
    return pattern.parent_path() / (name.empty() ? "slices.json" : name + ".json");
}

std::vector<VolumePath> found_slices_of(const VolumePath& pattern) {
    const VolumePath folder = pattern.parent_path();
    std::vector<VolumePath> files{slices_header_of(pattern)};
    std::error_code error;
    for (const auto& entry :
         std::filesystem::directory_iterator(folder.empty() ? "." : folder, error)) {
        const std::string name = entry.path().filename().string();
        if (has_number_in(pattern.filename().string(), name)) files.push_back(folder / name);
    }
    std::ranges::sort(files);
    return files;
}

std::vector<VolumePath> slice_files_of(const VolumePath& pattern) {
    const VolumePath header = slices_header_of(pattern);
    const VolumeJson json = read_header(header, VolumeFormat::slices);
    if (json.empty()) return {};
    const VolumeJson count = json.value("/shape/2"_json_pointer, VolumeJson());
    constexpr uint64_t kMaxSlices = 65536;  // number of slices of the largest display
    const uint64_t slices = count.is_number_unsigned() ? json_integer<uint64_t>(count) : 0;
    if (slices < 1 || slices > kMaxSlices) return {};
    std::vector<VolumePath> files;
    files.reserve(size_t(slices) + 1);
    for (int k = 0; k < int(slices); ++k) files.emplace_back(frame_path(pattern.string(), k, true));
    files.push_back(header);
    return files;
}

void write_volume_slices(const VolumePath& pattern, const Volume& volume) {
    const glm::ivec3& size = volume.frame.size;
    PngOptions options;
    options.keep_alpha = true;
    const auto stamp = volume.attributes.find("stamp");
    if (stamp != volume.attributes.end()) options.stamp = stamp->second;
    VolumeRows rows(volume);
    WrittenSlices written;
    for (int k = 0; k < size.z; ++k) {
        const VolumePath slice = frame_path(pattern.string(), k, true);
        write_png(slice, make_slice(volume, rows), options);
        written.add(slice);
    }
    VolumeJson header = start_header(pattern, volume, VolumeFormat::slices);
    header["shape"] = {size.x, size.y, size.z};
    header["axes"] = volume.frame.layout == VolumeLayout::rays ? VolumeJson{"u", "v", "k"}
                                                               : VolumeJson{"-X_E", "-Y_E", "+Z_E"};
    header["axis_order"] = "columns, rows from the top, slices";
    header["bits"] = "8 each of red, green, blue (sRGB, not multiplied by alpha) and alpha";
    write_json(slices_header_of(pattern), header);
    written.keep();
}

}  // namespace voxelume
