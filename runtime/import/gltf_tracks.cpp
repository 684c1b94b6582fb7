// SPDX-License-Identifier: Apache-2.0
#include "runtime/import/gltf_tracks.hpp"

#include <algorithm>
#include <array>
#include <cmath>

#include "runtime/import/contents.hpp"

namespace voxelume {
namespace {

constexpr std::array<const char*, 5> kInterpolations = {"step", "linear", "cubic", "slerp",
                                                        "spline"};

/// A number as text; nine digits tell apart all 32-bit floats, which files have.
std::string number_text(double value) {
    return fmt::format("{}", rounded(value, 9));
}

std::string row_text(const std::vector<double>& values, size_t row, size_t width) {
    std::vector<std::string> numbers;
    numbers.reserve(width);
    for (size_t i = 0; i < width; ++i) numbers.push_back(number_text(values[row * width + i]));
    return fmt::format("[{}]", fmt::join(numbers, ", "));
}

/// Limits scales from below to a ten-thousandth of the largest one: scales near 0, which make
/// things vanish, would give a flat map that can't place anything.
Keyframes without_flatness(Keyframes keys) {
    double largest = 0;
    for (const double value : keys.values) largest = std::max(largest, std::abs(value));
    const double min_scale = largest > 0 ? 1e-4 * largest : 1e-4;
    for (double& value : keys.values)
        if (std::abs(value) < min_scale) value = std::copysign(min_scale, value);
    return keys;
}

/// The keys of a placement, without braces, except those that have tracks.
std::string factor_members(const Factors& factors, const std::array<const GltfTrack*, 3>& tracks) {
    std::vector<std::string> members;
    if (!tracks[0] && factors.position != glm::dvec3(0))
        members.push_back(fmt::format("\"position\": {}", json_list(factors.position)));
    if (!tracks[1] && factors.turn != glm::dvec3(0))
        members.push_back(fmt::format("\"turn\": {}", json_list(factors.turn)));
    if (!tracks[2] && factors.scale != glm::dvec3(1))
        members.push_back(fmt::format("\"scale\": {}", json_list(factors.scale)));
    return fmt::format("{}", fmt::join(members, ", "));
}

/// A step of the path from the world to an object.
struct Link {
    int node = -1;  ///< node with tracks; -1: a matrix
    glm::dmat4 matrix{1};
};

std::vector<Link> links_of(const GltfMotion& motion, const GltfNode& node) {
    std::vector<Link> links;
    glm::dmat4 still = motion.world_from_file();
    const auto add_still = [&] {
        if (still != glm::dmat4(1)) links.push_back({-1, still});
        still = glm::dmat4(1);
    };
    for (const int number : motion.line_of(node.number)) {
        if (!motion.has_tracks(number)) {
            still = still * motion.parent_from_node(number);
            continue;
        }
        add_still();
        links.push_back({number, glm::dmat4(1)});
    }
    still = still * node.node_from_instance;
    add_still();
    return links;
}

}  // namespace

std::string matrix_text(const glm::dmat4& m) {
    std::array<std::string, 3> rows;
    for (int row = 0; row < 3; ++row)
        rows[size_t(row)] =
            fmt::format("[{}, {}, {}, {}]", m[0][row], m[1][row], m[2][row], m[3][row]);
    return fmt::format("[{}]", fmt::join(rows, ", "));
}

std::string keys_track(const std::string& target, const Keyframes& keys) {
    std::vector<std::string> items;
    for (size_t i = 0; i < keys.frames.size(); ++i) {
        std::string item = fmt::format("{{\"time\": {}, \"value\": {}", number_text(keys.frames[i]),
                                       row_text(keys.values, i, keys.width));
        if (keys.interpolation == Interpolation::spline)
            item += fmt::format(", \"in\": {}, \"out\": {}", row_text(keys.in, i, keys.width),
                                row_text(keys.out, i, keys.width));
        items.push_back(item + "}");
    }
    return fmt::format("{{\"target\": {}, \"interpolation\": \"{}\", \"keys\": [\n      {}]}}",
                       json_text(target), kInterpolations.at(size_t(keys.interpolation)),
                       fmt::join(items, ",\n      "));
}

GltfPlace gltf_place(const GltfMotion& motion, const GltfNode& node, const std::string& object) {
    constexpr std::array kKeys = {"position", "turn", "scale"};
    const std::vector<Link> links = links_of(motion, node);
    GltfPlace place;
    std::vector<std::string> parents;
    for (size_t i = 0; i < links.size(); ++i) {
        const Link& link = links[i];
        const bool is_own = i + 1 == links.size();
        std::string members = fmt::format("\"matrix\": {}", matrix_text(link.matrix));
        if (link.node >= 0) {
            const auto& tracks = motion.tracks_of(link.node);
            members = factor_members(motion.factors_of(link.node), tracks);
            for (size_t k = 0; k < kKeys.size(); ++k) {
                if (!tracks[k]) continue;
                const std::string target =
                    fmt::format("objects.{}.{}{}", target_name(object),
                                is_own ? "" : fmt::format("parents[{}].", i), kKeys[k]);
                place.tracks.push_back(keys_track(
                    target, k == 2 ? without_flatness(tracks[k]->keys) : tracks[k]->keys));
            }
        }
        if (!is_own)
            parents.push_back("{" + members + "}");
        else if (!members.empty())
            place.members = ",\n     " + members;
    }
    if (!parents.empty())
        place.members =
            fmt::format(",\n     \"parents\": [{}]{}", fmt::join(parents, ", "), place.members);
    return place;
}

std::string baked_track(const std::string& target, const std::vector<glm::dvec3>& values) {
    std::vector<std::string> items;
    items.reserve(values.size());
    for (size_t i = 0; i < values.size(); ++i)
        items.push_back(fmt::format("{{\"frame\": {}, \"value\": {}}}", i + 1,
                                    json_list(rounded(values[i], 9))));
    return fmt::format("{{\"target\": {}, \"keys\": [\n      {}]}}", json_text(target),
                       fmt::join(items, ",\n      "));
}

}  // namespace voxelume
