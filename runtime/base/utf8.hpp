// SPDX-License-Identifier: Apache-2.0
// Tells UTF-8 from other text, and turns text of unknown encoding, as old files have it, into it.
#pragma once

#include <string>

namespace voxelume {

bool is_utf8(const std::string& text);

/// The text itself where it is valid UTF-8; otherwise its bytes are taken for Latin-1, so that the
/// result always is.
std::string utf8_text(const std::string& text);

/// True if text begins with the mark of UTF-16, of either order of bytes.
bool is_utf16(const std::string& text);

/// The text in UTF-8, without its mark. What is no character becomes U+FFFD.
std::string utf8_of_utf16(const std::string& text);

}  // namespace voxelume
