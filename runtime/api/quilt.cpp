// SPDX-License-Identifier: Apache-2.0
// Quilts of light-field displays, and stereo pairs, for callers.
#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdlib>
#include <functional>
#include <memory>
#include <utility>
#include <vector>

#include "runtime/api/border/guarded.hpp"
#include "runtime/api/border/handles.hpp"
#include "runtime/api/frame_hash.hpp"
#include "runtime/api/render.hpp"
#include "runtime/base/files/cache_key.hpp"
#include "runtime/base/main_memory.hpp"
#include "runtime/image/join_images.hpp"
#include "runtime/memory/image_bands.hpp"
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
    if (!(quilt.cone >= 0 && quilt.cone <= 120) || !(quilt.focus >= 0 && quilt.focus < 1e9) ||
        !(quilt.separation >= 0 && quilt.separation < 1e9))
        throw voxelume::Error(voxelume::ErrorKind::usage,
                              "a quilt's cone has up to 120 degrees, and its focus and its places' "
                              "separation are at least 0");
}

std::string hash_of(const CacheKey& key) {
    const std::array<std::string_view, 1> parts = {key.bytes()};
    return cache_key(parts);
}

ViewRow row_of(const Quilt& quilt) {
    return {quilt.columns * quilt.rows, quilt.cone, quilt.focus, quilt.separation};
}

/// The views of a frame as scenes of their own, from left to right.
std::vector<Scene> scenes_of_views(const Scene& scene, const Quilt& quilt, int frame) {
    check_quilt(quilt);
    voxelume::Scene now = scene_at(api::inside(scene), frame);
    const ViewRow row = row_of(quilt);
    const int count = row.views;
    now.render.noise.seconds /= count;
    std::vector<Scene> views;
    views.reserve(size_t(count));
    for (int number = 0; number < count; ++number)
        views.push_back(api::handle_of(view_of_row(now, row, number), scene.implementation().hash,
                                       scene.implementation().read));
    return views;
}

struct QuiltView {
    const Quilt& quilt;
    int frame, number;
};

/// The hash of a view whose scene has the hash `of_scene`.
std::string hash_of_view(const std::string& of_scene, const QuiltView& view) {
    const Quilt& quilt = view.quilt;
    CacheKey key;
    key.add_text(of_scene).add(view.frame).add(view.number).add(quilt.columns * quilt.rows);
    key.add(quilt.cone).add(quilt.focus).add(quilt.separation);
    return hash_of(key);
}

/// True if the images have one size and the same channels.
bool are_alike(const voxelume::Image& a, const voxelume::Image& b) {
    const auto name = [](const auto& channel) -> const std::string& { return channel.first; };
    return a.width == b.width && a.height == b.height &&
           std::ranges::equal(a.planes, b.planes, {}, name, name) &&
           std::ranges::equal(a.id_planes, b.id_planes, {}, name, name);
}

void check_views(const std::vector<Image>& views, const Quilt& quilt) {
    const auto is_like_first = [&](const Image& view) {
        return are_alike(*view.implementation().image, *views.front().implementation().image);
    };
    const int count = quilt.columns * quilt.rows;
    if (views.size() != size_t(count) || !std::ranges::all_of(views, is_like_first))
        throw voxelume::Error(voxelume::ErrorKind::usage,
                              "this quilt is made of {} images of one size and the same channels",
                              count);
}

/// Throws Error::limit where main memory has no room for views and the image of all.
void require_room(const std::vector<Image>& views) {
    const voxelume::Image& view = *views.front().implementation().image;
    const double bytes = 4.0 * double(view.planes.size() + view.id_planes.size()) * view.width *
                         view.height * double(views.size());
    if (has_room_for(bytes)) return;
    throw voxelume::Error(voxelume::ErrorKind::limit,
                          "{} views and the image of all take {} more of main memory than this "
                          "process may: write them to files of their own, or ask for smaller ones",
                          views.size(), voxelume::bytes_text(bytes));
}

/// A quilt's image, of which views are copied one after another, from left to right.
class QuiltImage {
  public:
    explicit QuiltImage(const Quilt& quilt) : quilt_(quilt) {}

    void add(const Image& view) {
        const api::Attributes& attributes = view.implementation().attributes;
        if (hashes_.empty()) attributes_ = attributes;
        place_view(*view.implementation().image, int(hashes_.size()), {quilt_.columns, quilt_.rows},
                   *image_);
        const auto hash = attributes.find(api::kFrameHash);
        hashes_.push_back(hash == attributes.end() ? "" : hash->second);
        const auto noise = attributes.find("noise");
        if (noise == attributes.end()) return;
        squares_ += std::pow(std::strtod(noise->second.c_str(), nullptr), 2);
        ++with_noise_;
    }

    Image finish() {
        attributes_[api::kFrameHash] = quilt_hash(hashes_, quilt_);
        attributes_.erase("noise");  // the noise of the first view alone
        if (with_noise_ > 0)
            attributes_["noise"] = fmt::format("{:.5f}", std::sqrt(squares_ / with_noise_));
        return api::handle_of(std::move(image_), std::move(attributes_));
    }

  private:
    Quilt quilt_;
    std::shared_ptr<voxelume::Image> image_ = std::make_shared<voxelume::Image>();
    api::Attributes attributes_;
    std::vector<std::string> hashes_;
    double squares_ = 0;  ///< of the noise of views, as their attributes tell it
    int with_noise_ = 0;
};

/// The options with the progress of one view reported as a part of that of all views.
RenderOptions options_of_view(const RenderOptions& options, int number, int views) {
    RenderOptions of_view = options;
    if (options.progress)
        of_view.progress = [&options, number, views](double done, int frame) {
            options.progress((number + done) / views, frame);
        };
    if (number > 0) of_view.warn = {};  // other views would repeat the warnings
    return of_view;
}

struct QuiltJob {
    const Quilt& quilt;
    int frame;
    const RenderOptions& options;
};

/// Renders the views of a frame one after another, and hands each on.
void render_each(const Scene& scene, const std::vector<Device>& devices, const QuiltJob& job,
                 const std::function<void(Image)>& take, Statistics* statistics) {
    const std::vector<Scene> views = scenes_of_views(scene, job.quilt, job.frame);
    const int count = int(views.size());
    voxelume::Scene first = api::inside(views.front());
    first.render.channels = api::inside(job.options.channels);
    const MainMemoryClaim claim(bytes_of_views(first, count));
    for (int number = 0; number < count; ++number) {
        Statistics of_view;
        const Image image = render_image(views[size_t(number)], devices, 1,
                                         options_of_view(job.options, number, count), &of_view);
        api::Attributes attributes = image.implementation().attributes;
        attributes[api::kFrameHash] =
            hash_of_view(attributes[api::kFrameHash], {job.quilt, job.frame, number});
        take(api::handle_of(image.implementation().image, std::move(attributes)));
        for (FrameStatistics& view : of_view.frames) view.frame = job.frame;
        if (statistics) add_statistics(of_view, *statistics);
    }
}

}  // namespace

std::string quilt_suffix(const Quilt& quilt, Size view, double pixel_aspect) {
    return fmt::format("_qs{}x{}a{:.4g}", quilt.columns, quilt.rows,
                       pixel_aspect * view[0] / view[1]);
}

std::vector<std::string> view_hashes(const Scene& scene, const Quilt& quilt, int frame) {
    return api::guarded([&] {
        std::vector<std::string> hashes;
        for (const Scene& view : scenes_of_views(scene, quilt, frame))
            hashes.push_back(
                hash_of_view(frame_hashes(view, {1}).front(), {quilt, frame, int(hashes.size())}));
        return hashes;
    });
}

std::string quilt_hash(const std::vector<std::string>& views, const Quilt& quilt) {
    CacheKey key;
    for (const std::string& hash : views) key.add_text(hash);
    key.add(quilt.columns);
    return hash_of(key);
}

std::vector<Image> render_views(const Scene& scene, const std::vector<Device>& devices,
                                const Quilt& quilt, int frame, const RenderOptions& options,
                                Statistics* statistics) {
    return api::guarded([&] {
        std::vector<Image> images;
        render_each(
            scene, devices, {quilt, frame, options},
            [&](Image view) { images.push_back(std::move(view)); }, statistics);
        return images;
    });
}

Image join_views(const std::vector<Image>& views, const Quilt& quilt) {
    return api::guarded([&] {
        check_quilt(quilt);
        check_views(views, quilt);
        require_room(views);
        QuiltImage joined(quilt);
        for (const Image& view : views) joined.add(view);
        return joined.finish();
    });
}

Image render_quilt(const Scene& scene, const std::vector<Device>& devices, const Quilt& quilt,
                   int frame, const RenderOptions& options, Statistics* statistics) {
    return api::guarded([&] {
        QuiltImage joined(quilt);
        render_each(
            scene, devices, {quilt, frame, options}, [&](const Image& view) { joined.add(view); },
            statistics);
        return joined.finish();
    });
}

}  // namespace voxelume::v1

namespace voxelume {

void api::check_quilt(const Scene& scene, const v1::Quilt& quilt, int frame) {
    v1::check_quilt(quilt);
    const Scene now = scene_at(scene, frame);
    const ViewRow row = v1::row_of(quilt);
    for (const int number : {0, row.views - 1}) view_of_row(now, row, number);
}

}  // namespace voxelume
