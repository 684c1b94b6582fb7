// SPDX-License-Identifier: Apache-2.0
#include "runtime/scene_file/document/document_hash.hpp"

#include <algorithm>
#include <array>

#include "runtime/base/files/cache_key.hpp"
#include "runtime/base/files/disk_cache.hpp"

namespace voxelume {
namespace {

/// True for keys that don't change what a frame shows, and for keys that callers may replace later.
bool is_silent(std::string_view parent, std::string_view key) {
    return (parent.empty() && key == "$schema") || (parent == "animation" && key == "frames") ||
           (parent == "render" && (key == "size" || key == "samples" || key == "light"));
}

/// `place` is the key of the value if it is a member of the document, or else empty for the
/// document and "." for what is deeper.
void add(const JsonValue& value, std::string_view place, CacheKey& key) {
    key.add(char(value.type));
    switch (value.type) {
        case JsonType::null:
            return;
        case JsonType::boolean:
            key.add(value.boolean);
            return;
        case JsonType::number:
            key.add(value.number + 0.0);  // no negative zero
            return;
        case JsonType::string:
            key.add_text(value.text);
            return;
        case JsonType::array:
            key.add(value.items.size());
            for (const JsonValue& item : value.items) add(item, ".", key);
            return;
        case JsonType::object:
            break;
    }
    std::vector<const JsonMember*> members;
    for (const JsonMember& member : value.members)
        if (!is_silent(place, member.key)) members.push_back(&member);
    std::ranges::sort(members, {}, [](const JsonMember* member) { return member->key; });
    key.add(members.size());
    for (const JsonMember* member : members) {
        key.add_text(member->key);
        add(member->value, place.empty() ? std::string_view(member->key) : ".", key);
    }
}

}  // namespace

std::string document_hash(const JsonValue& document) {
    CacheKey key;
    add(document, "", key);
    const std::array<std::string_view, 1> parts = {key.bytes()};
    return cache_key(parts);
}

}  // namespace voxelume
