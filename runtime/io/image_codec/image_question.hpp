// SPDX-License-Identifier: Apache-2.0
// A question to the helper program about an image, and its answer.
#pragma once

#include <string>
#include <vector>

#include "runtime/base/helper/helper_wire.hpp"
#include "runtime/io/image_codec/image_codec.hpp"
#include "runtime/io/image_codec/image_wire.hpp"

namespace voxelume {

inline constexpr uint64_t kMaxImageText = 1 << 16;

/// A helper that was started for a question, and the words of its answer. Its functions throw
/// HelperFailure.
class ImageQuestion {
  public:
    /// Asks about `input`, which messages call `name`, and waits for the answer as long as its
    /// limits say.
    ImageQuestion(const std::filesystem::path& name, int input,
                  const std::vector<std::string>& question, const HelperLimits& limits);

    WireReceiver& receiver() { return receiver_; }

    /// The next word. Throws the error of a refusal.
    ImageAnswer next();
    void expect(ImageAnswer wanted) {
        if (next() != wanted) WireReceiver::fail();
    }

  private:
    const std::filesystem::path& name_;
    HelperProcess helper_;
    WireReceiver receiver_;
};

/// Throws ImageDecoderError.
[[noreturn]] void fail_to_ask(const std::filesystem::path& name, const HelperFailure& failure);

/// The result of `receive` for a question, see ImageQuestion.
template <class Receive>
auto ask_image(const std::filesystem::path& name, int input,
               const std::vector<std::string>& question, const HelperLimits& limits,
               const Receive& receive) {
    try {
        ImageQuestion asked(name, input, question, limits);
        return receive(asked);
    } catch (const HelperFailure& failure) {
        fail_to_ask(name, failure);
    }
}

}  // namespace voxelume
