// SPDX-License-Identifier: Apache-2.0
// Tells if this program was built with a sanitizer, which needs memory and system calls of its own.
#pragma once

namespace voxelume {

#if defined(__SANITIZE_ADDRESS__) || defined(__SANITIZE_THREAD__)
inline constexpr bool kHasSanitizer = true;
#elif defined(__has_feature)
inline constexpr bool kHasSanitizer =
    __has_feature(address_sanitizer) || __has_feature(thread_sanitizer);
#else
inline constexpr bool kHasSanitizer = false;
#endif

}  // namespace voxelume
