// SPDX-License-Identifier: Apache-2.0
// MagicaVoxel file -> contents of a scene: a model for each that is used, an object for each place
#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <set>

#include "runtime/base/files/input_file.hpp"
#include "runtime/import/contents.hpp"
#include "runtime/import/vox_parts.hpp"
#include "runtime/import/vox_sight.hpp"
#include "runtime/io/voxels/vox_voxels.hpp"

namespace voxelume {
namespace {

/// Turns [psi, theta, gamma] in quarters, and whether all axes are then mirrored.
struct QuarterTurns {
    std::array<int, 3> quarters{};
    bool is_mirrored = false;
};

using Rows = std::array<std::array<int, 3>, 3>;

Rows product(const Rows& a, const Rows& b) {
    Rows c{};
    for (size_t i = 0; i < 3; ++i)
        for (size_t j = 0; j < 3; ++j)
            for (size_t k = 0; k < 3; ++k) c[i][j] += a[i][k] * b[k][j];
    return c;
}

/// The turn by quarters about an axis.
Rows about(size_t axis, int quarters) {
    constexpr std::array kCosine = {1, 0, -1, 0}, kSine = {0, 1, 0, -1};
    const int c = kCosine[size_t(quarters)], s = kSine[size_t(quarters)];
    const size_t u = (axis + 1) % 3, v = (axis + 2) % 3;
    Rows rows{};
    rows[axis][axis] = 1;
    rows[u][u] = rows[v][v] = c;
    rows[u][v] = -s;
    rows[v][u] = s;
    return rows;
}

QuarterTurns turns_of(const glm::dmat4& matrix) {
    Rows wanted{}, mirrored{};
    for (size_t row = 0; row < 3; ++row)
        for (size_t column = 0; column < 3; ++column) {
            wanted[row][column] = int(matrix[int(column)][int(row)]);
            mirrored[row][column] = -wanted[row][column];
        }
    for (int psi = 0; psi < 4; ++psi)
        for (int theta = 0; theta < 4; ++theta)
            for (int gamma = 0; gamma < 4; ++gamma) {
                const Rows turned =
                    product(about(1, psi), product(about(0, theta), about(2, gamma)));
                if (turned == wanted) return {{psi, theta, gamma}, false};
                if (turned == mirrored) return {{psi, theta, gamma}, true};
            }
    return {};
}

std::string turn_text(const QuarterTurns& turns) {
    const auto degrees = [&](size_t i) { return 90 * turns.quarters[i]; };
    return fmt::format("[{}, {}, {}]", degrees(0), degrees(1), degrees(2));
}

class VoxContents {
  public:
    /// `edge` is the edge of voxels in metres.
    VoxContents(const ImportedFile& file, double edge)
        : file_(file), vox_(file.assets.vox_file(file.path)), parts_(file, vox_), edge_(edge) {}

    Contents read() {
        contents_.voxel_size = glm::dvec3(edge_);
        contents_.box = {glm::dvec3(INFINITY), glm::dvec3(-INFINITY)};
        contents_.frames = vox_.frames;
        for (const VoxObject& object : vox_.objects) add_object(object);
        if (contents_.box.min.x > contents_.box.max.x)
            InputFile(file_.path).refuse("has no voxels to show");
        contents_.models = parts_.models();
        contents_.materials = parts_.materials(edge_);
        contents_.has_glass = parts_.has_glass();
        contents_.from = {-40, 30};  // as in the editor; see vox_light_test.cpp
        contents_.observer = vox_observer(vox_, contents_.box, file_.options.size, edge_);
        contents_.file_light = vox_file_light(vox_.render, edge_);
        return std::move(contents_);
    }

  private:
    /// Adds an object. If it shows several models in turn, each gets an object of its own, of which
    /// one is visible.
    void add_object(const VoxObject& object) {
        for (size_t i = 0; i < object.shown.size(); ++i) {
            const VoxShown& shown = object.shown[i];
            if (!parts_.has_voxels(shown.model)) continue;
            const int first = i == 0 ? 0 : shown.frame;
            const int last = i + 1 < object.shown.size() ? object.shown[i + 1].frame : vox_.frames;
            if (last > first) add_shown(object, shown.model, first, last);
        }
    }

    void add_shown(const VoxObject& object, int model, int first, int last) {
        const VoxPose* pose = &object.poses.front();
        for (const VoxPose& other : object.poses)
            if (other.frame <= first) pose = &other;
        const std::string name = unique_name(object.name, model);
        const bool is_always = first == 0 && last == vox_.frames;
        std::string text = fmt::format("{{\"name\": {}, \"model\": {}", json_text(name),
                                       json_text(parts_.name_of(model)));
        text += parts_.group_members(model);
        text += fmt::format(", \"position\": {}", json_list(position_of(*pose)));
        const QuarterTurns turns = turns_of(placement_of(*pose));
        if (turns.quarters != QuarterTurns().quarters || turns_change(object))
            text += ", \"turn\": " + turn_text(turns);
        const double scale = turns.is_mirrored ? -edge_ : edge_;
        if (scale != 1) text += fmt::format(", \"scale\": {}", scale);
        if (object.hidden || first > 0) text += ", \"visible\": false";
        contents_.objects.push_back(text + "}");
        if (object.hidden) return;
        if (parts_.is_emissive(model))
            contents_.emissive_objects.push_back(contents_.objects.size() - 1);
        if (!is_always) add_visible_track(name, first, last);
        add_pose_tracks(name, object, turns.is_mirrored);
        for (const VoxPose& at : object.poses) add_box(placement_of(at), parts_.box_of(model));
    }

    glm::dvec3 position_of(const VoxPose& pose) const {
        return edge_ * glm::dvec3(placement_of(pose)[3]);
    }

    static bool turns_change(const VoxObject& object) {
        return std::ranges::any_of(object.poses, [&](const VoxPose& pose) {
            return pose.rotation != object.poses.front().rotation;
        });
    }

    /// The name, numbered if another object has it already.
    std::string unique_name(const std::string& wanted, int model) {
        std::string base = wanted.empty() ? parts_.name_of(model) : wanted;
        const int number = ++names_[base];
        if (number == 1) return base;
        return unique_name(fmt::format("{} {}", base, number), model);
    }

    void add_track(const std::string& name, const char* key, const std::string& keys) {
        contents_.tracks.push_back(
            fmt::format("{{\"target\": {}, \"interpolation\": \"step\", \"keys\": [{}]}}",
                        json_text(fmt::format("objects.{}.{}", target_name(name), key)), keys));
    }

    void add_visible_track(const std::string& name, int first, int last) {
        std::string keys = fmt::format("{{\"frame\": 1, \"value\": {}}}", first == 0);
        if (first > 0) keys += fmt::format(", {{\"frame\": {}, \"value\": true}}", first + 1);
        if (last < vox_.frames)
            keys += fmt::format(", {{\"frame\": {}, \"value\": false}}", last + 1);
        add_track(name, "visible", keys);
    }

    void add_pose_tracks(const std::string& name, const VoxObject& object, bool is_mirrored) {
        std::vector<std::string> positions, turns;
        std::set<std::string> places;
        for (const VoxPose& pose : object.poses) {
            const auto key = [&](const std::string& value) {
                return fmt::format("{{\"frame\": {}, \"value\": {}}}", pose.frame + 1, value);
            };
            places.insert(json_list(position_of(pose)));
            positions.push_back(key(json_list(position_of(pose))));
            const QuarterTurns at = turns_of(placement_of(pose));
            // A pose that is mirrored unlike the first one can't be reached by turning.
            if (at.is_mirrored == is_mirrored) turns.push_back(key(turn_text(at)));
        }
        if (places.size() > 1)
            add_track(name, "position", fmt::format("{}", fmt::join(positions, ", ")));
        if (turns_change(object))
            add_track(name, "turn", fmt::format("{}", fmt::join(turns, ", ")));
    }

    void add_box(const glm::dmat4& place, const Bounds& box) {
        for (int i = 0; i < 8; ++i) {
            const glm::dvec3 p = edge_ * glm::dvec3(place * glm::dvec4(corner(box, i), 1));
            contents_.box = {glm::min(contents_.box.min, p), glm::max(contents_.box.max, p)};
        }
    }

    const ImportedFile& file_;
    const VoxFile& vox_;
    VoxParts parts_;
    double edge_;
    Contents contents_;
    std::map<std::string, int> names_ = {{"ground", 1}};  ///< how many objects have each
};

}  // namespace

Contents vox_contents(const ImportedFile& file) {
    Contents contents = VoxContents(file, 1).read();
    if (file.options.fit == 0) return contents;
    return VoxContents(file, file.options.fit / longest_side(contents.box)).read();
}

}  // namespace voxelume
