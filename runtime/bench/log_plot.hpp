// Curves between two logarithmic axes, as SVG.
#pragma once

#include <glm/vec2.hpp>
#include <string>
#include <vector>

namespace voxelume {

struct PlotSeries {
    std::string name;
    std::string color;               ///< as CSS has it
    std::vector<glm::dvec2> points;  ///< in the order of the line; not positive ones are left out
    std::vector<bool> marked;        ///< per point: a ring around it; may be empty
    bool is_dashed = false;          ///< a line without dots
};

struct LogPlot {
    std::string title, x_label, y_label;
    std::vector<PlotSeries> series;
};

/// An <svg> element. Powers of ten have grid lines; the axes reach from the least to the most
/// point, with a little room.
std::string svg_of(const LogPlot& plot);

/// Text between tags or in an attribute's quotes.
std::string escape_html(const std::string& text);

}  // namespace voxelume
