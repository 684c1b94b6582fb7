// SPDX-License-Identifier: Apache-2.0
#include "runtime/io/image_codec/image_codec.hpp"

#include <ImfThreading.h>

#include <iterator>
#include <utility>

#include "runtime/io/image_codec/image_question.hpp"

namespace voxelume {
namespace {

constexpr uint64_t kMaxChannels = 1 << 20;

uint64_t thread_count() {
    return uint64_t(Imf::globalThreadCount());
}

ExrHeader receive_header(WireReceiver& receiver) {
    ExrHeader header;
    header.width = int(receiver.value<int32_t>());
    header.height = int(receiver.value<int32_t>());
    header.layout = receiver.text(kMaxImageText);
    header.compression = receiver.text(kMaxImageText);
    header.channels = receiver.texts();
    header.attributes = receiver.texts();
    for (uint64_t parts = receiver.count(kMaxChannels); parts > 0; --parts) {
        ExrPartHeader part{receiver.text(kMaxImageText), {}, receiver.value<uint32_t>() != 0};
        for (uint64_t channels = receiver.count(kMaxChannels); channels > 0; --channels)
            part.channels.push_back(receiver.text(kMaxImageText));
        header.parts.push_back(std::move(part));
    }
    if (header.width <= 0 || header.height <= 0) WireReceiver::fail();
    return header;
}

/// Receives the next rows of one of the header's channels, and returns how many. `next` has the
/// number of each channel's next row.
uint64_t receive_rows(WireReceiver& receiver, const ExrHeader& header, std::vector<int>& next,
                      ExrSink& sink) {
    const auto channel = receiver.value<uint32_t>();
    const auto first = receiver.value<int32_t>(), count = receiver.value<int32_t>();
    if (channel >= next.size() || first != next[channel] || count <= 0 ||
        count > header.height - first)
        WireReceiver::fail();
    next[channel] += count;
    const std::string& name = std::next(header.channels.begin(), channel)->first;
    auto* const values = static_cast<uint32_t*>(sink.room(name, first, count));
    receiver.fill(std::span(values, size_t(header.width) * size_t(count)));
    sink.take_rows();
    return uint64_t(count);
}

/// What is left of an image when its rows are there.
Image receive_rest(WireReceiver& receiver, const ExrHeader& header) {
    Image image;
    image.width = header.width;
    image.height = header.height;
    image.first = receiver.value<glm::ivec2>();
    image.frame = receiver.value<glm::ivec2>();
    image.attributes = receiver.texts();
    return image;
}

/// Receives an image from its header on.
Image receive_image(const InputFile& file, ImageQuestion& asked, ExrSink& sink) {
    asked.expect(ImageAnswer::begin);
    const ExrHeader header = receive_header(asked.receiver());
    check_exr_size(file, header);
    sink.begin(header);
    uint64_t left = header.channels.size() * uint64_t(header.height);
    std::vector<int> next(header.channels.size());
    for (ImageAnswer answer = asked.next(); answer == ImageAnswer::rows; answer = asked.next()) {
        const uint64_t count = receive_rows(asked.receiver(), header, next, sink);
        if (count > left) WireReceiver::fail();
        left -= count;
        if (left == 0) break;
    }
    if (left > 0) WireReceiver::fail();
    asked.expect(ImageAnswer::end);
    return receive_rest(asked.receiver(), header);
}

DeepExrRow receive_deep_row(WireReceiver& receiver, size_t width, uint32_t max_samples) {
    DeepExrRow row;
    row.counts = receiver.values<uint32_t>(width);
    for (const uint32_t count : row.counts)
        if (count > max_samples) WireReceiver::fail();
    const uint64_t samples = row.samples();
    bool is_right = row.counts.size() == width;
    for (auto& values : row.floats)
        is_right &= (values = receiver.values<float>(samples)).size() == samples;
    for (auto& values : row.ids)
        is_right &= (values = receiver.values<uint32_t>(samples)).size() == samples;
    if (!is_right) WireReceiver::fail();
    return row;
}

}  // namespace

ExrHeader ask_exr_header(const InputFile& file) {
    const HelperLimits limits = exr_limits(file.size(), check_exr_header(file), 0);
    return ask_image(file.path(), file.descriptor(), {"exr-header"}, limits,
                     [](ImageQuestion& asked) {
                         asked.expect(ImageAnswer::end);
                         return receive_header(asked.receiver());
                     });
}

Image ask_exr(const InputFile& file, ExrSink& sink) {
    const ExrExtent extent = check_exr_header(file);
    const uint64_t threads = exr_threads(file.size(), extent, thread_count());
    const HelperLimits limits = exr_limits(file.size(), extent, threads);
    return ask_image(file.path(), file.descriptor(), {"exr", std::to_string(threads)}, limits,
                     [&](ImageQuestion& asked) { return receive_image(file, asked, sink); });
}

DeepExrHeader ask_deep_exr_header(const InputFile& file) {
    const HelperLimits limits = deep_exr_limits(file.size(), check_exr_header(file), 0, 0);
    return ask_image(
        file.path(), file.descriptor(), {"deep-exr-header"}, limits, [](ImageQuestion& asked) {
            asked.expect(ImageAnswer::end);
            WireReceiver& receiver = asked.receiver();
            DeepExrHeader header;
            header.first = receiver.value<glm::ivec2>();
            header.size = receiver.value<glm::ivec2>();
            for (uint64_t channels = receiver.count(kMaxChannels); channels > 0; --channels)
                header.channels.insert(receiver.text(kMaxImageText));
            header.texts = receiver.texts();
            return header;
        });
}

void ask_deep_exr(const InputFile& file, glm::ivec2 size, uint32_t max_samples,
                  const TakeDeepExrRow& take) {
    const uint64_t threads = thread_count();
    const HelperLimits limits =
        deep_exr_limits(file.size(), check_exr_header(file), max_samples, threads);
    ask_image(file.path(), file.descriptor(),
              {"deep-exr", std::to_string(threads), std::to_string(max_samples)}, limits,
              [&](ImageQuestion& asked) {
                  for (int y = 0; y < size.y; ++y) {
                      asked.expect(ImageAnswer::rows);
                      take(y, receive_deep_row(asked.receiver(), size_t(size.x), max_samples));
                  }
                  asked.expect(ImageAnswer::end);
              });
}

}  // namespace voxelume
