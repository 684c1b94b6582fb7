// SPDX-License-Identifier: Apache-2.0
#include "runtime/opencl/source/kernel_slice.hpp"

#include <algorithm>
#include <map>
#include <set>
#include <unordered_map>
#include <utility>

#include "runtime/opencl/source/source_parts.hpp"

namespace voxelume {
namespace {

/// A compiler's -D constants.
SourceConstants constants_of(std::string_view options) {
    SourceConstants constants;
    for (std::string_view option : separate_options(options)) {
        if (!option.starts_with("-D")) continue;
        option.remove_prefix(2);
        const size_t sign = std::min(option.find('='), option.size());
        constants[std::string(option.substr(0, sign))] =
            sign < option.size() ? option.substr(sign + 1) : "1";
    }
    return constants;
}

/// Which parts of a source mention which, and which constants.
class PartGraph {
  public:
    PartGraph(const std::vector<SourcePart>& parts, const SourceConstants& constants)
        : parts_(parts), constants_(constants), links_(parts.size()) {
        for (size_t i = 0; i < parts_.size(); ++i)
            for (const std::string& name : parts_[i].names) by_name_[name].push_back(i);
        for (size_t i = 0; i < parts_.size(); ++i) {
            if (!parts_[i].names.empty()) continue;
            const auto checked = by_name_.find(parts_[i].checked);
            if (checked == by_name_.end())
                unnamed_.push_back(i);
            else
                links_[checked->second.back()].checks.push_back(i);
        }
    }

    /// The text that a part consists of, with the parts whose names can't be told. What a part
    /// mentions stands before it, in the order in which it is mentioned, whatever the order of the
    /// source is.
    std::string slice(size_t root) {
        Slice slice{std::vector<bool>(parts_.size()), {}, {}};
        for (const size_t part : unnamed_) add(part, slice);
        add(root, slice);
        std::string text;
        for (const std::string_view name : slice.constants)
            text.append("#define ")
                .append(name)
                .append(" ")
                .append(constants_.find(name)->second)
                .append("\n");
        std::set<std::string_view> directives;
        for (const size_t part : slice.order)
            if (!parts_[part].text.starts_with("#pragma") ||
                directives.insert(parts_[part].text).second)
                text.append(parts_[part].text).append("\n");
        return text;
    }

  private:
    struct Links {
        bool is_known = false;       ///< a part's are looked for once it is needed
        std::vector<size_t> parts;   ///< those that it mentions, in its order
        std::vector<size_t> checks;  ///< those that check it
        std::vector<std::string_view> constants;
    };
    struct Slice {
        std::vector<bool> is_needed;
        std::vector<size_t> order;
        std::set<std::string_view> constants;
    };

    /// A function, or a macro with parameters, has no part in a text that declares a variable of
    /// its name and doesn't call it.
    void link(size_t part) {
        const std::vector<Mention> words = mentions(parts_[part].text);
        std::set<std::string_view> declared;
        for (const Mention& mention : words)
            if (mention.is_declared) declared.insert(mention.word);
        Links& links = links_[part];
        for (const Mention& mention : words) {
            const auto constant = constants_.find(mention.word);
            if (constant != constants_.end()) links.constants.push_back(constant->first);
            const auto found = by_name_.find(mention.word);
            if (mention.is_member || found == by_name_.end()) continue;
            for (const size_t other : found->second)
                if (mention.is_call || !parts_[other].is_called || !declared.contains(mention.word))
                    links.parts.push_back(other);
        }
    }

    void add(size_t part, Slice& slice) {
        if (slice.is_needed[part]) return;
        slice.is_needed[part] = true;
        if (!std::exchange(links_[part].is_known, true)) link(part);
        const Links& links = links_[part];
        for (const size_t other : links.parts) add(other, slice);
        slice.constants.insert(links.constants.begin(), links.constants.end());
        slice.order.push_back(part);
        for (const size_t check : links.checks) add(check, slice);
    }

    const std::vector<SourcePart>& parts_;
    const SourceConstants& constants_;
    std::unordered_map<std::string_view, std::vector<size_t>> by_name_;
    std::vector<Links> links_;
    std::vector<size_t> unnamed_;  ///< the parts that every slice has
};

}  // namespace

std::vector<std::string_view> separate_options(std::string_view options) {
    std::vector<std::string_view> separate;
    while (!options.empty()) {
        const size_t end = std::min(options.find(' '), options.size());
        if (end > 0) separate.push_back(options.substr(0, end));
        options.remove_prefix(std::min(end + 1, options.size()));
    }
    return separate;
}

std::vector<KernelSlice> slice_kernels(std::string_view source, std::string_view options) {
    const SourceConstants constants = constants_of(options);
    const std::vector<SourcePart> parts = source_parts(source, constants);
    PartGraph graph(parts, constants);
    std::vector<KernelSlice> slices;
    for (size_t i = 0; i < parts.size(); ++i)
        if (parts[i].is_kernel) slices.push_back({parts[i].names[0], graph.slice(i)});
    return slices;
}

}  // namespace voxelume
