// SPDX-License-Identifier: Apache-2.0
#include "runtime/io/image_codec/image_question.hpp"

#include "runtime/base/helper/helper_program.hpp"

namespace voxelume {
namespace {

ImageDecoding decoding;

std::filesystem::path decoder_program() {
    return decoding.program.empty() ? helper_program(kImageDecoderName) : decoding.program;
}

std::vector<std::string> words_to(const std::filesystem::path& name,
                                  const std::vector<std::string>& question) {
    std::vector<std::string> words = {VXL_VERSION, name.string()};
    words.insert(words.end(), question.begin(), question.end());
    return words;
}

}  // namespace

void decode_images(const ImageDecoding& how) {
    decoding = how;
}

bool decodes_apart() {
    return decoding.is_apart;
}

ImageQuestion::ImageQuestion(const std::filesystem::path& name, int input,
                             const std::vector<std::string>& question, const HelperLimits& limits)
    : name_(name),
      helper_(decoder_program(), words_to(name, question), input,
              decoding.seconds > 0 ? decoding.seconds : seconds_to_wait(limits)),
      receiver_(helper_) {}

ImageAnswer ImageQuestion::next() {
    const auto answer = receiver_.value<ImageAnswer>();
    if (answer != ImageAnswer::refusal) return answer;
    const bool is_limit = receiver_.value<uint32_t>() == uint32_t(ErrorKind::limit);
    throw Error(SourcePlace(name_.string()), is_limit ? ErrorKind::limit : ErrorKind::input,
                receiver_.text(kMaxImageText));
}

void fail_to_ask(const std::filesystem::path& name, const HelperFailure& failure) {
    using Cause = HelperFailure::Cause;
    const SourcePlace place(name.string());
    if (failure.cause() == Cause::missing || failure.cause() == Cause::killed)
        throw ImageDecoderError(ErrorKind::input, "{}: can't be read: {}", place, failure.what());
    throw ImageDecoderError(
        ErrorKind::input, "{}: can't be decoded: {}, so it is {}; use another copy of it", place,
        failure.what(), failure.cause() == Cause::too_long ? "too large or damaged" : "damaged");
}

}  // namespace voxelume
