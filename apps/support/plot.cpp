#include "plot.hpp"

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <iterator>
#include <map>
#include <set>

namespace study {

std::string shown_name(const std::string& column) {
    static const std::map<std::string, std::string> names{
        {"alpha_L", "α_L"},          {"alpha_T", "α_T"},      {"lambda", "λ"},    {"epsilon", "ε"},
        {"size_ratio", "dx_T/dx_L"}, {"aspect", "b/a"},       {"poisson", "ν"},   {"lateral_ratio", "δ_y"},
        {"spin_ratio", "δ_φ"},       {"creepage_ratio", "δ"}, {"a_over_b", "a/b"}};
    const auto found = names.find(column);
    return found == names.end() ? column : found->second;
}

void raise_to_drawn(Plot& plot, double least) {
    PlotRange x{HUGE_VAL, -HUGE_VAL}, y{least / 3, least};
    bool any = false;
    for (Series& series : plot.series) {
        for (auto& [at, value] : series.points) {
            any = any || value < least;
            value = std::max(value, least);  // the maximum of nan is nan
            if (!std::isfinite(at) || !std::isfinite(value)) continue;
            x = {std::min(x.low, at), std::max(x.high, at)};
            y.high = std::max(y.high, 3 * value);
        }
    }
    if (!any) return;
    plot.y_range = y;
    plot.series.push_back({.label = Cell(least).text() + " or less",
                           .points = {{x.low, least}, {x.high, least}},
                           .markers = false,
                           .reference = true});
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
        const std::pair undefined{std::nan(""), std::nan("")};
        series[position->second].points.push_back(x ? std::pair{*x, selection.absolute ? std::abs(value) : value}
                                                    : undefined);
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

Series map_of(const std::vector<std::string>& columns, const std::vector<Row>& rows, const std::string& x,
              const std::string& y, const std::string& z) {
    const auto number = [&](const Row& row, const std::string& name) { return row[index_of(columns, name)].number(); };
    /// The borders between the values of a column, the outer ones as far from it as the inner ones.
    const auto borders_of = [&](const std::string& name) {
        std::set<double> values;
        for (const Row& row : rows) {
            if (const auto value = number(row, name)) values.insert(*value);
        }
        std::map<double, std::pair<double, double>> cells;
        for (auto at = values.begin(); at != values.end(); ++at) {
            const bool first = at == values.begin(), last = std::next(at) == values.end();
            const double to_last = last && !first ? *at - *std::prev(at) : last ? 1 : *std::next(at) - *at;
            const double to_first = first ? to_last : *at - *std::prev(at);
            cells[*at] = {*at - to_first / 2, *at + to_last / 2};
        }
        return cells;
    };
    const auto wide = borders_of(x), high = borders_of(y);
    Series series{.label = "map", .markers = false, .shape = Shape::rectangles};
    for (const Row& row : rows) {
        const auto at_x = number(row, x), at_y = number(row, y), value = number(row, z);
        if (!at_x || !at_y || !value) continue;
        const auto &across = wide.at(*at_x), &along = high.at(*at_y);
        series.points.emplace_back(across.first, along.first);
        series.points.emplace_back(across.second, along.second);
        series.values.push_back(*value);
    }
    return series;
}

Plot in_one_column(std::vector<Plot> panels) {
    if (panels.empty()) return {};
    Plot first = std::move(panels.front());
    first.below.assign(std::make_move_iterator(panels.begin() + 1), std::make_move_iterator(panels.end()));
    return first;
}

bool plot_is_png(const Options& options) {
    const std::string path = options.text("plot");
    const std::string ending = std::filesystem::path(path).extension().string();
    options.require(ending == ".svg" || ending == ".png", "plot", "end in .svg or .png");
    return ending == ".png";
}

}  // namespace study
