// SPDX-License-Identifier: Apache-2.0
#include "runtime/image/image_difference.hpp"

#include <algorithm>
#include <bit>
#include <cctype>
#include <cmath>
#include <string_view>

#include "runtime/base/error.hpp"
#include "runtime/base/text.hpp"
#include "runtime/image/cryptomatte.hpp"

namespace voxelume {

namespace {

constexpr float kUnmatched = 65504.0f;  // for values that aren't finite

bool are_equal(float a, float b) {
    return a == b || (std::isnan(a) && std::isnan(b));
}

/// The distance |a - b| as difference images show it.
float distance_of(float a, float b) {
    if (are_equal(a, b)) return 0.0f;
    return std::isfinite(a) && std::isfinite(b) ? std::abs(a - b) : kUnmatched;
}

float distance_of(uint32_t a, uint32_t b) {
    return a == b ? 0.0f : 1.0f;
}

bool is_above(float a, float b, double threshold) {
    if (are_equal(a, b)) return false;
    return !std::isfinite(a) || !std::isfinite(b) || std::abs(double{a} - double{b}) > threshold;
}

bool is_above(uint32_t a, uint32_t b, double) {
    return a != b;
}

ChannelDifference compare_values(const std::string& name, const Plane<float>& a,
                                 const Plane<float>& b) {
    ChannelDifference result{name};
    double squares = 0.0, sum = 0.0, relative_squares = 0.0;
    size_t counted = 0;
    for (size_t i = 0; i < a.size(); ++i) {
        const bool equal = are_equal(a[i], b[i]);
        const bool finite = std::isfinite(a[i]) && std::isfinite(b[i]);
        if (!equal) ++result.differing;
        if (!equal && !finite) ++result.unmatched;
        if (!finite) continue;
        ++counted;
        const double error = double{a[i]} - double{b[i]};
        const double relative = error / (std::abs(double{b[i]}) + 0.01);
        result.largest = std::max(result.largest, std::abs(error));
        squares += error * error;
        sum += std::abs(error);
        relative_squares += relative * relative;
    }
    if (counted == 0) return result;
    const double count = static_cast<double>(counted);
    result.rmse = std::sqrt(squares / count);
    result.mae = sum / count;
    result.mrse = relative_squares / count;
    return result;
}

ChannelDifference compare_values(const std::string& name, const Plane<uint32_t>& a,
                                 const Plane<uint32_t>& b) {
    ChannelDifference result{.channel = name, .is_id = true};
    for (size_t i = 0; i < a.size(); ++i)
        if (a[i] != b[i]) ++result.differing;
    return result;
}

/// The channels that are compared.
class Selection {
  public:
    Selection(const Image& a, const Image& b, const std::vector<std::string>& wanted)
        : wanted_(wanted) {
        std::vector<std::string_view> known;
        for (const Image* image : {&a, &b}) {
            for (const auto& [name, plane] : image->planes) known.push_back(name);
            for (const auto& [name, plane] : image->id_planes) known.push_back(name);
        }
        std::ranges::sort(known);
        known.erase(std::unique(known.begin(), known.end()), known.end());
        for (const std::string& name : wanted)
            if (std::ranges::find(known, name) == known.end())
                throw Error(ErrorKind::usage, "no channel named {}{}", quote(name),
                            suggest(name, known));
    }

    bool has(const std::string& name) const {
        return wanted_.empty() || std::ranges::find(wanted_, name) != wanted_.end();
    }

  private:
    const std::vector<std::string>& wanted_;
};

/// True if a plane of an image has Cryptomatte's ids: bits of hashes, which are no light.
bool has_ids(const Image& image, const std::string& plane) {
    if (!plane.ends_with(".R") && !plane.ends_with(".B")) return false;
    constexpr size_t kEnd = 4;  // as "00.R" of "CryptoObject00.R"
    return std::ranges::any_of(image.attributes, [&](const auto& attribute) {
        const auto& [key, layer] = attribute;
        return key.starts_with(kMatteKey) && key.ends_with("/name") &&
               plane.size() == layer.size() + kEnd && plane.starts_with(layer) &&
               std::isdigit(static_cast<unsigned char>(plane[layer.size()])) &&
               std::isdigit(static_cast<unsigned char>(plane[layer.size() + 1]));
    });
}

Plane<uint32_t> bits_of(const Plane<float>& plane) {
    std::vector<uint32_t> bits;
    bits.reserve(plane.size());
    for (const float value : plane) bits.push_back(std::bit_cast<uint32_t>(value));
    return bits;
}

/// Calls `visit` with the name of each selected channel of both images, and its two planes.
template <class Planes, class Visit>
void for_each_pair(const Planes& a, const Planes& b, const Selection& selection,
                   const Visit& visit) {
    for (const auto& [name, plane] : a) {
        const auto other = b.find(name);
        if (other != b.end() && selection.has(name)) visit(name, plane, other->second);
    }
}

/// Visits all channels the same way, and treats Cryptomatte's ids as ids.
template <class Visit>
void for_each_channel(const Image& a, const Image& b, const Selection& selection,
                      const Visit& visit) {
    for_each_pair(a.planes, b.planes, selection,
                  [&](const std::string& name, const auto& first, const auto& second) {
                      if (has_ids(a, name) && has_ids(b, name))
                          visit(name, bits_of(first), bits_of(second));
                      else
                          visit(name, first, second);
                  });
    for_each_pair(a.id_planes, b.id_planes, selection, visit);
}

template <class Planes>
void note_missing(const Planes& in, const Planes& from, const Selection& selection,
                  std::vector<std::string>& missing) {
    for (const auto& [name, plane] : in)
        if (!from.contains(name) && selection.has(name)) missing.push_back(name);
}

}  // namespace

ImageDifference compare_images(const Image& a, const Image& b, const CompareOptions& options) {
    const Selection selection(a, b, options.channels);
    ImageDifference result;
    result.pixels = uint64_t(a.width) * uint64_t(a.height);
    std::vector<bool> above(result.pixels);
    const auto visit = [&](const std::string& name, const auto& first, const auto& second) {
        ChannelDifference& channel =
            result.channels.emplace_back(compare_values(name, first, second));
        for (size_t i = 0; i < first.size(); ++i) {
            if (!is_above(first[i], second[i], options.threshold)) continue;
            ++channel.above;
            above[i] = true;
        }
    };
    for_each_channel(a, b, selection, visit);
    note_missing(a.planes, b.planes, selection, result.only_in_a);
    note_missing(a.id_planes, b.id_planes, selection, result.only_in_a);
    note_missing(b.planes, a.planes, selection, result.only_in_b);
    note_missing(b.id_planes, a.id_planes, selection, result.only_in_b);
    result.above = uint64_t(std::ranges::count(above, true));
    return result;
}

Image difference_image(const Image& a, const Image& b, const CompareOptions& options) {
    const Selection selection(a, b, options.channels);
    Image result{a.width, a.height, {}, {}, {}, a.first, a.frame};
    const auto visit = [&](const std::string& name, const auto& first, const auto& second) {
        std::vector<float> distances(first.size());
        for (size_t i = 0; i < first.size(); ++i) distances[i] = distance_of(first[i], second[i]);
        result.planes[name] = std::move(distances);
    };
    for_each_channel(a, b, selection, visit);
    return result;
}

}  // namespace voxelume
