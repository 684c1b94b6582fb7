// SPDX-License-Identifier: Apache-2.0
// The one exception type of the library, and what it knows of the place of a mistake.
#pragma once

#include <memory>
#include <stdexcept>
#include <string>

/// Keeps a class with a vtable visible in programs that are compiled with -fvisibility=hidden.
#define VOXELUME_API __attribute__((visibility("default")))

namespace voxelume::v1 {

/// The kind of a failure. The numbers are the exit codes of the program `voxelume`.
enum class ErrorKind : int {
    render = 1,      ///< rendering failed: a device was lost, a kernel misbehaved
    usage = 2,       ///< a call doesn't accept an argument
    scene = 3,       ///< the text or the values of a scene are wrong
    input = 4,       ///< a file is missing, unreadable or damaged
    output = 5,      ///< a file can't be written
    device = 6,      ///< there is no device, or not the one asked for
    build = 7,       ///< a kernel doesn't compile on this device
    limit = 8,       ///< memory doesn't suffice, or a documented limit is exceeded
    cancelled = 130  ///< the caller asked to stop
};

/// The place of a mistake. Parts that don't apply are empty or 0.
struct ErrorPlace {
    /// The scene, mesh, image or volume; the name of a scene built from structs.
    std::string file{};
    int line = 0;       ///< number of the line, from 1
    int column = 0;     ///< number of the character in its line, from 1
    std::string key{};  ///< the path of a value in a scene: "objects[0].material"
};

/// A failed call. `what()` is a finished sentence for a person: where, what, and what to do about
/// it, such as `room.json:12:9: objects[0].material: no material named "brik"; did you mean
/// "brick"?`. The parts of the place that the sentence names are data, too.
///
/// Every function of the library may throw it, and they throw nothing else, except for what a
/// caller's own callbacks throw: such exceptions end the call and arrive unchanged.
class VOXELUME_API Error : public std::runtime_error {
  public:
    /// An error of a kind, with a finished sentence and the place that it is about.
    Error(ErrorKind kind, const std::string& sentence, ErrorPlace place = {});
    /// Copies share the sentence.
    Error(const Error&) noexcept = default;
    /// Copies share the sentence.
    Error& operator=(const Error&) noexcept = default;
    ~Error() override;

    /// The kind of the failure, for programs.
    ErrorKind kind() const noexcept { return kind_; }
    /// The exit code of the command line for this kind.
    int exit_code() const noexcept { return static_cast<int>(kind_); }

    /// The place that the error is about; empty parts don't apply.
    const ErrorPlace& place() const noexcept { return *place_; }
    /// The file; empty if there is none.
    const std::string& file() const noexcept { return place_->file; }
    /// The line of the file, from 1; 0 if there is none.
    int line() const noexcept { return place_->line; }
    /// The column of the line, from 1; 0 if there is none.
    int column() const noexcept { return place_->column; }
    /// The key of the scene, such as "models.ball.radius"; empty if there is none.
    const std::string& key() const noexcept { return place_->key; }

  private:
    ErrorKind kind_;
    std::shared_ptr<const ErrorPlace> place_;
};

}  // namespace voxelume::v1
