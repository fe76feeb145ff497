// Contact patches in three dimensions: Kalker's creep coefficients of ellipses and other outlines in full adhesion,
// steady or over the frequency, whether they are stable in the time domain, the patch as linear differential equations, and forces
// with friction and spin, steady or in the time domain:
//
//     ./patch_study --a-over-b 0.5,1,2 --n 12
//     ./patch_study --n 12 --omega 0.1,1,3
//     ./patch_study --outline wheel.csv --n 16 --stability
//     ./patch_study --n 12 --longitudinal 0.1,0.2,0.4 --spin 0,0.2
//     ./patch_study --n 12 --longitudinal 0.1 --spin 0.2 --transient --load-sine 0.5,8
#include <algorithm>
#include <cmath>
#include <complex>
#include <limits>
#include <memory>
#include <optional>
#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

#include <rollbem/adhesion/frequency.hpp>
#include <rollbem/adhesion/stability.hpp>
#include <rollbem/adhesion/state_space.hpp>
#include <rollbem/compiled/frequency.hpp>
#include <rollbem/compiled/patch.hpp>
#include <rollbem/compiled/stability.hpp>

#include "patch/friction.hpp"
#include "patch/help.hpp"
#include "patch/patches.hpp"
#include "patch/plots.hpp"
#include "patch/transient.hpp"
#include "support/options.hpp"
#include "support/program.hpp"
#include "support/state_space_files.hpp"
#include "support/table.hpp"
#include "support/timing.hpp"

namespace {

using patch::Patch;
using study::joined;
using Kernel = rollbem::HalfSpace<double>;

Kernel kernel_of(const Patch& patch) { return Kernel(patch.contact.poisson_ratio()); }

/// Kalker's 3 x 3 coefficients of forces over G a^2, moments over G a^3 and spin times a.
template <class Matrix>
Matrix to_kalker(const Patch& patch, Matrix coefficients) {
    const double force = patch.contact.a_over_b(), length = std::sqrt(force);
    coefficients *= force;
    coefficients.col(2) *= length;
    coefficients.row(2) *= length;
    return coefficients;
}

/// c11, c22, c23, c32, c33, those left out which cannot be trusted: of a long patch those that other meshes do not
/// confirm.
template <class Matrix>
std::vector<typename Matrix::Scalar> trusted(rollbem::Status status, const Eigen::MatrixXd& changes,
                                             const Matrix& given) {
    const bool known = status == rollbem::Status::ok || status == rollbem::Status::not_converged;
    std::vector<typename Matrix::Scalar> values;
    for (const auto& [i, j] : {std::pair{0, 0}, {1, 1}, {1, 2}, {2, 1}, {2, 2}}) {
        const bool confirmed = changes.size() == 0 || changes(i, j) <= rollbem::largest_mesh_change;
        values.push_back(known && confirmed ? given(i, j) : std::numeric_limits<double>::quiet_NaN() * given(i, j));
    }
    return values;
}

double if_ok(rollbem::Status status, double value) {
    return status == rollbem::Status::ok ? value : std::numeric_limits<double>::quiet_NaN();
}

/// Of a patch that is not its own mirror image.
const std::vector<std::pair<Eigen::Index, Eigen::Index>> unmirrored{{0, 1}, {0, 2}, {1, 0}, {2, 0}};

// --- steady rolling ------------------------------------------------------------------------------------------------

std::vector<std::string> steady_columns(const study::Options& options) {
    std::vector<std::string> names =
        joined(patch::columns(), {"c11", "c22", "c23", "c32", "c33", "residual", "assembly_us", "solve_us"});
    if (options.flag("stability")) {
        names = joined(names, {"unstable_count", "uncertain_count", "spectral_abscissa"});
    }
    return joined(names, {"status", "nodes", "c12", "c13", "c21", "c31"});
}

study::Row steady_row(const study::Options& options, const Patch& patch) {
    // 3. G' by halves where the patch is symmetric, and one right-hand side for each creepage and spin.
    const Kernel kernel = kernel_of(patch);
    const auto solve = [&] { return rollbem::solve_steady(patch.contact, patch.mesh, patch.scheme, kernel); };
    const rollbem::Response<double> steady = solve();
    std::string status = name(steady.status);
    std::optional<double> assembly_us, solve_us;
    if (study::has_times(options)) {
        assembly_us = study::median_time_us(
            [&] { return rollbem::assemble_G_prime(patch.mesh, patch.scheme, kernel)[0][0](0, 0); });
        solve_us = std::max(0.0, study::median_time_us([&] { return solve().c11(); }) - *assembly_us);
    }
    study::Row row = patch::cells(patch);
    const Eigen::MatrixXd c = to_kalker(patch, steady.coefficients);
    for (const double value : trusted(steady.status, steady.error_estimates, c)) row.emplace_back(value);
    row.insert(row.end(), {steady.residual, assembly_us, solve_us});

    // 4. All eigenvalues of G' p = nu G p.
    if (options.flag("stability")) {
        const rollbem::StabilityVerdict verdict =
            rollbem::judge_stability(rollbem::patch_parts(patch.mesh, patch.scheme, kernel));
        if (verdict.status == rollbem::Status::ok) {
            row.insert(row.end(), {verdict.unstable_count, verdict.uncertain_count, verdict.spectral_abscissa});
        } else {
            row.insert(row.end(), {study::Cell(), study::Cell(), study::Cell()});
            if (steady.status == rollbem::Status::ok) status = name(verdict.status);
        }
    }
    row.insert(row.end(), {status, nodes_name(patch)});
    for (const auto& [i, j] : unmirrored) row.emplace_back(if_ok(steady.status, c(i, j)));
    return row;
}

// --- frequency response --------------------------------------------------------------------------------------------

const std::vector<std::string>& response_columns() {
    static const std::vector<std::string> names =
        joined(patch::columns(), {"omega",  "c11_re", "c11_im", "c22_re", "c22_im", "c23_re", "c23_im",
                                  "c32_re", "c32_im", "c33_re", "c33_im", "status", "nodes",  "c12_re",
                                  "c12_im", "c13_re", "c13_im", "c21_re", "c21_im", "c31_re", "c31_im"});
    return names;
}

void emit_sweep(const Patch& patch, const std::vector<double>& omegas, study::RowRange range, const study::Emit& emit) {
    // 5. One reduction to Hessenberg form for each half, then little work for each frequency.
    const rollbem::FrequencySweep<double> sweep(rollbem::patch_parts(patch.mesh, patch.scheme, kernel_of(patch)));
    const rollbem::Response<double> steady =
        rollbem::solve_steady(patch.contact, patch.mesh, patch.scheme, kernel_of(patch));
    for (std::size_t i = range.first; i < range.last; ++i) {
        const rollbem::Response<std::complex<double>> point = sweep(omegas[i]);
        const rollbem::Status status = point.status == rollbem::Status::ok ? steady.status : point.status;
        study::Row row = patch::cells(patch);
        row.emplace_back(omegas[i]);
        const Eigen::MatrixXcd c = to_kalker(patch, point.coefficients);
        for (const std::complex<double>& value : trusted(status, steady.error_estimates, c)) {
            row.emplace_back(value.real());
            row.emplace_back(value.imag());
        }
        row.insert(row.end(), {name(status), nodes_name(patch)});
        for (const auto& [k, j] : unmirrored) {
            row.emplace_back(if_ok(status, c(k, j).real()));
            row.emplace_back(if_ok(status, c(k, j).imag()));
        }
        emit(std::move(row));
    }
}

// --- differential equations ----------------------------------------------------------------------------------------

std::unique_ptr<study::StateSpaceFiles> state_space_files(const study::Options& options,
                                                          const std::vector<Patch>& patches) {
    const std::string said = options.said("state-space");
    if (patches.size() != 1) {
        throw study::BadInput(said +
                              " must go with one patch; the values of --n, --strips, --a-over-b and --poisson make " +
                              std::to_string(patches.size()));
    }
    const Patch& patch = patches.front();
    rollbem::StateSpace<double> space;
    try {
        space = rollbem::state_space(rollbem::rolling_system(patch.mesh, patch.scheme, kernel_of(patch)).whole());
    } catch (const std::invalid_argument& singular) {
        throw study::BadInput(said + " must go with a patch that has one: " + singular.what());
    }
    // from forces over G a^2, moments over G a^3 and spin times a to Kalker's a b and c
    const double force = patch.contact.a_over_b(), length = std::sqrt(force);
    space.B.col(2) *= length;
    space.C *= force;
    space.C.row(2) *= length;
    return std::make_unique<study::StateSpaceFiles>(
        options, space,
        "equations = \"d x/d(q/a) = A x + B (xi, eta, phi c), (-F_x, -F_y, -M_z/c)/(G a b) = C x + D (xi, eta, phi "
        "c); q = V t, c = sqrt(a b); outlines: a, b and c are sqrt(area/pi)\"\n"
        "response = \"(c11 c12 c13; c21 c22 c23; c31 c32 c33) = C (s I - A)^-1 B + D, s in V/a\"\n",
        "tractions p_x/G of the elements, strip by strip from trailing to leading, then p_y/G",
        "the matrix of coefficients");
}

}  // namespace

int main(int argc, char** argv) {
    // 1. The command line.
    study::Options options("patch_study",
                           "Contact patches in three dimensions: creep coefficients, and friction with spin.");
    patch::add_options(options);
    options.group("Result");
    options.add_flag("stability", "also count growing modes (the eigenvalues of G' p = nu G p)");
    options.add("omega", "LIST", "instead: response to creepages at frequencies omega a/V, at least 0 (dimensionless)");
    study::StateSpaceFiles::add_options(options, "one patch");
    patch::add_friction_options(options);
    patch::add_transient_options(options);
    const std::vector<std::string> friction{"longitudinal", "lateral", "spin"};
    options.not_with({"stability", "state-space"}, "omega");
    for (const std::string& creepage : friction) options.not_with({"stability", "omega", "state-space"}, creepage);
    options.only_with({"pressure", "tractions", "transient"}, friction);
    options.not_with({"tractions"}, "transient");
    options.footer(patch::help, patch::topics);

    return study::run_program(options, argc, argv, [](const study::Options& given) {
        // 2. One row for each patch, or for each patch and frequency.
        const bool harmonic = given.given("omega");
        std::vector<double> omegas;
        if (harmonic) {
            omegas = given.numbers("omega",
                                   {[](double z) { return z >= 0 && std::isfinite(z); }, "be at least 0 and finite"});
        }
        const bool rubs = patch::asks_for_friction(given);
        if (given.given("state-space") && given.given("shard")) {
            throw study::BadInput(given.said("shard") + " cannot go with --state-space: every part would write it");
        }
        const std::vector<Patch> patches = patch::make_patches(given);
        if (rubs) {
            // 6. Stick and slip at each creepage, or in the time domain.
            (given.flag("transient") ? patch::run_transient : patch::run_friction)(given, patches);
            return study::exit_ok;
        }
        std::unique_ptr<study::StateSpaceFiles> state_space;
        if (given.given("state-space")) state_space = state_space_files(given, patches);

        study::Table table = study::table_of(harmonic ? response_columns() : steady_columns(given), patches,
                                             harmonic ? omegas.size() : 1);
        table.compute = [&](std::size_t task, study::RowRange range, const study::Emit& emit) {
            if (harmonic) return emit_sweep(patches[task], omegas, range, emit);
            emit(steady_row(given, patches[task]));
        };
        table.written = [&] {
            if (state_space) state_space->commit();
        };
        table.plot = [&](const std::vector<study::Row>& rows) {
            return harmonic ? patch::draw_responses(response_columns(), rows)
                            : patch::draw_coefficients(steady_columns(given), rows);
        };
        study::write_table(given, table);
        return study::exit_ok;
    });
}
