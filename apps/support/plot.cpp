#include "plot.hpp"

#include <algorithm>
#include <array>
#include <cerrno>
#include <cmath>
#include <cstdio>
#include <cstring>
#include <filesystem>
#include <iterator>
#include <map>
#include <set>
#include <string_view>

#include <sys/wait.h>

namespace study {

namespace {

std::string gnuplot_string(std::string text) {
    for (std::size_t i = text.find('\''); i != std::string::npos; i = text.find('\'', i + 2)) text.insert(i, 1, '\'');
    return "'" + text + "'";
}

/// A logarithmic x axis, with marks at the values if those are few. gnuplot sets too few on a short one, which is
/// linear.
std::string logarithmic_axis(const Plot& plot) {
    std::set<double> values;
    for (const Series& series : plot.series) {
        for (const auto& point : series.points) values.insert(point.first);
    }
    const auto is_short = [](double value) { return value == std::round(value) && value < 1e4; };
    std::vector<std::string> marks;
    for (const double value : values) marks.push_back(Cell(value).text());
    const bool few = values.size() <= 8 && std::all_of(values.begin(), values.end(), is_short);
    if (!few && *values.begin() > 0 && *values.rbegin() < 10 * *values.begin() && !plot.x_range) return "";
    return "set logscale x " + std::to_string(plot.log_base) + "\n" +
           (few ? "set xtics (" + join(marks, ",") + ")\n" : "");
}

/// "set title", in two lines if one would be longer than `widest` characters.
std::string title_command(const std::string& title, std::ptrdiff_t widest) {
    const auto is_character = [](char c) { return (static_cast<unsigned char>(c) & 0xC0) != 0x80 && c != '_'; };
    const bool fits = std::count_if(title.begin(), title.end(), is_character) <= widest;
    const std::size_t end = fits ? std::string::npos : title.rfind(", ", title.size() * 3 / 5);
    if (end == std::string::npos) return "set title " + gnuplot_string(title) + "\n";
    return "set title " + gnuplot_string(title.substr(0, end + 1)) + ".\"\\n\"." +
           gnuplot_string(title.substr(end + 2)) + "\n";
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
    if (given.shape == Shape::rectangles) return "boxxyerror" + colour + " fs solid 0.5 border rgb '#ffffff'";
    if (given.shape == Shape::arrows) return "vectors head filled size graph 0.012,20 lw 1.2" + colour;
    std::string text = !series.markers ? "lines" : series.line ? "linespoints" : "points";
    text += " lw 2" + colour;
    if (series.line) text += " dt " + std::string(dashes[(style + (series.reference ? 1 : 0)) % dashes.size()]);
    if (series.markers) text += " pt " + std::to_string((series.open ? open : filled)[style % open.size()]);
    if (series.markers && series.open) text += " ps 1.2";
    return text;
}

bool has_place(const Plot& plot, const std::pair<double, double>& point) {
    return std::isfinite(point.first) && std::isfinite(point.second) && (!plot.log_x || point.first > 0) &&
           (!plot.log_y || point.second > 0);
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
        if (series.shape == Shape::rectangles) add({x + dx / 2, y + dy / 2, std::abs(dx) / 2, std::abs(dy) / 2});
    }
    return text;
}

std::string panel_script(const Plot& plot, bool alone) {
    if (!can_be_drawn(plot)) throw PlotError("the plot has no point to draw");
    const auto usable = [&](const std::pair<double, double>& point) { return has_place(plot, point); };
    const auto is_counted = [&](const Series& series) {
        const bool shows = std::any_of(series.points.begin(), series.points.end(), usable);
        return shows && !series.label.empty() && !series.reference;
    };
    const auto labelled = static_cast<std::size_t>(std::count_if(plot.series.begin(), plot.series.end(), is_counted));
    std::string title = plot.title;
    if (labelled > most_curves) {
        title += (title.empty() ? "" : ": ") + ("the first " + std::to_string(most_curves)) + " of " +
                 std::to_string(labelled) + " curves";
    }
    std::string script;
    script += title_command(title, alone ? 105 : 76) + "set xlabel " + gnuplot_string(plot.x_label) + "\nset ylabel " +
              gnuplot_string(plot.y_label) + "\nset grid lt 1 lc rgb '#dddddd' lw 1\n";
    script += "set key above samplen 3\nset autoscale xfix\nset format '%h'\n";
    if (plot.true_scale) script += "set size ratio -1\n";
    if (plot.log_x) script += logarithmic_axis(plot);
    if (plot.log_y) script += "set logscale y 10\nset format y '10^{%T}'\n";
    for (const auto& [axis, range] : {std::pair{"x", plot.x_range}, std::pair{"y", plot.y_range}}) {
        if (!range) continue;
        script +=
            "set " + std::string(axis) + "range [" + Cell(range->low).text() + ":" + Cell(range->high).text() + "]\n";
    }
    if (!plot.x_range) script += "set offsets graph 0.02, graph 0.02, 0, 0\n";  // no marker is cut by the frame
    std::vector<std::string> commands;
    std::size_t curves = 0, drawn = 0, references = 0;  // drawn: of those with a label
    for (std::size_t k = 0; k < plot.series.size(); ++k) {
        const Series& series = plot.series[k];
        const std::size_t style = series.style.value_or(series.reference ? references++ : curves++);
        if (std::none_of(series.points.begin(), series.points.end(), usable)) continue;
        if (is_counted(series) && ++drawn > most_curves) continue;
        const std::string data = "$data" + std::to_string(k);
        script += data + " << EOD\n" + data_of(plot, series) + "EOD\n";
        commands.push_back(data + " with " + style_of(series, style) +
                           (series.label.empty() ? " notitle" : " title " + gnuplot_string(series.label)));
    }
    if (commands.size() == 1) script += "set key off\n";  // the title and the axes say it all
    return script + "plot " + join(commands, ", ") + "\n";
}

std::string gnuplot_script(const Plot& plot, bool png) {
    const std::size_t panels = 1 + plot.beside.size();
    const bool one = panels == 1;  // several are smaller, so that text remains legible when the picture is scaled down
    const auto size = [&](std::size_t width, std::size_t height) {
        return "size " + std::to_string(panels * width) + "," + std::to_string(height) + " ";
    };
    std::string script = "set encoding utf8\n";
    if (png) {
        script += "set terminal pngcairo " + (one ? size(1200, 800) : size(900, 780)) +
                  "enhanced font 'sans,14' linewidth 1.3 dashlength 1.3 pointscale 1.4 background '#ffffff'\n";
    } else {
        script += "set terminal svg " + (one ? size(900, 600) : size(675, 585)) +
                  "dynamic enhanced font 'sans-serif,14' background '#ffffff'\n";
    }
    if (!one) script += "set multiplot layout 1," + std::to_string(panels) + "\n";
    script += panel_script(plot, one);
    for (const Plot& panel : plot.beside) script += "reset\n" + panel_script(panel, one);
    if (!one) script += "unset multiplot\n";
    return script;
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

std::string shown_name(const std::string& column) {
    static const std::map<std::string, std::string> names{
        {"alpha_L", "α_L"},          {"alpha_T", "α_T"},      {"lambda", "λ"},    {"epsilon", "ε"},
        {"size_ratio", "dx_T/dx_L"}, {"aspect", "b/a"},       {"poisson", "ν"},   {"lateral_ratio", "δ_y"},
        {"spin_ratio", "δ_φ"},       {"creepage_ratio", "δ"}, {"a_over_b", "a/b"}};
    const auto found = names.find(column);
    return found == names.end() ? column : found->second;
}

void raise_to_drawn(Plot& plot) {
    for (Series& series : plot.series) {
        for (auto& point : series.points) point.second = std::max(point.second, least_drawn);
    }
}

void fit_to_scale(Plot& plot) {
    PlotRange x{1e9, -1e9}, y{1e9, -1e9};
    for (const Series& series : plot.series) {
        for (const auto& [at, value] : series.points) {
            if (!std::isfinite(at) || !std::isfinite(value)) continue;
            x = {std::min(x.low, at), std::max(x.high, at)};
            y = {std::min(y.low, value), std::max(y.high, value)};
        }
    }
    const double wide = 0.05 * (x.high - x.low), high = 0.05 * (y.high - y.low);
    plot.x_range = {x.low - wide, x.high + wide};
    plot.y_range = {y.high + high, y.low - high};
    plot.true_scale = true;
}

bool can_be_drawn(const Plot& plot) {
    return std::any_of(plot.series.begin(), plot.series.end(), [&](const Series& series) {
        return std::any_of(series.points.begin(), series.points.end(),
                           [&](const auto& point) { return has_place(plot, point); });
    });
}

void add_series(Plot& plot, const std::vector<std::string>& columns, const std::vector<Row>& rows,
                const Selection& selection) {
    const auto column = [&](const std::string& name) { return index_of(columns, name); };
    std::vector<std::string> names = selection.by;
    names.insert(names.end(), selection.apart.begin(), selection.apart.end());
    std::map<std::vector<std::string>, std::size_t> found;
    std::vector<std::vector<std::string>> keys;
    std::vector<Series> series;
    for (const Row& row : rows) {
        std::vector<std::string> key;
        for (const std::string& name : names) key.push_back(row[column(name)].text(6));
        const auto [position, is_new] = found.try_emplace(key, series.size());
        if (is_new) {
            keys.push_back(key);
            series.emplace_back();
        }
        const std::optional<double> x = row[column(selection.x)].number(), y = row[column(selection.y)].number();
        const double value = y.value_or(std::nan(""));
        if (x) series[position->second].points.emplace_back(*x, selection.absolute ? std::abs(value) : value);
    }
    for (Series& each : series) {
        const auto& points = each.points;
        if (std::none_of(points.begin(), points.end(), [](const auto& point) { return std::isfinite(point.second); })) {
            each.points.clear();
        }
    }
    const auto append = [](std::string& text, const std::string& name, const std::string& value) {
        if (value.empty()) return;
        const bool speaks = value.find_first_not_of("0123456789.+-e") != std::string::npos && name != "aspect";
        text += (text.empty() ? "" : ", ") + (name == "kernel"       ? value + " kernel"
                                              : name == "quadrature" ? "quadrature " + value
                                              : speaks               ? value
                                                                     : shown_name(name) + " = " + value);
    };
    for (std::size_t i = 0; i < names.size(); ++i) {
        const bool shared =
            std::all_of(keys.begin(), keys.end(), [&](const auto& key) { return key[i] == keys[0][i]; });
        if (shared && !keys.empty() && plot.series.empty()) append(plot.title, names[i], keys[0][i]);
        for (std::size_t k = 0; k < keys.size() && !shared; ++k) append(series[k].label, names[i], keys[k][i]);
    }
    if (series.size() == 1) series[0].label = selection.prefix.empty() ? plot.y_label : "";
    if (selection.reference) series.resize(std::min<std::size_t>(series.size(), 1), Series{});
    for (Series& each : series) {
        const std::string& prefix = selection.prefix;
        if (!prefix.empty()) {
            each.label = prefix + (each.label.empty() || selection.reference ? "" : ", " + each.label);
        }
        each.markers = selection.markers && !selection.reference;
        each.reference = selection.reference;
    }
    plot.series.insert(plot.series.end(), series.begin(), series.end());
}

Plot side_by_side(std::vector<Plot> panels) {
    if (panels.empty()) return {};
    Plot first = std::move(panels.front());
    first.beside.assign(std::make_move_iterator(panels.begin() + 1), std::make_move_iterator(panels.end()));
    return first;
}

bool plot_is_png(const Options& options) {
    const std::string path = options.text("plot");
    const std::string ending = std::filesystem::path(path).extension().string();
    options.require(ending == ".svg" || ending == ".png", "plot", "end in .svg or .png");
    return ending == ".png";
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
