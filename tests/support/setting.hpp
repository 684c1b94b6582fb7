// A variable of the environment while a test needs it.
#pragma once

#include <cstdlib>
#include <string>

namespace voxelume {

/// Sets an environment variable while it lives.
class Setting {
  public:
    Setting(const char* name, const std::string& value) : name_(name) {
        setenv(name, value.c_str(), 1);
    }
    Setting(const Setting&) = delete;
    Setting& operator=(const Setting&) = delete;
    ~Setting() { unsetenv(name_); }

  private:
    const char* name_;
};

}  // namespace voxelume
