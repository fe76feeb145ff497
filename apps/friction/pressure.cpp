#include "pressure.hpp"

#include <stdexcept>
#include <string>
#include <vector>

#include <rollbem/normal/hertz.hpp>
#include <rollbem/normal/pressure_table.hpp>

#include "support/columns_file.hpp"
#include "support/errors.hpp"

namespace friction {

Pressure make_pressure(const study::Options& options) {
    if (!options.given("pressure")) {
        const rollbem::HertzPressure<double> hertz;
        return {hertz, hertz, true};
    }
    const study::Pairs points = study::read_pairs(options, "pressure", "x_over_a,pressure", study::between(-1, 1));
    const auto column = [](const std::vector<double>& values) {
        return Eigen::ArrayXd(Eigen::Map<const Eigen::ArrayXd>(values.data(), Eigen::Index(values.size())));
    };
    Eigen::ArrayXd pressures = column(points.values);
    const double largest = pressures.maxCoeff();
    if (largest > 0 && pressures.minCoeff() >= 0)
        pressures /= largest;  // the unit does not matter, however small or large it makes the numbers
    try {
        const rollbem::PressureTable<double> table(column(points.places), pressures);
        const double scale = mu_N / table.integral();
        return {[=](double x_over_a) { return scale * table(x_over_a); },
                [=](const rollbem::Mesh<double>& mesh) { return Eigen::ArrayXd(scale * table(mesh)); }, false};
    } catch (const std::invalid_argument& error) {
        throw study::BadInput(options.said("pressure") + ": " + error.what());
    }
}

double creepage(const study::Scene& scene, double ratio) { return 2 * (1 - scene.contact.poisson_ratio()) * ratio; }

study::Cell relative_error(double value, std::optional<double> exact) {
    return exact && *exact != 0 ? study::Cell(value / *exact - 1) : study::Cell();
}

}  // namespace friction
