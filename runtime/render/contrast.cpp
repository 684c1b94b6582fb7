// SPDX-License-Identifier: Apache-2.0
#include "runtime/render/contrast.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <functional>
#include <string>
#include <type_traits>
#include <utility>

#include "kernels/shared/matte.h"
#include "runtime/render/noise.hpp"

namespace voxelume {
namespace {

constexpr float kAlike = 0.9f;       // minimum cosine between normals of one surface
constexpr float kDepthStep = 0.05f;  // maximum difference of depths, in parts of the nearer one
constexpr const char* kComparedColors[] = {"R", "G", "B"};

/// The planes by which pixels are told apart.
class PixelContrast {
  public:
    PixelContrast(const Image& image, double contrast)
        : contrast_(float(contrast)),
          depth_(image.planes.at("Z")),
          objects_(image.id_planes.at("objectId")) {
        for (size_t i = 0; i < 3; ++i) {
            normal_[i] = &image.planes.at(fmt::format("N.{}", "XYZ"[i]));
            for (const float value : image.planes.at(kComparedColors[i]))
                roots_[i].push_back(std::sqrt(std::max(value, 0.0f)));
        }
    }

    bool differ(size_t a, size_t b) const {
        if (objects_[a] != objects_[b]) return true;
        for (const std::vector<float>& root : roots_)
            if (std::abs(root[a] - root[b]) > contrast_) return true;
        if (objects_[a] == 0) return false;  // both show the background
        float cosine = 0;
        for (const Plane<float>* axis : normal_) cosine += (*axis)[a] * (*axis)[b];
        const float nearer = std::min(std::abs(depth_[a]), std::abs(depth_[b]));
        return cosine < kAlike || std::abs(depth_[a] - depth_[b]) > kDepthStep * nearer;
    }

  private:
    float contrast_;
    const Plane<float>& depth_;
    const Plane<uint32_t>& objects_;
    std::array<const Plane<float>*, 3> normal_{};
    std::array<std::vector<float>, 3> roots_;  ///< of R, G and B: close to perceived brightness
};

/// A matte's pair of planes: the objects or materials that cover a pixel, and their shares.
template <class FloatPlane>
struct RankPlanes {
    FloatPlane* id;
    FloatPlane* share;
};

/// The planes of a layer, rank after rank; none where the image has no such layer.
template <class AnyImage>
auto ranks_of(const std::string& layer, AnyImage& image) {
    using FloatPlane =
        std::conditional_t<std::is_const_v<AnyImage>, const Plane<float>, Plane<float>>;
    std::vector<RankPlanes<FloatPlane>> ranks;
    for (int rank = 0; rank < VXL_MATTE_RANKS; ++rank) {
        const std::string start = fmt::format("{}{:02}.", layer, rank / 2);
        const auto id = image.planes.find(start + (rank % 2 == 0 ? "R" : "B"));
        if (id == image.planes.end()) break;
        ranks.push_back({&id->second, &image.planes.at(start + (rank % 2 == 0 ? "G" : "A"))});
    }
    return ranks;
}

/// Adds the shares of a pixel's objects or materials to those of another one, and ranks them again.
void add_ranks(const std::vector<RankPlanes<const Plane<float>>>& more, size_t from, double weight,
               const std::vector<RankPlanes<Plane<float>>>& ranks, size_t to) {
    std::vector<std::pair<float, double>> covering;  // id and share
    const auto add = [&](float id, double share) {
        if (share <= 0) return;
        const auto known = std::ranges::find(covering, id, &std::pair<float, double>::first);
        if (known == covering.end())
            covering.emplace_back(id, share);
        else
            known->second += share;
    };
    for (const auto& rank : ranks) add((*rank.id)[to], (1 - weight) * (*rank.share)[to]);
    for (const auto& rank : more) add((*rank.id)[from], weight * (*rank.share)[from]);
    std::ranges::stable_sort(covering, std::greater(), &std::pair<float, double>::second);
    covering.resize(ranks.size());
    for (size_t i = 0; i < ranks.size(); ++i) {
        (*ranks[i].id)[to] = covering[i].first;
        (*ranks[i].share)[to] = float(covering[i].second);
    }
}

bool is_light(const std::string& plane) {
    return plane == "R" || plane == "G" || plane == "B" || plane == "A";
}

/// Adds the neighbours of the pixels that are in a set.
void widen(int width, int height, std::vector<bool>& pixels) {
    const std::vector<bool> before = pixels;
    for (int y = 0; y < height; ++y)
        for (int x = 0; x < width; ++x)
            for (int row = std::max(y - 1, 0); row <= std::min(y + 1, height - 1); ++row)
                for (int column = std::max(x - 1, 0); column <= std::min(x + 1, width - 1);
                     ++column)
                    if (before[size_t(row) * size_t(width) + size_t(column)])
                        pixels[size_t(y) * size_t(width) + size_t(x)] = true;
}

/// True for each pixel that shows nothing. For images without depth, no pixel counts.
std::vector<bool> misses(const std::vector<uint32_t>& pixels, const Image& image) {
    std::vector<bool> missed(pixels.size());
    const auto depth = image.planes.find("Z");
    if (depth == image.planes.end()) return missed;
    for (size_t i = 0; i < pixels.size(); ++i) missed[i] = std::isinf(depth->second[pixels[i]]);
    return missed;
}

template <class Value>
Plane<Value> part_of(const Plane<Value>& plane, int width, glm::ivec2 first, glm::ivec2 size) {
    std::vector<Value> part;
    part.reserve(size_t(size.x) * size_t(size.y));
    for (int row = first.y; row < first.y + size.y; ++row) {
        const auto start = plane.begin() + int64_t(row) * width + first.x;
        part.insert(part.end(), start, start + size.x);
    }
    return part;
}

}  // namespace

std::vector<uint32_t> contrasting_pixels(const Image& image, double contrast, int reach) {
    const PixelContrast pixels(image, contrast);
    std::vector<bool> contrasts(size_t(image.width) * size_t(image.height));
    for (int y = 0; y < image.height; ++y)
        for (int x = 0; x < image.width; ++x) {
            const size_t at = size_t(y) * size_t(image.width) + size_t(x);
            const auto compare = [&](int dx, int dy) {
                if (x + dx < 0 || x + dx >= image.width || y + dy >= image.height) return;
                const size_t other = at + size_t(dy) * size_t(image.width) + size_t(dx);
                if (pixels.differ(at, other)) contrasts[at] = contrasts[other] = true;
            };
            compare(1, 0), compare(-1, 1), compare(0, 1), compare(1, 1);
        }
    for (int i = 0; i < reach; ++i) widen(image.width, image.height, contrasts);
    std::vector<uint32_t> numbers;
    for (size_t i = 0; i < contrasts.size(); ++i)
        if (contrasts[i]) numbers.push_back(uint32_t(i));
    return numbers;
}

void add_samples(const std::vector<uint32_t>& pixels, const Image& more, int samples,
                 int more_samples, Image& image) {
    const double weight = double(more_samples) / (samples + more_samples);
    const std::vector<bool> missed = misses(pixels, image);
    const auto each = [&](const auto& change) {
        for (size_t i = 0; i < pixels.size(); ++i)
            change(i, pixels[i], i % 16 / 4 * size_t(more.width) + i / 16 * 4 + i % 4);
    };
    for (const char* layer : {"CryptoObject", "CryptoMaterial"}) {
        const std::vector<RankPlanes<Plane<float>>> ranks = ranks_of(layer, image);
        const std::vector<RankPlanes<const Plane<float>>> further = ranks_of(layer, more);
        if (!ranks.empty())
            each([&](size_t, size_t to, size_t from) {
                add_ranks(further, from, weight, ranks, to);
            });
    }
    for (const char* color : {"R", "G", "B"}) {
        const auto variance = image.planes.find(std::string("variance.") + color);
        if (variance == image.planes.end()) continue;
        each([&](size_t, size_t to, size_t from) {
            variance->second[to] =
                joined_variance(color, {image, to, samples}, {more, from, more_samples});
        });
    }
    for (auto& entry : image.planes) {
        const std::string& name = entry.first;
        Plane<float>& plane = entry.second;
        const Plane<float>& other = more.planes.at(name);
        if (name.starts_with("variance.")) continue;
        if (is_light(name))
            each([&](size_t, size_t to, size_t from) {
                plane[to] = float((1 - weight) * plane[to] + weight * other[from]);
            });
        else if (!name.starts_with("Crypto"))
            each([&](size_t i, size_t to, size_t from) {
                if (missed[i]) plane[to] = other[from];
            });
    }
    for (auto& entry : image.id_planes) {
        Plane<uint32_t>& plane = entry.second;
        const Plane<uint32_t>& other = more.id_planes.at(entry.first);
        each([&](size_t i, size_t to, size_t from) {
            if (missed[i]) plane[to] = other[from];
        });
    }
}

Image part_of(Image image, glm::ivec2 first, glm::ivec2 size) {
    for (auto& [name, plane] : image.planes) plane = part_of(plane, image.width, first, size);
    for (auto& [name, plane] : image.id_planes) plane = part_of(plane, image.width, first, size);
    image.width = size.x;
    image.height = size.y;
    image.first += first;
    return image;
}

}  // namespace voxelume
