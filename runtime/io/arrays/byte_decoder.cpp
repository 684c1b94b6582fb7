// SPDX-License-Identifier: Apache-2.0
#include "runtime/io/arrays/byte_decoder.hpp"

#include <bzlib.h>
#include <zlib.h>

#include <algorithm>
#include <charconv>
#include <cstring>
#include <string>
#include <system_error>
#include <vector>

#include "runtime/base/text.hpp"

namespace voxelume {
namespace {

constexpr size_t kBlock = 1 << 17;
constexpr size_t kMaxPiece = size_t{1} << 30;  // the libraries count in 32 bits

/// A file's bytes, a block at a time.
class Blocks {
  public:
    Blocks(const InputFile& file, uint64_t start) : file_(file), position_(start) {}

    /// Up to `size` bytes; fewer at the file's end.
    size_t take(void* data, size_t size) {
        const uint64_t left = position_ < file_.size() ? file_.size() - position_ : 0;
        const size_t count = size_t(std::min<uint64_t>(size, left));
        file_.read(position_, data, count);
        position_ += count;
        return count;
    }
    const InputFile& file() const { return file_; }

  private:
    const InputFile& file_;
    uint64_t position_;
};

class PlainBytes : public ByteDecoder {
  public:
    PlainBytes(const InputFile& file, uint64_t start) : blocks_(file, start) {}
    size_t read_some(void* data, size_t size) override { return blocks_.take(data, size); }

  private:
    Blocks blocks_;
};

/// Members of a compressed file, one after the other. A codec wraps a library's stream.
template <class Codec>
class InflatedBytes : public ByteDecoder {
  public:
    InflatedBytes(const InputFile& file, uint64_t start) : blocks_(file, start), block_(kBlock) {
        if (!codec_.start()) file.refuse("its decompression doesn't start");
    }
    ~InflatedBytes() override { codec_.end(); }
    InflatedBytes(const InflatedBytes&) = delete;
    InflatedBytes& operator=(const InflatedBytes&) = delete;

    size_t read_some(void* data, size_t size) override {
        size_t done = 0;
        while (done < size) {
            const size_t piece = std::min(size - done, kMaxPiece);
            codec_.stream.next_out =
                reinterpret_cast<decltype(codec_.stream.next_out)>(static_cast<char*>(data) + done);
            codec_.stream.avail_out = unsigned(piece);
            const bool goes_on = inflate_block();
            done += piece - codec_.stream.avail_out;
            if (!goes_on) break;
        }
        return done;
    }

  private:
    /// Inflates into the stream's free output. Returns false at the end of the file.
    bool inflate_block() {
        auto& stream = codec_.stream;
        if (stream.avail_in == 0) {
            const size_t size = blocks_.take(block_.data(), block_.size());
            if (size == 0) return false;
            stream.next_in = reinterpret_cast<decltype(stream.next_in)>(block_.data());
            stream.avail_in = unsigned(size);
        }
        if (has_ended_) {
            // Another member may follow, perhaps after zeros that fill up a block.
            for (; stream.avail_in > 0 && *stream.next_in == 0; --stream.avail_in) ++stream.next_in;
            if (stream.avail_in == 0) return true;
            if (!codec_.restart()) damaged();
            has_ended_ = false;
        }
        if (!codec_.go_on(has_ended_)) damaged();
        return true;
    }
    [[noreturn]] void damaged() const { blocks_.file().refuse("its compressed data are damaged"); }

    Blocks blocks_;
    Codec codec_;
    bool has_ended_ = false;
    std::vector<char> block_;
};

struct Gzip {
    z_stream stream{};

    bool start() {
        constexpr int kGzipOrZlib = 15 + 32;
        return inflateInit2(&stream, kGzipOrZlib) == Z_OK;
    }
    bool restart() { return inflateReset(&stream) == Z_OK; }
    void end() { inflateEnd(&stream); }
    bool go_on(bool& has_ended) {
        const int code = inflate(&stream, Z_NO_FLUSH);
        has_ended = code == Z_STREAM_END;
        return code == Z_OK || has_ended;
    }
};

struct Bzip2 {
    bz_stream stream{};

    bool start() { return BZ2_bzDecompressInit(&stream, 0, 0) == BZ_OK; }
    bool restart() {
        bz_stream next{};
        next.next_in = stream.next_in;
        next.avail_in = stream.avail_in;
        next.next_out = stream.next_out;
        next.avail_out = stream.avail_out;
        BZ2_bzDecompressEnd(&stream);
        stream = next;
        return start();
    }
    void end() { BZ2_bzDecompressEnd(&stream); }
    bool go_on(bool& has_ended) {
        const int code = BZ2_bzDecompress(&stream);
        has_ended = code == BZ_STREAM_END;
        return code == BZ_OK || has_ended;
    }
};

/// Numbers separated by blanks or commas.
class TextValues : public ByteDecoder {
  public:
    TextValues(const InputFile& file, uint64_t start, CellType type)
        : blocks_(file, start), type_(type) {}

    /// `size` must be a multiple of a value's size.
    size_t read_some(void* data, size_t size) override {
        const size_t each = bytes_of(type_);
        size_t done = 0;
        for (; done + each <= size; done += each)
            if (!read_value(static_cast<char*>(data) + done)) break;
        return done;
    }

  private:
    static bool is_blank(char c) { return c == ' ' || c == ',' || (c >= '\t' && c <= '\r'); }

    /// The next word, which lies in `text_`; empty at the end of the file.
    std::string_view next_word() {
        constexpr size_t kLongest = 400;  // more than a double's digits
        while (true) {
            while (at_ < text_.size() && is_blank(text_[at_])) ++at_;
            size_t end = at_;
            while (end < text_.size() && !is_blank(text_[end])) ++end;
            if (end < text_.size() || has_ended_) {
                const size_t begin = std::exchange(at_, end);
                return std::string_view(text_).substr(begin, end - begin);
            }
            if (end - at_ > kLongest) refuse(std::string_view(text_).substr(at_, 20));
            text_.erase(0, at_);
            at_ = 0;
            const size_t kept = text_.size();
            text_.resize(kept + kBlock);
            text_.resize(kept + blocks_.take(text_.data() + kept, kBlock));
            has_ended_ = text_.size() == kept;
        }
    }

    bool read_value(char* value) {
        const std::string_view word = next_word();
        if (word.empty()) return false;
        switch (type_) {
            case CellType::boolean:
            case CellType::u8:
                return parse<uint8_t>(word, value);
            case CellType::i8:
                return parse<int8_t>(word, value);
            case CellType::u16:
                return parse<uint16_t>(word, value);
            case CellType::i16:
                return parse<int16_t>(word, value);
            case CellType::u32:
                return parse<uint32_t>(word, value);
            case CellType::i32:
                return parse<int32_t>(word, value);
            case CellType::u64:
                return parse<uint64_t>(word, value);
            case CellType::i64:
                return parse<int64_t>(word, value);
            case CellType::f32:
                return parse<float>(word, value);
            case CellType::f16:  // no text format has f16
                refuse(word);
            case CellType::f64:
                break;
        }
        return parse<double>(word, value);
    }

    template <class Value>
    bool parse(std::string_view word, char* value) const {
        Value number{};
        const std::string_view digits = word.starts_with('+') ? word.substr(1) : word;
        const auto [end, error] =
            std::from_chars(digits.data(), digits.data() + digits.size(), number);
        if (error != std::errc() || end != digits.data() + digits.size()) refuse(word);
        std::memcpy(value, &number, sizeof number);
        return true;
    }

    [[noreturn]] void refuse(std::string_view word) const {
        blocks_.file().refuse(fmt::format("{} among its data isn't a number of the type {}",
                                          quote(word), name_of(type_)));
    }

    Blocks blocks_;
    CellType type_;
    std::string text_;
    size_t at_ = 0;  ///< position of the first unread byte in `text_`
    bool has_ended_ = false;
};

}  // namespace

std::unique_ptr<ByteDecoder> byte_decoder(const InputFile& file, uint64_t start,
                                          DataEncoding encoding, CellType type) {
    switch (encoding) {
        case DataEncoding::gzip:
            return std::make_unique<InflatedBytes<Gzip>>(file, start);
        case DataEncoding::bzip2:
            return std::make_unique<InflatedBytes<Bzip2>>(file, start);
        case DataEncoding::text:
            return std::make_unique<TextValues>(file, start, type);
        case DataEncoding::raw:
            break;
    }
    return std::make_unique<PlainBytes>(file, start);
}

}  // namespace voxelume
