// SPDX-License-Identifier: Apache-2.0
// A libFuzzer target: any .vxm gives a valid model or an error's sentence. An input that begins
// with a zero is a file whose directory gets the right checksum. Any other input is the file's
// content, so that what checksums hold off is tried, too: a number of header entries, each a key
// and a value, and a number of arrays, each a name, a type, a number of elements and these.
#include <xxhash.h>

#include <algorithm>
#include <cstring>

#include "runtime/assets/voxel_model_file.hpp"
#include "runtime/io/voxels/model_file.hpp"
#include "runtime/io/voxels/model_format.hpp"
#include "tests/fuzz/fuzz_file.hpp"
#include "tests/fuzz/refusals.hpp"
#include "tests/support/voxel_invariants.hpp"

namespace {

using namespace voxelume;

/// Takes what an input says, and zeros behind its end.
class Input {
  public:
    explicit Input(std::span<const uint8_t> bytes) : bytes_(bytes) {}

    std::span<const uint8_t> take(size_t count) {
        const auto taken = bytes_.first(std::min(count, bytes_.size()));
        bytes_ = bytes_.subspan(taken.size());
        return taken;
    }
    template <class Number>
    Number number() {
        Number number = 0;
        const auto bytes = take(sizeof number);
        if (!bytes.empty()) std::memcpy(&number, bytes.data(), bytes.size());
        return number;
    }
    std::string text() {
        const auto bytes = take(number<uint8_t>());
        return {bytes.begin(), bytes.end()};
    }
    template <class Element>
    std::vector<Element> elements(size_t count) {
        const auto bytes = take(count * sizeof(Element));
        std::vector<Element> values(bytes.size() / sizeof(Element));
        if (!values.empty())
            std::memcpy(values.data(), bytes.data(), values.size() * sizeof(Element));
        return values;
    }

  private:
    std::span<const uint8_t> bytes_;
};

ModelArray array_of(Input& input) {
    const uint8_t type = input.number<uint8_t>();
    const size_t count = input.number<uint16_t>();
    switch (ElementType(type % 5)) {
        case ElementType::u8:
            return input.elements<uint8_t>(count);
        case ElementType::i16:
            return input.elements<int16_t>(count);
        case ElementType::u32:
            return input.elements<uint32_t>(count);
        case ElementType::u64:
            return input.elements<uint64_t>(count);
        case ElementType::f32:
            break;
    }
    return input.elements<float>(count);
}

ModelFile content_of(Input input) {
    ModelFile content;
    for (int left = input.number<uint8_t>(); left > 0; --left) {
        const std::string key = input.text();
        content.header[key] = input.text();
    }
    for (int left = input.number<uint8_t>(); left > 0; --left) {
        const std::string name = input.text();
        content.arrays[name] = array_of(input);
    }
    return content;
}

/// The bytes of a file, with the checksum that its directory has.
std::vector<uint8_t> with_checksum(std::span<const uint8_t> bytes) {
    std::vector<uint8_t> file(bytes.begin(), bytes.end());
    model_format::Start start;
    if (file.size() < sizeof start) return file;
    std::memcpy(&start, file.data(), sizeof start);
    if (start.directory_bytes > file.size() - sizeof start) return file;
    std::vector<uint8_t> covered(file.begin(), file.begin() + model_format::kCheckedBytes);
    covered.insert(covered.end(), file.begin() + sizeof start,
                   file.begin() + sizeof start + ptrdiff_t(start.directory_bytes));
    start.checksum = XXH3_64bits(covered.data(), covered.size());
    std::memcpy(file.data(), &start, sizeof start);
    return file;
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const uint8_t* data, size_t size) {
    static const std::filesystem::path given = fuzz_file();
    static const std::filesystem::path made = given.parent_path() / "made.vxm";
    if (size == 0) return 0;
    const std::span<const uint8_t> bytes(data + 1, size - 1);
    const std::filesystem::path& file = data[0] == 0 ? given : made;
    if (data[0] == 0)
        write_bytes(file, with_checksum(bytes));
    else
        write_model_file(file, content_of(Input({data, size})));
    for (const Surface surface : {Surface::cubes, Surface::smooth, Surface::exact})
        check_refusal(file, [&] {
            const std::string broken = broken_invariant(read_voxel_model(file, surface));
            if (!broken.empty()) fail_fuzzing("invalid model", broken);
        });
    return 0;
}
