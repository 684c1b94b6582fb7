// SPDX-License-Identifier: Apache-2.0
#include "runtime/base/files/stamp.hpp"

#include <fcntl.h>
#include <fmt/format.h>
#include <sys/stat.h>
#include <unistd.h>
#include <xxhash.h>

#include <algorithm>
#include <array>
#include <cerrno>
#include <cstring>
#include <memory>
#include <optional>
#include <system_error>
#include <utility>

namespace voxelume {
namespace {

constexpr std::string_view kStampBegin = "voxelume-frame=", kStampMiddle = " check=";
constexpr size_t kHashDigits = 32, kCheckDigits = kStampCheckDigits;
constexpr size_t kStampLength =
    kStampBegin.size() + kHashDigits + kStampMiddle.size() + kCheckDigits;
constexpr std::string_view kPngStart = "\x89PNG\r\n\x1a\n";
constexpr std::string_view kTextChunk = "tEXt";

/// The CRC-32 of PNG's chunks, bit by bit: its input is about a hundred bytes.
uint32_t crc_of(std::string_view bytes) {
    uint32_t sum = ~0u;
    for (const char byte : bytes) {
        sum ^= static_cast<unsigned char>(byte);
        for (int bit = 0; bit < 8; ++bit) sum = (sum & 1) ? (sum >> 1) ^ 0xedb88320u : sum >> 1;
    }
    return ~sum;
}

/// The position of a stamp's check, and the number of bytes from there on that no hash covers.
struct StampOffsets {
    size_t hash = 0, check = 0;
    size_t blank = kCheckDigits;
    std::optional<size_t> chunk;  ///< in a PNG: start of the type of the text's chunk
};

bool is_hex(std::string_view text) {
    return text.find_first_not_of("0123456789abcdef") == text.npos;
}

std::optional<StampOffsets> find_stamp(std::string_view header) {
    const size_t begin = header.find(kStampBegin);
    if (begin == header.npos || begin + kStampLength > header.size()) return {};
    const size_t hash = begin + kStampBegin.size(), middle = hash + kHashDigits;
    const size_t check = middle + kStampMiddle.size();
    if (header.substr(middle, kStampMiddle.size()) != kStampMiddle ||
        !is_hex(header.substr(hash, kHashDigits)) || !is_hex(header.substr(check, kCheckDigits)))
        return {};
    StampOffsets offsets{hash, check, kCheckDigits, {}};
    if (!header.starts_with(kPngStart)) return offsets;
    // The text is the end of its chunk, whose checksum of four bytes follows.
    offsets.blank += 4;
    offsets.chunk = header.rfind(kTextChunk, begin);
    if (*offsets.chunk == header.npos || check + offsets.blank > header.size()) return {};
    return offsets;
}

/// The hash of bytes that arrive one after another, with zeros in the place of some.
class StampHasher {
  public:
    StampHasher() : state_(XXH3_createState(), &XXH3_freeState) { XXH3_64bits_reset(state_.get()); }

    void add(std::string_view bytes) {
        XXH3_64bits_update(state_.get(), bytes.data(), bytes.size());
    }
    std::string digits() const { return fmt::format("{:016x}", XXH3_64bits_digest(state_.get())); }

  private:
    std::unique_ptr<XXH3_state_t, decltype(&XXH3_freeState)> state_;
};

/// The first bytes of a file, and the rest in pieces.
class StampReader {
  public:
    StampReader(uint64_t size, ReadBytes read) : size_(size), read_(std::move(read)) {}

    /// Fewer bytes than `count` are the last ones.
    std::string next(size_t count) {
        std::string bytes(size_t(std::min<uint64_t>(count, size_ - position_)), '\0');
        if (!bytes.empty()) read_(position_, bytes.data(), bytes.size());
        position_ += bytes.size();
        return bytes;
    }

  private:
    uint64_t size_, position_ = 0;
    ReadBytes read_;
};

/// The check of a file whose first bytes are `header`.
std::string check_of(std::string header, const StampOffsets& offsets, StampReader& rest) {
    std::memset(&header[offsets.check], 0, offsets.blank);
    StampHasher hasher;
    hasher.add(header);
    for (std::string block; !(block = rest.next(kStampHeader)).empty();) hasher.add(block);
    return hasher.digits();
}

/// Puts the check, and the checksum of a PNG's chunk, into the header.
void put_check(std::string& header, const StampOffsets& offsets, const std::string& digits) {
    header.replace(offsets.check, kCheckDigits, digits);
    if (!offsets.chunk) return;
    const size_t end = offsets.check + kCheckDigits;
    const uint32_t sum =
        crc_of(std::string_view(header).substr(*offsets.chunk, end - *offsets.chunk));
    for (size_t i = 0; i < 4; ++i) header[end + i] = char(sum >> (24 - 8 * i));
}

void read_at(int descriptor, uint64_t position, char* data, size_t size) {
    while (size > 0) {
        const ssize_t now = pread(descriptor, data, size, off_t(position));
        if (now < 0 && errno == EINTR) continue;
        if (now <= 0) throw std::system_error(now < 0 ? errno : EIO, std::generic_category());
        data += now, size -= size_t(now), position += uint64_t(now);
    }
}

/// A file to read, and the stamp near its start.
class StampedFile {
  public:
    explicit StampedFile(const std::filesystem::path& path)
        : descriptor_(open(path.c_str(), O_RDONLY | O_CLOEXEC | O_NONBLOCK)),
          is_missing_(descriptor_ < 0 && errno == ENOENT) {
        struct stat status {};
        if (descriptor_ < 0 || fstat(descriptor_, &status) != 0 || !S_ISREG(status.st_mode)) return;
        rest_ = StampReader(uint64_t(status.st_size), [this](uint64_t at, char* data, size_t size) {
            read_at(descriptor_, at, data, size);
        });
        try {
            header_ = rest_->next(kStampHeader);
            offsets_ = find_stamp(header_);
        } catch (const std::system_error&) {
            return;  // it counts as a file without a stamp
        }
    }
    ~StampedFile() {
        if (descriptor_ >= 0) close(descriptor_);
    }
    StampedFile(const StampedFile&) = delete;
    StampedFile& operator=(const StampedFile&) = delete;

    bool is_missing() const { return is_missing_; }
    bool has_stamp() const { return offsets_.has_value(); }
    std::string_view hash() const {
        return std::string_view(header_).substr(offsets_->hash, kHashDigits);
    }
    /// Reads all of the file, once.
    bool is_whole() try {
        std::string sealed = header_;
        put_check(sealed, *offsets_, check_of(header_, *offsets_, *rest_));
        return sealed == header_;
    } catch (const std::system_error&) {
        return false;
    }

  private:
    int descriptor_;
    bool is_missing_;
    std::optional<StampReader> rest_;
    std::string header_;
    std::optional<StampOffsets> offsets_;
};

}  // namespace

std::string stamp_of(std::string_view hash) {
    return fmt::format("{}{}{}{:016x}", kStampBegin, hash, kStampMiddle, 0);
}

std::optional<size_t> stamp_check_offset(std::string_view header) {
    const std::optional<StampOffsets> offsets = find_stamp(header.substr(0, kStampHeader));
    return offsets ? std::optional(offsets->check) : std::nullopt;
}

bool seal(std::string& bytes) {
    const std::optional<StampOffsets> offsets =
        find_stamp(std::string_view(bytes).substr(0, kStampHeader));
    if (!offsets) return false;
    std::string blank = bytes;
    std::memset(&blank[offsets->check], 0, offsets->blank);
    StampHasher hasher;
    hasher.add(blank);
    put_check(bytes, *offsets, hasher.digits());
    return true;
}

std::optional<StampSeal> seal_of(uint64_t size, const ReadBytes& read) {
    StampReader reader(size, read);
    std::string header = reader.next(kStampHeader);
    const std::optional<StampOffsets> offsets = find_stamp(header);
    if (!offsets) return {};
    put_check(header, *offsets, check_of(header, *offsets, reader));
    return StampSeal{offsets->check, header.substr(offsets->check, offsets->blank)};
}

StampState check_stamp(const std::filesystem::path& file, std::string_view hash) {
    StampedFile stamped(file);
    if (stamped.is_missing()) return StampState::missing;
    if (!stamped.has_stamp()) return StampState::damaged;
    if (stamped.hash() != hash) return StampState::stale;
    return stamped.is_whole() ? StampState::current : StampState::damaged;
}

std::optional<bool> is_as_written(const std::filesystem::path& file) {
    StampedFile stamped(file);
    return stamped.has_stamp() ? std::optional(stamped.is_whole()) : std::nullopt;
}

}  // namespace voxelume
