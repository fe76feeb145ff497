#include "friction.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <numbers>
#include <optional>

#include <Eigen/Cholesky>

#include <rollbem/adhesion/creep_coefficients.hpp>
#include <rollbem/compiled/friction.hpp>
#include <rollbem/compiled/patch.hpp>

#include "plots.hpp"
#include "pressure.hpp"
#include "support/table.hpp"
#include "support/timing.hpp"

namespace patch {

namespace {

// G = 1 and mu N = G a b: a creepage is the given number
constexpr double mu = 1;
constexpr double peak = 3 / (2 * std::numbers::pi);  // mu p_0

std::vector<study::Row> traction_rows(const Patch& patch, const CreepPoint& point,
                                      const rollbem::Creepage<double>& creepage, const rollbem::FrictionState<2>& state,
                                      const rollbem::ElementVectors<double>& slip, const std::string& status) {
    const rollbem::Elements<double> elements = rollbem::patch_elements(patch.mesh, patch.scheme);
    const double b_over_a = 1 / patch.contact.a_over_b(), spin = creepage.spin * patch.contact.half_length();
    double largest = 0;
    for (Eigen::Index i = 0; i < elements.size(); ++i) {
        largest = std::max(
            largest, std::hypot(creepage.longitudinal - spin * elements.y[i], creepage.lateral + spin * elements.x[i]));
    }
    if (largest == 0) largest = 1;  // then nothing slips
    std::vector<study::Row> rows;
    for (Eigen::Index i = 0; i < elements.size(); ++i) {
        const double strip = patch.mesh.widths()[i / patch.mesh.elements_per_strip()];
        study::Row row = cells(patch);
        row.insert(row.end(), {point.longitudinal, point.lateral, point.spin, elements.centre_x[i],
                               elements.centre_y[i] / b_over_a, elements.areas[i] / strip, strip / b_over_a,
                               mu * state.normal_pressure[i] / peak});
        if (status == "ok") {
            row.insert(row.end(), {state.traction(i, 0) / peak, state.traction(i, 1) / peak, slip(i, 0) / largest,
                                   slip(i, 1) / largest, int(state.zones[std::size_t(i)] == rollbem::Zone::stick)});
        } else {
            row.insert(row.end(), 5, study::Cell());
        }
        row.emplace_back(status);
        rows.push_back(std::move(row));
    }
    return rows;
}

/// The rows of a patch, each solved from rest; `tractions` may be null.
void friction_rows(const study::Options& options, const Patch& patch, const std::vector<CreepPoint>& points,
                   const Pressure& pressure, std::size_t task, study::RowRange range, const study::Emit& emit,
                   Tractions* tractions) {
    const double mu_N = patch.contact.half_length() * patch.contact.half_width(), c = patch.contact.c();
    const rollbem::FrictionModel<rollbem::ConstantFriction<double>, 2> model(
        patch.contact,
        steady_system(patch.mesh, patch.scheme, rollbem::HalfSpace<double>(patch.contact.poisson_ratio())),
        {mu, pressure.on(patch)});
    auto workspace = model.workspace();
    const auto rest = model.at_rest();
    auto state = rest;
    for (std::size_t i = range.first; i < range.last; ++i) {
        const CreepPoint& point = points[i];
        const rollbem::Creepage<double> creepage{point.longitudinal, point.lateral, point.spin / c};
        std::optional<double> time_us;
        if (study::has_times(options)) {
            time_us = study::median_time_us(
                [&] { return model.steady(rest, creepage, state, workspace).force.longitudinal; });
        }
        const rollbem::FrictionStep<2> step = model.steady(rest, creepage, state, workspace);
        const std::string status = name(step.status);
        study::Row row = cells(patch);
        row.insert(row.end(), {point.longitudinal, point.lateral, point.spin});
        const auto& force = step.force;
        for (const double value : {force.longitudinal, force.lateral, force.moment / c}) {
            row.emplace_back(step.status == rollbem::StepStatus::ok ? study::Cell(0 - value / mu_N) : study::Cell());
        }
        row.insert(row.end(),
                   {step.stick_count, step.rounds, step.complementarity_residual, time_us, status, nodes_name(patch)});
        emit(std::move(row));
        if (tractions) {
            tractions->add(task, i, traction_rows(patch, point, creepage, state, workspace.slip(), status));
        }
    }
}

}  // namespace

void add_friction_options(study::Options& options) {
    options.group("Friction");
    options.add("longitudinal", "LIST",
                "instead: friction at longitudinal creepages xi, times G a b/(mu N) (dimensionless)", "0");
    options.add("lateral", "LIST", "the same with lateral creepages eta, times G a b/(mu N) (dimensionless)", "0");
    options.add("spin", "LIST", "the same with spin phi, times G a b c/(mu N) (dimensionless)", "0");
    options.add_input("pressure",
                      "with these: CSV file with the columns x,y,pressure instead of Hertz's pressure: any unit, rows "
                      "that make a grid in any order, bilinear between them, zero outside; x and y in a and b, of an "
                      "outline in its unit");
    options.add_table("tractions", "with these, also write a CSV file with one row per element, and FILE.toml");
}

bool asks_for_friction(const study::Options& options) {
    return options.given("longitudinal") || options.given("lateral") || options.given("spin");
}

std::vector<CreepPoint> read_points(const study::Options& options, const std::vector<Patch>& patches) {
    const study::Rule rule = study::between(-1e6, 1e6);
    std::vector<CreepPoint> points;
    for (const double longitudinal : options.numbers("longitudinal", rule)) {
        for (const double lateral : options.numbers("lateral", rule)) {
            for (const double spin : options.numbers("spin", rule)) points.push_back({longitudinal, lateral, spin});
        }
    }
    const auto spins = [](const CreepPoint& point) { return point.spin != 0; };
    if (std::none_of(points.begin(), points.end(), spins)) return points;
    for (const Patch& patch : patches) {
        // moments are those of tractions at the middles of elements, slip is taken elsewhere in them: creep work
        // without slip, a quadratic form, may become negative where elements are few
        const auto steady = rollbem::solve_steady(patch.contact, patch.mesh, patch.scheme,
                                                  rollbem::HalfSpace<double>(patch.contact.poisson_ratio()));
        const Eigen::Matrix3d C = steady.coefficients;
        if (steady.status != rollbem::Status::ok ||
            Eigen::LLT<Eigen::Matrix3d>(C + C.transpose()).info() == Eigen::Success)
            continue;
        throw study::BadInput(options.said("spin") + " must go with more elements or strips than " + patch.label() +
                              ": rolling could gain energy");
    }
    return points;
}

void Tractions::add(std::size_t task, std::size_t point, std::vector<study::Row> rows) {
    const std::lock_guard<std::mutex> lock(mutex_);
    rows_[{task, point}] = std::move(rows);
}

void Tractions::write(study::TableFile& file) const {
    for (const auto& [place, rows] : rows_) {
        for (const study::Row& row : rows) file.rows().write(study::csv_line(row));
    }
    file.commit();
}

const std::vector<std::string>& friction_columns() {
    static const std::vector<std::string> names = study::joined(
        columns(), {"longitudinal", "lateral", "spin", "longitudinal_force", "lateral_force", "spin_moment",
                    "stick_count", "rounds", "complementarity_residual", "time_us", "status", "nodes"});
    return names;
}

const std::vector<std::string>& traction_columns() {
    static const std::vector<std::string> names =
        study::joined(columns(), {"longitudinal", "lateral", "spin", "x", "y", "width", "strip_width", "pressure_bound",
                                  "traction_x", "traction_y", "slip_x", "slip_y", "stick", "status"});
    return names;
}

void run_friction(const study::Options& options, const std::vector<Patch>& patches) {
    const std::vector<CreepPoint> points = read_points(options, patches);
    const Pressure pressure(options);
    for (const Patch& patch : patches) pressure.on(patch);  // before anything is written
    std::optional<study::TableFile> tractions_file;
    if (options.given("tractions")) {
        tractions_file.emplace(options, "tractions",
                               study::has_header(options) ? study::join(traction_columns(), ",") + "\n" : "");
    }
    const bool from_above = points.size() == 1 && patches.size() <= 3 && options.given("plot");
    Tractions tractions;

    study::Table table = study::table_of(friction_columns(), patches, points.size());
    table.compute = [&](std::size_t task, study::RowRange range, const study::Emit& emit) {
        friction_rows(options, patches[task], points, pressure, task, range, emit,
                      tractions_file || from_above ? &tractions : nullptr);
    };
    table.written = [&] {
        if (tractions_file) tractions.write(*tractions_file);
    };
    table.plot = [&](const std::vector<study::Row>& rows) {
        return from_above ? draw_from_above(patches, points.front(), tractions) : draw_friction(rows);
    };
    study::write_table(options, table);
}

}  // namespace patch
