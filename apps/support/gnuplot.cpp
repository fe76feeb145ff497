// Plots as scripts for gnuplot, and the pictures it draws.
#include <algorithm>
#include <array>
#include <cerrno>
#include <cmath>
#include <cstdio>
#include <cstring>
#include <iterator>
#include <limits>
#include <set>
#include <string_view>

#include <sys/wait.h>

#include "plot.hpp"

namespace study {

namespace {

std::string gnuplot_string(std::string text) {
    for (std::size_t i = text.find('\''); i != std::string::npos; i = text.find('\'', i + 2)) text.insert(i, 1, '\'');
    return "'" + text + "'";
}

// --- axes ----------------------------------------------------------------------------------------------------------

using Point = std::pair<double, double>;

/// One of the two axes of a plot: gets the coordinate of a point along it.
struct PlotAxis {
    char name;
    bool logarithmic;
    double linear_within;
    std::optional<PlotRange> Plot::*range;
    double Point::*coordinate;

    /// The place of a value on the paper, but for shift and scale, and the value at a place.
    double place(double value) const {
        return logarithmic ? std::log10(value) : linear_within > 0 ? std::asinh(value / linear_within) : value;
    }
    double value(double place) const {
        return logarithmic ? std::pow(10, place) : linear_within > 0 ? linear_within * std::sinh(place) : place;
    }
    /// 0 ... 1 within a range.
    double share(double at, const PlotRange& of) const {
        return (place(at) - place(of.low)) / (place(of.high) - place(of.low));
    }
    double at_share(double share, const PlotRange& of) const {
        return value(place(of.low) + share * (place(of.high) - place(of.low)));
    }
};

std::array<PlotAxis, 2> axes_of(const Plot& plot) {
    return {PlotAxis{'x', plot.log_x, plot.linear_within, &Plot::x_range, &Point::first},
            PlotAxis{'y', plot.log_y, plot.linear_within, &Plot::y_range, &Point::second}};
}

bool has_place(const Plot& plot, const Point& point) {
    return std::isfinite(point.first) && std::isfinite(point.second) && (!plot.log_x || point.first > 0) &&
           (!plot.log_y || point.second > 0);
}

/// The least and the largest coordinate of all points that have a place.
PlotRange extent(const Plot& plot, const PlotAxis& axis) {
    PlotRange found{std::numeric_limits<double>::infinity(), -std::numeric_limits<double>::infinity()};
    for (const Series& series : plot.series) {
        for (const Point& point : series.points) {
            if (!has_place(plot, point)) continue;
            found = {std::min(found.low, point.*axis.coordinate), std::max(found.high, point.*axis.coordinate)};
        }
    }
    return found;
}

std::string marks_command(const PlotAxis& axis, const std::vector<double>& marks) {
    std::string line = csv_line(Row(marks.begin(), marks.end()));
    line.pop_back();  // its end
    return std::string("set ") + axis.name + "tics (" + line + ")\n";
}

/// 1, 2, 5, 10, ... around a range and some beyond, or other digits.
std::vector<double> marks_of_decades(const PlotRange& range, const std::vector<int>& digits = {1, 2, 5}) {
    std::vector<double> marks;
    for (int k = int(std::floor(std::log10(range.low))) - 1; k <= int(std::floor(std::log10(range.high))) + 1; ++k) {
        for (const int digit : digits) marks.push_back(digit * std::pow(10, k));
    }
    return marks;
}

/// A logarithmic x axis, with marks at the values if those are few. One shorter than a decade is linear: gnuplot sets
/// too few marks.
std::string logarithmic_x(const Plot& plot, const PlotAxis& axis) {
    std::set<double> values;
    for (const Series& series : plot.series) {
        for (const Point& point : series.points) {
            if (has_place(plot, point)) values.insert(point.first);
        }
    }
    const PlotRange range = plot.x_range.value_or(PlotRange{*values.begin(), *values.rbegin()});
    const auto is_short = [](double value) { return value == std::round(value) && value < 1e4; };
    const bool few = values.size() <= 8 && std::all_of(values.begin(), values.end(), is_short);
    if (!few && range.high < 10 * range.low && !plot.x_range) return "";
    const std::string scale = "set logscale x " + std::to_string(plot.log_base) + "\n";
    if (!few)
        return scale + (plot.log_base == 10 && range.high < 100 * range.low
                            ? marks_command(axis, marks_of_decades(range))
                            : "");
    std::vector<double> marks;  // none on top of another
    for (const double value : values) {
        const bool apart = marks.empty() || std::log(value / marks.back()) > 0.08 * std::log(range.high / range.low);
        if (apart) marks.push_back(value);
    }
    return scale + marks_command(axis, marks);
}

/// A logarithmic y axis, with a margin around the values and, if it is short, marks between powers of ten. Without a
/// range and over less than a factor of 3, it is linear; nearly equal values lie in the middle of a factor of 4.
std::string logarithmic_y(Plot& plot, const PlotAxis& axis) {
    PlotRange range = plot.y_range.value_or(extent(plot, axis));
    if (range.high < 1.02 * range.low) range = {range.low / 2, 2 * range.high};
    if (!plot.y_range && range.high < 3 * range.low) {
        plot.log_y = false;
        return "";
    }
    if (!plot.y_range) plot.y_range = PlotRange{axis.at_share(-0.05, range), axis.at_share(1.05, range)};
    const std::string scale = "set logscale y 10\n";
    if (range.high < 10 * range.low) return scale + marks_command(axis, marks_of_decades(range, {1, 2, 3, 5, 7}));
    if (range.high < 100 * range.low) return scale + marks_command(axis, marks_of_decades(range, {1, 2, 3, 5}));
    return scale + "set format y '10^{%T}'\n";
}

/// Axes that are linear near 0 and logarithmic beyond, with marks at powers of ten of either sign.
std::string both_logarithms(const Plot& plot, const PlotAxis& axis) {
    const std::string within = Cell(axis.linear_within).text();
    std::vector<double> marks{0};
    const PlotRange range = (plot.*axis.range).value();
    const double most = std::max(std::abs(range.low), std::abs(range.high));
    const std::string name(1, axis.name), scale = "set nonlinear " + name + " via asinh(" + name + "/" + within +
                                                  ") inverse " + within + "*sinh(" + name + ")\n";
    if (most < 10 * axis.linear_within) return scale;  // nearly linear
    for (double mark = std::pow(10, std::ceil(std::log10(axis.linear_within))); mark <= most; mark *= 10) {
        if (-mark >= range.low) marks.insert(marks.begin(), -mark);
        if (mark <= range.high) marks.push_back(mark);
    }
    return scale + marks_command(axis, marks);
}

/// Moves the ends of given ranges outwards from markers that lie on them.
void clear_the_frame(Plot& plot) {
    if (plot.true_scale) return;
    for (const PlotAxis& axis : axes_of(plot)) {
        std::optional<PlotRange>& range = plot.*axis.range;
        if (!range) continue;
        bool at_low = false, at_high = false;
        for (const Series& series : plot.series) {
            for (const Point& point : series.points) {
                if (!series.markers || !has_place(plot, point)) continue;
                const double share = axis.share(point.*axis.coordinate, *range);
                at_low = at_low || std::abs(share) < 0.015;
                at_high = at_high || std::abs(share - 1) < 0.015;
            }
        }
        const PlotRange given = *range;
        if (at_low) range->low = axis.at_share(-0.025, given);
        if (at_high) range->high = axis.at_share(1.025, given);
    }
}

/// Lengths to scale have marks as far apart along either axis.
std::string to_scale(const Plot& plot) {
    const auto length = [](const PlotRange& range) { return std::abs(range.high - range.low); };
    const double apart = std::max(length(*plot.x_range), length(*plot.y_range)) / 10;
    const std::vector<double> steps = marks_of_decades({apart, apart});
    const std::string step = Cell(*std::lower_bound(steps.begin(), steps.end(), apart)).text(6);
    return "set size ratio -1\nset xtics " + step + "\nset ytics " + step + "\n";
}

/// Scales, ranges and marks.
std::string axis_commands(Plot& plot) {
    const auto [x, y] = axes_of(plot);
    std::string script = plot.true_scale ? to_scale(plot) : "";
    if (plot.log_x) script += logarithmic_x(plot, x);
    if (plot.log_y) script += logarithmic_y(plot, y);
    clear_the_frame(plot);
    for (const PlotAxis& axis : {x, y}) {
        if (axis.linear_within > 0) script += both_logarithms(plot, axis);
        if (const auto& range = plot.*axis.range) {
            script += std::string("set ") + axis.name + "range [" + Cell(range->low).text() + ":" +
                      Cell(range->high).text() + "]\n";
        }
    }
    // no marker is cut by the frame; an end near 0 stays there
    const PlotRange heights = extent(plot, y);
    const double near = 0.05 * (heights.high - heights.low);
    const bool above = !plot.y_range && (heights.high > 0 || heights.high < -near);
    const bool below = !plot.y_range && (heights.low < 0 || heights.low > near);
    const auto margin = [](bool wanted) { return std::string(wanted ? "graph 0.02" : "0"); };
    return script + "set offsets " + margin(!plot.x_range) + ", " + margin(!plot.x_range) + ", " + margin(above) +
           ", " + margin(below) + "\n";
}

// --- what the axes cannot show -------------------------------------------------------------------------------------

/// Arrows at the frame to points beyond given ranges: of markers, and of lines without a point in view.
Series arrows_to_hidden(const Plot& plot) {
    Series arrows{.shape = Shape::arrows};
    const auto axes = axes_of(plot);
    const auto beyond = [&](const PlotAxis& axis, const Point& point) {
        const auto& range = plot.*axis.range;
        const double share = range ? axis.share(point.*axis.coordinate, *range) : 0;
        return share < -1e-9 || share > 1 + 1e-9;
    };
    const auto is_hidden = [&](const Point& point) {
        return beyond(axes[0], point) ? !plot.x_is_part : beyond(axes[1], point);
    };
    for (const Series& series : plot.series) {
        if (series.reference || series.shape != Shape::curve) continue;
        std::vector<Point> hidden, placed;
        for (const Point& point : series.points) {
            if (has_place(plot, point)) placed.push_back(point);
        }
        std::copy_if(placed.begin(), placed.end(), std::back_inserter(hidden), is_hidden);
        if (!series.markers && placed.size() > 1 && hidden.size() < placed.size()) continue;  // the line shows where
        for (Point head : hidden) {
            Point tail = head;
            for (const PlotAxis& axis : axes) {
                const auto& range = plot.*axis.range;
                if (!range) continue;
                const double share = axis.share(head.*axis.coordinate, *range);
                const double end = std::clamp(share, 0.0, 1.0);
                head.*axis.coordinate = axis.at_share(end, *range);
                tail.*axis.coordinate = axis.at_share(share < end ? 0.035 : share > end ? 0.965 : end, *range);
            }
            arrows.points.push_back(tail);
            arrows.points.push_back(head);
        }
    }
    arrows.label = std::to_string(arrows.points.size() / 2) + " beyond the frame";
    arrows.reference = true;
    return arrows;
}

/// The title's words on values that no point shows: undefined ones, and ones that a logarithmic axis lacks.
std::string missing_values(const Plot& plot) {
    std::size_t missing = 0, all = 0;
    for (const Series& series : plot.series) {
        if (series.reference || series.shape != Shape::curve) continue;
        for (const Point& point : series.points) {
            if (!std::isfinite(point.first) && std::isfinite(point.second)) continue;  // between two lines
            ++all;
            if (!has_place(plot, point)) ++missing;
        }
    }
    return missing == 0 ? "" : std::to_string(missing) + " of " + std::to_string(all) + " values cannot be drawn";
}

/// The points of a line without a neighbour to join them to.
std::vector<Point> isolated_points(const Plot& plot, const Series& series) {
    std::vector<Point> found;
    const auto& points = series.points;
    const auto is_placed = [&](std::size_t i) { return i < points.size() && has_place(plot, points[i]); };
    for (std::size_t i = 0; i < points.size(); ++i) {
        if (is_placed(i) && !is_placed(i + 1) && (i == 0 || !is_placed(i - 1))) found.push_back(points[i]);
    }
    return found;
}

// --- gnuplot's commands --------------------------------------------------------------------------------------------

/// The number of characters of a text that are shown: the marks of subscripts are not.
std::ptrdiff_t shown_length(std::string_view text) {
    return std::count_if(text.begin(), text.end(), [](char c) {
        return (static_cast<unsigned char>(c) & 0xC0) != 0x80 && c != '_' && c != '{' && c != '}' && c != '^';
    });
}

/// A text in lines of at most `widest` characters, if commas and semicolons allow it: that is where they end.
std::vector<std::string> broken(std::string_view text, std::ptrdiff_t widest) {
    std::vector<std::string> lines;
    for (std::size_t from = 0; from < text.size();) {
        const auto next = [&](std::size_t at) { return std::min(text.find_first_of(",;", at), text.size()); };
        std::size_t end = next(from);
        while (end < text.size() && shown_length(text.substr(from, next(end + 1) - from)) < widest) end = next(end + 1);
        lines.emplace_back(text.substr(from, end + 1 - from));
        from = std::min(text.find_first_not_of(' ', end + 1), text.size());
    }
    return lines;
}

/// The lines of a title, no more than the picture's width asks for, and about equally long.
std::vector<std::string> title_lines(std::string_view title) {
    constexpr std::ptrdiff_t widest = 52;
    const std::size_t least = broken(title, widest).size();
    std::ptrdiff_t narrow = widest;
    while (narrow > 1 && broken(title, narrow - 1).size() == least) --narrow;
    return broken(title, narrow);
}

/// Colour, dashes and markers of a series. References are black.
std::string style_of(const Series& given, std::size_t style) {
    Series series = given;
    const bool single = given.points.size() == 1;
    series.markers = given.markers || single;
    series.open = given.open || (single && given.reference);  // it may lie on another
    constexpr std::array colours{"#0072B2", "#D55E00", "#009E73", "#CC79A7", "#E69F00", "#56B4E9",
                                 "#332288", "#882255", "#999933", "#777777", "#8B4513", "#AA4499"};
    constexpr std::array dashes{"1", "(12,6)", "(3,4)", "(12,5,3,5)", "(20,6,6,6)"};
    constexpr std::array filled{7, 5, 9, 13, 11, 15};
    constexpr std::array open{6, 4, 8, 12, 10, 14};
    const std::string colour =
        std::string(" lc rgb '") + (series.reference ? "#000000" : colours[style % colours.size()]) + "'";
    if (!given.values.empty()) return "boxxyerror lc palette fs solid 1 noborder";
    if (given.shape == Shape::rectangles) return "boxxyerror" + colour + " fs solid 0.5 border rgb '#ffffff'";
    if (given.shape == Shape::arrows) return "vectors head filled size graph 0.012,20 lw 1.2" + colour;
    if (given.alarm) return "points pt 2 ps 1.8 lw 3 lc rgb '#D55E00'";
    // the markers of a seventh curve have the shape of the first one's
    const bool shows_through = series.open || (series.line && style >= filled.size());
    std::string text = !series.markers ? "lines" : series.line ? "linespoints" : "points";
    text += (series.line ? " lw 2" : " lw 1") + colour;
    if (series.line) text += " dt " + std::string(dashes[(style + (series.reference ? 1 : 0)) % dashes.size()]);
    if (series.markers) text += " pt " + std::to_string((shows_through ? open : filled)[style % open.size()]);
    if (series.markers && shows_through) text += series.reference ? " ps 0.9" : " ps 1.2";
    return text;
}

/// Lines for gnuplot: points, rectangles by middle and half sides, or arrows by tail and components.
std::string data_of(const Plot& plot, const Series& series) {
    std::string text;
    const auto add = [&](const Row& numbers) {
        for (const Cell& number : numbers) text += number.text() + " ";
        text += "\n";
    };
    for (std::size_t i = 0; i < series.points.size(); ++i) {
        const auto [x, y] = series.points[i];
        if (series.shape == Shape::curve) {  // an empty line interrupts the curve, two would end it
            if (has_place(plot, {x, y})) {
                add({x, y});
            } else if (text.rfind("\n\n") != text.size() - 2) {
                text += "\n";
            }
            continue;
        }
        if (++i == series.points.size()) break;
        const double dx = series.points[i].first - x, dy = series.points[i].second - y;
        if (series.shape == Shape::arrows) add({x, y, dx, dy});
        if (series.shape == Shape::rectangles) {
            Row numbers{x + dx / 2, y + dy / 2, std::abs(dx) / 2, std::abs(dy) / 2};
            if (!series.values.empty()) numbers.emplace_back(series.values[i / 2]);
            add(numbers);
        }
    }
    return text;
}

/// The title with a note on values that are not drawn.
std::string title_of(const Plot& plot) {
    std::string title = plot.title;
    const auto add = [&](const std::string& between, const std::string& note) {
        if (!note.empty()) title += (title.empty() ? "" : between) + note;
    };
    add("; ", missing_values(plot));
    return title;
}

// --- panels --------------------------------------------------------------------------------------------------------

// A picture is one column of a page wide, 85 mm: its text is then printed in 7 points.
constexpr double width = 600, font = 18, line_height = 27;
constexpr double character = 0.6 * font;
constexpr double left = 122;  // of the frame: marks and label of the y axis

bool shows(const Plot& plot, const Series& series) {
    return std::any_of(series.points.begin(), series.points.end(),
                       [&](const Point& point) { return has_place(plot, point); });
}

void require_few_curves(const Plot& plot) {
    const auto labelled =
        static_cast<std::size_t>(std::count_if(plot.series.begin(), plot.series.end(), [&](const Series& series) {
            return shows(plot, series) && !series.label.empty() && !series.reference && !series.alarm;
        }));
    if (labelled <= most_curves) return;
    throw PlotError("the plot would have " + std::to_string(labelled) + " curves, of which at most " +
                    std::to_string(most_curves) + " can be told apart; give fewer values of what is not along x");
}

struct EndLabel {
    double height;  ///< along the y axis
    std::string text;
};

/// Labels of two to five curves where they end, at the right of the frame; none where a legend serves better: ends lie
/// elsewhere or too near to one another, or labels are long.
std::vector<EndLabel> end_labels(const Plot& plot) {
    constexpr std::size_t most = 5;
    constexpr double apart = 0.09, furthest = 0.06;  // shares of the frame's height: a line, and how far one may move
    const auto [x, y] = axes_of(plot);
    const PlotRange wide = plot.x_range.value_or(extent(plot, x)), high = plot.y_range.value_or(extent(plot, y));
    std::vector<EndLabel> labels;
    for (const Series& series : plot.series) {
        if (series.label.empty() || !shows(plot, series)) continue;
        std::optional<Point> end;
        for (const Point& point : series.points) {
            if (has_place(plot, point) && x.share(point.first, wide) < 1.001) end = point;
        }
        if (!end) return {};
        const double height = y.share(end->second, high);
        const bool ends_at_frame = x.share(end->first, wide) > 0.97 && height >= 0 && height <= 1;
        const bool is_line = series.shape == Shape::curve && series.line && !series.alarm && series.points.size() > 1;
        if (!is_line || !ends_at_frame || shown_length(series.label) > 17) return {};
        labels.push_back({end->second, series.label});
    }
    if (labels.size() < 2 || labels.size() > most) return {};
    std::sort(labels.begin(), labels.end(), [&, &along = y](const EndLabel& one, const EndLabel& other) {
        return along.share(one.height, high) < along.share(other.height, high);
    });
    double lowest = -1;
    for (EndLabel& label : labels) {
        const double share = y.share(label.height, high);
        if (lowest - share > furthest) return {};
        label.height = y.at_share(std::max(share, lowest), high);
        lowest = std::max(share, lowest) + apart;
    }
    return labels;
}

std::string label_commands(const std::vector<EndLabel>& labels) {
    std::string script;
    for (const auto& [height, text] : labels) {
        script += "set label " + gnuplot_string(text) + " at graph 1.02, first " + Cell(height).text() + " left\n";
    }
    return script;
}

double longest(const std::vector<std::string>& texts) {
    std::ptrdiff_t most = 0;
    for (const std::string& text : texts) most = std::max(most, shown_length(text));
    return double(most);
}

struct Legend {
    std::set<std::string> listed{};  ///< label and style of the entries of this panel and those above
    std::vector<std::string> labels{};

    /// The words that list a curve in gnuplot's command: a panel need not repeat an entry of a panel above it.
    std::string title_of(const std::string& label, const std::string& style) {
        if (label.empty() || !listed.insert(label + style).second) return " notitle";
        labels.push_back(label);
        return " title " + gnuplot_string(label);
    }
    /// The characters by which gnuplot overestimates an entry, which it takes for as wide as its text and seven
    /// characters: letters are narrower.
    double excess() const { return 0.15 * longest(labels); }
    std::size_t columns() const {
        const double entry = 0.7 * font * (longest(labels) - excess() + 7);
        return std::clamp<std::size_t>(std::size_t(width / entry), 1, 4);
    }
    std::size_t rows() const { return (labels.size() + columns() - 1) / columns(); }
    double height() const { return labels.empty() ? 0 : line_height * double(rows()) + 12; }

    /// gnuplot would choose the columns by the frame: in this way it does not.
    std::string layout() const {
        if (labels.empty()) return "set key off\n";
        const std::string rows_of_columns = "vertical maxrows " + std::to_string(rows());
        return "set key center top Left reverse samplen 3 width " + Cell(1 - excess()).text(3) + " " +
               (columns() > 1 ? rows_of_columns : "horizontal maxcols 1") + "\n";
    }
};

/// The series as data, and gnuplot's commands that draw them.
std::vector<std::string> curve_commands(const Plot& plot, std::string& script, Legend& legend) {
    std::vector<std::string> commands;
    std::size_t curves = 0, references = 0;
    for (const Series& series : plot.series) {
        const std::size_t style = series.style.value_or(series.reference ? references++ : curves++);
        if (!shows(plot, series)) continue;
        const auto add = [&](const Series& one, const std::string& label) {
            const std::string data = "$data" + std::to_string(commands.size()), drawn = style_of(one, style);
            script += data + " << EOD\n" + data_of(plot, one) + "EOD\n";
            commands.push_back(data + " with " + drawn + legend.title_of(label, drawn));
        };
        add(series, series.label);
        Series points = series;
        points.points = isolated_points(plot, series);
        const bool lost = !series.markers && series.shape == Shape::curve && !points.points.empty();
        points.line = false, points.markers = true;
        if (lost && series.points.size() > 1) add(points, "");
    }
    return commands;
}

/// Commands of a panel, and the space around its frame.
struct Panel {
    std::string script, plot;
    double above, height, below, beside;
};

/// The height of a frame: as usual, or to scale what its ranges ask for.
double frame_height(const Plot& plot, double frame_width) {
    constexpr double usual = 280, least = 100, most = 480;
    if (!plot.true_scale) return usual;
    const double wide = std::abs(plot.x_range->high - plot.x_range->low);
    return std::clamp(frame_width * std::abs(plot.y_range->high - plot.y_range->low) / wide, least, most);
}

/// Title, axes and colours.
std::string frame_commands(Plot& plot, const std::vector<std::string>& title) {
    std::vector<std::string> quoted;
    for (const std::string& text : title) quoted.push_back(gnuplot_string(text));
    std::string script = "set title " + (title.empty() ? "''" : join(quoted, ".\"\\n\".")) + "\nset xlabel " +
                         gnuplot_string(plot.x_label) + " offset 0,0.4\nset label " + gnuplot_string(plot.y_label) +
                         " center rotate at screen 0.035, graph 0.5" +
                         "\nset grid lt 1 lc rgb '#dddddd' lw 1\nset autoscale xfix\nset format '%h'\n" +
                         axis_commands(plot);
    if (plot.z_label.empty()) return script;
    return script +
           "set palette defined (0 '#f7fbff', 0.001 '#c6dbef', 0.5 '#2171b5', 1 '#08306b')\nset cbrange [0:1]\n"
           "set cbtics 0.5\nset mcbtics 5\n"
           "set cblabel " +
           gnuplot_string(plot.z_label) + " offset 0.5,0\n";
}

Panel panel_of(Plot plot, Legend& legend) {
    if (!can_be_drawn(plot)) throw PlotError("the plot has no point to draw");
    require_few_curves(plot);
    const std::vector<std::string> title = title_lines(title_of(plot));
    std::string script = frame_commands(plot, title);
    plot.series.push_back(arrows_to_hidden(plot));
    const std::vector<EndLabel> ends = end_labels(plot);
    legend.labels.clear();
    Legend shown = legend, none;
    const std::vector<std::string> commands = curve_commands(plot, script, ends.empty() ? shown : none);
    if (commands.size() > 1) legend = shown;  // otherwise title and axes say it all
    script += legend.layout();
    std::vector<std::string> texts;
    for (const EndLabel& end : ends) texts.push_back(end.text);
    const double beside = !plot.z_label.empty() ? 110 : ends.empty() ? 25 : character * longest(texts) + 20;
    return {script + label_commands(ends),
            "plot " + join(commands, ", ") + "\n",
            title.empty() ? 20 : 34 + line_height * double(title.size()),
            frame_height(plot, width - left - beside),
            75 + legend.height(),
            beside};
}

std::string gnuplot_script(const Plot& plot, bool png) {
    Legend legend;
    std::vector<Panel> panels{panel_of(plot, legend)};
    for (const Plot& panel : plot.below) panels.push_back(panel_of(panel, legend));
    double height = 0;
    for (const Panel& panel : panels) height += panel.above + panel.height + panel.below;
    const double pixels = png ? 5.0 / 3 : 1;
    const std::string size = "size " + std::to_string(std::lround(pixels * width)) + "," +
                             std::to_string(std::lround(pixels * height)) + " ";
    std::string script = "set encoding utf8\n";
    if (png) {
        script += "set terminal pngcairo " + size +
                  "enhanced font 'sans,22.5' linewidth 1.7 dashlength 1.3 pointscale 2.2 background '#ffffff'\n";
    } else {
        script += "set terminal svg " + size + "enhanced font 'sans-serif,18' background '#ffffff'\n";
    }
    script += "set multiplot\n";
    const auto share = [](double part) { return " screen " + Cell(part).text(6); };
    double top = height;  // of what is left
    for (const Panel& panel : panels) {
        const double bottom = top - panel.above - panel.height;
        script += "reset\nset lmargin at" + share(left / width) + "\nset rmargin at" + share(1 - panel.beside / width) +
                  "\nset tmargin at" + share((top - panel.above) / height) + "\nset bmargin at" +
                  share(bottom / height) + "\nset key at" + share(0.5) + "," + share((bottom - 72) / height) + "\n" +
                  panel.script + panel.plot;
        top = bottom - panel.below;
    }
    return script + "unset multiplot\n";
}

/// The output of gnuplot for `script`. It goes through a pipe, not into the file: gnuplot does not report a failure to
/// write.
std::string run_gnuplot(const std::string& script, const std::string& path) {
    const auto require = [&](bool done, const std::string& why) {
        if (!done) throw PlotError("--plot = " + path + why + "; the rows are written");
    };
    std::FILE* const commands = std::tmpfile();
    require(commands != nullptr, std::string(": no temporary file: ") + std::strerror(errno));
    std::fwrite(script.data(), 1, script.size(), commands);
    std::rewind(commands);
    const std::string command = "exec gnuplot /dev/fd/" + std::to_string(::fileno(commands)) + " 2>/dev/null";
    std::FILE* const pipe = ::popen(command.c_str(), "r");
    std::string picture;
    std::array<char, 65536> buffer;
    while (pipe != nullptr) {
        const std::size_t count = std::fread(buffer.data(), 1, buffer.size(), pipe);
        picture.append(buffer.data(), count);
        if (count == 0) break;
    }
    const int status = pipe != nullptr ? ::pclose(pipe) : -1;
    std::fclose(commands);
    require(!WIFEXITED(status) || WEXITSTATUS(status) != 127, " needs gnuplot, which cannot be started");
    require(status == 0, ": gnuplot failed");
    return picture;
}

}  // namespace

bool can_be_drawn(const Plot& plot) {
    return std::any_of(plot.series.begin(), plot.series.end(), [&](const Series& series) {
        return std::any_of(series.points.begin(), series.points.end(),
                           [&](const auto& point) { return has_place(plot, point); });
    });
}

std::string picture(const Plot& plot, bool png, const std::string& path) {
    using namespace std::string_view_literals;
    std::string drawn = run_gnuplot(gnuplot_script(plot, png), path);
    if (drawn.find(png ? "\0\0\0\0IEND"sv : "</svg>"sv) == std::string::npos) {
        throw PlotError("--plot = " + path + ": gnuplot drew " + (drawn.empty() ? "nothing" : "only a part") +
                        "; the rows are written");
    }
    // gnuplot puts what follows a subscript into a part of its own, whose leading space some viewers drop
    constexpr std::string_view tag = "<text>", kept = "<text xml:space=\"preserve\">";
    for (std::size_t i = 0; !png && (i = drawn.find(tag, i)) != std::string::npos; i += kept.size()) {
        drawn.replace(i, tag.size(), kept);
    }
    return drawn;
}

}  // namespace study
