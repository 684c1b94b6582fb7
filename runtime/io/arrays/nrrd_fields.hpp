// SPDX-License-Identifier: Apache-2.0
// The lines of a NRRD header, "name: value" each.
#pragma once

#include <glm/vec3.hpp>
#include <map>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "runtime/base/files/input_file.hpp"

namespace voxelume {

class NrrdFields {
  public:
    /// Throws Error::input for a file that isn't NRRD, or whose header is damaged or too long.
    explicit NrrdFields(const InputFile& file);

    /// The value of a field; empty where the header has none.
    std::string text(std::string_view name) const;
    /// Words of the value, split at blanks; quoted or bracketed ones stay whole.
    std::vector<std::string> words(std::string_view name) const;
    /// Numbers of the value; NaN for words that are no numbers.
    std::vector<double> numbers(std::string_view name) const;
    bool has(std::string_view name) const { return !text(name).empty(); }
    bool has_key(std::string_view name) const { return keys_.contains(name); }
    uint64_t end() const { return end_; }  ///< byte behind the header

    /// Throws Error::input for a header whose data are in several files.
    [[noreturn]] static void refuse_several(const InputFile& file);

    /// "(1,0.5,-2)" as a vector; none for "none" and for what isn't three numbers.
    static std::optional<glm::dvec3> vector(std::string_view word);

  private:
    std::map<std::string, std::string, std::less<>> fields_, keys_;
    uint64_t end_ = 0;
};

}  // namespace voxelume
