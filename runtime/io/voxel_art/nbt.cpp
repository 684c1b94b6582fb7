// SPDX-License-Identifier: Apache-2.0
#include "runtime/io/voxel_art/nbt.hpp"

#include <algorithm>
#include <cstring>

#include "runtime/base/text.hpp"

namespace voxelume {
namespace {

constexpr int kMaxDepth = 64;
constexpr size_t kMaxValues = 1'000'000;

using Kind = NbtValue::Kind;

class NbtParser {
  public:
    NbtParser(std::string_view bytes, const InputFile& file) : bytes_(bytes), file_(file) {}

    NbtValue root() {
        if (take_kind() != Kind::compound) file_.refuse("has no named binary tags");
        take_text();
        return value(Kind::compound, 0);
    }

  private:
    std::string_view take(uint64_t count) {
        if (count > bytes_.size() - at_) file_.refuse("the file ends too early; it is truncated");
        at_ += size_t(count);
        return bytes_.substr(at_ - size_t(count), size_t(count));
    }

    uint64_t take_number(size_t size) {
        uint64_t number = 0;
        for (const char c : take(size)) number = number << 8 | uint8_t(c);
        return number;
    }

    uint64_t take_count(uint64_t bytes_each) {
        const auto count = int32_t(take_number(4));
        if (count < 0 || uint64_t(count) * bytes_each > bytes_.size() - at_)
            file_.refuse("a list counts more than the file holds; it is damaged");
        return uint64_t(count);
    }

    Kind take_kind() {
        const uint64_t kind = take_number(1);
        if (kind > uint64_t(Kind::longs))
            file_.refuse("a value is of no known kind; it is damaged");
        return Kind(kind);
    }

    std::string_view take_text() { return take(take_number(2)); }

    NbtValue value(Kind kind, int depth) {
        if (depth > kMaxDepth) file_.refuse(fmt::format("is deeper than {} levels", kMaxDepth));
        if (++count_ > kMaxValues) file_.refuse(fmt::format("has more than {} values", kMaxValues));
        NbtValue value;
        value.kind = kind;
        switch (kind) {
            case Kind::none:
                break;
            case Kind::i8:
                value.number = int64_t(take_number(1) ^ 0x80) - 0x80;
                break;
            case Kind::i16:
                value.number = int16_t(take_number(2));
                break;
            case Kind::i32:
                value.number = int32_t(take_number(4));
                break;
            case Kind::i64:
                value.number = int64_t(take_number(8));
                break;
            case Kind::f32:
                value.content = take(4);
                break;
            case Kind::f64:
                value.content = take(8);
                break;
            case Kind::bytes:
                value.content = take(take_count(1));
                break;
            case Kind::text:
                value.content = take_text();
                break;
            case Kind::list:
                take_items(value, depth);
                break;
            case Kind::compound:
                take_members(value, depth);
                break;
            case Kind::ints:
                value.content = take(4 * take_count(4));
                break;
            case Kind::longs:
                value.content = take(8 * take_count(8));
                break;
        }
        return value;
    }

    void take_items(NbtValue& list, int depth) {
        const Kind kind = take_kind();
        // A list without values may be of no kind.
        const uint64_t count = take_count(kind == Kind::none ? 0 : 1);
        if (kind == Kind::none) return;
        for (uint64_t i = 0; i < count; ++i) list.items.push_back(value(kind, depth + 1));
    }

    void take_members(NbtValue& compound, int depth) {
        for (Kind kind = take_kind(); kind != Kind::none; kind = take_kind()) {
            const std::string_view name = take_text();
            compound.members.push_back({name, value(kind, depth + 1)});
        }
    }

    std::string_view bytes_;
    const InputFile& file_;
    size_t at_ = 0;
    size_t count_ = 0;
};

}  // namespace

const NbtValue* NbtValue::find(std::string_view name) const {
    for (const auto& [key, value] : members)
        if (key == name) return &value;
    return nullptr;
}

const NbtValue& NbtValue::get(std::string_view name, Kind of, const InputFile& file) const {
    const NbtValue* found = find(name);
    if (!found || found->kind != of) file.refuse(fmt::format("lacks its {}", quote(name)));
    return *found;
}

int64_t NbtValue::whole(std::string_view name, const InputFile& file) const {
    const NbtValue* found = find(name);
    if (!found || found->kind < Kind::i8 || found->kind > Kind::i64)
        file.refuse(fmt::format("lacks its {}", quote(name)));
    return found->number;
}

uint64_t NbtValue::long_at(size_t i) const {
    uint64_t bits = 0;
    for (const char c : content.substr(8 * i, 8)) bits = bits << 8 | uint8_t(c);
    return bits;
}

NbtValue parse_nbt(std::string_view bytes, const InputFile& file) {
    return NbtParser(bytes, file).root();
}

}  // namespace voxelume
