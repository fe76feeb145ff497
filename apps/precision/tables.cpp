// The rows of precision_study, read again for --front, the file of --cheapest, and the lines of --recommend.
#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>
#include <set>
#include <stdexcept>
#include <utility>

#include <rollbem/accuracy/recommendation.hpp>
#include <rollbem/accuracy/recommended_patch.hpp>

#include "comparison.hpp"
#include "support/input.hpp"
#include "support/named_scheme.hpp"

namespace precision {

namespace {

constexpr std::size_t first_setting = 9;  // of the columns

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
    std::vector<Point> points;
    std::set<std::vector<std::string>> seen;
    while (lines.next()) {
        const std::string where = lines.where();
        const std::vector<std::string> cells = study::cells_of(lines.text(), ',');
        if (lines.is_first()) {
            if (lines.text() != header) throw study::BadInput(where + " must be " + header);
            continue;
        }
        if (cells.size() != columns().size()) {
            throw study::BadInput(where + " must have " + std::to_string(columns().size()) + " cells");
        }
        try {
            study::scheme_named(cells[0]);
        } catch (const study::BadInput&) {
            throw study::BadInput(where + " must name a scheme: " + cells[0]);
        }
        const bool wanted = std::any_of(quantities.begin(), quantities.end(),
                                        [&](const Quantity& quantity) { return quantity.name == cells[2]; });
        if (!wanted) continue;
        if (!seen.insert({cells[0], cells[1], cells[2]}).second) {
            throw study::BadInput(where + " must not repeat a row: " + cells[0] + ", n = " + cells[1] + ", " +
                                  cells[2]);
        }
        const auto cell = [&](std::size_t column) { return read_cell(cells[column], where); };
        const std::optional<double> n = cell(1), stable = cell(5);
        if (n && !(*n >= 1 && *n <= 1e9)) throw study::BadInput(where + " must have a number of elements: " + cells[1]);
        points.push_back({.scheme = cells[0],
                          .n = n ? std::optional(std::lround(*n)) : std::nullopt,
                          .quantity = cells[2],
                          .relative_error = cell(3),
                          .time_us = cell(4),
                          .stable = stable ? std::optional(*stable != 0) : std::nullopt,
                          .on_front = std::nullopt,
                          .model_error = cell(7),
                          .status = cells[8],
                          .setting = {cells.begin() + first_setting, cells.end()}});
        // rows can only be compared for one contact
        if (!std::equal(cells.begin() + first_setting, cells.begin() + first_setting + 3,
                        points.front().setting.begin())) {
            throw study::BadInput(where + " must have the kernel, aspect and poisson of the rows above");
        }
    }
    options.require(!points.empty(), "front", "have rows of the quantities asked for");
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
}

void print_recommendations(const study::Options& options) {
    const study::Rule open{[](double value) { return value > 0 && value < 1; }, "be above 0 and below 1"};
    const double tolerance = options.number("recommend", open);
    for (const study::Given& given : options.given()) {
        if (given.name != "recommend" && given.name != "a-over-b") options.ignored(given.name, "with --recommend");
    }
    const double a_over_b = options.number("a-over-b", study::between(0.1, 25));
    study::OutputFile output = study::OutputFile::standard_output();
    const auto print = [&](const char* purpose, const auto& line) {
        output.write(std::string("# ") + purpose + "\n");
        try {
            output.write(line() + "\n");
        } catch (const std::invalid_argument&) {
            output.write("# none: so small an error was not measured\n");
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
    print("the same by elements, extrapolated from half as many and all", [&] {
        return "precision_study --quantity c11 --scheme richardson:cosine:nodes --n " + elements(Purpose::steady);
    });
    print("c11 at frequencies omega a/V up to 5",
          [&] { return "frequency_study --kernel plane " + states(Purpose::frequency) + " --omega 5"; });
    print("the same by elements", [&] {
        return "precision_study --quantity response --scheme richardson:cosine:nodes --n " +
               elements(Purpose::frequency);
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
    output.commit();
}

}  // namespace precision
