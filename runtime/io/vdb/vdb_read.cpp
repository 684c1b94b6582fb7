// SPDX-License-Identifier: Apache-2.0
#include "runtime/io/vdb/vdb_read.hpp"

#include <openvdb/io/Stream.h>

#include <algorithm>
#include <array>
#include <istream>
#include <streambuf>

namespace voxelume::vdb {
namespace {

/// The bytes of a file that is open already. Past its end there is nothing, not zeros as in
/// OpenVDB's own file class.
class FileBuffer : public std::streambuf {
  public:
    explicit FileBuffer(const InputFile& file) : file_(file) {}

  protected:
    int_type underflow() override {
        const uint64_t position = current();
        if (position >= file_.size()) return traits_type::eof();
        fill(position);
        return traits_type::to_int_type(*gptr());
    }
    std::streamsize xsgetn(char* target, std::streamsize size) override {
        std::streamsize done = 0;
        while (done < size) {
            const uint64_t position = current(), left = file_.size() - position;
            if (gptr() == egptr() && left == 0) return done;
            const auto wanted = uint64_t(size - done);
            if (gptr() == egptr() && wanted >= block_.size()) {
                const uint64_t length = std::min(wanted, left);
                file_.read(position, target + done, length);
                forget(position + length);
                done += std::streamsize(length);
                continue;
            }
            if (gptr() == egptr()) fill(position);
            const auto length = std::min<std::streamsize>(size - done, egptr() - gptr());
            std::copy_n(gptr(), length, target + done);
            gbump(int(length));
            done += length;
        }
        return done;
    }
    pos_type seekoff(off_type offset, std::ios_base::seekdir from,
                     std::ios_base::openmode) override {
        uint64_t base = 0;
        if (from == std::ios_base::cur) base = current();
        if (from == std::ios_base::end) base = file_.size();
        const int64_t position = int64_t(base) + offset;
        if (position < 0 || uint64_t(position) > file_.size()) return pos_type(off_type(-1));
        if (uint64_t(position) != current()) forget(uint64_t(position));
        return position;
    }
    pos_type seekpos(pos_type position, std::ios_base::openmode mode) override {
        return seekoff(off_type(position), std::ios_base::beg, mode);
    }

  private:
    /// The position in the file of the next byte.
    uint64_t current() const { return end_ - uint64_t(egptr() - gptr()); }
    void forget(uint64_t position) {
        setg(block_.data(), block_.data(), block_.data());
        end_ = position;
    }
    void fill(uint64_t position) {
        const size_t size = std::min<uint64_t>(block_.size(), file_.size() - position);
        file_.read(position, block_.data(), size);
        setg(block_.data(), block_.data(), block_.data() + size);
        end_ = position + size;
    }

    const InputFile& file_;
    uint64_t end_ = 0;  ///< position in the file of the end of the block
    std::array<char, 1 << 16> block_{};
};

VdbContent read_stream(const InputFile& file) {
    FileBuffer buffer(file);
    std::istream stream(&buffer);
    stream.exceptions(std::ios::failbit | std::ios::badbit | std::ios::eofbit);
    openvdb::io::Stream content(stream, false);
    return {content.getGrids(), content.getMetadata()};
}

}  // namespace

VdbContent read_vdb_content(const InputFile& file) {
    std::string failure;
    try {
        openvdb::initialize();
        return read_stream(file);
    } catch (const std::ios_base::failure&) {
        failure = "it ends too early";
    } catch (const std::bad_alloc&) {
        failure = "it declares more than there is memory";
    } catch (const std::exception& error) {
        failure = *error.what() ? error.what() : "OpenVDB gives no reason";
    }
    file.refuse(fmt::format("not a readable OpenVDB file: {}", failure.substr(0, 400)));
}

}  // namespace voxelume::vdb
