// Pictures by gnuplot: panels, one below the other, of curves, fields and arrows, as SVG or PNG.
// The first colours are Okabe and Ito's, which colour-blind readers tell apart; dashes and markers do so in grey.
#pragma once

#include <cstddef>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "csv.hpp"
#include "options.hpp"

namespace study {

/// The looks of series; their styles are a table in gnuplot.cpp. Curves, markers, and stick and slip as markers are
/// results: a panel takes twelve of them, and its title counts their missing values.
enum class Look {
    curve,          ///< a line in a colour of its label, with markers if its points in view are few
    markers,        ///< open markers in a colour of its label, which show what lies below them
    crosses,        ///< such as modes that grow: on other markers
    exact,          ///< a black line, dashed
    exact_markers,  ///< black and open
    outline,        ///< a black line without dashes
    stick,          ///< markers
    slip,
    stick_cells,  ///< filled rectangles
    slip_cells,
    cells,        ///< rectangles, coloured by their values
    empty_cells,  ///< hatched, without a value
    arrows
};

/// A line of the plot, interrupted at points that are not finite or have no place on a logarithmic axis. The title
/// counts those, except where x alone is not a number, which only ends a line. A point of a result without a
/// neighbour gets a marker. Labels use gnuplot's enhanced text: x_1 is a subscript. Series of one label have one style
/// in all panels.
struct Series {
    std::string label{};
    Look look = Look::curve;
    std::vector<std::pair<double, double>> points{};  ///< two by two opposite corners of cells, tails and heads
    std::vector<double> values{};                     ///< of cells: 0 to 1
    std::string styled_as{};                          ///< the label whose style it has, if not its own
};

/// A text above a point.
struct PlotNote {
    double x, y;
    std::string text;
};

/// The largest number of curves with a label in a panel: more cannot be told apart.
inline constexpr std::size_t most_curves = 12;

struct PlotRange {
    double low, high;  ///< the other way round if the axis points left or down
};

struct PlotAxis {
    std::string label{};
    bool logarithmic = false;          ///< unless values are too near to one another
    double linear_within = 0;          ///< if > 0: with a range, logarithmic beyond +- this
    double least = 1e-16;              ///< of a logarithmic y axis: smaller values from 0 on are drawn there
    std::optional<PlotRange> range{};  ///< by default all points; arrows at the frame point to markers beyond it
};

/// A panel; without a point to draw it is left out. A title that the one above begins with is not repeated.
struct Plot {
    std::string title{};
    PlotAxis x{}, y{};
    std::string colours{};  ///< what values of cells mean
    bool to_scale = false;  ///< both axes have one scale, in ranges with a margin around all points
    bool y_down = false;    ///< y points down
    std::vector<Series> series{};
    std::vector<PlotNote> notes{};  ///< drawn where they have room
    bool shares_legend = false;     ///< its entries stand in the legend of the first panel
};

using Picture = std::vector<Plot>;

/// The name of a column in pictures: "α_T" for alpha_T.
std::string shown_name(const std::string& column);

/// Rows as series: one for each combination of the columns `by`, which `y` over `x`. What differs between the series is
/// their label, what they share is appended to the title of an empty panel. Where y is undefined the line is
/// interrupted. Curves that coincide are drawn as one. A single series without a prefix is called computed. Exact lines
/// have each point once.
struct Selection {
    std::vector<std::string> by{};
    std::string x{}, y{};
    bool absolute = false;  ///< |y|
    std::string prefix{};   ///< of labels
    Look look = Look::curve;
    double x_unit = 1, y_unit = 1;  ///< of the axes, in units of the columns
};

void add_series(Plot& plot, const Records& records, const Selection& selection);

/// A map: the cells around (x, y) of rows, halfway to their neighbours, in colours of the column z, and hatched where
/// it is empty.
std::vector<Series> map_of(const Records& records, const std::string& x, const std::string& y, const std::string& z);

/// The edge of an outline, rollbem::PatchContact::Outline, as a closed line.
template <class Outline>
std::vector<std::pair<double, double>> edge_of(const Outline& outline) {
    std::vector<std::pair<double, double>> points;
    for (const double y : outline.y()) points.emplace_back(outline.trailing(y), y);
    for (auto i = outline.y().size(); i-- > 0;) points.emplace_back(outline.leading(outline.y()[i]), outline.y()[i]);
    points.push_back(points.front());
    return points;
}

/// The picture as PNG if the path ends in .png, otherwise as SVG. Throws PlotError, which names `path`, when there is
/// nothing to draw or too much, and when gnuplot is missing, fails or draws only a part.
std::string drawing_of(const Picture& picture, const std::string& path);

}  // namespace study
