// SPDX-License-Identifier: Apache-2.0
// Ctrl-C and SIGTERM: the program ends within two seconds, and leaves nothing half written.
#pragma once

#include <chrono>
#include <functional>
#include <stop_token>

namespace voxelume::cli {

/// Has SIGINT and SIGTERM end the program: at once, or, as long as an `Interruptible` lives, by its
/// stop token and at the latest when its grace is over. What is unfinished on disk is removed,
/// and one line says why the program ends. A signal 0.3 s after the first or later ends it as if
/// nothing was prepared. Signals that are ignored when the program starts stay so.
void handle_interrupts();

/// A part of the program that ends soon when it is asked to.
class Interruptible {
  public:
    /// `grace` is how long it may take from the signal to its end.
    explicit Interruptible(std::chrono::milliseconds grace = std::chrono::milliseconds(1500));
    ~Interruptible();
    Interruptible(const Interruptible&) = delete;
    Interruptible& operator=(const Interruptible&) = delete;

    /// Requested by a signal.
    std::stop_token stop() const;
};

/// The exit code of a program that was interrupted: 130 after SIGINT, 143 after SIGTERM.
int interrupted_code();

/// Calls `say`, which says that the program was interrupted, unless this was said before. The
/// process doesn't end meanwhile.
void tell_interruption(const std::function<void()>& say);

}  // namespace voxelume::cli
