// Plots by gnuplot: lines and points with axis labels and a legend, as SVG or PNG.
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

/// The shape of a series: its points are drawn one by one, or two by two as opposite corners of filled rectangles, or
/// as tail and head of arrows.
enum class Shape { curve, rectangles, arrows };

/// A line of the plot, interrupted at points that are not finite or have no place on a logarithmic axis. The title
/// counts those, except where x alone is not a number, which only ends a line. A point without a neighbour gets a
/// marker. Labels use gnuplot's enhanced text: x_1 is a subscript.
struct Series {
    std::string label{};
    std::vector<std::pair<double, double>> points{};
    bool markers = true;  ///< in addition to the line
    bool line = true;
    bool open = false;                   ///< markers, which then show what lies below them
    std::optional<std::size_t> style{};  ///< index of colour, dashes and markers; by default each series has its own
    bool reference = false;              ///< such as exact values: black, and drawn however many curves there are
    bool alarm = false;                  ///< such as modes that grow: crosses on other markers, drawn in any case
    Shape shape = Shape::curve;
    std::vector<double> values{};  ///< of rectangles: 0 to 1, their colour
};

/// The largest number of curves with a label in a panel: more cannot be told apart.
inline constexpr std::size_t most_curves = 12;

/// The name of a column in pictures: "α_T" for alpha_T.
std::string shown_name(const std::string& column);

struct PlotRange {
    double low, high;  ///< the other way round if the axis points left or down
};

struct Plot {
    std::string title{}, x_label{}, y_label{};
    std::string z_label{};  ///< what the colours of rectangles with values mean
    bool log_x = false, log_y = false;
    int log_base = 10;                              ///< of the marks on a logarithmic x axis
    double linear_within = 0;                       ///< if > 0: both axes, with ranges, are logarithmic beyond, +-
    std::optional<PlotRange> x_range{}, y_range{};  ///< of the axes; by default all points; what lies beyond is marked
    bool x_is_part = false;                         ///< x_range is a part, as the title says: beyond, nothing is marked
    bool true_scale = false;                        ///< a length is as long along either axis; takes ranges
    std::vector<Series> series{};
    std::vector<Plot> below{};  ///< further panels
};

/// Raises smaller values of y to `least`, and marks that as a line: a logarithmic axis has no zero, and results can be
/// exact.
void raise_to_drawn(Plot& plot, double least = 1e-16);

/// Draws lengths to scale, in ranges with a margin around all points; y points down.
void fit_to_scale(Plot& plot);

/// Whether any point has a place on the axes: 0 has none on a logarithmic one. Other plots are not drawn.
bool can_be_drawn(const Plot& plot);

/// Rows as series: one for each combination of the columns `by`, which `y` over `x`. What differs between the series is
/// their label, what they share is appended to the title. Where y is undefined the line is interrupted.
struct Selection {
    std::vector<std::string> by{};
    std::string x{}, y{};
    bool absolute = false;             ///< |y|
    std::vector<std::string> apart{};  ///< columns as `by`, whose values follow in titles and labels
    std::string prefix{};              ///< of labels
    bool markers = true;
    bool reference = false;  ///< the first series alone, as a black line that the prefix names
};

void add_series(Plot& plot, const std::vector<std::string>& columns, const std::vector<Row>& rows,
                const Selection& selection);

/// A map: the cells around the places (x, y) of rows, halfway to their neighbours, in colours of the column z.
Series map_of(const std::vector<std::string>& columns, const std::vector<Row>& rows, const std::string& x,
              const std::string& y, const std::string& z);

/// The first panel with the others below it; an empty plot if there is none.
Plot in_one_column(std::vector<Plot> panels);

/// Whether the file's name asks for a PNG; false is SVG. Throws BadInput for any other ending.
bool plot_is_png(const Options& options);

/// The picture as PNG or SVG. Throws PlotError, which names `path`, when gnuplot is missing, fails or draws only a
/// part.
std::string picture(const Plot& plot, bool png, const std::string& path);

}  // namespace study
