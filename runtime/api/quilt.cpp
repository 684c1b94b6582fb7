// SPDX-License-Identifier: Apache-2.0
// Quilts of light-field displays, for callers.
#include <fmt/format.h>

#include <array>
#include <memory>
#include <vector>

#include "runtime/api/frame_hash.hpp"
#include "runtime/api/guarded.hpp"
#include "runtime/api/handles.hpp"
#include "runtime/base/files/cache_key.hpp"
#include "runtime/image/join_images.hpp"
#include "runtime/scene/quilt.hpp"
#include "runtime/scene/scene_animation.hpp"
#include "runtime/voxelume/render.hpp"

namespace voxelume::v1 {
namespace {

constexpr int kMaxViews = 1000;

void check_quilt(const Quilt& quilt) {
    const bool has_views = quilt.columns >= 1 && quilt.rows >= 1 && quilt.columns <= kMaxViews &&
                           quilt.rows <= kMaxViews && quilt.columns * quilt.rows <= kMaxViews;
    if (!has_views)
        throw voxelume::Error(voxelume::ErrorKind::usage,
                              "a quilt has from 1 to {} views, not {}x{}", kMaxViews, quilt.columns,
                              quilt.rows);
    if (!(quilt.cone >= 0 && quilt.cone <= 120) || !(quilt.focus >= 0 && quilt.focus < 1e9))
        throw voxelume::Error(voxelume::ErrorKind::usage,
                              "a quilt's cone has up to 120 degrees, and its focus is at least 0");
}

/// Progress of one view as that of all.
RenderOptions options_of_view(const RenderOptions& options, int number, int views) {
    RenderOptions of_view = options;
    if (options.progress)
        of_view.progress = [&options, number, views](double done, int frame) {
            options.progress((number + done) / views, frame);
        };
    if (number > 0) of_view.warn = {};  // which would say the same
    return of_view;
}

}  // namespace

std::string quilt_suffix(const Quilt& quilt, Size view) {
    return fmt::format("_qs{}x{}a{:.4g}", quilt.columns, quilt.rows, double(view[0]) / view[1]);
}

Image render_quilt(const Scene& scene, const std::vector<Device>& devices, const Quilt& quilt,
                   int frame, const RenderOptions& options) {
    return api::guarded([&] {
        check_quilt(quilt);
        const voxelume::Scene now = scene_at(api::inside(scene), frame);
        const int views = quilt.columns * quilt.rows;
        std::vector<std::shared_ptr<const voxelume::Image>> images;
        api::Attributes attributes;
        for (int number = 0; number < views; ++number) {
            const Scene view =
                api::handle_of(view_of_row(now, {views, quilt.cone, quilt.focus}, number),
                               scene.implementation().hash, scene.implementation().read);
            const Image image =
                render_image(view, devices, 1, options_of_view(options, number, views));
            images.push_back(image.implementation().image);
            if (number == 0) attributes = image.implementation().attributes;
        }
        CacheKey key;
        key.add_text(attributes[api::kFrameHash]).add(frame);
        key.add(quilt.columns).add(quilt.rows).add(quilt.cone).add(quilt.focus);
        const std::array<std::string_view, 1> parts = {key.bytes()};
        attributes[api::kFrameHash] = cache_key(parts);
        return api::handle_of(
            std::make_shared<const voxelume::Image>(quilt_of(images, quilt.columns)),
            std::move(attributes));
    });
}

}  // namespace voxelume::v1
