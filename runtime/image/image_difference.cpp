// SPDX-License-Identifier: Apache-2.0
#include "runtime/image/image_difference.hpp"

#include <algorithm>
#include <cmath>

namespace voxelume {

namespace {

ChannelDifference compare_values(const std::string& name, const Plane<float>& a,
                                 const Plane<float>& b) {
    ChannelDifference result{name};
    double squares = 0.0, sum = 0.0, relative_squares = 0.0;
    size_t counted = 0;
    for (size_t i = 0; i < a.size(); ++i) {
        const bool equal = a[i] == b[i] || (std::isnan(a[i]) && std::isnan(b[i]));
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
    ChannelDifference result{name};
    for (size_t i = 0; i < a.size(); ++i)
        if (a[i] != b[i]) ++result.differing;
    return result;
}

template <class Planes>
void compare_planes(const Planes& a, const Planes& b, ImageDifference& result) {
    for (const auto& [name, plane] : a) {
        const auto other = b.find(name);
        if (other == b.end())
            result.only_in_a.push_back(name);
        else
            result.channels.push_back(compare_values(name, plane, other->second));
    }
    for (const auto& [name, plane] : b)
        if (!a.contains(name)) result.only_in_b.push_back(name);
}

}  // namespace

ImageDifference compare_images(const Image& a, const Image& b) {
    ImageDifference result;
    compare_planes(a.planes, b.planes, result);
    compare_planes(a.id_planes, b.id_planes, result);
    return result;
}

}  // namespace voxelume
