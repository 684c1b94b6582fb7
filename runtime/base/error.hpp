// SPDX-License-Identifier: Apache-2.0
// The one exception type of the library.
#pragma once

#include <fmt/format.h>

#include <memory>
#include <stdexcept>
#include <string>
#include <type_traits>
#include <utility>

#include "runtime/base/source_place.hpp"

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

/// The first place among a message's arguments; empty if there is none.
template <class... Args>
SourcePlace place_among(const Args&... args) {
    SourcePlace place;
    const auto take = [&place](const auto& arg) {
        if constexpr (std::is_same_v<std::remove_cvref_t<decltype(arg)>, SourcePlace>)
            if (place.empty()) place = arg;
    };
    (take(args), ...);
    return place;
}

/// A failure with a finished sentence for the user (where, what, what to do). It is thrown anywhere
/// and caught once in `main`. The place that the sentence names is known as data, too.
class Error : public std::runtime_error {
  public:
    Error(ErrorKind kind, const std::string& sentence)
        : std::runtime_error(sentence), kind_(kind) {}

    /// Makes an error whose sentence already names `place`.
    Error(const SourcePlace& place, ErrorKind kind, const std::string& sentence)
        : std::runtime_error(sentence),
          kind_(kind),
          place_(place.empty() ? nullptr : std::make_shared<const SourcePlace>(place)) {}

    /// The first SourcePlace among the arguments is the error's.
    template <class... Args>
    Error(ErrorKind kind, fmt::format_string<Args...> format,
          Args&&... args) requires(sizeof...(Args) > 0)
        : Error(place_among(args...), kind, fmt::vformat(format, fmt::make_format_args(args...))) {}

    ErrorKind kind() const noexcept { return kind_; }
    int exit_code() const noexcept { return static_cast<int>(kind_); }
    /// The place of the mistake; empty if it isn't known.
    SourcePlace place() const { return place_ ? *place_ : SourcePlace(); }

  private:
    ErrorKind kind_;
    std::shared_ptr<const SourcePlace> place_;
};

/// Calls `action`. If it meets a limit, the error's sentence begins with `subject`: "room.json:
/// world: the rays buffer needs 3.7 MB on ...". The error stands at `place`.
template <class Action>
auto with_limits_of(const std::string& subject, const Action& action,
                    const SourcePlace& place = {}) {
    try {
        return action();
    } catch (const Error& error) {
        const bool has_subject = place.empty() && !error.place().empty();
        if (error.kind() != ErrorKind::limit || has_subject) throw;
        throw Error(place.empty() ? error.place() : place, ErrorKind::limit,
                    fmt::format("{}: {}", subject, error.what()));
    }
}

}  // namespace voxelume
