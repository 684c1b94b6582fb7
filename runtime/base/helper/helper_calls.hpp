// SPDX-License-Identifier: Apache-2.0
// The system calls that are left to a helper program while it decodes what it is given.
#pragma once

namespace voxelume {

/// Restricts this process, for the rest of its life and in all of its threads, to what computing
/// takes: to read and write the descriptors that it has, to take memory that isn't executable, to
/// start threads, and to end. Every other system call fails with EPERM: none opens a file or a
/// socket, starts a process or signals one. Call it after everything that the process needs is
/// open.
///
/// Returns false where the kernel has no such filter (seccomp), and in programs built with
/// sanitizers, which need more: then nothing is forbidden.
bool forbid_system_calls();

}  // namespace voxelume
