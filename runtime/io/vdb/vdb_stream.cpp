// SPDX-License-Identifier: Apache-2.0
#include "runtime/io/vdb/vdb_stream.hpp"

#include <openvdb/io/Stream.h>
#include <xxhash.h>

#include <algorithm>
#include <array>
#include <memory>
#include <ostream>
#include <streambuf>
#include <vector>

#include "runtime/base/files/stamp.hpp"

namespace voxelume::vdb {

namespace {

/// The offset of the file's identifier, which is text: after magic, three version numbers and a
/// flag.
constexpr uint64_t kUuidStart = 21;
constexpr uint64_t kUuidLength = 36;

/// Hashes a file's bytes in order, without the identifier and with zeros for a stamp's check, which
/// are written later.
class ContentHash {
  public:
    ContentHash() : state_(XXH3_createState(), XXH3_freeState) { XXH3_128bits_reset(state_.get()); }

    void update(const char* bytes, size_t size) {
        if (!is_in_head_) return add(bytes, size);
        head_.append(bytes, size);
        if (head_.size() >= kStampHeader) end_head();
    }
    /// The hash's 128 bits in the form of a version 5 (from a hash) identifier.
    std::string uuid() {
        if (is_in_head_) end_head();
        const XXH128_hash_t hash = XXH3_128bits_digest(state_.get());
        const uint64_t high = (hash.high64 & ~uint64_t{0xf000}) | 0x5000;
        const uint64_t low = (hash.low64 & ~(uint64_t{3} << 62)) | (uint64_t{2} << 62);
        return fmt::format("{:08x}-{:04x}-{:04x}-{:04x}-{:012x}", high >> 32, high >> 16 & 0xffff,
                           high & 0xffff, low >> 48, low & 0xffffffffffff);
    }

  private:
    void add(const char* bytes, size_t size) { XXH3_128bits_update(state_.get(), bytes, size); }

    void end_head() {
        if (const auto check = stamp_check_offset(head_))
            head_.replace(*check, kStampCheckDigits, kStampCheckDigits, '0');
        const size_t start = std::min<size_t>(kUuidStart, head_.size());
        const size_t end = std::min<size_t>(kUuidStart + kUuidLength, head_.size());
        add(head_.data(), start);
        add(head_.data() + end, head_.size() - end);
        head_ = {};
        is_in_head_ = false;
    }

    std::unique_ptr<XXH3_state_t, decltype(&XXH3_freeState)> state_;
    std::string head_;  ///< the bytes among which a stamp lies
    bool is_in_head_ = true;
};

/// Passes bytes on to an AtomicFile in blocks, and hashes them.
class VdbStreamBuffer : public std::streambuf {
  public:
    explicit VdbStreamBuffer(AtomicFile& file) : file_(file) {
        setp(block_.data(), block_.data() + block_.size());
    }
    std::string uuid() { return hash_.uuid(); }

  protected:
    int_type overflow(int_type next) override {
        sync();
        if (!traits_type::eq_int_type(next, traits_type::eof()))
            sputc(traits_type::to_char_type(next));
        return traits_type::not_eof(next);
    }
    int sync() override {
        const auto size = static_cast<size_t>(pptr() - pbase());
        hash_.update(pbase(), size);
        file_.write(pbase(), size);
        setp(block_.data(), block_.data() + block_.size());
        return 0;
    }

  private:
    AtomicFile& file_;
    ContentHash hash_;
    std::array<char, 1 << 16> block_{};
};

}  // namespace

void write_vdb_grids(AtomicFile& file, const openvdb::GridCPtrVec& grids,
                     const openvdb::MetaMap& metadata) {
    try {
        VdbStreamBuffer buffer(file);
        std::ostream stream(&buffer);
        stream.exceptions(std::ios::badbit);  // lets the AtomicFile's own error through
        openvdb::io::Stream(stream).write(grids, metadata);
        stream.flush();
        const std::string uuid = buffer.uuid();
        file.seek(kUuidStart);
        file.write(uuid.data(), uuid.size());
    } catch (const openvdb::Exception& error) {
        file.fail(error.what());
    } catch (const std::ios_base::failure& error) {
        file.fail(error.what());
    }
}

namespace {

/// Empty for a file that is too short.
std::string identifier_in(const InputFile& file) {
    if (file.size() < kUuidStart + kUuidLength) return {};
    std::string uuid(kUuidLength, '\0');
    file.read(kUuidStart, uuid.data(), uuid.size());
    return uuid;
}

}  // namespace

bool vdb_identifier_holds(const InputFile& file) {
    const std::string uuid = identifier_in(file);
    if (uuid.empty()) return false;
    std::vector<char> block(std::min<uint64_t>(file.size(), 1 << 20));
    ContentHash hash;
    for (uint64_t position = 0; position < file.size(); position += block.size()) {
        const size_t size = std::min<uint64_t>(block.size(), file.size() - position);
        file.read(position, block.data(), size);
        hash.update(block.data(), size);
    }
    return uuid == hash.uuid();
}

std::optional<bool> is_vdb_as_written(const std::filesystem::path& path) {
    constexpr size_t kVersionDigit = 14;  // others' identifiers are random: of version 4
    const InputFile file(path);
    const std::string uuid = identifier_in(file);
    if (uuid.empty() || uuid[kVersionDigit] != '5') return {};
    return vdb_identifier_holds(file);
}

}  // namespace voxelume::vdb
