// SPDX-License-Identifier: Apache-2.0
// An environment variable that is set for the duration of a test.
#pragma once

#include <cstdlib>
#include <optional>
#include <string>

namespace voxelume {

/// Sets an environment variable during its lifetime, or unsets it if no value is given; restores
/// the previous value afterwards.
class Setting {
  public:
    Setting(const char* name, const std::optional<std::string>& value) : name_(name) {
        if (const char* before = std::getenv(name)) before_ = before;
        put(value);
    }
    Setting(const Setting&) = delete;
    Setting& operator=(const Setting&) = delete;
    ~Setting() { put(before_); }

  private:
    void put(const std::optional<std::string>& value) const {
        value ? setenv(name_, value->c_str(), 1) : unsetenv(name_);
    }

    const char* name_;
    std::optional<std::string> before_;
};

}  // namespace voxelume
