// SPDX-License-Identifier: Apache-2.0
// A part of a scene as it is at one frame.
#pragma once

#include <string>
#include <string_view>

#include "runtime/scene/scene_motion.hpp"

namespace voxelume {

/// Sets the values that a part's tracks change, and values that depend on these.
class MovedPart {
  public:
    MovedPart(const MovingPart& part, const std::string& file, double frame, Scene& scene);

    /// Throws Error::scene for values that contradict each other although they don't at any key.
    void apply();

  private:
    void set(const Track& track);
    void form();
    void build_world();
    void place_object();
    bool has_scale_track(const SolidPath& solid) const;
    void form_model();
    void form_display(Observer& observer);

    Slot slot(const ValueReference& value, const SolidPath& solid);
    Solid& solid_at(const SolidPath& path);
    glm::dmat4 placed(const MovingPlacement& placement) const;

    /// Refuses values whose paths in the part begin with `prefix`.
    Refuse refusal(const std::string& prefix) const;
    SourcePlace where(std::string_view path) const;

    const MovingPart& part_;
    const std::string& file_;
    double frame_;
    Scene& scene_;
    std::vector<MovingPlacement> placements_;
    LightParameters light_;
    ObserverParameters observer_;
};

}  // namespace voxelume
