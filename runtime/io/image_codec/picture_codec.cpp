// SPDX-License-Identifier: Apache-2.0
// PNG and JPEG -> arrays, by the helper program.
#include "runtime/base/helper/memory_file.hpp"
#include "runtime/io/image_codec/image_question.hpp"

namespace voxelume {
namespace {

namespace fs = std::filesystem;

Picture receive_picture(ImageQuestion& asked, uint64_t max_pixels, const PictureRoom& room) {
    asked.expect(ImageAnswer::begin);
    WireReceiver& receiver = asked.receiver();
    Picture picture{int(receiver.value<int32_t>()), int(receiver.value<int32_t>()), {}};
    const uint64_t pixels = uint64_t(picture.width) * uint64_t(picture.height);
    if (picture.width <= 0 || picture.height <= 0 || pixels > max_pixels) WireReceiver::fail();
    room(picture.width, picture.height);
    asked.expect(ImageAnswer::end);
    picture.pixels.resize(pixels);
    receiver.fill(std::span(picture.pixels));
    return picture;
}

Picture ask_picture(PictureKind kind, const fs::path& name, int input, uint64_t bytes,
                    uint64_t max_pixels, const PictureRoom& room) {
    return ask_image(
        name, input, {kind == PictureKind::png ? "png" : "jpeg", std::to_string(max_pixels)},
        image_limits(bytes, 4 * max_pixels, 0),
        [&](ImageQuestion& asked) { return receive_picture(asked, max_pixels, room); });
}

/// Fills a file of several pictures, see pictures_limits. Returns its bytes.
template <class Pictures>
uint64_t put_pictures(const MemoryFile& file, const Pictures& pictures) {
    std::vector<uint64_t> table = {pictures.size()};
    for (const auto& picture : pictures) table.push_back(picture.size());
    uint64_t bytes = table.size() * sizeof(uint64_t);
    file.append(table.data(), bytes);
    for (const auto& picture : pictures) {
        file.append(picture.data(), picture.size());
        bytes += picture.size();
    }
    return bytes;
}

}  // namespace

Picture ask_picture(PictureKind kind, const InputFile& file, uint64_t max_pixels,
                    const PictureRoom& room) {
    return ask_picture(kind, file.path(), file.descriptor(), file.size(), max_pixels, room);
}

Picture ask_picture(PictureKind kind, std::span<const uint8_t> bytes, const fs::path& name,
                    uint64_t max_pixels, const PictureRoom& room) {
    const MemoryFile file("a picture");
    file.append(bytes.data(), bytes.size());
    return ask_picture(kind, name, file.descriptor(), bytes.size(), max_pixels, room);
}

std::vector<Picture> ask_pngs(std::span<const std::span<const uint8_t>> pictures,
                              const fs::path& name, uint64_t max_pixels) {
    const MemoryFile file("pictures");
    const uint64_t bytes = put_pictures(file, pictures);
    return ask_image(name, file.descriptor(), {"pngs", std::to_string(max_pixels)},
                     pictures_limits(bytes, pictures.size(), max_pixels),
                     [&](ImageQuestion& asked) {
                         std::vector<Picture> decoded;
                         decoded.reserve(pictures.size());
                         for (size_t i = 0; i < pictures.size(); ++i)
                             decoded.push_back(receive_picture(asked, max_pixels, [](int, int) {}));
                         return decoded;
                     });
}

PngShape ask_png_shape(const InputFile& file) {
    const HelperLimits limits = image_limits(file.size(), 4 * kMaxSlicePixels, 0);
    return ask_image(
        file.path(), file.descriptor(), {"png-shape"}, limits, [](ImageQuestion& asked) {
            asked.expect(ImageAnswer::end);
            const auto shape = asked.receiver().value<PngShape>();
            if (shape.width <= 0 || shape.height <= 0 || (shape.bits != 8 && shape.bits != 16) ||
                shape.channels < 1 || shape.channels > 4)
                WireReceiver::fail();
            return shape;
        });
}

std::vector<std::byte> ask_png_values(std::span<const std::vector<uint8_t>> pngs,
                                      std::span<const fs::path> names, const PngShape& shape) {
    const MemoryFile file("slices");
    const uint64_t bytes = put_pictures(file, pngs);
    std::vector<std::string> question = {"png-values"};
    for (const int number : {shape.width, shape.height, shape.bits, shape.channels})
        question.push_back(std::to_string(number));
    std::vector<std::byte> values(shape.bytes() * pngs.size());
    size_t done = 0;
    const auto receive = [&](ImageQuestion& asked) {
        for (; done < pngs.size(); ++done) {
            asked.expect(ImageAnswer::end);
            asked.receiver().fill(std::span(values).subspan(done * shape.bytes(), shape.bytes()));
        }
    };
    try {
        ask_image(names.front(), file.descriptor(), question,
                  pictures_limits(bytes, pngs.size(), shape.bytes()), receive);
    } catch (const ImageDecoderError&) {
        throw;
    } catch (const Error&) {
        if (done == 0) throw;
        ask_png_values(pngs.subspan(done, 1), names.subspan(done, 1),
                       shape);  // throws with its name
        throw;
    }
    return values;
}

}  // namespace voxelume
