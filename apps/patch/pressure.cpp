#include <algorithm>
#include <cstddef>
#include <map>
#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

#include <rollbem/normal/hertz_ellipse.hpp>
#include <rollbem/normal/pressure_grid.hpp>

#include "patch.hpp"
#include "support/csv.hpp"
#include "support/errors.hpp"
#include "support/input.hpp"

namespace patch {

namespace {

/// Rows in any order.
rollbem::PressureGrid<double> read_grid(const study::Options& options) {
    std::map<std::pair<double, double>, double> points;
    const std::vector<study::Numbers> columns =
        study::read_columns(options, "pressure", "x,y,pressure", "", [&](const auto& read, const std::string& where) {
            if (read[2].back() < 0) throw study::BadInput(where + ": pressure must not be negative");
            if (!points.emplace(std::pair(read[0].back(), read[1].back()), read[2].back()).second) {
                throw study::BadInput(where + " must not be the second row at this place");
            }
        });
    const auto different = [](study::Numbers numbers) {
        std::sort(numbers.begin(), numbers.end());
        numbers.erase(std::unique(numbers.begin(), numbers.end()), numbers.end());
        return Eigen::ArrayXd(Eigen::Map<Eigen::ArrayXd>(numbers.data(), Eigen::Index(numbers.size())));
    };
    const Eigen::ArrayXd x = different(columns[0]), y = different(columns[1]);
    Eigen::MatrixXd pressures(x.size(), y.size());
    for (Eigen::Index i = 0; i < x.size(); ++i) {
        for (Eigen::Index j = 0; j < y.size(); ++j) {
            const auto point = points.find({x[i], y[j]});
            if (point == points.end()) {
                throw study::BadInput(options.said("pressure") +
                                      " must have a row at x = " + study::Cell(x[i]).text(6) +
                                      ", y = " + study::Cell(y[j]).text(6) + ": its points must make a grid");
            }
            pressures(i, j) = point->second;
        }
    }
    try {
        return {x, y, std::move(pressures)};
    } catch (const std::invalid_argument& error) {
        throw study::BadInput(options.said("pressure") + ": " + error.what());
    }
}

/// Of a grid that the options `said`, which measures an ellipse in a and b, an outline in its own unit.
Eigen::ArrayXd means_of(const rollbem::PressureGrid<double>& grid, const std::string& said, const Patch& patch) {
    const double a = patch.contact.half_length(), b = patch.contact.half_width();
    const bool outline = patch.contact.outline() != nullptr;
    std::vector<rollbem::Rectangle<double>> elements = patch.mesh.rectangles(a);
    for (rollbem::Rectangle<double>& element : elements) {
        if (!outline) element = {element.x_1 / a, element.x_2 / a, element.y_1 / b, element.y_2 / b};
    }
    const Eigen::ArrayXd means = grid(elements);
    double load = 0, area = 0, covered = 0;
    for (std::size_t i = 0; i < elements.size(); ++i) {
        const auto& [x_1, x_2, y_1, y_2] = elements[i];
        const auto overlap = [](double low, double high, const Eigen::ArrayXd& places) {
            return std::max(0.0, std::min(high, places[places.size() - 1]) - std::max(low, places[0]));
        };
        load += means[Eigen::Index(i)] * (x_2 - x_1) * (y_2 - y_1);
        area += (x_2 - x_1) * (y_2 - y_1);
        covered += overlap(x_1, x_2, grid.x()) * overlap(y_1, y_2, grid.y());
    }
    const auto require = [&](const std::string& what, double share, double least) {
        if (share >= least) return;
        throw study::BadInput(said + ": the share of " + what + " = " + study::Cell(share).text(3) +
                              " must be at least " + study::Cell(least).text() + "; x and y are " +
                              (outline ? "in the unit of the outline" : "in a and b, from -1 to 1"));
    };
    require("its load on the patch", load / grid.integral(), 0.5);
    require("the patch that it covers", covered / area, 0.9);
    return means * (outline ? a * b : 1) / load;
}

}  // namespace

Pressure read_pressure(const study::Options& options) {
    const std::string said = options.said("pressure");
    if (options.given("pressure")) {
        return [said, grid = read_grid(options)](const Patch& patch) { return means_of(grid, said, patch); };
    }
    if (options.given("outline")) {
        throw study::BadInput(options.said("outline") +
                              " must go with --pressure for friction: Hertz's contact is an ellipse");
    }
    return [](const Patch& patch) { return rollbem::hertz_pressures(patch.contact, patch.mesh, mu_N(patch)); };
}

}  // namespace patch
