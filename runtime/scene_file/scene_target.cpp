// SPDX-License-Identifier: Apache-2.0
#include "runtime/scene_file/scene_target.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <optional>

#include "runtime/scene/parts/solid.hpp"

namespace voxelume {
namespace {

using Names = std::vector<std::string_view>;

/// A kind of JSON object: its animated values, and objects in it that have animated values.
struct Place {
    std::string_view name;
    Names values;
    std::vector<std::pair<std::string_view, std::string_view>> places;  ///< key and Place::name
};

/// The keys of the animated values in all these lists of rows.
template <class... Rows>
Names animated(const Rows&... lists) {
    Names names;
    const auto add = [&](const auto& rows) {
        for (const auto& row : rows)
            if (row.is_animated) names.push_back(row.key);
    };
    (add(lists), ...);
    return names;
}

const Place& place_named(std::string_view name) {
    static const std::vector<Place> places = {
        {"world", animated(world_rows()), {{"medium", "medium"}}},
        {"medium", animated(medium_rows()), {{"density", "density"}}},
        {"density",
         animated(factor_rows(), height_density_rows(), ball_density_rows(), grid_density_rows()),
         {}},
        {"materials", animated(material_rows()), {{"checker", "checker"}}},
        {"checker", animated(checker_rows()), {}},
        {"models",
         animated(solid_rows(), model_rows()),
         {{"parts", "parts"}, {"cut", "parts"}, {"morph", "morph"}}},
        {"parts", animated(solid_rows(), factor_rows()), {{"parts", "parts"}}},
        {"morph", animated(morph_rows()), {}},
        {"objects", animated(factor_rows(), object_rows()), {{"parents", "parents"}}},
        {"parents", animated(factor_rows()), {}},
        {"lights", animated(light_rows()), {}},
        {"observer", animated(observer_rows()), {{"display", "display"}}},
        {"display", animated(display_rows()), {}},
    };
    return *std::ranges::find(places, name, &Place::name);
}

std::vector<PathStep> read_path(const SceneValue& path) {
    std::optional<std::vector<PathStep>> steps = parse_path(path.text());
    if (!steps) path.fail(kPathAdvice);
    return std::move(*steps);
}

/// Follows a path through the document.
class PathWalker {
  public:
    PathWalker(const SceneValue& path, const JsonValue& document)
        : path_(path), steps_(read_path(path)), root_(document) {}

    TrackTarget walk() {
        const std::string& start = steps_.front().key;
        static constexpr std::string_view kSections[] = {"world",   "materials", "models",
                                                         "objects", "lights",    "observer"};
        const auto section = std::ranges::find(kSections, start);
        if (section == std::end(kSections))
            path_.fail(fmt::format("starts with {}, which is no part of a scene that can change{}",
                                   quote(start), suggest(start, kSections)));
        target_.part = static_cast<ScenePart>(section - std::begin(kSections));
        target_.path = start;
        target_.value = &member(root_, start, "the scene");
        next_ = 1;
        if (target_.part != ScenePart::world && target_.part != ScenePart::observer) find_item();
        follow(place_named(start), *target_.value);
        return std::move(target_);
    }

  private:
    bool is_at_end() const { return next_ == steps_.size(); }

    const std::string& next_key(const std::string& of, const Names& known) {
        if (is_at_end() || steps_[next_].key.empty())
            path_.fail(fmt::format("names no value of {}{}", of, suggest("", known)));
        return steps_[next_++].key;
    }

    const JsonValue& member(const JsonValue& of, const std::string& key,
                            const std::string& what) const {
        const auto found = std::ranges::find(of.members, key, &JsonMember::key);
        if (found == of.members.end())
            path_.fail(fmt::format("{} has no {} to change", what, quote(key)));
        return found->value;
    }

    const JsonValue& item(const JsonValue& list, const std::string& what) {
        if (is_at_end() || !steps_[next_].key.empty())
            path_.fail(fmt::format("which of {}? Write its place, counted from 0, as in \"{}[0]\"",
                                   what, what));
        const size_t index = steps_[next_++].item;
        if (list.type == JsonType::number)
            path_.fail(
                fmt::format("{} is one number here; change it as a whole, or write it as a "
                            "list of numbers in the scene",
                            what));
        if (index >= list.items.size())
            path_.fail(fmt::format("there is no {}[{}]: {} has {} items", what, index, what,
                                   list.items.size()));
        return list.items[index];
    }

    /// Finds the object, light, material or model that the path names.
    void find_item() {
        const std::string section = target_.path;
        const bool is_list = target_.part == ScenePart::object || target_.part == ScenePart::light;
        const std::string kind = section.substr(0, section.size() - 1);
        const JsonValue& all = *target_.value;
        if (is_list && !is_at_end() && steps_[next_].key.empty()) {
            target_.value = &item(all, section);
            target_.number = size_t(target_.value - all.items.data());
            target_.path = section + item_step(all, target_.number);
            return;
        }
        const Names names = is_list ? names_of_items(all) : names_of_members(all);
        Names given = names;
        std::erase(given, std::string_view());
        const std::string& name = next_key(section, given);
        const auto found = std::ranges::find(names, name);
        if (found == names.end())
            path_.fail(fmt::format("no {} named {}{}", kind, quote(name),
                                   suggest_item(section, name, names.size(), given)));
        target_.number = size_t(found - names.begin());
        target_.name = name;
        target_.value = is_list ? &all.items[target_.number] : &all.members[target_.number].value;
        target_.path =
            is_list ? section + item_step(all, target_.number)
                    : fmt::format("{}.{}", section,
                                  name.find_first_of(".[") == name.npos ? name : quote(name));
    }

    /// Suggestions for the path: a list's items can also be named by their indices, and those
    /// without a name only by these.
    static std::string suggest_item(const std::string& section, const std::string& name,
                                    size_t count, const Names& given) {
        std::string nearest = suggest(name, given);
        if (given.size() == count || nearest.starts_with("; did you mean")) return nearest;
        if (count == 1)
            return fmt::format("; the only one has no name: give it one, or write \"{}[0]\"",
                               section);
        return fmt::format(
            "{}; {} of {} have no name: give them one, or write places such as "
            "\"{}[0]\"",
            nearest, count - given.size(), count, section);
    }

    /// Items without a name of their own have an empty one.
    static Names names_of_items(const JsonValue& list) {
        Names names;
        for (const JsonValue& item : list.items) {
            const auto name = std::ranges::find(item.members, "name", &JsonMember::key);
            names.push_back(name == item.members.end() ? std::string_view()
                                                       : std::string_view(name->value.text));
        }
        return names;
    }

    static Names names_of_members(const JsonValue& object) {
        Names names;
        for (const JsonMember& m : object.members) names.push_back(m.key);
        return names;
    }

    void follow(const Place& place, const JsonValue& value) {
        Names known = place.values;
        for (const auto& [key, name] : place.places) known.push_back(key);
        const std::string here = path_so_far(), key = next_key(here, known);
        const auto inner =
            std::ranges::find(place.places, key, [](const auto& entry) { return entry.first; });
        if (inner != place.places.end()) {
            const JsonValue* child = &member(value, key, here);
            target_.steps.push_back({key});
            if (child->type == JsonType::array) {
                child = &item(*child, key);
                target_.steps.push_back(steps_[next_ - 1]);
            }
            return follow(place_named(inner->second), *child);
        }
        if (std::ranges::find(place.values, key) == place.values.end())
            path_.fail(fmt::format("{} has no value {} that can change{}", here, quote(key),
                                   suggest_key(key, known)));
        check_rivals(value, key);
        target_.steps.push_back({key});
        if (is_at_end()) return;
        item(member(value, key, here), key);
        target_.steps.push_back(steps_[next_ - 1]);
        if (!is_at_end()) path_.fail(fmt::format("goes on behind a number of {}", quote(key)));
    }

    /// Refuses to change a value that another key of the object replaces.
    void check_rivals(const JsonValue& of, const std::string& key) const {
        const auto has = [&](std::string_view rival) {
            return std::ranges::find(of.members, rival, &JsonMember::key) != of.members.end();
        };
        if ((key == "position" || key == "turn" || key == "scale") && has("matrix"))
            path_.fail(
                fmt::format("{} is placed by its \"matrix\"; write \"position\", \"turn\" "
                            "and \"scale\" instead of that to change them",
                            path_so_far()));
        if ((key == "mesh" || key == "voxels" || key == "file") && has("sequence"))
            path_.fail(
                fmt::format("{} has its files from its \"sequence\"; leave out that or this "
                            "track",
                            path_so_far()));
    }

    std::string path_so_far() const {
        std::string path = target_.path;
        for (const PathStep& step : target_.steps)
            path += step.key.empty() ? fmt::format("[{}]", step.item) : "." + step.key;
        return path;
    }

    const SceneValue& path_;
    std::vector<PathStep> steps_;
    const JsonValue& root_;
    size_t next_ = 0;
    TrackTarget target_;
};

}  // namespace

TrackTarget find_target(const SceneValue& path, const JsonValue& document) {
    return PathWalker(path, document).walk();
}

}  // namespace voxelume
