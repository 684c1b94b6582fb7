// SPDX-License-Identifier: Apache-2.0
#include "runtime/opencl/source/kernel_slice.hpp"

#include <algorithm>
#include <set>
#include <unordered_map>
#include <utility>

#include "runtime/opencl/source/source_conditions.hpp"
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

/// The directives that define some of the constants.
std::string definitions_of(const std::set<std::string_view>& names,
                           const SourceConstants& constants) {
    std::string text;
    for (const std::string_view name : names) {
        const auto constant = constants.find(name);
        if (constant == constants.end()) continue;
        text.append("#define ").append(name).append(" ").append(constant->second).append("\n");
    }
    return text;
}

/// True if the order of parts counts: functions of one name, or a pragma that isn't before all
/// functions.
bool depend_on_order(const std::vector<SourcePart>& parts) {
    std::set<std::string_view> functions, pragmas;
    for (const SourcePart& part : parts) {
        if (part.is_called && !part.is_macro && !functions.insert(part.names[0]).second)
            return true;
        const bool is_new = part.text.starts_with("#pragma") && pragmas.insert(part.text).second;
        if (is_new && !functions.empty()) return true;
    }
    return false;
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
            const auto checked = by_name_.find(parts_[i].argument);
            if (checked != by_name_.end() && is_check(parts_[i]))
                links_[checked->second.back()].checks.push_back(i);
            else
                unnamed_.push_back(i);
        }
    }

    /// The text that a part consists of, with the parts whose names can't be told. What a part
    /// mentions stands before it, in the order in which it is mentioned, whatever the order of the
    /// source is.
    std::string slice(size_t root) {
        Slice slice{std::vector<bool>(parts_.size()), {}, {}};
        for (const size_t part : unnamed_) add(part, slice);
        add(root, slice);
        std::string text = definitions_of(slice.constants, constants_);
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

    /// True if a call of a macro only checks its first argument: it names a type that nothing uses.
    bool is_check(const SourcePart& part) const {
        const auto macro = by_name_.find(part.macro);
        return macro != by_name_.end() && macro->second.size() == 1 &&
               parts_[macro->second[0]].text.find(") typedef char ") != std::string::npos;
    }

    /// True if a mention is of something else that has a part's name: a member, or a variable that
    /// the text declares, where a function of that name isn't called.
    bool is_other(const Mention& mention, const SourcePart& part, bool is_declared) const {
        if (part.is_macro && !part.is_called) return false;
        if (mention.is_member) return !part.is_macro;
        return part.is_called && !mention.is_call && is_declared;
    }

    void link(size_t part) {
        const std::vector<Mention> words = mentions(parts_[part].text);
        std::set<std::string_view> declared;
        for (const Mention& mention : words)
            if (mention.is_declared && !parts_[part].is_macro) declared.insert(mention.word);
        Links& links = links_[part];
        for (const Mention& mention : words) {
            const auto constant = constants_.find(mention.word);
            if (constant != constants_.end()) links.constants.push_back(constant->first);
            const auto found = by_name_.find(mention.word);
            if (found == by_name_.end()) continue;
            for (const size_t other : found->second)
                if (!is_other(mention, parts_[other], declared.contains(mention.word)))
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
    const ResolvedSource resolved = resolve_conditions(source, constants);
    const std::vector<SourcePart> parts = source_parts(resolved.text);
    PartGraph graph(parts, constants);
    const bool has_order = resolved.has_order || depend_on_order(parts);
    std::string whole;
    if (has_order) {
        const std::vector<std::string_view> words = identifiers(resolved.text);
        whole = definitions_of({words.begin(), words.end()}, constants) + resolved.text;
    }
    std::vector<KernelSlice> slices;
    for (size_t i = 0; i < parts.size(); ++i)
        if (parts[i].is_kernel)
            slices.push_back({parts[i].names[0], has_order ? whole : graph.slice(i)});
    return slices;
}

}  // namespace voxelume
