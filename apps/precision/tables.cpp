// The rows of precision_study, read again for --front, the file of --cheapest, and the lines of --recommend.
#include <algorithm>
#include <cmath>
#include <iostream>
#include <iterator>
#include <limits>
#include <optional>
#include <stdexcept>
#include <utility>

#include <rollbem/accuracy/recommendation.hpp>
#include <rollbem/accuracy/recommended_patch.hpp>

#include "comparison.hpp"
#include "support/errors.hpp"
#include "support/input.hpp"

namespace precision {

namespace {

constexpr std::size_t first_setting = 9,
                      measured = 8;  // of the columns; --front does not need those after the first `measured`

std::optional<double> read_cell(const std::string& text, const std::string& where) {
    if (text.empty()) return std::nullopt;
    const std::optional<double> value = study::detail::parse_number<double>(text);
    if (!value || !std::isfinite(*value)) throw study::BadInput(where + " must be a number or empty: " + text);
    return value;
}

}  // namespace

const std::vector<std::string>& columns() {
    static const std::vector<std::string> names{"scheme", "n",        "quantity",    "relative_error", "time_us",
                                                "stable", "on_front", "model_error", "status",         "kernel",
                                                "aspect", "poisson",  "size_ratio",  "epsilon"};
    return names;
}

study::Row row(const Point& point) {
    const auto flag = [](const std::optional<bool>& value) { return value ? study::Cell(int(*value)) : study::Cell(); };
    study::Row cells{point.scheme,       study::Cell(point.n), point.quantity,    point.relative_error, point.time_us,
                     flag(point.stable), flag(point.on_front), point.model_error, point.status};
    cells.insert(cells.end(), point.setting.begin(), point.setting.end());
    return cells;
}

std::vector<Point> read_points(const study::Options& options, const std::vector<Quantity>& quantities) {
    study::Lines lines(options, "front");
    const std::string header = study::join(columns(), ",");
    const std::string short_header = study::join({columns().begin(), columns().begin() + measured}, ",");
    std::size_t cells_expected = 0;
    std::vector<Point> points;
    while (lines.next()) {
        const std::string where = lines.where();
        const std::string& text = lines.text();
        if (lines.is_first()) {
            const std::vector<std::string> names = study::cells_of(text, ',');
            const std::string given = study::join(names, ",");
            if (given != header && given != short_header) throw study::BadInput(where + " must be " + header);
            cells_expected = names.size();
            continue;
        }
        std::vector<std::string> cells = study::cells_of(text, ',');
        const auto known = [](const auto& list, const auto& name, const auto& name_of) {
            return std::any_of(list.begin(), list.end(), [&](const auto& item) { return name_of(item) == name; });
        };
        if (cells.size() != cells_expected) {
            throw study::BadInput(where + " must have " + std::to_string(cells_expected) + " cells");
        }
        cells.resize(columns().size());
        if (!known(line_schemes(), cells[0], [](const std::string& name) { return name; })) {
            throw study::BadInput(where + " must name a scheme: " + cells[0]);
        }
        const auto name_of = [](const Quantity& quantity) { return quantity.name; };
        if (!known(line_quantities(), cells[2], name_of)) {
            throw study::BadInput(where + " must name a quantity: " + cells[2]);
        }
        if (!known(quantities, cells[2], name_of)) continue;
        const auto in_range = [&](std::size_t column, double low, double high) {
            const std::optional<double> value = read_cell(cells[column], where);
            if (value && !(*value >= low && *value <= high)) {
                throw study::BadInput(where + ": " + columns()[column] + " = " + cells[column] + " must " +
                                      study::between(low, high).text);
            }
            return value;
        };
        const std::optional<double> n = in_range(1, 1, largest_n), stable = in_range(5, 0, 1);
        points.push_back({.scheme = cells[0],
                          .n = n ? std::optional(std::lround(*n)) : std::nullopt,
                          .quantity = cells[2],
                          .relative_error = read_cell(cells[3], where),
                          .time_us = in_range(4, 0, 1e15),
                          .stable = stable ? std::optional(*stable != 0) : std::nullopt,
                          .on_front = std::nullopt,
                          .model_error = read_cell(cells[7], where),
                          .status = cells[8],
                          .setting = {cells.begin() + first_setting, cells.end()}});
        // rows can only be compared for one contact
        const auto other = std::find_if(points.begin(), points.end(), [&](const Point& point) {
            const auto first = point.setting.begin();
            return point.scheme == points.back().scheme ? point.setting != points.back().setting
                                                        : !std::equal(first, first + 3, points.back().setting.begin());
        });
        if (other != points.end()) {
            throw study::BadInput(where +
                                  " must have the kernel, aspect, poisson, size_ratio and epsilon of the rows above");
        }
    }
    if (points.empty()) throw study::BadInput(options.said("front") + " must have rows of the quantities asked for");
    return points;
}

void write_cheapest(study::OutputFile& file, const std::vector<Point>& points,
                    const std::vector<Quantity>& quantities) {
    const std::vector<double> sustained = sustained_errors(points);
    file.write(
        study::csv_line({"quantity", "tolerance", "among", "scheme", "n", "relative_error", "time_us", "status"}));
    for (const Quantity& quantity : quantities) {
        for (int exponent = 2; exponent <= 12; ++exponent) {
            for (const auto& [among, name] : {std::pair{Among::elements, "elements"},
                                              {Among::stable_elements, "stable-elements"},
                                              {Among::stable, "stable"},
                                              {Among::all, "all"}}) {
                const double tolerance = std::pow(10.0, -exponent);
                const auto best = cheapest(points, sustained, quantity.name, tolerance, among);
                const std::string text = "1e-" + std::to_string(exponent);
                study::Row cells{quantity.name, text, name, {}, {}, {}, {}, "none"};
                if (best) {
                    const Point& point = points[*best];
                    cells = {quantity.name,        text,          name, point.scheme, study::Cell(point.n),
                             point.relative_error, point.time_us, "ok"};
                }
                file.write(study::csv_line(cells));
            }
        }
    }
    file.commit();
}

void print_recommendations(const study::Options& options) {
    const study::Rule open{[](double value) { return value > 0 && value < 1; }, "be above 0 and below 1"};
    const double tolerance = options.number("recommend", open);
    for (const auto& [name, value] : options.given_values()) {
        if (name != "recommend" && name != "a-over-b") options.ignored(name, "with --recommend");
    }
    const double a_over_b = options.number("a-over-b", study::between(0.1, 25));
    const auto print = [&](const char* purpose, const auto& line) {
        std::cout << "# " << purpose << "\n";
        try {
            std::cout << line() << "\n";
        } catch (const std::invalid_argument&) {
            std::cout << "# none: so small an error was not measured\n";
        }
    };
    const auto states = [&](rollbem::Purpose::Adhesion purpose) {
        return "--method chebyshev --n " +
               std::to_string(rollbem::recommended_scheme(tolerance, purpose).scheme.states);
    };
    const auto elements = [&](auto purpose) {
        return std::to_string(rollbem::recommended_elements(tolerance, purpose).n);
    };
    using rollbem::Purpose;
    print("steady rolling, c11", [&] { return "steady_study --kernel plane " + states(Purpose::steady); });
    print("the same by elements, extrapolated from half as many and all",
          [&] { return "precision_study --quantity c11 --schemes richardson-nodes --n " + elements(Purpose::steady); });
    print("c11 at frequencies omega a/V up to 5",
          [&] { return "frequency_study --kernel plane " + states(Purpose::frequency) + " --omega 5"; });
    print("the same by elements", [&] {
        return "precision_study --quantity c11_z5 --schemes richardson-nodes --n " + elements(Purpose::frequency);
    });
    const std::string after_step = "transient_study --step 1 --dq 1 --integrator exponential --kernel plane ";
    print("force in time, from q/a = 1 on after a step", [&] { return after_step + states(Purpose::time_loop); });
    print("the same by elements",
          [&] { return after_step + "--mesh cosine --alpha 0.5 --n " + elements(Purpose::time_loop); });
    print("friction, creepage ratios from 0.05", [&] {
        return "friction_study --kernel plane --method nodes --nodes chebyshev --n " + elements(Purpose::friction);
    });
    const std::string ratio = study::Cell(a_over_b).text();
    const auto patch = [&](double spin) {
        const rollbem::RecommendedPatch best = rollbem::recommended_patch(tolerance, a_over_b, spin);
        return "patch_study --a-over-b " + ratio + " --n " + std::to_string(best.n) + " --strips " +
               std::to_string(best.strips) + " --strip-grading uniform --longitudinal 0.2 --lateral 0.2" +
               (spin > 0 ? " --spin 0.5" : "");
    };
    const double any = std::numeric_limits<double>::infinity();
    print("friction on a patch, any creepages and spin, forces over mu N", [&] { return patch(any); });
    print("the same without spin", [&] { return patch(0); });
}

}  // namespace precision
