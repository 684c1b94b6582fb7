// SPDX-License-Identifier: Apache-2.0
#include "runtime/io/voxels/vox_graph.hpp"

#include <algorithm>
#include <cstdio>
#include <cstdlib>

namespace voxelume {
namespace {

constexpr int kMaxDepth = 256;
constexpr size_t kMaxObjects = 50'000;
constexpr int kFarthest = 1'000'000;  // voxels from the origin

VoxPose take_pose(VoxContent& content) {
    const VoxDictionary values = content.take_dictionary();
    VoxPose pose;
    pose.frame = std::max(0, std::atoi(text_in(values, "_f", "0").c_str()));
    if (values.contains("_r"))
        pose.rotation = vox_rotation(std::atoi(text_in(values, "_r").c_str()), content);
    glm::ivec3& t = pose.translation;
    if (values.contains("_t") &&
        std::sscanf(text_in(values, "_t").c_str(), "%9d %9d %9d", &t.x, &t.y, &t.z) != 3)
        content.refuse("has a translation that isn't three whole numbers");
    return pose;
}

template <class Value>
void sort_by_frame(std::vector<Value>& values) {
    std::stable_sort(values.begin(), values.end(),
                     [](const Value& a, const Value& b) { return a.frame < b.frame; });
}

/// The last value whose frame isn't later than `frame`; else the first value.
template <class Value>
const Value& at_frame(const std::vector<Value>& values, int frame) {
    const Value* found = &values.front();
    for (const Value& value : values)
        if (value.frame <= frame) found = &value;
    return *found;
}

/// The state that a node inherits from the nodes above it.
struct Above {
    std::vector<VoxPose> poses = {VoxPose()};
    std::string name;
    bool hidden = false;
    int depth = 0;
};

/// Poses in a parent that has several poses: one for each frame in which either changes.
std::vector<VoxPose> composed(const std::vector<VoxPose>& outer,
                              const std::vector<VoxPose>& inner) {
    std::set<int> frames = {0};
    for (const auto* poses : {&outer, &inner})
        for (const VoxPose& pose : *poses) frames.insert(pose.frame);
    std::vector<VoxPose> result;
    for (const int frame : frames) {
        const VoxPose &a = at_frame(outer, frame), &b = at_frame(inner, frame);
        result.push_back(
            {frame, a.rotation * b.rotation, a.rotation * b.translation + a.translation});
    }
    return result;
}

class GraphWalk {
  public:
    GraphWalk(const VoxGraph& graph, const VoxFile& vox, const InputFile& file)
        : graph_(graph), vox_(vox), file_(file) {}

    void walk(int number, Above above) {
        const auto found = graph_.nodes.find(number);
        if (found == graph_.nodes.end())
            file_.refuse(fmt::format("its scene names a node {} that there isn't", number));
        const VoxNode& node = found->second;
        if (++above.depth > kMaxDepth)
            file_.refuse(
                fmt::format("the nodes of its scene go round in a circle, or are more than {} deep",
                            kMaxDepth));
        above.hidden |= node.hidden || graph_.hidden_layers.contains(node.layer);
        if (!node.name.empty()) above.name = node.name;
        if (node.kind == VoxNodeKind::shape) return add_object(node, above);
        if (node.kind == VoxNodeKind::transform) above.poses = composed(above.poses, node.poses);
        for (const int child : node.children) walk(child, above);
    }

    std::vector<VoxObject> objects;

  private:
    void add_object(const VoxNode& node, const Above& above) {
        for (const VoxShown& shown : node.shown)
            if (shown.model < 0 || size_t(shown.model) >= vox_.models.size())
                file_.refuse(fmt::format("its scene names model {} of {}", shown.model + 1,
                                         vox_.models.size()));
        if (node.shown.empty()) return;
        if (objects.size() == kMaxObjects)
            file_.refuse(fmt::format("its scene has more than {} objects", kMaxObjects));
        for (const VoxPose& pose : above.poses)
            for (int axis = 0; axis < 3; ++axis)
                if (std::abs(pose.translation[axis]) > kFarthest)
                    file_.refuse(
                        fmt::format("an object lies farther than {} voxels from the "
                                    "origin",
                                    kFarthest));
        objects.push_back({above.name, above.hidden, above.poses, node.shown});
    }

    const VoxGraph& graph_;
    const VoxFile& vox_;
    const InputFile& file_;
};

}  // namespace

VoxRotation vox_rotation(int byte, const VoxContent& content) {
    VoxRotation rotation;
    rotation.axis = {byte & 3, byte >> 2 & 3, 0};
    rotation.axis[2] = 3 - rotation.axis[0] - rotation.axis[1];
    if (rotation.axis[0] == 3 || rotation.axis[1] == 3 || rotation.axis[0] == rotation.axis[1])
        content.refuse(fmt::format("has a rotation {}, which is none", byte));
    for (int row = 0; row < 3; ++row) rotation.sign[size_t(row)] = byte >> (4 + row) & 1 ? -1 : 1;
    return rotation;
}

void take_node(VoxNodeKind kind, VoxContent& content, VoxGraph& graph) {
    const int number = content.take_int();
    const VoxDictionary attributes = content.take_dictionary();
    VoxNode node;
    node.kind = kind;
    node.name = text_in(attributes, "_name");
    node.hidden = text_in(attributes, "_hidden") == "1";
    if (kind == VoxNodeKind::transform) {
        node.children.push_back(content.take_int());
        content.take_int();  // reserved
        node.layer = content.take_int();
        for (int left = content.take_count(4); left > 0; --left)
            node.poses.push_back(take_pose(content));
        if (node.poses.empty()) node.poses.emplace_back();
        sort_by_frame(node.poses);
    } else if (kind == VoxNodeKind::group) {
        for (int left = content.take_count(4); left > 0; --left)
            node.children.push_back(content.take_int());
    } else {
        for (int left = content.take_count(8); left > 0; --left) {
            const int model = content.take_int();
            const VoxDictionary values = content.take_dictionary();
            node.shown.push_back(
                {std::max(0, std::atoi(text_in(values, "_f", "0").c_str())), model});
        }
        sort_by_frame(node.shown);
    }
    graph.nodes[number] = std::move(node);
}

std::vector<VoxObject> objects_of(const VoxGraph& graph, const VoxFile& vox,
                                  const InputFile& file) {
    GraphWalk walk(graph, vox, file);
    if (!graph.nodes.empty()) {
        walk.walk(0, {});
        return std::move(walk.objects);
    }
    VoxObject object;
    for (size_t model = 0; model < vox.models.size(); ++model)
        object.shown.push_back({int(model), int(model)});
    // The models of a file without nodes are frames, each on the ground.
    for (size_t model = 0; model < vox.models.size(); ++model)
        object.poses.push_back({int(model), {}, {0, 0, vox.models[model].size.z / 2}});
    if (object.shown.empty()) return {};
    return {object};
}

}  // namespace voxelume
