// The one exception type of the library.
#pragma once

#include <fmt/format.h>

#include <stdexcept>
#include <string>
#include <utility>

namespace voxelume {

/// The kind of failure, which is also the program's exit code.
enum class ErrorKind : int {
    render = 1,  ///< rendering failed: a device was lost, a kernel misbehaved
    usage = 2,   ///< the command line
    scene = 3,   ///< the scene's text or values
    input = 4,   ///< a file that is missing, unreadable or damaged
    output = 5,  ///< a file that can't be written
    device = 6,  ///< no device, or not the one asked for
    build = 7,   ///< a kernel that doesn't compile on this device
    limit = 8,   ///< memory, or a documented limit
};

/// A failure with a finished sentence for the user (where, what, what to do). It is thrown anywhere
/// and caught once in `main`.
class Error : public std::runtime_error {
  public:
    Error(ErrorKind kind, const std::string& sentence)
        : std::runtime_error(sentence), kind_(kind) {}

    template <class... Args>
    Error(ErrorKind kind, fmt::format_string<Args...> format,
          Args&&... args) requires(sizeof...(Args) > 0)
        : Error(kind, fmt::format(format, std::forward<Args>(args)...)) {}

    ErrorKind kind() const noexcept { return kind_; }
    int exit_code() const noexcept { return static_cast<int>(kind_); }

  private:
    ErrorKind kind_;
};

/// Calls `action`. If it meets a limit, the error's sentence begins with `subject`: "room.json:
/// world: the rays buffer needs 3.7 MB on ...".
template <class Action>
auto with_limits_of(const std::string& subject, const Action& action) {
    try {
        return action();
    } catch (const Error& error) {
        if (error.kind() != ErrorKind::limit) throw;
        throw Error(ErrorKind::limit, "{}: {}", subject, error.what());
    }
}

}  // namespace voxelume
