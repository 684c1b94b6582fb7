// SPDX-License-Identifier: Apache-2.0
#include "runtime/verify/report/log_plot.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace voxelume {
namespace {

// The picture's layout in pixels: the frame's corners, the total width, and the rows of names
// below.
constexpr glm::dvec2 kFrameMin(70, 24), kFrameMax(440, 280);
constexpr double kWidth = 460, kLegend = 324, kLegendRow = 16;

bool can_be_shown(const glm::dvec2& p) {
    return p.x > 0 && p.y > 0 && std::isfinite(p.x) && std::isfinite(p.y);
}

/// The decimal logarithms at the frame's edges.
struct Axes {
    glm::dvec2 low{INFINITY}, high{-INFINITY};

    glm::dvec2 place(const glm::dvec2& p) const {
        const glm::dvec2 share =
            (glm::dvec2(std::log10(p.x), std::log10(p.y)) - low) / (high - low);
        return {kFrameMin.x + share.x * (kFrameMax.x - kFrameMin.x),
                kFrameMax.y - share.y * (kFrameMax.y - kFrameMin.y)};
    }
};

Axes axes_of(const LogPlot& plot) {
    Axes axes;
    for (const PlotSeries& series : plot.series) {
        for (const glm::dvec2& p : series.points) {
            if (!can_be_shown(p)) continue;
            for (int i = 0; i < 2; ++i) {
                axes.low[i] = std::min(axes.low[i], std::log10(p[i]));
                axes.high[i] = std::max(axes.high[i], std::log10(p[i]));
            }
        }
    }
    for (int i = 0; i < 2; ++i) {
        if (!(axes.low[i] <= axes.high[i])) axes.low[i] = axes.high[i] = 0;
        const double room = std::max(0.06 * (axes.high[i] - axes.low[i]), 0.15);
        axes.low[i] -= room;
        axes.high[i] += room;
    }
    return axes;
}

std::string line(glm::dvec2 a, glm::dvec2 b, const char* kind) {
    return fmt::format(
        "<line class=\"{}\" x1=\"{:.1f}\" y1=\"{:.1f}\" x2=\"{:.1f}\" y2=\"{:.1f}\"/>\n", kind, a.x,
        a.y, b.x, b.y);
}

std::string label(glm::dvec2 p, const char* anchor, const std::string& text) {
    return fmt::format("<text x=\"{:.1f}\" y=\"{:.1f}\" text-anchor=\"{}\">{}</text>\n", p.x, p.y,
                       anchor, escape_html(text));
}

/// The ticks of an axis: 1, 2 and 5 of each power of ten where few powers are on the axis, else the
/// powers alone.
std::vector<double> ticks_of(double low, double high) {
    const std::vector<double> digits =
        high - low < 2.5 ? std::vector<double>{1, 2, 5} : std::vector<double>{1};
    std::vector<double> ticks;
    for (int power = int(std::floor(low)); power <= int(std::ceil(high)); ++power)
        for (const double digit : digits)
            if (const double at = power + std::log10(digit); at >= low && at <= high)
                ticks.push_back(digit * std::pow(10.0, power));
    return ticks;
}

std::string grid(const Axes& axes) {
    std::string svg;
    for (const double tick : ticks_of(axes.low.x, axes.high.x)) {
        const double x = axes.place({tick, 1}).x;
        svg += line({x, kFrameMin.y}, {x, kFrameMax.y}, "grid");
        svg += label({x, kFrameMax.y + 14}, "middle", fmt::format("{:g}", tick));
    }
    for (const double tick : ticks_of(axes.low.y, axes.high.y)) {
        const double y = axes.place({1, tick}).y;
        svg += line({kFrameMin.x, y}, {kFrameMax.x, y}, "grid");
        svg += label({kFrameMin.x - 6, y + 4}, "end", fmt::format("{:g}", tick));
    }
    return svg;
}

std::string curve(const PlotSeries& series, const Axes& axes) {
    std::string way, dots;
    for (size_t i = 0; i < series.points.size(); ++i) {
        if (!can_be_shown(series.points[i])) continue;
        const glm::dvec2 p = axes.place(series.points[i]);
        way += fmt::format("{:.1f},{:.1f} ", p.x, p.y);
        if (series.is_dashed) continue;
        dots += fmt::format(
            "<circle cx=\"{:.1f}\" cy=\"{:.1f}\" r=\"3\" fill=\"{}\"><title>{}: {:g}, "
            "{:g}</title></circle>\n",
            p.x, p.y, series.color, escape_html(series.name), series.points[i].x,
            series.points[i].y);
        if (i < series.marked.size() && series.marked[i])
            dots += fmt::format("<circle class=\"mark\" cx=\"{:.1f}\" cy=\"{:.1f}\" r=\"6.5\"/>\n",
                                p.x, p.y);
    }
    if (way.empty()) return {};
    return fmt::format("<polyline points=\"{}\" stroke=\"{}\"{}/>\n", way, series.color,
                       series.is_dashed ? " stroke-dasharray=\"5 4\"" : "") +
           dots;
}

/// The names of the curves, in as many rows as they need.
struct Legend {
    std::string svg;
    double bottom = kLegend;
};

Legend legend_of(const LogPlot& plot) {
    constexpr double kFirst = 14, kDot = 11, kGap = 14, kLetter = 6;
    Legend legend;
    double x = kFirst;
    const auto add = [&](const std::string& name, const std::string& circle) {
        const double width = kDot + kGap + kLetter * double(name.size());
        if (x > kFirst && x + width > kWidth) x = kFirst, legend.bottom += kLegendRow;
        legend.svg += fmt::format("<circle cx=\"{:.1f}\" cy=\"{:.1f}\" {}/>\n", x + 4,
                                  legend.bottom - 4, circle);
        legend.svg += label({x + kDot, legend.bottom}, "start", name);
        x += width;
    };
    for (const PlotSeries& series : plot.series)
        if (!series.name.empty())
            add(series.name, fmt::format("r=\"3\" fill=\"{}\"", series.color));
    const auto has_marks = [](const PlotSeries& series) {
        return std::ranges::find(series.marked, true) != series.marked.end();
    };
    if (std::ranges::any_of(plot.series, has_marks)) add("front", "class=\"mark\" r=\"4.5\"");
    return legend;
}

/// The SVG of everything in the picture.
std::string content_of(const LogPlot& plot, const Legend& legend) {
    const Axes axes = axes_of(plot);
    const glm::dvec2 size = kFrameMax - kFrameMin, middle = (kFrameMin + kFrameMax) / 2.0;
    std::string svg =
        fmt::format("<text class=\"title\" x=\"14\" y=\"14\">{}</text>\n", escape_html(plot.title));
    svg += grid(axes);
    svg += fmt::format("<rect class=\"frame\" x=\"{}\" y=\"{}\" width=\"{}\" height=\"{}\"/>\n",
                       kFrameMin.x, kFrameMin.y, size.x, size.y);
    for (const PlotSeries& series : plot.series) svg += curve(series, axes);
    svg += label({middle.x, kFrameMax.y + 28}, "middle", plot.x_label);
    svg += fmt::format(
        "<text text-anchor=\"middle\" transform=\"translate(14 {:.0f}) rotate(-90)\">{}</text>\n",
        middle.y, escape_html(plot.y_label));
    return svg + legend.svg;
}

}  // namespace

std::string escape_html(const std::string& text) {
    std::string escaped;
    for (const char c : text) {
        if (c == '&')
            escaped += "&amp;";
        else if (c == '<')
            escaped += "&lt;";
        else if (c == '>')
            escaped += "&gt;";
        else if (c == '"')
            escaped += "&quot;";
        else if (static_cast<unsigned char>(c) < 0x20 || c == 0x7f)
            escaped += '?';
        else
            escaped += c;
    }
    return escaped;
}

bool has_points(const LogPlot& plot) {
    return std::ranges::any_of(plot.series, [](const PlotSeries& series) {
        return std::ranges::any_of(series.points, can_be_shown);
    });
}

std::string svg_of(const LogPlot& plot) {
    const Legend legend = legend_of(plot);
    return fmt::format(
        "<svg viewBox=\"0 0 {:.0f} {:.0f}\" role=\"img\" aria-label=\"{}\">\n{}</svg>\n", kWidth,
        legend.bottom + 8, escape_html(plot.title), content_of(plot, legend));
}

std::string svg_file(const std::vector<LogPlot>& plots) {
    std::string content;
    double top = 0, bottom = 0;
    for (size_t i = 0; i < plots.size(); ++i) {
        if (i % 2 == 0) top = bottom;
        const Legend legend = legend_of(plots[i]);
        content += fmt::format("<g transform=\"translate({} {})\">\n{}</g>\n",
                               i % 2 == 0 ? 0.0 : kWidth, top, content_of(plots[i], legend));
        bottom = std::max(bottom, top + legend.bottom + 12);
    }
    return fmt::format(
        "<svg xmlns=\"http://www.w3.org/2000/svg\" width=\"{0}\" height=\"{1}\" viewBox=\"0 0 "
        "{0} {1}\">\n<style>{2}</style>\n<rect width=\"100%\" height=\"100%\" "
        "fill=\"#fff\"/>\n{3}</svg>\n",
        plots.size() > 1 ? 2 * kWidth : kWidth, bottom, kPlotStyle, content);
}

}  // namespace voxelume
