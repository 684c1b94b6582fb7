// SPDX-License-Identifier: Apache-2.0
// The system calls that are left to a helper program while it decodes what it is given.
#pragma once

namespace voxelume {

/// Leaves this process, for the rest of its life, what computing takes: to read and write the
/// descriptors that it has, to take memory that isn't executable, and to end. Every other system
/// call fails with EPERM: none opens a file, a socket or a process, or signals another one. Call it
/// before the process has threads, and after all that it needs is open.
///
/// Returns false where the kernel has no such filter (seccomp), and in programs built with
/// sanitizers, which need more: then nothing is forbidden.
bool forbid_system_calls();

}  // namespace voxelume
