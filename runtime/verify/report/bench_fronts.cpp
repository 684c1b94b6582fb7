// SPDX-License-Identifier: Apache-2.0
#include "runtime/verify/report/bench_fronts.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "runtime/verify/bench/bench.hpp"

namespace voxelume {
namespace {

/// The natural logarithm of the seconds that a front takes for an error of exp(log_error).
double log_seconds(const ErrorFront& front, double log_error) {
    if (log_error >= std::log(front.front().first)) return std::log(front.front().second);
    size_t i = 1;
    while (i + 1 < front.size() && log_error < std::log(front[i].first)) ++i;
    const double e0 = std::log(front[i - 1].first), e1 = std::log(front[i].first);
    const double t0 = std::log(front[i - 1].second), t1 = std::log(front[i].second);
    return t0 + (t1 - t0) * (log_error - e0) / (e1 - e0);
}

/// The logarithms of the errors, descending, at which the ratio of two fronts bends.
std::vector<double> bends(const ErrorFront& ours, const ErrorFront& other, double coarse) {
    const double fine = std::log(std::max(ours.back().first, other.back().first));
    std::vector<double> errors = {coarse, fine};
    for (const ErrorFront* front : {&ours, &other})
        for (const auto& [error, seconds] : *front)
            if (std::log(error) < coarse && std::log(error) > fine)
                errors.push_back(std::log(error));
    std::ranges::sort(errors, std::greater());
    errors.erase(std::unique(errors.begin(), errors.end()), errors.end());
    return errors;
}

/// The text for a ratio in favour of a program: "1.9 to 5.6 times as quick", "5.6 times as quick"
/// where both bounds read alike, or "as quick" where they are 1.
std::string times_text(double minimum, double maximum) {
    const auto digits = [](double times) {
        return times < 100 ? fmt::format("{:.3g}", times) : fmt::format("{:.0f}", times);
    };
    if (maximum < 1.005) return "as quick";
    if (minimum < 1.005) return fmt::format("up to {} times as quick", digits(maximum));
    if (digits(minimum) == digits(maximum)) return digits(maximum) + " times as quick";
    return fmt::format("{} to {} times as quick", digits(minimum), digits(maximum));
}

}  // namespace

ErrorFront error_front(const std::vector<std::pair<double, double>>& errors_and_seconds) {
    std::vector<double> errors, seconds;
    for (const auto& [error, time] : errors_and_seconds) {
        if (!(error > 0 && time > 0)) continue;
        errors.push_back(error);
        seconds.push_back(time);
    }
    ErrorFront front;
    for (const size_t i : pareto_front(seconds, errors))
        if (front.empty() || errors[i] < front.back().first)
            front.emplace_back(errors[i], seconds[i]);
    return front;
}

std::vector<FrontPiece> compare_fronts(const ErrorFront& ours, const ErrorFront& other,
                                       double coarse) {
    std::vector<FrontPiece> pieces;
    if (ours.empty() || other.empty()) return pieces;
    if (std::max(ours.back().first, other.back().first) > coarse) return pieces;
    double last_error = 0, last_log = 0;
    for (const double error : bends(ours, other, std::log(coarse))) {
        const double log_ratio = log_seconds(other, error) - log_seconds(ours, error);
        const double ratio = std::exp(log_ratio), fine = std::exp(error);
        if (pieces.empty()) {
            pieces.push_back({fine, fine, ratio, ratio});
        } else if ((log_ratio > 0) != (last_log > 0)) {
            const double share = last_log / (last_log - log_ratio);
            const double crossing = std::exp(last_error + share * (error - last_error));
            FrontPiece& before = pieces.back();
            before.fine = crossing;
            (last_log > 0 ? before.minimum : before.maximum) = 1;
            pieces.push_back({crossing, fine, std::min(1.0, ratio), std::max(1.0, ratio)});
        } else {
            FrontPiece& piece = pieces.back();
            piece.fine = fine;
            piece.minimum = std::min(piece.minimum, ratio);
            piece.maximum = std::max(piece.maximum, ratio);
        }
        last_error = error;
        last_log = log_ratio;
    }
    return pieces;
}

namespace {

using Pairs = std::vector<std::pair<double, double>>;

/// Adds the comparison of all errors and seconds of a program on a scene, unless it is there, or
/// one of both has none.
template <class Ours, class Theirs>
void add_comparison(const std::string& program, const std::string& scene, const ErrorWords& words,
                    const Ours& ours_of, const Theirs& theirs_of,
                    std::vector<FrontComparison>& comparisons) {
    const auto is_known = [&](const FrontComparison& c) {
        return c.program == program && c.scene == scene;
    };
    if (std::ranges::any_of(comparisons, is_known)) return;
    const Pairs theirs = theirs_of();
    const ErrorFront our_front = error_front(ours_of()), their_front = error_front(theirs);
    if (our_front.empty() || their_front.empty()) return;
    const double coarse = std::ranges::max(theirs).first;
    comparisons.push_back({program, scene, compare_fronts(our_front, their_front, coarse),
                           our_front.back().first, their_front.back().first, words});
}

}  // namespace

std::vector<FrontComparison> front_comparisons(const BenchReport& report) {
    std::vector<FrontComparison> comparisons;
    for (const BenchPeerRow& peer : report.peers) {
        const auto ours = [&] {
            Pairs pairs;
            for (const BenchRow& row : report.rows)
                if (row.scene == peer.scene && row.samples == 1)
                    pairs.emplace_back(row.errors.depth_rms, row.seconds.total);
            return pairs;
        };
        const auto theirs = [&] {
            Pairs pairs;
            for (const BenchPeerRow& row : report.peers)
                if (row.program == peer.program && row.scene == peer.scene)
                    pairs.emplace_back(row.depth_rms, row.total_seconds());
            return pairs;
        };
        add_comparison(peer.program, peer.scene, kDepthWords, ours, theirs, comparisons);
    }
    return comparisons;
}

std::vector<FrontComparison> noise_comparisons(const BenchReport& report) {
    std::vector<FrontComparison> comparisons;
    for (const GlobalRow& peer : report.global_rows) {
        if (peer.program.empty()) continue;
        const auto pairs_of = [&](const std::string& program) {
            Pairs pairs;
            for (const GlobalRow& row : report.global_rows)
                if (row.program == program && row.scene == peer.scene)
                    pairs.emplace_back(row.relative_mse, row.seconds);
            return pairs;
        };
        add_comparison(
            peer.program, peer.scene, kNoiseWords, [&] { return pairs_of(""); },
            [&] { return pairs_of(peer.program); }, comparisons);
    }
    return comparisons;
}

std::string sentence_of(const FrontComparison& comparison) {
    const ErrorWords& words = comparison.words;
    std::vector<std::string> parts;
    for (const FrontPiece& piece : comparison.pieces) {
        const bool is_ours = piece.maximum > 1;
        const std::string range =
            piece.fine < piece.coarse
                ? fmt::format("from {:.2g}{}{} down to {:.2g}{}", piece.coarse, words.unit,
                              words.measure, piece.fine, words.unit)
                : fmt::format("at {:.2g}{}{}", piece.fine, words.unit, words.measure);
        parts.push_back(fmt::format("{} is {} {}", is_ours ? "Voxelume" : comparison.program,
                                    is_ours ? times_text(piece.minimum, piece.maximum)
                                            : times_text(1 / piece.maximum, 1 / piece.minimum),
                                    range));
    }
    const bool ours_is_finer = comparison.finest_ours < comparison.finest_theirs;
    parts.push_back(fmt::format(
        "only {} comes nearer, to {:.2g}{}", ours_is_finer ? "Voxelume" : comparison.program,
        std::min(comparison.finest_ours, comparison.finest_theirs), words.unit));
    return fmt::format("{}, {}: {}.", comparison.scene, comparison.program, fmt::join(parts, "; "));
}

}  // namespace voxelume
