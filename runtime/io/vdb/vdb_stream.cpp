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

/// Hashes a file's bytes in order, without the identifier.
class ContentHash {
  public:
    ContentHash() : state_(XXH3_createState(), XXH3_freeState) { XXH3_128bits_reset(state_.get()); }
    /// Adds bytes. Those of the first call contain the whole identifier, or the file has none.
    void update(const char* bytes, size_t size) {
        if (is_first_ && size >= kUuidStart + kUuidLength) {
            add(bytes, kUuidStart);
            add(bytes + kUuidStart + kUuidLength, size - kUuidStart - kUuidLength);
        } else {
            add(bytes, size);
        }
        is_first_ = is_first_ && size == 0;
    }
    /// The hash's 128 bits in the form of a version 5 (from a hash) identifier.
    std::string uuid() const {
        const XXH128_hash_t hash = XXH3_128bits_digest(state_.get());
        const uint64_t high = (hash.high64 & ~uint64_t{0xf000}) | 0x5000;
        const uint64_t low = (hash.low64 & ~(uint64_t{3} << 62)) | (uint64_t{2} << 62);
        return fmt::format("{:08x}-{:04x}-{:04x}-{:04x}-{:012x}", high >> 32, high >> 16 & 0xffff,
                           high & 0xffff, low >> 48, low & 0xffffffffffff);
    }

  private:
    void add(const char* bytes, size_t size) { XXH3_128bits_update(state_.get(), bytes, size); }

    std::unique_ptr<XXH3_state_t, decltype(&XXH3_freeState)> state_;
    bool is_first_ = true;
};

/// Passes bytes on to an AtomicFile in blocks, each far longer than the file's head, and hashes
/// them.
class VdbStreamBuffer : public std::streambuf {
  public:
    explicit VdbStreamBuffer(AtomicFile& file) : file_(file) {
        setp(block_.data(), block_.data() + block_.size());
    }
    std::string uuid() const { return hash_.uuid(); }

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

bool vdb_identifier_holds(const InputFile& file) {
    std::vector<char> block(1 << 20);  // stamps lie in the first
    std::string uuid;
    ContentHash hash;
    for (uint64_t position = 0; position < file.size(); position += block.size()) {
        const size_t size = std::min<uint64_t>(block.size(), file.size() - position);
        file.read(position, block.data(), size);
        if (position == 0 && size >= kUuidStart + kUuidLength)
            uuid.assign(block.data() + kUuidStart, kUuidLength);
        // The check of a stamp is written after the identifier.
        if (position == 0)
            if (const auto check = stamp_check_offset({block.data(), size}))
                std::fill_n(block.data() + *check, kStampCheckDigits, '0');
        hash.update(block.data(), size);
    }
    return uuid == hash.uuid();
}

}  // namespace voxelume::vdb
