// SPDX-License-Identifier: Apache-2.0
#include "runtime/scene_file/scene_sequence.hpp"

#include "runtime/base/error.hpp"
#include "runtime/base/frame_path.hpp"

namespace voxelume {
namespace {

constexpr int kFarthestNumber = 1'000'000;

/// The value of a key "sequence".
struct Sequence {
    int first = 1, last = 1;  ///< numbers in the files' names
    int start = 1;            ///< frame that shows the first file
    bool loop = false;        ///< the first file follows the last one; otherwise the last one stays
};

Sequence read_sequence(const SceneValue& value) {
    const SceneFields fields(value, "sequence");
    const auto number = [](const SceneValue& of) {
        return of.integer(-kFarthestNumber, kFarthestNumber);
    };
    Sequence sequence;
    sequence.first = number(fields.get("first"));
    sequence.last = number(fields.get("last"));
    if (sequence.last < sequence.first)
        fields.get("last").fail(
            fmt::format("must not be smaller than first, which is {}", sequence.first));
    if (const auto start = fields.find("start")) sequence.start = number(*start);
    if (const auto loop = fields.find("loop")) sequence.loop = loop->boolean();
    return sequence;
}

/// Throws Error::input that names all missing files.
void check_files(const SceneValue& pattern, const Sequence& sequence, const AssetSearch& search) {
    constexpr int kMaxNamed = 5;
    int missing = 0;
    std::string names;
    for (int number = sequence.first; number <= sequence.last; ++number) {
        const std::string name = frame_path(pattern.text(), number, false);
        if (is_asset(name, search.scene_folder, search.assets)) continue;
        if (++missing <= kMaxNamed) names += (missing == 1 ? "" : ", ") + quote(name);
    }
    if (missing == 0) return;
    throw Error(ErrorKind::input,
                "{}: {} of the {} files are missing: {}{}; give their folder with --assets or "
                "VOXELUME_ASSETS, or change \"first\" and \"last\"",
                pattern.where(), missing, int64_t(sequence.last) - sequence.first + 1, names,
                missing > kMaxNamed ? ", ..." : "");
}

std::filesystem::path find_number(const SceneValue& pattern, int number,
                                  const AssetSearch& search) {
    return find_asset(frame_path(pattern.text(), number, false), search.scene_folder, search.assets,
                      pattern.where());
}

}  // namespace

std::filesystem::path first_file(const SceneFields& fields, std::string_view key,
                                 const AssetSearch& search) {
    const SceneValue name = fields.get(key);
    const std::string& file = name.text();
    const auto value = fields.find("sequence");
    if (!value) return find_asset(file, search.scene_folder, search.assets, name.where());
    const Sequence sequence = read_sequence(*value);
    if (frame_path(file, 1, false) == file)
        name.fail(
            "has no place for the numbers of its \"sequence\"; write # for each digit, as in "
            "\"smoke.####.vdb\"");
    if (search.all_files) check_files(name, sequence, search);
    return find_number(name, sequence.first, search);
}

FileSequence read_files(const SceneFields& fields, std::string_view key,
                        const ValueReference& value, const AssetSearch& search) {
    const Sequence sequence = read_sequence(fields.get("sequence"));
    FileSequence files{value, {}, sequence.start, sequence.loop};
    const SceneValue name = fields.get(key);
    for (int number = sequence.first; number <= sequence.last; ++number)
        files.files.push_back(find_number(name, number, search));
    return files;
}

}  // namespace voxelume
