// Pictures as scripts for gnuplot, and what it draws.
#include <algorithm>
#include <array>
#include <cerrno>
#include <cmath>
#include <cstdio>
#include <map>
#include <set>
#include <string_view>

#include <sys/wait.h>

#include "plot.hpp"

namespace study {

namespace {

using Point = std::pair<double, double>;

// --- styles --------------------------------------------------------------------------------------------------------

/// What all panels share: twelve line types in colours, the same with open markers, and in black. A seventh marker has
/// the shape of the first one, open.
constexpr std::string_view line_types =
    R"(colours = "#0072B2 #D55E00 #009E73 #CC79A7 #E69F00 #56B4E9 #332288 #882255 #999933 #777777 #8B4513 #AA4499"
array open[6] = [6, 4, 8, 12, 10, 14]
set dashtype 2 (12,6)
set dashtype 3 (3,4)
set dashtype 4 (12,5,3,5)
set dashtype 5 (20,6,6,6)
set for [k=0:11] linetype k+1 lc rgb word(colours, k+1) dt 1+k%5 pt (open[k%6+1]+(k<6)) ps (k<6 ? 1 : 1.2)
set for [k=0:11] linetype k+13 lc rgb word(colours, k+1) pt open[k%6+1] ps 1.2
set for [k=0:11] linetype k+25 lc rgb '#000000' dt 1+(k+1)%5 pt open[(k+2)%6+1] ps 0.9
set multiplot
)";

/// What a panel starts with.
constexpr std::string_view frame = R"(reset
set format '%h'
set grid lt 1 lc rgb '#dddddd' lw 1
set key off
set palette defined (0 '#f7fbff', 0.5 '#2171b5', 1 '#08306b')
set cbrange [0:1]
set cbtics 0.5
set mcbtics 5
)";

/// How gnuplot draws a look.
struct Style {
    std::string with;      ///< with @ for the number of a line type
    int line_type = 0;     ///< the first one, of which each label has its own; 0 for none
    bool compared = true;  ///< results; others serve for comparison or orientation
    std::string columns = "1:2";
    std::size_t points_in_row = 1;
};

const Style& style_of(Look look) {
    static const std::string corners = "(($1+$3)/2):(($2+$4)/2):1:3:2:4",
                             filled = "boxxyerror fs solid 0.5 border rgb '#ffffff' lc rgb ",
                             arrows = "vectors head filled size graph 0.012,20 lw 1.2 dt 1 lc rgb '#000000'";
    static const std::map<Look, Style> styles{
        {Look::curve, {"linespoints lt @ lw 2", 1}},
        {Look::markers, {"points lt @", 13}},
        {Look::crosses, {"points pt 2 ps 1.8 lw 3 lc rgb '#882255'", 0, false}},
        {Look::exact, {"lines lt @ lw 2", 25, false}},
        {Look::exact_markers, {"points lt @", 25, false}},
        {Look::outline, {"lines lw 2 dt 1 lc rgb '#000000'", 0, false}},
        {Look::stick, {"points pt 7 lc rgb '#332288'"}},
        {Look::slip, {"points pt 5 lc rgb '#E69F00'"}},
        {Look::stick_cells, {filled + "'#0072B2' dt 1", 0, false, corners, 2}},
        {Look::slip_cells, {filled + "'#E69F00' dt 1", 0, false, corners, 2}},
        {Look::cells, {"boxxyerror lc palette fs solid 1 noborder", 0, false, corners + ":5", 2}},
        {Look::empty_cells, {"boxxyerror fs pattern 4 border rgb '#777777' lc rgb '#777777'", 0, false, corners, 2}},
        {Look::arrows, {arrows, 0, false, "1:2:($3-$1):($4-$2)", 2}}};
    return styles.at(look);
}

std::string quoted(std::string text) {
    for (std::size_t i = text.find('\''); i != std::string::npos; i = text.find('\'', i + 2)) text.insert(i, 1, '\'');
    return "'" + text + "'";
}

/// The number of characters of a text that are shown: the marks of subscripts are not.
std::size_t shown_length(std::string_view text) {
    return std::size_t(std::count_if(text.begin(), text.end(), [](char c) {
        return (static_cast<unsigned char>(c) & 0xC0) != 0x80 && c != '_' && c != '{' && c != '}' && c != '^';
    }));
}

/// A text in lines of at most `widest` characters, if commas and semicolons allow it: that is where they end.
std::vector<std::string> broken(std::string_view text, std::size_t widest) {
    std::vector<std::string> lines;
    while (!text.empty()) {
        const std::string part(text.substr(0, std::min(text.find_first_of(",;"), text.size() - 1) + 1));
        text.remove_prefix(part.size());
        const bool fits = !lines.empty() && shown_length(lines.back() + part) <= widest;
        fits ? lines.back() += part : lines.emplace_back(part, std::min(part.find_first_not_of(' '), part.size()));
    }
    return lines;
}

/// The lines of a title, no more than the picture's width asks for, and about equally long.
std::vector<std::string> title_lines(std::string_view title) {
    std::size_t widest = 52;
    const std::size_t least = broken(title, widest).size();
    while (widest > 1 && broken(title, widest - 1).size() == least) --widest;
    return broken(title, widest);
}

// --- axes ----------------------------------------------------------------------------------------------------------

bool has_place(const Plot& plot, const Point& point) {
    return std::isfinite(point.first) && std::isfinite(point.second) && (!plot.x.logarithmic || point.first > 0) &&
           (!plot.y.logarithmic || point.second > 0);
}

std::vector<Point> placed(const Plot& plot, const Series& series) {
    std::vector<Point> points;
    for (const Point& point : series.points) {
        if (has_place(plot, point)) points.push_back(point);
    }
    return points;
}

/// The place of a value along its axis: 0 ... 1 in the frame.
double share(const PlotAxis& axis, double value) {
    const auto place = [&](double at) {
        return axis.logarithmic ? std::log10(at) : axis.linear_within > 0 ? std::asinh(at / axis.linear_within) : at;
    };
    return (place(value) - place(axis.range->low)) / (place(axis.range->high) - place(axis.range->low));
}

bool is_in_frame(double share) { return share > -1e-9 && share < 1 + 1e-9; }

/// Values and a margin. An end near 0 lies there; equal values lie in the middle, but for what is rounding.
PlotRange with_margin(double low, double high, bool logarithmic) {
    if (logarithmic) {
        const double factor = high < 1.02 * low ? 2 : std::pow(high / low, 0.05);
        return {low / factor, high * factor};
    }
    const double most = std::max(std::abs(low), std::abs(high)), margin = 0.04 * (high - low);
    if (most < 1e-13) return {-1, 1};
    if (high - low < 1e-9 * most) return {low - most / 10, high + most / 10};
    return {low >= 0 && low <= margin ? 0 : low - margin, high <= 0 && high >= -margin ? 0 : high + margin};
}

/// Few whole numbers, or parts of one: they are marked.
bool are_few(const std::set<double>& values) {
    const auto is_whole = [](double value) { return value == std::round(value) && value < 1e4; };
    return values.size() <= 8 && std::all_of(values.begin(), values.end(),
                                             [&](double value) { return is_whole(value) || is_whole(1 / value); });
}

/// The scale of a logarithmic axis, with marks at the values if these are few, none on top of another; otherwise
/// gnuplot's, or over less than two powers of ten more of them.
std::string logarithmic(const std::string& name, const PlotRange& range, const std::set<double>& values) {
    const double ratio = *values.rbegin() / *values.begin();
    std::string script = "set logscale " + name + " 10\n";
    if (are_few(values)) {
        double last = 0;
        script += "set " + name + "tics ()\n";
        for (const double value : values) {
            if (last > 0 && std::log(value / last) < 0.08 * std::log(ratio)) continue;
            script += "set " + name + "tics add (" + Cell(last = value).text() + ")\n";
        }
    } else if (ratio < 100) {
        script += "set " + name + "tics ()\nset for [k=-30:30] for [d in '" + (ratio < 10 ? "1 2 3 5 7" : "1 2 5") +
                  "'] " + name + "tics add (d*10.0**k)\n";
    } else if (range.low < 1e-4) {
        script += "set format " + name + " '10^{%T}'\n";
    }
    return script;
}

/// An axis that is linear near 0 and logarithmic beyond, with marks at powers of ten of either sign.
std::string both_logarithms(const std::string& x, const PlotAxis& axis) {
    const std::string within = Cell(axis.linear_within).text();
    const bool nearly_linear =
        std::max(std::abs(axis.range->low), std::abs(axis.range->high)) < 10 * axis.linear_within;
    return "set nonlinear " + x + " via asinh(" + x + "/" + within + ") inverse " + within + "*sinh(" + x + ")\n" +
           (nearly_linear ? ""
                          : "set " + x + "tics (0)\nset for [k=ceil(log10(" + within + ")):15] for [sign in '-1 1'] " +
                                x + "tics add (sign*10.0**k)\n");
}

/// Settles what an axis leaves open, along y by points within a given range of x, and writes its commands. A
/// logarithmic axis is linear over less than a factor of 3 unless the values have marks.
std::string settle(const std::string& name, PlotAxis& axis, const Plot& plot, double Point::*coordinate) {
    std::set<double> values;
    for (const Series& series : plot.series) {
        for (const Point& point : placed(plot, series)) {
            if (name == "x" || is_in_frame(share(plot.x, point.first))) values.insert(point.*coordinate);
        }
    }
    if (values.empty()) values = {1};
    const double low = *values.begin(), high = *values.rbegin();
    axis.logarithmic = axis.logarithmic && (high >= 3 * low || high < 1.02 * low || are_few(values));
    if (!axis.range) axis.range = with_margin(low, high, axis.logarithmic);
    if (name == "y" && plot.y_down) std::swap(axis.range->low, axis.range->high);
    return "set " + name + "range [" + Cell(axis.range->low).text() + ":" + Cell(axis.range->high).text() + "]\n" +
           (axis.logarithmic         ? logarithmic(name, *axis.range, values)
            : axis.linear_within > 0 ? both_logarithms(name, axis)
                                     : "");
}

/// Lengths to scale have marks as far apart along either axis.
std::string to_scale(const Plot& plot) {
    const auto length = [](const PlotRange& range) { return std::abs(range.high - range.low); };
    const double apart = std::max(length(*plot.x.range), length(*plot.y.range)) / 10;
    double step = std::pow(10, std::floor(std::log10(apart)));
    for (const double factor : {2.0, 2.5, 2.0}) step *= step < apart ? factor : 1;
    return "set size ratio -1\nset xtics " + Cell(step).text(6) + "\nset ytics " + Cell(step).text(6) + "\n";
}

/// Raises zeros to the least value of a logarithmic axis, and marks that as a line: results can be exact.
void raise_zeros(Plot& plot) {
    const double least = plot.y.least;
    std::set<double> places;
    bool any = false;
    for (Series& series : plot.series) {
        for (auto& [x, y] : series.points) {
            if (!std::isfinite(x) || !(y >= 0)) continue;
            places.insert(x);
            any = any || y < least;
            y = std::max(y, least);
        }
    }
    if (!any) return;
    plot.series.push_back(
        {Cell(least).text() + " or less", Look::exact, {{*places.begin(), least}, {*places.rbegin(), least}}});
}

// --- what the axes cannot show -------------------------------------------------------------------------------------

/// Arrows at the frame to points beyond it: of markers, and of lines without a point in view. `count` becomes their
/// number.
std::string arrows_to_hidden(const Plot& plot, std::size_t& count) {
    std::string script;
    for (const Series& series : plot.series) {
        if (!style_of(series.look).compared) continue;
        const std::vector<Point> points = placed(plot, series);
        std::vector<Point> hidden;  // as shares
        for (const auto& [x, y] : points) {
            const Point at{share(plot.x, x), share(plot.y, y)};
            if (!is_in_frame(at.first) || !is_in_frame(at.second)) hidden.push_back(at);
        }
        if (series.look == Look::curve && hidden.size() < points.size()) continue;  // the line shows where
        count += hidden.size();
        for (const Point& at : hidden) {
            const auto place = [&](double within) {
                const auto end = [&](double of) { return std::clamp(of, 0.0, 1.0); };
                const auto moved = [&](double of) { return of == end(of) ? of : std::clamp(of, within, 1 - within); };
                return "graph " + Cell(moved(at.first)).text(4) + "," + Cell(moved(at.second)).text(4);
            };
            script +=
                "set arrow from " + place(0.035) + " to " + place(0) + " head filled size graph 0.012,20 lw 1.2\n";
        }
    }
    return script;
}

/// The title's words on values that no point shows: undefined ones, and ones that a logarithmic axis lacks.
std::string missing_values(const Plot& plot) {
    std::size_t missing = 0, all = 0;
    for (const Series& series : plot.series) {
        for (const Point& point : series.points) {
            const bool ends_line = !std::isfinite(point.first) && std::isfinite(point.second);
            if (ends_line || !style_of(series.look).compared) continue;
            ++all;
            if (!has_place(plot, point)) ++missing;
        }
    }
    return missing == 0 ? ""
                        : "; " + std::to_string(missing) + " of " + std::to_string(all) + " values cannot be drawn";
}

void require_few_curves(const Plot& plot) {
    const auto count = std::count_if(plot.series.begin(), plot.series.end(),
                                     [](const Series& series) { return style_of(series.look).compared; });
    if (count <= std::ptrdiff_t(most_curves)) return;
    throw PlotError("the plot would have " + std::to_string(count) + " curves, of which at most " +
                    std::to_string(most_curves) + " can be told apart; give fewer values of what is not along x");
}

// --- panels --------------------------------------------------------------------------------------------------------

// A picture is one column of a page wide, 85 mm: its text is then printed in 7 points.
constexpr double picture_width = 600, line_height = 27;
constexpr double character = 0.6 * 18;  // of the font

/// Of the frame: marks and label of the y axis on the left; labels of curves or the bar of colours on the right.
struct Margins {
    double left = 0, right = 0;
};

/// A panel while its script is written.
struct Panel {
    Margins needs{};
    std::string data{}, script{};
    std::vector<std::string> commands{}, legend{};
    double above = 0, frame = 0, height = 0;  ///< of what is above the frame, of the frame, and of all
};

/// What panels know of those above: the title, the labels by their first line type, and what legends list.
struct Above {
    std::string title{};
    std::map<int, std::vector<std::string>> labels{};
    std::set<std::string> listed{};
};

double longest(const std::vector<std::string>& texts) {
    std::size_t most = 0;
    for (const std::string& text : texts) most = std::max(most, shown_length(text));
    return character * double(most);
}

/// Labels of two to five curves where they end, at the right of the frame, by their heights in it; none where a legend
/// serves better: ends lie elsewhere or too near to one another, or labels are long.
std::map<double, std::string> end_labels(const Plot& plot) {
    constexpr double apart = 0.09, furthest = 0.06;  // a line, and how far one may move
    std::multimap<double, std::string> ends;
    for (const Series& series : plot.series) {
        double along = 0, height = -1;
        for (const auto& [x, y] : placed(plot, series)) {
            if (!is_in_frame(share(plot.x, x))) continue;
            along = share(plot.x, x);
            height = share(plot.y, y);
        }
        const bool is_line = (series.look == Look::curve || series.look == Look::exact) && series.points.size() > 1;
        if (!is_line || along < 0.94 || !is_in_frame(height) || shown_length(series.label) > 17) return {};
        ends.emplace(height, series.label);
    }
    if (ends.size() < 2 || ends.size() > 5) return {};
    std::map<double, std::string> labels;
    double least = 0;
    for (const auto& [height, text] : ends) {
        if (least - height > furthest) return {};
        labels[std::max(height, least)] = text;
        least = std::max(height, least) + apart;
    }
    return labels;
}

/// Lines for gnuplot; not a number interrupts a curve.
std::string data_of(const Series& series) {
    const std::size_t in_row = style_of(series.look).points_in_row;
    std::string text;
    for (std::size_t i = 0; i < series.points.size(); ++i) {
        for (const double number : {series.points[i].first, series.points[i].second}) {
            text += std::isfinite(number) ? Cell(number).text() + " " : "NaN ";
        }
        const bool has_value = (i + 1) % in_row == 0 && !series.values.empty();
        text += (has_value ? Cell(series.values[i / in_row]).text() : "") + ((i + 1) % in_row == 0 ? "\n" : "");
    }
    return text;
}

/// The words of gnuplot for a series: few points of a line have markers, and those of an interrupted one, as they may
/// have no neighbours.
std::string words_of(const Plot& plot, const Series& series, Above& above) {
    constexpr std::ptrdiff_t most_markers = 30;
    const Style& style = style_of(series.look);
    std::string with = style.with;
    const auto replace = [&](std::string_view from, const std::string& to) {
        if (const std::size_t at = with.find(from); at != std::string::npos) with.replace(at, from.size(), to);
    };
    const std::string& label = series.styled_as.empty() ? series.label : series.styled_as;
    const std::vector<Point> points = placed(plot, series);
    const auto in_view = std::count_if(points.begin(), points.end(),
                                       [&](const Point& point) { return is_in_frame(share(plot.x, point.first)); });
    if (points.size() == series.points.size() && in_view > most_markers) replace("linespoints", "lines");
    if (series.points.size() == 1) replace("lines ", "points ");
    if (style.line_type > 0) {
        auto& labels = above.labels[style.line_type];
        if (!contains(labels, label)) labels.push_back(label);
        replace("@", std::to_string(style.line_type + int(index_of(labels, label) % most_curves)));
    }
    return with;
}

/// Adds the series, and the entries of a legend that none above has, if it shall have one.
void add_curves(Panel& panel, const Plot& plot, bool legend, Above& above) {
    for (const Series& series : plot.series) {
        const std::string name = "$data" + std::to_string(panel.commands.size()), with = words_of(plot, series, above);
        const bool lists = legend && !series.label.empty() && above.listed.insert(series.label + with).second;
        if (lists) panel.legend.push_back(series.label);
        panel.data += name + " << EOD\n" + data_of(series) + "EOD\n";
        panel.commands.push_back(name + " using " + style_of(series.look).columns + " with " + with +
                                 (lists ? " title " + quoted(series.label) : " notitle"));
    }
}

/// The longest text at the marks of the y axis, in letters.
double mark_length(const Plot& plot) {
    const double low = std::min(plot.y.range->low, plot.y.range->high),
                 high = std::max(plot.y.range->low, plot.y.range->high);
    if (plot.y.linear_within > 0) return 5;
    if (plot.y.logarithmic && low < 1e-4) return 5;
    const double unit = std::pow(10, std::floor(std::log10(high - low))), parts = 20 / ((high - low) / unit);
    const double step = unit * (parts > 10 ? 0.2 : parts > 4 ? 0.5 : parts > 2 ? 1 : 2);
    std::size_t most = 0;
    for (double k = std::ceil(low / step); k * step <= high && !plot.y.logarithmic; ++k) {
        most = std::max(most, Cell(k * step).text(6).size());
    }
    for (double at = std::pow(10, std::floor(std::log10(low))); at <= high && plot.y.logarithmic; at *= 10) {
        most = std::max(most, Cell(at).text(6).size());
    }
    return double(std::min<std::size_t>(most, 7));
}

/// Whether two curves differ by less than a line is wide.
bool coincide(const Plot& plot, const Series& one, const Series& other) {
    constexpr double line = 0.004;  // over the frame
    const auto is_near = [&](const Point& a, const Point& b) {
        if (!has_place(plot, a) || !has_place(plot, b)) return has_place(plot, a) == has_place(plot, b);
        return std::abs(share(plot.x, a.first) - share(plot.x, b.first)) < line &&
               std::abs(share(plot.y, a.second) - share(plot.y, b.second)) < line;
    };
    return one.look == Look::curve && other.look == Look::curve && one.points.size() > 1 &&
           std::equal(one.points.begin(), one.points.end(), other.points.begin(), other.points.end(), is_near);
}

/// "n = 20, 40" of "n = 20" and "n = 40": labels whose last words alone differ.
std::optional<std::string> joined_label(const std::string& first, const std::string& all, const std::string& label) {
    const std::size_t word = label.rfind(' ');
    if (word == std::string::npos || first.compare(0, word + 1, label, 0, word + 1) != 0) return std::nullopt;
    if (first.find(' ', word + 1) != std::string::npos) return std::nullopt;
    return all + ", " + label.substr(word + 1);
}

/// Draws curves that coincide as the first of them, if one label can name all.
void join_coinciding(Plot& plot) {
    std::vector<Series> kept;
    for (Series& series : plot.series) {
        bool joined = false;
        for (Series& same : kept) {
            if (joined || !coincide(plot, same, series)) continue;
            const std::string first = same.styled_as.empty() ? same.label : same.styled_as;
            const auto label = joined_label(first, same.label, series.label);
            if (!label) continue;
            joined = true;
            same.styled_as = first;
            same.label = *label;
        }
        if (!joined) kept.push_back(std::move(series));
    }
    plot.series = std::move(kept);
}

/// The notes, some a line or two higher, without those that would still cover one before, or repeat it.
std::string notes_of(const Plot& plot, double frame_height) {
    std::string script;
    std::vector<std::pair<Point, std::string>> drawn;  // middles in the frame and texts
    for (const PlotNote& note : plot.notes) {
        for (int line = 0; line < 3; ++line) {
            const Point at{share(plot.x, note.x), share(plot.y, note.y) + (0.9 + line) * line_height / frame_height};
            const auto is_beside = [&](const auto& other) {
                const auto letters = double(shown_length(note.text) + shown_length(other.second));
                return std::abs(other.first.first - at.first) < 0.004 + 0.0115 * letters;
            };
            const bool repeats = std::any_of(drawn.begin(), drawn.end(), [&](const auto& other) {
                return other.second == note.text && is_beside(other);
            });
            const bool has_room = std::none_of(drawn.begin(), drawn.end(), [&](const auto& other) {
                return is_beside(other) && std::abs(other.first.second - at.second) < 0.8 * line_height / frame_height;
            });
            if (repeats) break;
            if (!has_room || !is_in_frame(at.first) || !is_in_frame(at.second)) continue;
            drawn.emplace_back(at, note.text);
            script += "set label " + quoted(note.text) + " at first " + Cell(note.x).text(6) + ", first " +
                      Cell(note.y).text(6) + " center offset 0," + Cell(0.9 + line).text(2) + "\n";
            break;
        }
    }
    return script;
}

/// The commands for a legend below a frame with margins, its rows, and entries that are wider than the frame further
/// to the left.
std::string legend_of(const Panel& panel, const Margins& margins, double below_frame, std::size_t& rows) {
    constexpr double letter = 0.7 * 18, sample = 6.1 * letter;  // as gnuplot reckons when it counts columns
    rows = 0;
    if (panel.legend.empty()) return "";
    const double frame_width = picture_width - margins.left - margins.right,
                 entry = longest(panel.legend) / character * letter + sample;
    const auto columns = std::size_t(std::max(std::floor(frame_width / entry), 1.0));
    rows = (panel.legend.size() + columns - 1) / columns;
    const double wide = longest(panel.legend) + sample;
    const std::string looks = " Left reverse samplen 3 height 0.5\n";
    if (wide <= frame_width + margins.right) return "set key on below left horizontal" + looks;
    return "set key on at screen " + Cell(std::max(picture_width - wide, 0.0) / picture_width).text(4) + ", graph " +
           Cell(-below_frame / panel.frame).text(4) + " left top vertical maxcols 1" + looks;
}

/// The height of a frame: as usual, or to scale what its ranges ask for.
double frame_height(const Plot& plot, double frame_width) {
    constexpr double usual = 280, least = 100, most = 480;
    const double high = std::abs(plot.y.range->high - plot.y.range->low), wide = plot.x.range->high - plot.x.range->low;
    return plot.to_scale ? std::clamp(frame_width * high / wide, least, most) : usual;
}

/// Adds entries of the legend for labels of panels below that no curve has here.
void add_entries(Panel& panel, const std::vector<std::string>& labels, Above& above) {
    const Style& style = style_of(Look::curve);
    for (const std::string& label : labels) {
        auto& known = above.labels[style.line_type];
        if (contains(known, label)) continue;
        known.push_back(label);
        panel.legend.push_back(label);
        panel.commands.push_back("keyentry with linespoints lt " + std::to_string(known.size()) + " lw 2 title " +
                                 quoted(label));
    }
}

/// A panel within margins, and the margins that it needs; its legend has labels of curves below, too.
Panel panel_of(Plot plot, Above& above, const Margins& margins, const std::vector<std::string>& below = {}) {
    std::string title = (above.title.starts_with(plot.title) ? "" : plot.title) + missing_values(plot);
    above.title = plot.title;
    if (title.starts_with("; ")) title.erase(0, 2);
    std::erase_if(plot.series, [&](const Series& series) { return placed(plot, series).empty(); });
    require_few_curves(plot);
    Panel panel{.script = settle("x", plot.x, plot, &Point::first)};
    panel.script += settle("y", plot.y, plot, &Point::second);
    join_coinciding(plot);
    panel.frame = frame_height(plot, picture_width - margins.left - margins.right);
    panel.script += notes_of(plot, panel.frame);
    std::size_t hidden = 0;
    panel.script += arrows_to_hidden(plot, hidden);
    const bool only_legend = hidden > 0 || !below.empty() || plot.shares_legend;
    const std::map<double, std::string> ends = only_legend ? std::map<double, std::string>{} : end_labels(plot);
    add_curves(panel, plot, ends.empty() && !plot.shares_legend && (plot.series.size() > 1 || hidden > 0), above);
    add_entries(panel, below, above);
    if (hidden > 0) {
        panel.legend.push_back(std::to_string(hidden) + " beyond the frame");
        panel.commands.push_back("keyentry with " + style_of(Look::arrows).with + " title " +
                                 quoted(panel.legend.back()));
    }
    std::vector<std::string> texts, lines = title_lines(title);
    for (const auto& [height, text] : ends) {
        texts.push_back(text);
        panel.script += "set label " + quoted(text) + " at graph 1.02, graph " + Cell(height).text(4) + " left\n";
    }
    panel.needs = {48 + character * mark_length(plot), !plot.colours.empty() ? 110
                                                       : ends.empty()        ? (plot.x.logarithmic ? 33 : 25)
                                                                             : longest(texts) + 20};
    constexpr double marks_and_label = 79;  // below the frame
    std::size_t rows = 0;
    const std::string legend_commands = legend_of(panel, margins, marks_and_label - 4, rows);
    panel.above = title.empty() ? 18 : 45 + line_height * double(lines.size());
    panel.height = panel.above + panel.frame + marks_and_label + line_height * (double(rows) + (rows > 0 ? 0.5 : 0));
    for (std::string& line : lines) line = quoted(line);
    panel.script += "set title " + (title.empty() ? "''" : join(lines, ".\"\\n\".")) + "\nset xlabel " +
                    quoted(plot.x.label) + " offset 0,0.6\nset cblabel " + quoted(plot.colours) +
                    " offset 0.5,0\nset label " + quoted(plot.y.label) +
                    " center rotate at screen 0.035, graph 0.5\nset lmargin at screen " +
                    Cell(margins.left / picture_width).text(6) + "\nset rmargin at screen " +
                    Cell(1 - margins.right / picture_width).text(6) + "\n" + (plot.to_scale ? to_scale(plot) : "") +
                    legend_commands;
    return panel;
}

std::string gnuplot_script(const Picture& picture, bool png) {
    Above above, unused;
    std::vector<Plot> drawn;
    Margins margins;
    for (Plot plot : picture) {
        if (plot.y.logarithmic) raise_zeros(plot);
        const auto empty = [&](const Series& series) { return placed(plot, series).empty(); };
        if (std::all_of(plot.series.begin(), plot.series.end(), empty)) continue;
        const Margins needs = panel_of(plot, unused, margins).needs;
        margins = {std::max(margins.left, needs.left), std::max(margins.right, needs.right)};
        drawn.push_back(std::move(plot));
    }
    std::vector<Panel> panels;
    double height = 0;
    for (const Plot& plot : drawn) {
        std::vector<std::string> below;
        for (const Plot& other : drawn) {
            if (!panels.empty() || !other.shares_legend) continue;
            for (const Series& series : other.series) {
                if (series.look == Look::curve) below.push_back(series.label);
            }
        }
        height += panels.emplace_back(panel_of(plot, above, margins, below)).height;
    }
    if (panels.empty()) throw PlotError("the plot has no point to draw");
    const double pixels = png ? 5.0 / 3 : 1;
    std::string script = std::string("set encoding utf8\nset terminal ") + (png ? "pngcairo" : "svg") + " size " +
                         std::to_string(std::lround(pixels * picture_width)) + "," +
                         std::to_string(std::lround(pixels * height)) + " enhanced background '#ffffff' font " +
                         (png ? "'sans,22.5' linewidth 1.7 dashlength 1.3 pointscale 2.2" : "'sans-serif,18'") + "\n" +
                         std::string(line_types);
    double top = height;
    for (const Panel& panel : panels) {
        top -= panel.height;
        const auto at_screen = [&](const char* name, double below_top) {
            return std::string("set ") + name + " at screen " +
                   Cell((top + panel.height - below_top) / height).text(6) + "\n";
        };
        script +=
            std::string(frame) + at_screen("tmargin", panel.above) + at_screen("bmargin", panel.above + panel.frame);
        script += "set size 1," + Cell(panel.height / height).text(6) + "\nset origin 0," + Cell(top / height).text(6) +
                  "\n" + panel.script + panel.data + "plot " + join(panel.commands, ", ") + "\n";
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

std::string drawing_of(const Picture& picture, const std::string& path) {
    using namespace std::string_view_literals;
    const bool png = path.ends_with(".png");
    std::string drawn = run_gnuplot(gnuplot_script(picture, png), path);
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
