#include "cli/nearest_name.hpp"

#include <algorithm>

namespace voxelume::cli {

namespace {

/// The optimal string alignment distance.
size_t edit_distance(const std::string& a, const std::string& b) {
    std::vector<size_t> before_last, last(b.size() + 1), row(b.size() + 1);
    for (size_t j = 0; j <= b.size(); ++j) last[j] = j;
    for (size_t i = 1; i <= a.size(); ++i) {
        row[0] = i;
        for (size_t j = 1; j <= b.size(); ++j) {
            const bool same = a[i - 1] == b[j - 1];
            row[j] = std::min({last[j] + 1, row[j - 1] + 1, last[j - 1] + (same ? 0 : 1)});
            if (i > 1 && j > 1 && a[i - 1] == b[j - 2] && a[i - 2] == b[j - 1])
                row[j] = std::min(row[j], before_last[j - 2] + 1);
        }
        before_last = last;
        last = row;
    }
    return last.back();
}

}  // namespace

std::string nearest_name(const std::string& typed, const std::vector<std::string>& names) {
    std::string nearest;
    size_t fewest = std::max<size_t>(2, typed.size() / 2) + 1;
    for (const std::string& name : names) {
        const size_t edits = edit_distance(typed, name);
        if (edits >= fewest || edits >= name.size()) continue;
        fewest = edits;
        nearest = name;
    }
    return nearest;
}

}  // namespace voxelume::cli
