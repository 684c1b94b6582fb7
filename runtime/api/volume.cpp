// SPDX-License-Identifier: Apache-2.0
// Volumetric images for callers: their arrays, files and views.
#include "runtime/image/volume.hpp"

#include <cmath>
#include <glm/trigonometric.hpp>
#include <mutex>

#include "runtime/api/border/convert.hpp"
#include "runtime/api/border/guarded.hpp"
#include "runtime/api/border/handles.hpp"
#include "runtime/api/border/process.hpp"
#include "runtime/api/exposure.hpp"
#include "runtime/base/files/stamp.hpp"
#include "runtime/image/volume_view.hpp"
#include "runtime/io/volume/volume_page.hpp"
#include "runtime/io/volume_file.hpp"
#include "runtime/stages/display/display_frame.hpp"

namespace voxelume {
namespace {

constexpr int kMinViewSide = 64;

v1::VolumeFrame frame_for_callers(const VolumeFrame& frame) {
    v1::VolumeFrame result;
    result.layout = static_cast<v1::VolumeLayout>(frame.layout);
    result.size = api::array_of(frame.size);
    result.origin = api::array_of(frame.origin);
    result.edge = api::array_of(frame.edge);
    result.near = frame.display.near;
    result.step = frame.step;
    result.world_from_observer = api::rows_of(frame.world_from_observer);
    return result;
}

VolumeOptions options_inside(const v1::VolumeFileOptions& options) {
    VolumeOptions result;
    if (options.format) result.format = static_cast<VolumeFormat>(*options.format);
    result.compress = options.compress;
    result.all_values = options.all_values;
    result.device.exposure = api::exposure_inside(options.exposure);
    result.device.dither = static_cast<Dither>(options.dither);
    result.device.sweep = static_cast<SweepAxis>(options.sweep);
    result.device.angles = options.angles;
    result.device.radii = options.radii;
    return result;
}

ViewPoint view_inside(const v1::ViewPoint& from) {
    constexpr double kMax = 360;
    if (!(std::abs(from.around) <= kMax) || !(std::abs(from.above) <= kMax))
        throw Error(ErrorKind::usage, "a view is from -{0} to {0} degrees, not {1} and {2}", kMax,
                    from.around, from.above);
    return {glm::radians(from.around), glm::radians(from.above)};
}

/// Frames that show the same share a volume, and each writes it with attributes of its own. Volumes
/// that aren't a frame's have a stamp for its check alone.
void write(const v1::Volume::Implementation& volume, const std::filesystem::path& file,
           const VolumeOptions& options) {
    static std::mutex attributes_mutex;
    const std::lock_guard lock(attributes_mutex);
    volume.volume->attributes = volume.attributes;
    volume.volume->attributes.try_emplace(api::kStamp, stamp_of(kNoFrame));
    write_volume(file, *volume.volume, options);
}

}  // namespace

v1::Volume api::handle_of(std::shared_ptr<Volume> volume, Attributes attributes) {
    v1::VolumeFrame frame = frame_for_callers(volume->frame);
    return v1::Volume(std::make_shared<const v1::Volume::Implementation>(
        v1::Volume::Implementation{std::move(volume), std::move(attributes), frame}));
}

namespace v1 {

VolumeFormat volume_format_of(const std::filesystem::path& file) {
    return api::guarded(
        [&] { return static_cast<VolumeFormat>(voxelume::volume_format_of(file)); });
}

VolumeFormat volume_format_named(std::string_view name) {
    return api::guarded(
        [&] { return static_cast<VolumeFormat>(voxelume::volume_format_named(name)); });
}

std::span<const std::string_view> volume_format_names() {
    return kVolumeFormatNames;
}

Volume Volume::read(const std::filesystem::path& file) {
    return api::guarded([&] {
        api::apply_process_options();
        auto volume = std::make_shared<voxelume::Volume>(read_volume(file));
        api::Attributes attributes = volume->attributes;
        return api::handle_of(std::move(volume), std::move(attributes));
    });
}

const VolumeFrame& Volume::frame() const {
    return implementation_->frame;
}

size_t Volume::count() const {
    return api::inside(*this).indices.size();
}

std::span<const uint64_t> Volume::indices() const {
    return api::inside(*this).indices;
}

std::span<const float> Volume::colors() const {
    static_assert(sizeof(glm::vec3) == 3 * sizeof(float));
    const std::vector<glm::vec3>& colors = api::inside(*this).colors;
    if (colors.empty()) return {};
    return {&colors.front().x, colors.size() * 3};
}

std::span<const float> Volume::opacities() const {
    return api::inside(*this).opacities;
}

std::span<const float> Volume::depths() const {
    return api::inside(*this).depths;
}

std::span<const uint32_t> Volume::object_ids() const {
    return api::inside(*this).objects;
}

std::span<const VoxelKind> Volume::kinds() const {
    static_assert(sizeof(VoxelKind) == sizeof(voxelume::VoxelKind));
    const std::vector<voxelume::VoxelKind>& kinds = api::inside(*this).kinds;
    // Both enumerations are numbered alike and stand on the same bytes.
    return {reinterpret_cast<const VoxelKind*>(kinds.data()), kinds.size()};
}

void Volume::write(const std::filesystem::path& file, const VolumeFileOptions& options) const {
    api::guarded([&] { voxelume::write(*implementation_, file, options_inside(options)); });
}

Image Volume::view(ViewPoint from, Size size) const {
    return api::guarded([&] {
        if (size[0] < kMinViewSide || size[1] < kMinViewSide)
            throw voxelume::Error(voxelume::ErrorKind::usage,
                                  "a sheet of views has at least {} pixels a side, not {}x{}",
                                  kMinViewSide, size[0], size[1]);
        return api::handle_of(std::make_shared<const voxelume::Image>(
            view_sheet(api::inside(*this), view_inside(from), api::vector_of(size))));
    });
}

void Volume::write_page(const std::filesystem::path& file, ViewPoint from, double exposure) const {
    api::guarded([&] {
        write_volume_page(file, api::inside(*this),
                          {view_inside(from), api::exposure_inside(exposure)});
    });
}

std::vector<std::filesystem::path> volume_files(const std::filesystem::path& file) {
    return api::guarded([&] { return voxelume::volume_files(file); });
}

std::vector<std::filesystem::path> replaced_files(const std::filesystem::path& file) {
    return api::guarded([&] { return voxelume::replaced_files(file); });
}

void check_volume_file(const std::filesystem::path& file, const Scene& scene) {
    api::guarded([&] { check_volume_output(file, display_frame(api::inside(scene))); });
}

}  // namespace v1
}  // namespace voxelume
