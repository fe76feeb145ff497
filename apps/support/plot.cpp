#include "plot.hpp"

#include <algorithm>
#include <cmath>
#include <iterator>
#include <map>
#include <set>

namespace study {

std::string shown_name(const std::string& column) {
    static const std::map<std::string, std::string> names{{"alpha_L", "α_L"},
                                                          {"alpha_T", "α_T"},
                                                          {"lambda", "λ"},
                                                          {"epsilon", "ε"},
                                                          {"size_ratio", "dx_T/dx_L"},
                                                          {"aspect", "b/a"},
                                                          {"poisson", "ν"},
                                                          {"lateral_ratio", "δ_y"},
                                                          {"spin_ratio", "δ_φ"},
                                                          {"creepage_ratio", "δ"},
                                                          {"a_over_b", "a/b"},
                                                          {"longitudinal", "ξ"},
                                                          {"lateral", "η"},
                                                          {"spin", "φ c"}};
    const auto found = names.find(column);
    return found == names.end() ? column : found->second;
}

namespace {

/// The value of a column in words.
std::string in_words(const std::string& name, const std::string& value) {
    static const std::map<std::string, std::map<std::string, std::string>> words{
        {"derivative",
         {{"fd", "finite differences"},
          {"fd4", "finite differences of fourth order"},
          {"analytic", "analytic derivative"}}},
        {"method",
         {{"galerkin", "Galerkin"},
          {"knothe-bc", "boundary conditions of Knothe"},
          {"nodes", "node differences"},
          {"chebyshev", "Chebyshev states"}}},
        {"nodes", {{"centres", "at centres"}, {"chebyshev", "at Chebyshev points"}}}};
    if (name == "mesh" && value != "edges") return value + " mesh";
    const auto column = words.find(name);
    if (column == words.end()) return value;
    const auto found = column->second.find(value);
    return found == column->second.end() ? value : found->second;
}

/// Adds ", name = value", or what speaks for itself; to the elements of a strip the number of strips.
void add_property(std::string& text, const std::string& name, const std::string& value) {
    if (value.empty()) return;
    const std::size_t n = text.rfind(", n = ");
    if (name == "strips" && n != std::string::npos && text.find(',', n + 1) == std::string::npos) {
        text.replace(n, 6, ", ").append(" × " + value + " elements");
        return;
    }
    const bool speaks = value.find_first_not_of("0123456789.+-e") != std::string::npos && name != "aspect";
    text += ", " + (name == "kernel"       ? value + " kernel"
                    : name == "quadrature" ? "quadrature " + value
                    : speaks               ? in_words(name, value)
                                           : shown_name(name) + " = " + value);
}

}  // namespace

void add_series(Plot& plot, const Records& records, const Selection& selection) {
    const std::vector<std::string>& names = selection.by;
    std::map<std::vector<std::string>, std::size_t> found;
    std::vector<std::vector<std::string>> keys;
    std::vector<Series> series;
    std::set<std::pair<std::size_t, std::pair<double, double>>> known;
    for (const Row& row : records.rows) {
        std::vector<std::string> key;
        for (const std::string& name : names) key.push_back(records.cell(row, name).text(6));
        const auto [position, is_new] = found.try_emplace(key, series.size());
        if (is_new) {
            keys.push_back(key);
            series.push_back({.look = selection.look});
        }
        const double x = records.number(row, selection.x) / selection.x_unit,
                     y = records.number(row, selection.y) / selection.y_unit;
        const std::pair point{x, std::isnan(x) ? x : selection.absolute ? std::abs(y) : y};
        const bool again = selection.look == Look::exact && !std::isnan(point.second) &&
                           !known.insert({position->second, point}).second;
        if (!again) series[position->second].points.push_back(point);
    }
    std::vector<std::string> labels(series.size());
    for (std::size_t i = 0; i < names.size() && !keys.empty(); ++i) {
        const bool shared =
            std::all_of(keys.begin(), keys.end(), [&](const auto& key) { return key[i] == keys[0][i]; });
        if (shared && plot.series.empty()) add_property(plot.title, names[i], keys[0][i]);
        for (std::size_t k = 0; k < keys.size() && !shared; ++k) add_property(labels[k], names[i], keys[k][i]);
    }
    for (std::size_t k = 0; k < series.size(); ++k) {
        std::string label = selection.prefix + labels[k];
        if (selection.prefix.empty()) label = labels[k].empty() ? "computed" : labels[k].substr(2);
        series[k].label = label;
    }
    plot.series.insert(plot.series.end(), series.begin(), series.end());
}

std::vector<Series> map_of(const Records& records, const std::string& x, const std::string& y, const std::string& z) {
    const std::set<double> wide = records.numbers(x), high = records.numbers(y);
    /// The cell around one of several values, at the ends as wide as the gap to the only neighbour.
    const auto cell = [](const std::set<double>& values, double value) {
        const auto at = values.find(value), next = std::next(at);
        const double behind = next == values.end() ? value - *std::prev(at) : *next - value;
        const double before = at == values.begin() ? behind : value - *std::prev(at);
        return PlotRange{value - before / 2, value + behind / 2};
    };
    Series coloured{.look = Look::cells}, empty{.label = "not defined", .look = Look::empty_cells};
    for (const Row& row : records.rows) {
        const double value = records.number(row, z);
        const PlotRange across = cell(wide, records.number(row, x)), along = cell(high, records.number(row, y));
        Series& series = std::isnan(value) ? empty : coloured;
        series.points.emplace_back(across.low, along.low);
        series.points.emplace_back(across.high, along.high);
        if (!std::isnan(value)) series.values.push_back(value);
    }
    return {std::move(coloured), std::move(empty)};
}

}  // namespace study
