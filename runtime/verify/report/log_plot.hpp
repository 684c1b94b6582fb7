// SPDX-License-Identifier: Apache-2.0
// Curves between two logarithmic axes, as SVG.
#pragma once

#include <glm/vec2.hpp>
#include <string>
#include <vector>

namespace voxelume {

struct PlotSeries {
    std::string name;
    std::string color;               ///< colour in CSS
    std::vector<glm::dvec2> points;  ///< in the order of the line; points that aren't positive are
                                     ///< left out
    std::vector<bool> marked;        ///< per point: true for a ring around it; may be empty
    bool is_dashed = false;          ///< true for a line without dots
};

struct LogPlot {
    std::string title, x_label, y_label;
    std::vector<PlotSeries> series;
};

/// An <svg> element. Powers of ten have grid lines. The axes extend from the minimum to the maximum
/// of all points, with a little room.
std::string svg_of(const LogPlot& plot);

/// The plots' elements side by side, two in a row, as a file of their own.
std::string svg_file(const std::vector<LogPlot>& plots);

/// The elements' style, as CSS.
inline constexpr const char* kPlotStyle =
    "svg text{font:11px system-ui,sans-serif;fill:#333}svg .title{font-size:13px;font-weight:600}"
    "svg .grid{stroke:#ddd}svg .frame{fill:none;stroke:#888}"
    "svg polyline{fill:none;stroke-width:1.5}svg .mark{fill:none;stroke:#111;stroke-width:1.5}";

/// True if any point can be shown.
bool has_points(const LogPlot& plot);

/// Escapes text for use between tags or in an attribute's quotes.
std::string escape_html(const std::string& text);

}  // namespace voxelume
