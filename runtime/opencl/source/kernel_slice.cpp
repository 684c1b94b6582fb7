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

/// A compiler's -D constants as directives, by name.
std::map<std::string, std::string, std::less<>> constants_of(std::string_view options) {
    std::map<std::string, std::string, std::less<>> constants;
    for (const std::string_view given : separate_options(options)) {
        std::string option(given);
        if (!option.starts_with("-D")) continue;
        const size_t sign = option.find('=');
        std::string name = option.substr(2, sign == std::string::npos ? sign : sign - 2);
        if (sign != std::string::npos) option[sign] = ' ';
        constants[std::move(name)] = "#define " + option.substr(2) + "\n";
    }
    return constants;
}

/// The references between the parts of a source, and from parts to constants.
class PartGraph {
  public:
    PartGraph(const std::vector<SourcePart>& parts, std::string_view options)
        : parts_(parts), constants_(constants_of(options)), links_(parts.size()) {
        std::unordered_map<std::string_view, std::vector<size_t>> by_name;
        for (size_t i = 0; i < parts_.size(); ++i)
            if (!parts_[i].name.empty()) by_name[parts_[i].name].push_back(i);
        for (size_t i = 0; i < parts_.size(); ++i) {
            for (const std::string_view word : identifiers(parts_[i].text)) {
                const auto found = by_name.find(word);
                if (found != by_name.end())
                    links_[i].parts.insert(found->second.begin(), found->second.end());
                const auto constant = constants_.find(word);
                if (constant != constants_.end()) links_[i].constants.insert(&constant->second);
            }
        }
        link_conditions();
    }

    /// The text of a part and of the parts that it needs, with all parts whose names are unknown.
    std::string slice(size_t root) const {
        std::vector<bool> is_needed(parts_.size());
        std::vector<size_t> left;
        const auto need = [&](size_t part) {
            if (!is_needed[part]) left.push_back(part);
            is_needed[part] = true;
        };
        need(root);
        for (size_t i = 0; i < parts_.size(); ++i)
            if (parts_[i].kind == SourcePart::Kind::definition && parts_[i].name.empty()) need(i);
        std::set<std::string_view> constants;
        while (!left.empty()) {
            const Links& links = links_[left.back()];
            left.pop_back();
            for (const std::string* constant : links.constants) constants.insert(*constant);
            for (const size_t part : links.parts) need(part);
        }
        std::string text;
        for (const std::string_view constant : constants) text += constant;
        for (size_t i = 0; i < parts_.size(); ++i)
            if (is_needed[i]) text.append(parts_[i].text).append("\n");
        return text;
    }

  private:
    struct Links {
        std::set<size_t> parts;
        std::set<const std::string*> constants;
    };

    /// Makes each part inside a condition need all directives of the condition.
    void link_conditions() {
        std::vector<std::vector<size_t>> inside;  // the parts in each open condition
        std::vector<std::vector<size_t>> directives;
        for (size_t i = 0; i < parts_.size(); ++i) {
            const SourcePart::Kind kind = parts_[i].kind;
            if (kind == SourcePart::Kind::condition) {
                if (!inside.empty()) inside.back().push_back(i);
                inside.emplace_back();
                directives.emplace_back();
            }
            if (kind == SourcePart::Kind::definition) {
                if (!inside.empty()) inside.back().push_back(i);
                continue;
            }
            if (directives.empty()) continue;  // an end without a beginning
            directives.back().push_back(i);
            if (kind != SourcePart::Kind::condition_end) continue;
            for (const size_t part : inside.back())
                links_[part].parts.insert(directives.back().begin(), directives.back().end());
            for (const size_t part : directives.back())
                links_[part].parts.insert(directives.back().begin(), directives.back().end());
            inside.pop_back();
            directives.pop_back();
        }
    }

    const std::vector<SourcePart>& parts_;
    std::map<std::string, std::string, std::less<>> constants_;
    std::vector<Links> links_;
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
    const std::vector<SourcePart> parts = source_parts(source);
    const PartGraph graph(parts, options);
    std::vector<KernelSlice> slices;
    for (size_t i = 0; i < parts.size(); ++i)
        if (parts[i].is_kernel) slices.push_back({parts[i].name, graph.slice(i)});
    return slices;
}

}  // namespace voxelume
