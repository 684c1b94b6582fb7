// A variable of the environment while a test needs it.
#pragma once

#include <cstdlib>
#include <optional>
#include <string>

namespace voxelume {

/// Sets an environment variable while it lives, or unsets it where no value is given; puts back
/// what was there before.
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
