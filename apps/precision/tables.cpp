// The rows of precision_study, read again for --front, the file of --cheapest, and the lines of --recommend.
#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>
#include <set>
#include <stdexcept>

#include <rollbem/accuracy/recommendation.hpp>

#include "comparison.hpp"
#include "support/input.hpp"
#include "support/named_scheme.hpp"

namespace precision {

const std::vector<std::string>& settings(bool of_patch) {
    static const std::vector<std::string> of_lines{"kernel", "aspect", "poisson", "size_ratio", "epsilon"},
        of_patches = study::joined<std::string>(of_lines, {"a_over_b", "strips"});
    return of_patch ? of_patches : of_lines;
}

std::vector<std::string> columns(bool of_patch) {
    const std::vector<std::string> first{"scheme", "n",        "quantity",    "relative_error", "time_us",
                                         "stable", "on_front", "model_error", "status"};
    return study::joined(study::joined(first, settings(of_patch)), {"worst_at"});
}

study::Row row(const Point& point) {
    const auto flag = [](const std::optional<bool>& value) { return value ? study::Cell(int(*value)) : study::Cell(); };
    study::Row cells{point.scheme,       study::Cell(point.n), point.quantity,    point.relative_error, point.time_us,
                     flag(point.stable), flag(point.on_front), point.model_error, point.status};
    cells.insert(cells.end(), point.setting.begin(), point.setting.end());
    cells.emplace_back(point.worst_at);
    return cells;
}

namespace {

bool is_status(const std::string& word) {
    for (int k = 0; k <= int(rollbem::Status::not_finite); ++k) {
        if (word == name(rollbem::Status(k))) return true;
    }
    return false;
}

}  // namespace

std::vector<Point> read_points(const study::Options& options, const std::vector<Quantity>& quantities) {
    study::Lines lines(options, "front");
    const auto require = [&](bool holds, const std::string& what) {
        if (!holds) throw study::BadInput(lines.where() + " must " + what);
    };
    const std::vector<std::string> names = columns();
    const auto setting = study::index_of(names, settings().front());
    std::vector<Point> points;
    std::set<std::vector<std::string>> seen;
    while (lines.next()) {
        const std::vector<std::string> cells = study::cells_of(lines.text());
        if (lines.is_first()) {
            require(cells == names, "be " + study::join(names, ","));
            continue;
        }
        require(cells.size() == names.size(), "have " + std::to_string(names.size()) + " cells");
        try {
            study::scheme_named(cells[0]);
        } catch (const study::BadInput&) {
            require(false, "name a scheme: " + cells[0]);
        }
        const auto quantity = std::find_if(quantities.begin(), quantities.end(),
                                           [&](const Quantity& one) { return one.name == cells[2]; });
        if (quantity == quantities.end()) continue;
        const Places& places = quantity->places;
        require(std::any_of(places.begin(), places.end(), [&](const Place& p) { return p.text() == cells.back(); }),
                "have a worst_at of " + cells[2] + " by the options given: " + cells.back());
        require(seen.insert({cells[0], cells[1], cells[2]}).second,
                "not repeat a row: " + cells[0] + ", n = " + cells[1] + ", " + cells[2]);
        const auto cell = [&](std::size_t column) -> std::optional<double> {
            const std::string& text = cells[column];
            const std::optional<double> value = study::number_of(text);
            require(text.empty() || value, "be a number or empty: " + text);
            return value;
        };
        const std::optional<double> n = cell(1), error = cell(3), time = cell(4), stable = cell(5);
        require(!n || (*n >= 1 && *n <= 1e9 && *n == std::round(*n)), "have a number of elements: " + cells[1]);
        require(n || cells[0] == "closed-form", "have a number of elements, as all but closed-form");
        require(!time || *time > 0, "have a time above 0: " + cells[4]);
        require(!stable || *stable == 0 || *stable == 1, "have 1 or 0 where it says whether it is stable: " + cells[5]);
        require(is_status(cells[8]), "have a status: " + cells[8]);
        require((cells[8] == "ok") == error.has_value(),
                "have a relative_error where its status is ok, and there alone: " + cells[3] + ", " + cells[8]);
        points.push_back({.scheme = cells[0],
                          .n = n ? std::optional(std::lround(*n)) : std::nullopt,
                          .quantity = cells[2],
                          .relative_error = error,
                          .time_us = time,
                          .stable = stable ? std::optional(*stable != 0) : std::nullopt,
                          .on_front = std::nullopt,
                          .model_error = cell(7),
                          .status = cells[8],
                          .setting = {cells.begin() + setting, cells.end() - 1},
                          .worst_at = cells.back(),
                          .competes = quantity->competes(cells[0])});
        // rows can only be compared for one contact
        require(std::equal(points.back().setting.begin(), points.back().setting.begin() + 3,
                           points.front().setting.begin()),
                "have the kernel, aspect and poisson of the rows above");
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
            for (const char* group : {"elements", "stable-elements", "stable", "all"}) {
                const auto best = cheapest(points, sustained, quantity.name, std::pow(10.0, -exponent), group);
                study::Row cells{quantity.name, "1e-" + std::to_string(exponent), group};
                if (best) {
                    const Point& point = points[*best];
                    cells = study::joined(
                        cells, {point.scheme, study::Cell(point.n), point.relative_error, point.time_us, "ok"});
                } else {
                    cells = study::joined(cells, {{}, {}, {}, {}, "none"});
                }
                file.write(study::csv_line(cells));
            }
        }
    }
}

Recommendation read_recommendation(const study::Options& options) {
    const study::Rule open{[](double value) { return value > 0 && value < 1; }, "be above 0 and below 1"};
    const double tolerance = options.number("recommend", open);
    for (const study::Given& given : options.given()) {
        if (given.name != "recommend" && given.name != "a-over-b") options.ignored(given.name, "with --recommend");
    }
    return {tolerance, options.given("a-over-b") ? options.number("a-over-b", study::between(0.1, 25)) : 1};
}

void print_recommendations(const Recommendation& wanted) {
    const double tolerance = wanted.tolerance, a_over_b = wanted.a_over_b;
    study::OutputFile output = study::OutputFile::standard_output();
    const auto print = [&](const char* purpose, const std::string& before, const auto& words,
                           const std::string& behind = "") {
        output.write(std::string("# ") + purpose + "\n");
        try {
            output.write(before + words() + behind + "\n");
        } catch (const std::invalid_argument&) {
            output.write("# none: so small an error was not measured\n");
        }
    };
    const auto states = [=](rollbem::Purpose::Adhesion purpose) {
        return [=] { return std::to_string(rollbem::recommended_scheme(tolerance, purpose).scheme.states); };
    };
    const auto elements = [=](auto purpose) {
        return [=] { return std::to_string(rollbem::recommended_elements(tolerance, purpose).n); };
    };
    const auto patch = [=](double spin) {
        return [=] {
            const auto best = rollbem::recommended_patch(tolerance, a_over_b, spin);
            return std::to_string(best.n) + " --strips " + std::to_string(best.strips);
        };
    };
    using rollbem::Purpose;
    const std::string by_states = "--kernel plane --method chebyshev --n ",
                      extrapolated = " --scheme richardson:cosine:nodes --n ",
                      after_step = "transient_study --step 1 --dq 1 --integrator exponential ",
                      of_patch = "patch_study --a-over-b " + study::Cell(a_over_b).text() + " --n ",
                      rolling = " --strip-grading uniform --longitudinal 0.2 --lateral 0.2";
    print("steady rolling, c11", "steady_study " + by_states, states(Purpose::steady));
    print("the same by elements, extrapolated from half as many and all",
          "precision_study --quantity c11" + extrapolated, elements(Purpose::steady));
    print("c11 at frequencies omega a/V up to 5", "frequency_study " + by_states, states(Purpose::frequency),
          " --omega 5");
    print("the same by elements", "precision_study --quantity response" + extrapolated, elements(Purpose::frequency));
    print("force in time, from q/a = 1 on after a step", after_step + by_states, states(Purpose::time_loop));
    print("the same by elements", after_step + "--kernel plane --mesh cosine --alpha 0.5 --n ",
          elements(Purpose::time_loop));
    print("friction, creepage ratios from 0.05", "friction_study --kernel plane --method nodes --nodes chebyshev --n ",
          elements(Purpose::friction));
    print("friction on a patch, any creepages and spin, forces over mu N", of_patch,
          patch(std::numeric_limits<double>::infinity()), rolling + " --spin 0.5");
    print("the same without spin", of_patch, patch(0), rolling);
    output.commit();
}

}  // namespace precision
