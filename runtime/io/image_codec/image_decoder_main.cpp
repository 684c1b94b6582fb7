// SPDX-License-Identifier: Apache-2.0
// The program voxelume-image-decoder: decodes one image for image_codec.cpp, under limits of its
// own. What a damaged file does to its memory stays here.
#include <ImfThreading.h>
#include <fmt/format.h>
#include <malloc.h>
#include <pthread.h>
#include <unistd.h>

#include <algorithm>
#include <cstdlib>
#include <cstring>
#include <iterator>
#include <new>
#include <string_view>

#include "runtime/base/helper/helper_calls.hpp"
#include "runtime/base/helper/helper_wire.hpp"
#include "runtime/io/image_codec/image_codec.hpp"
#include "runtime/io/image_codec/image_wire.hpp"
#include "runtime/io/image_codec/picture_size.hpp"

namespace voxelume {
namespace {

void send_header(WireSender& sender, const ExrHeader& header) {
    sender.value(int32_t{header.width});
    sender.value(int32_t{header.height});
    sender.text(header.layout);
    sender.text(header.compression);
    sender.texts(header.channels);
    sender.texts(header.attributes);
    sender.value(uint64_t{header.parts.size()});
    for (const ExrPartHeader& part : header.parts) {
        sender.text(part.name);
        sender.value(uint32_t{part.is_read});
        sender.value(uint64_t{part.channels.size()});
        for (const std::string& channel : part.channels) sender.text(channel);
    }
}

/// Sends an image's header, and its rows while others are decoded.
class SentRows : public ExrSink {
  public:
    explicit SentRows(WireSender& sender) : sender_(sender) {}

    void begin(const ExrHeader& header) override {
        sender_.value(ImageAnswer::begin);
        send_header(sender_, header);
        sender_.flush();  // memory may have no room for it there
        channels_ = header.channels;
        width_ = size_t(header.width);
    }
    int rows_at_once() const override { return 256; }  // the most in a chunk
    void* room(const std::string& channel, int first, int count) override {
        const auto found = channels_.find(channel);
        rows_.push_back({uint32_t(std::distance(channels_.begin(), found)), first, count, {}});
        rows_.back().values.resize(width_ * size_t(count));
        return rows_.back().values.data();
    }
    void take_rows() override {
        for (const Rows& rows : rows_) {
            sender_.value(ImageAnswer::rows);
            sender_.value(rows.channel);
            sender_.value(int32_t{rows.first});
            sender_.value(int32_t{rows.count});
            sender_.values(rows.values);
        }
        rows_.clear();
    }

  private:
    struct Rows {
        uint32_t channel;
        int first, count;
        std::vector<uint32_t> values;  ///< or floats
    };
    WireSender& sender_;
    std::map<std::string, std::string> channels_;
    size_t width_ = 0;
    std::vector<Rows> rows_;
};

void send_image(WireSender& sender, const InputFile& file) {
    SentRows rows(sender);
    const Image image = decode_exr(file, rows);
    sender.value(ImageAnswer::end);
    sender.value(image.first);
    sender.value(image.frame);
    sender.texts(image.attributes);
}

void send_deep_header(WireSender& sender, const InputFile& file) {
    const DeepExrHeader header = decode_deep_exr_header(file);
    sender.value(ImageAnswer::end);
    sender.value(header.first);
    sender.value(header.size);
    sender.value(uint64_t{header.channels.size()});
    for (const std::string& channel : header.channels) sender.text(channel);
    sender.texts(header.texts);
}

void send_deep_rows(WireSender& sender, const InputFile& file, uint32_t max_samples) {
    decode_deep_exr(file, max_samples, [&](int, const DeepExrRow& row) {
        sender.value(ImageAnswer::rows);
        sender.values(row.counts);
        for (const auto& values : row.floats) sender.values(values);
        for (const auto& values : row.ids) sender.values(values);
    });
    sender.value(ImageAnswer::end);
}

/// The sizes of the pictures in a file of several.
std::vector<uint64_t> picture_table(std::span<const uint8_t> bytes) {
    uint64_t count = 0;
    std::memcpy(&count, bytes.data(), sizeof count);
    std::vector<uint64_t> sizes(count);
    std::memcpy(sizes.data(), bytes.data() + sizeof count, count * sizeof count);
    return sizes;
}

void send_picture(WireSender& sender, const InputFile& file, std::span<const uint8_t> bytes,
                  bool is_png, uint64_t max_pixels) {
    const auto begin = [&](int width, int height) {
        sender.value(ImageAnswer::begin);
        sender.value(int32_t{width});
        sender.value(int32_t{height});
        sender.flush();  // memory may have no room for it there
    };
    Picture picture;
    if (is_png) {
        picture = decode_png(bytes, file.path(), max_pixels, begin);
    } else {
        picture = decode_jpeg(bytes, file.path());
        begin(picture.width, picture.height);
    }
    sender.value(ImageAnswer::end);
    sender.values(picture.pixels);
}

/// Calls `send` for each picture in a file of several.
template <class Send>
void for_pictures(std::span<const uint8_t> bytes, const Send& send) {
    const std::vector<uint64_t> table = picture_table(bytes);
    uint64_t first = (1 + table.size()) * sizeof(uint64_t);
    for (const uint64_t size : table) {
        send(bytes.subspan(first, size));
        first += size;
    }
}

void send_png_values(WireSender& sender, const InputFile& file, std::span<const uint8_t> bytes,
                     const PngShape& shape) {
    for_pictures(bytes, [&](std::span<const uint8_t> png) {
        const std::vector<std::byte> values = decode_png_values(png, file.path(), shape);
        sender.value(ImageAnswer::end);
        sender.values(values);
    });
}

/// What follows the name of the file in the arguments.
struct Words {
    std::string_view question;
    std::vector<uint64_t> numbers;

    uint64_t number(size_t i) const { return i < numbers.size() ? numbers[i] : 0; }
    bool is_of_exr() const { return question.find("exr") != question.npos; }
};

Words words_of(int count, char** arguments) {
    Words words{arguments[3], {}};
    for (int i = 4; i < count; ++i)
        words.numbers.push_back(std::strtoull(arguments[i], nullptr, 10));
    return words;
}

/// Has no library look at the file.
HelperLimits limits_for(const Words& words, const InputFile& file, std::span<const uint8_t> bytes) {
    if (words.question == "pngs" || words.question == "png-values") {
        const bool has_shape = words.question == "png-values";
        const uint64_t pixels = has_shape ? words.number(0) * words.number(1) : words.number(0);
        return pictures_limits(file.size(), picture_table(bytes).size(), pixels);
    }
    if (!words.is_of_exr()) {
        // No PNG or JPEG has more pixels for a byte, and none with more pixels is read.
        const uint64_t pixels =
            std::min({declared_pixels(bytes), 8 * 1032 * file.size(), uint64_t{1} << 28});
        return image_limits(file.size(), 4 * pixels, 0);
    }
    const ExrExtent extent = check_exr_header(file);
    if (words.question.starts_with("deep"))
        return deep_exr_limits(file.size(), extent, words.number(1), words.number(0));
    return exr_limits(file.size(), extent, words.number(0));
}

void answer(WireSender& sender, const Words& words, const InputFile& file,
            std::span<const uint8_t> bytes) {
    if (words.question == "exr-header") {
        const ExrHeader header = decode_exr_header(file);
        sender.value(ImageAnswer::end);
        send_header(sender, header);
    } else if (words.question == "exr") {
        send_image(sender, file);
    } else if (words.question == "deep-exr-header") {
        send_deep_header(sender, file);
    } else if (words.question == "deep-exr") {
        send_deep_rows(sender, file, uint32_t(words.number(1)));
    } else if (words.question == "png-shape") {
        const PngShape shape = decode_png_shape(bytes, file.path());
        sender.value(ImageAnswer::end);
        sender.value(shape);
    } else if (words.question == "png-values") {
        send_png_values(sender, file, bytes,
                        {int(words.number(0)), int(words.number(1)), int(words.number(2)),
                         int(words.number(3))});
    } else if (words.question == "pngs") {
        for_pictures(bytes, [&](std::span<const uint8_t> png) {
            send_picture(sender, file, png, true, words.number(0));
        });
    } else {
        send_picture(sender, file, bytes, words.question == "png", words.number(0));
    }
}

void refuse(WireSender& sender, ErrorKind kind, const std::string& sentence) {
    sender.value(ImageAnswer::refusal);
    sender.value(uint32_t(kind));
    sender.text(sentence);
}

/// Threads have stacks as large as the user's limit for stacks, which may take all of the address
/// space.
void limit_stacks() {
    pthread_attr_t attributes;
    if (pthread_attr_init(&attributes) != 0) return;
    if (pthread_attr_setstacksize(&attributes, size_t{8} << 20) == 0)
        pthread_setattr_default_np(&attributes);
    pthread_attr_destroy(&attributes);
}

/// Answers the question in the arguments and ends the process. Returns an exit code if it is
/// another version's, or if the limits can't be set.
int serve(int count, char** arguments) {
    if (count < 4 || std::strcmp(arguments[1], VXL_VERSION) != 0) return 2;
    const Words words = words_of(count, arguments);
    WireSender sender(kHelperAnswer);
    try {
        const InputFile file(arguments[2], kHelperInput);
        std::vector<uint8_t> bytes;
        if (!words.is_of_exr()) bytes = file.bytes();
        mallopt(M_ARENA_MAX, 2);  // one for each thread would take all of the address space
        limit_stacks();
        if (!limit_helper(limits_for(words, file, bytes))) return 3;
        forbid_system_calls();
        if (words.is_of_exr()) Imf::setGlobalThreadCount(int(words.number(0)));
        answer(sender, words, file, bytes);
    } catch (const Error& error) {
        refuse(sender, error.kind(), error.what());
    } catch (const std::bad_alloc&) {
        refuse(sender, ErrorKind::input,
               fmt::format("{}: decoding it takes more memory than what it declares should take; "
                           "it is damaged or unusual",
                           arguments[2]));
    } catch (const std::exception& error) {
        refuse(sender, ErrorKind::input,
               fmt::format("{}: can't be decoded: {}", arguments[2],
                           std::string(error.what()).substr(0, 400)));
    }
    sender.flush();
    _exit(0);  // skips destructors: the heap may be damaged
}

}  // namespace
}  // namespace voxelume

int main(int count, char** arguments) {
    return voxelume::serve(count, arguments);
}
