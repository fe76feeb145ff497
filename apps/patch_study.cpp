// Contact patches in three dimensions: Kalker's creep coefficients of ellipses and other outlines in full adhesion,
// steady or over the frequency, whether they are stable in the time domain, the patch as linear differential equations,
// and forces with friction and spin, steady or in the time domain:
//
//     ./patch_study --a-over-b 0.5,1,2 --n 12
//     ./patch_study --n 12 --omega 0.1,1,3
//     ./patch_study --outline wheel.csv --n 16 --stability
//     ./patch_study --n 12 --longitudinal 0.1,0.2,0.4 --spin 0,0.2
//     ./patch_study --n 12 --longitudinal 0.1 --spin 0.2 --transient --load-sine 0.5,8
#include <algorithm>
#include <cmath>
#include <complex>
#include <cstddef>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include <rollbem/adhesion/balanced_reduction.hpp>
#include <rollbem/adhesion/frequency.hpp>
#include <rollbem/adhesion/stability.hpp>
#include <rollbem/adhesion/transient.hpp>
#include <rollbem/assembly/patch_system.hpp>
#include <rollbem/assembly/rolling_system.hpp>
#include <rollbem/discretisation/scheme.hpp>
#include <rollbem/elasticity/line_kernel.hpp>
#include <rollbem/elasticity/patch_kernel.hpp>
#include <rollbem/spectral/chebyshev.hpp>
#include <rollbem/steady/creep_coefficients.hpp>
#include <rollbem/steady/steady.hpp>

#include "patch/patch.hpp"
#include "support/options.hpp"
#include "support/sheet.hpp"
#include "support/state_space_files.hpp"
#include "support/timing.hpp"

namespace {

using patch::Patch;
using Complex = std::complex<double>;
using Verdict = rollbem::StabilityVerdict;

// --- coefficients --------------------------------------------------------------------------------------------------

/// Kalker's 3 x 3 coefficients of a patch, steady or at a frequency.
struct Found {
    Eigen::Matrix3cd c;  ///< of forces over G a^2, moments over G a^3 and spin times a
    rollbem::Status status;
    rollbem::Response<double> steady;  ///< tells which of them can be used
    double omega = 0;
    std::optional<double> assembly_us{}, solve_us{};
    std::optional<Verdict> verdict{};

    std::string word() const { return name(status == rollbem::Status::ok && verdict ? verdict->status : status); }
    /// c_ij; nothing where it cannot be trusted.
    std::optional<Complex> at(Eigen::Index i, Eigen::Index j) const {
        const bool known = status == steady.status && is_confirmed(steady, i, j);
        return known ? std::optional(c(i, j)) : std::nullopt;
    }
};

Found found(const Patch& patch, Eigen::Matrix3cd c, rollbem::Status status, rollbem::Response<double> steady) {
    const double force = patch.contact.a_over_b(), length = std::sqrt(force);
    c *= force;
    c.col(2) *= length;
    c.row(2) *= length;
    steady.unknowns.resize(0, 0);
    return {.c = c, .status = status, .steady = std::move(steady)};
}

using Columns = std::vector<study::Column<Found>>;
using Sheet = study::Sheet<Found, Patch>;

/// Columns c11 and so on for each pair of digits, real or with real and imaginary part.
Columns coefficients(const std::vector<std::string>& digits, bool complex, const std::string& meaning) {
    Columns columns;
    for (const std::string& ij : digits) {
        const Eigen::Index i = ij[0] - '1', j = ij[1] - '1';
        const auto part = [=](double (*of)(const Complex&)) {
            return [=](const Found& f) { return f.at(i, j) ? study::Cell(of(*f.at(i, j))) : study::Cell(); };
        };
        columns.push_back({"c" + ij + (complex ? "_re" : ""), meaning, part(std::real)});
        if (complex) columns.push_back({"c" + ij + "_im", meaning, part(std::imag)});
    }
    return columns;
}

Sheet make_sheet(const Columns& before, bool harmonic, const Columns& behind) {
    const Columns status{
        {"status",
         "ok; not_converged if some coefficients may be off by more than 5 %: these are empty. Ellipses of few "
         "elements or strips (8, 12 above a/b = 3.5), or above a/b = 10, and outlines are compared with limits that "
         "meshes of 8, 12 and 16 elements a strip show",
         &Found::word}};
    const Columns columns =
        study::joined(study::joined(before, coefficients({"11", "22", "23", "32", "33"}, harmonic,
                                                         "Kalker's coefficient; empty if status is not ok")),
                      study::joined(study::joined(behind, status),
                                    coefficients({"12", "13", "21", "31"}, harmonic,
                                                 "coefficients that are 0 if y -> -y leaves the patch unchanged")));
    return {patch::identity, columns, patch::distinctions};
}

/// A number of the verdict.
template <class Value>
auto judged(const Value& value) {
    return study::where([](const Found& f) { return f.verdict && f.verdict->status == rollbem::Status::ok; },
                        [=](const Found& f) { return std::invoke(value, *f.verdict); });
}

Sheet steady_sheet(bool stability) {
    Columns columns{
        {"residual", "residual of the equations for the tractions p, max|G' p - slip| / (|G'| max|p| + max|slip|)",
         [](const Found& f) { return f.steady.residual; }},
        {"assembly_us", std::string("time of G' [microseconds], ") + study::median_of_runs, &Found::assembly_us},
        {"solve_us", std::string("time of its equations [microseconds], ") + study::median_of_runs, &Found::solve_us}};
    const Columns modes{
        {"unstable_count", "number of modes e^{nu V t} with Re(nu) > 0; this and the next two with --stability",
         judged(&Verdict::unstable_count)},
        {"uncertain_count",
         "number of modes whose sign rounding could change one by one (a proof that all decay may exist all the same)",
         judged(&Verdict::uncertain_count)},
        {"spectral_abscissa", "largest Re(nu) a", judged(&Verdict::spectral_abscissa)}};
    return make_sheet({}, false, stability ? study::joined(columns, modes) : columns);
}

Sheet response_sheet() { return make_sheet({{"omega", "frequency omega a/V", &Found::omega}}, true, {}); }

Found steady(const Patch& patch, bool timed, bool stability) {
    // G' by halves where the patch is symmetric, and one right-hand side for each creepage and spin.
    const auto solve = [&] { return rollbem::solve_steady(patch.contact, patch.mesh, patch.scheme, patch.kernel()); };
    const rollbem::Response<double> response = solve();
    Found result = found(patch, response.coefficients.cast<Complex>(), response.status, response);
    if (timed) {
        result.assembly_us = study::median_time_us(
            [&] { return rollbem::assemble_G_prime(patch.mesh, patch.scheme, patch.kernel())[0][0](0, 0); });
        // the equations of each half, matrices ready
        const auto parts = rollbem::patch_subsystems(patch.mesh, patch.scheme, patch.kernel());
        result.solve_us = study::median_time_us([&] {
            double sum = 0;
            for (const auto& part : parts) sum += rollbem::solve_steady(part).coefficients(0, 0);
            return sum;
        });
    }
    // All eigenvalues of G' p = nu G p.
    if (stability) {
        result.verdict = rollbem::judge_stability(rollbem::patch_subsystems(patch.mesh, patch.scheme, patch.kernel()));
    }
    return result;
}

void emit_sweep(const Patch& patch, const std::vector<double>& omegas, study::RowRange range,
                const study::Results<Found>& emit) {
    // One reduction to Hessenberg form for each half, then little work for each frequency.
    const rollbem::FrequencySweep sweep(rollbem::patch_subsystems(patch.mesh, patch.scheme, patch.kernel()));
    const rollbem::Response<double> steady =
        rollbem::solve_steady(patch.contact, patch.mesh, patch.scheme, patch.kernel());
    for (std::size_t i = range.first; i < range.last; ++i) {
        const rollbem::Response<Complex> point = sweep(omegas[i]);
        const rollbem::Status status = point.status == rollbem::Status::ok ? steady.status : point.status;
        Found row = found(patch, point.coefficients, status, steady);
        row.omega = omegas[i];
        emit(row);
    }
}

// --- differential equations ----------------------------------------------------------------------------------------

rollbem::StateSpace equations_of(const Patch& patch) {
    rollbem::StateSpace space =
        rollbem::state_space(rollbem::rolling_system(patch.mesh, patch.scheme, patch.kernel()).joined());
    // from forces over G a^2, moments over G a^3 and spin times a to Kalker's a b and c
    const double force = patch.contact.a_over_b(), length = std::sqrt(force);
    space.B.col(2) *= length;
    space.C *= force;
    space.C.row(2) *= length;
    return space;
}

study::StateSpaceWords words_of_equations(const Patch& patch) {
    const auto steady = rollbem::solve_steady(patch.contact, patch.mesh, patch.scheme, patch.kernel());
    return {.one = "patch",
            .lists = "--n, --strips, --a-over-b and --poisson",
            .conventions =
                "# equations = d x/d(q/a) = A x + B (xi, eta, phi c), (-F_x, -F_y, -M_z/c)/(G a b) = C x + "
                "D (xi, eta, phi c); q = V t, c = sqrt(a b); outlines: a, b and c are sqrt(area/pi)\n"
                "# response = (c11 c12 c13; c21 c22 c23; c31 c32 c33) = C (s I - A)^-1 B + D, s in V/a\n"
                "# status = " +
                std::string(name(steady.status)) + " of the steady coefficients, as in the table\n",
            .states = "tractions p_x/G of the elements, strip by strip from trailing to leading, then p_y/G",
            .bounded = "the matrix of coefficients"};
}

/// The text of --help; `columns` name the coefficients.
std::string help(const std::string& columns) {
    return R"(Examples: Kalker's creep coefficients over a/b, against his table; a triangle, pointed in front
  patch_study --a-over-b 0.1,0.2,0.5,1,2,5,10 --poisson 0,0.25,0.5 --n 16 --output c.csv --plot c.svg
  printf 'y,x_trailing,x_leading\n-1,-1,-1\n0,-1,2\n1,-1,-1\n' > triangle.csv
  patch_study --n 12 --outline triangle.csv --strips 12
Whether all modes decay; creep curves with and without spin; one patch from above; a load that varies by half
  patch_study --a-over-b 0.2,1,5 --n 8,12 --stability
  patch_study --n 12 --longitudinal 0,0.1,0.2,0.3,0.4,0.5 --spin 0,0.3 --plot curves.svg
  patch_study --n 12 --a-over-b 2 --lateral 0.1 --spin 0.3 --tractions t.csv --plot patch.svg
  patch_study --n 12 --longitudinal 0.1 --spin 0.2 --transient --load-sine 0.5,8 --breathing --until 24

x is the rolling direction, y lies across it, z points into body 2 (the rail). Creepages xi, eta along x and y,
spin phi about z: F_x = -G a b (c11 xi + c12 eta + c13 c phi), F_y = -G a b (c21 xi + c22 eta + c23 c phi),
M_z = -G a b c (c31 xi + c32 eta + c33 c phi), c = sqrt(a b), about the origin of the outline; c32 = -c23 in the limit
of small elements if x -> -x leaves the patch unchanged. Bodies are equal half-spaces.
The patch is cut into strips along x, each with --n elements (rectangles) on a cosine mesh that ends on the
outline. With n = strips = 12 and a/b up to 10 c11 and c22 are within 1 %, c23 and c32 within 2 %, c33 within 0.9 % at
nu = 0.28 up to a/b = 5 and else within 5 %. Four times as many elements as strips suit patches more than ten times
longer than wide, --n 48 --strips 12; c33 at nu = 0.5 takes more.
)" + columns +
           R"(--state-space: d x/d(q/a) = A x + B (xi, eta, phi c),
(-F_x, -F_y, -M_z/c)/(G a b) = C x + D (xi, eta, phi c).
--outline: a row is a line y = const, which cuts the patch from x_trailing to x_leading; only the first and the last row
may have x_trailing = x_leading. a, b and c are sqrt(area/pi), and creepages, spin and moment refer to the origin of x
and y: put it where the bodies' motion is known. --strip-edges FILE puts edges of strips on corners of the outline.
--omega: c11_re, c11_im and so on, real and imaginary parts of the coefficients, in place of c11 and so on.
--pressure: the table must cover nine tenths of the patch. Means over the elements are exact and scaled so that they
carry N: the unit of the pressure does not matter, nor a part of it outside the patch, up to half. An outline needs one.

--longitudinal, --lateral, --spin: a row for every combination of the creepages, each solved from rest:
)" + patch::friction_help() +
           R"(Errors of 12 x 12 elements: 1e-3 of mu N without spin, 6e-3 with spin in the mean and 2e-2 under large
spin, for which strips of equal width are better, an odd number, at a/b >= 1 half as many as elements, more at smaller
a/b (precision_study --recommend): --n 12 --strips 7 --strip-grading uniform errs by 5e-3 where 12 x 12 cosine strips
err by 1.7e-2. Meshes are compared for creep coefficients alone: where those have the status not_converged, take more
elements and strips.
--creepage XI,ETA,PHI: one ellipse in SI units; also its ratios stand in the row.
  patch_study --n 12 --creepage 0.001,0,0.3 --normal-load 8e4 --friction 0.3 --half-length 6e-3 --half-width 4e-3 \
      --shear-modulus 8.2e10
--falling, --memory: slip velocities in V mu_0 p_0/G, p_0 = 3 N/(2 pi a b) Hertz's largest pressure, distances in
c mu_0 p_0/G; mu is mu_0 in all ratios. Particles remember along their strips, on a mesh without --breathing. Where mu
falls steeply, several solutions may exist, and rows take the one with most friction.
--plot draws up to three patches at one creepage from above, with y downwards and z away from the viewer. At the pole of
spin the rigid slip vanishes.

--transient: creepages have one value each, or a --history, and are scaled as above by N_0, a_0 and b_0, the values at
load_ratio 1. Rigid shifts, shift_x and shift_y of a --history, displace the bodies in addition. Where a shift or the force
jumps, the bodies move without rolling, in the time of a step; a jump at q = 0 has a row of its own. p_0 is
3 N/(2 pi a b) always. One row for each step:
)" + patch::transient_help() +
           R"(With --breathing, the default where --load has a_ratio,b_ratio and never vanishes, the mesh follows the
ellipse, also where a/b changes (second order in 1/n); where a changes by as much as the step rolls, status is
needs_fixed_mesh and the run ends. Otherwise the mesh covers the largest ellipse of the run: first order, and the load
may vanish. Steps are divided where --load has a row, and in halves, up to six times, where they have no solution. If a
step fails, the run has no more results, and the exit code is 1. A patch whose modes grow in time is refused
(--stability shows them).
)";
}

void add_options(study::Options& options) {
    patch::add_options(options);
    options.group("Result");
    options.add_flag("stability",
                     "count of the modes that grow, from the eigenvalues of G' p = nu G p, in further columns");
    options.add("omega", "LIST",
                "frequencies omega a/V of the creepages [dimensionless], at least 0, for the response in place of "
                "steady coefficients");
    study::add_state_space_options(options, "the one patch");
    patch::add_friction_options(options);
    patch::add_transient_options(options);
    patch::add_si_options(options);
    const std::vector<std::string> friction = patch::ways_of_friction();
    options.not_with({"stability", "state-space"}, "omega");
    for (const std::string& creepage : friction) options.not_with({"stability", "omega", "state-space"}, creepage);
    options.only_with(study::joined(study::friction_law_options(), {"pressure", "tractions", "transient"}), friction);
    options.not_with({"tractions"}, "transient");
    options.footer(help(steady_sheet(true).help()));
}

/// Patches in full adhesion.
struct Coefficients {
    const std::vector<Patch>& patches;
    std::vector<double> omegas;  ///< of responses; empty: steady
    bool stability, timed;
};

Coefficients read_coefficients(const study::Options& options, const std::vector<Patch>& patches) {
    Coefficients scene{patches, {}, options.flag("stability"), study::has_times(options)};
    if (options.given("omega")) scene.omegas = options.numbers("omega", study::not_negative());
    return scene;
}

/// A row for each patch, or for each patch and frequency.
study::Table coefficient_table(const Coefficients& scene) {
    static const Sheet responses = response_sheet(), counted = steady_sheet(true), plain = steady_sheet(false);
    const bool harmonic = !scene.omegas.empty();
    const Sheet& sheet = harmonic ? responses : scene.stability ? counted : plain;
    study::Table table = sheet.table(
        scene.patches, [&](const Patch&) { return harmonic ? scene.omegas.size() : 1; },
        [&scene, harmonic](const Patch& patch, study::RowRange range, const study::Results<Found>& emit) {
            harmonic ? emit_sweep(patch, scene.omegas, range, emit) : emit(steady(patch, scene.timed, scene.stability));
        });
    table.plot = [harmonic](const study::Records& rows) {
        return (harmonic ? patch::draw_responses : patch::draw_coefficients)(rows);
    };
    return table;
}

}  // namespace

int main(int argc, char** argv) {
    study::Options options("patch_study",
                           "Contact patches in three dimensions: creep coefficients, and friction with spin.");
    add_options(options);
    return study::run_program(options, argc, argv, [](const study::Options& given) {
        const std::vector<Patch> patches = patch::read_patches(given);
        const std::vector<std::string> ways = patch::ways_of_friction();
        if (std::none_of(ways.begin(), ways.end(), [&](const std::string& way) { return given.given(way); })) {
            const Coefficients scene = read_coefficients(given, patches);
            study::OutputFiles files;
            if (given.given("state-space")) {
                const Patch& patch = patches.front();
                study::write_state_space(
                    given, files, patches.size(), [&] { return equations_of(patch); }, words_of_equations(patch));
            }
            study::write_table(given, coefficient_table(scene), files);
        } else if (given.flag("transient")) {
            const patch::TimeScene scene = patch::read_time_scene(given, patches);
            study::write_table(given, patch::transient_table(scene));
        } else {
            const patch::Friction scene = patch::read_friction(given, patches);
            study::write_table(given, patch::friction_table(scene));
        }
        return study::exit_ok;
    });
}
