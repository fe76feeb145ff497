// Steady creep forces of ellipses with friction and spin on a grid, for look-up in the time loop of a vehicle: rows as
// CSV, the CreepForceTable that interpolates them, and how far it is from the patches that it was made from:
//
//     ./creep_table --output table.csv --jobs 2
//     ./creep_table --n 6 --levels 5 --shapes 6 --output coarse.csv --check 1000
#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <functional>
#include <mutex>
#include <numbers>
#include <optional>
#include <random>
#include <sstream>
#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

#include <rollbem/compiled/creep_force_table.hpp>
#include <rollbem/compiled/patch.hpp>
#include <rollbem/detail/parallel_for.hpp>
#include <rollbem/vehicle/make_creep_force_table.hpp>

#include "support/csv.hpp"
#include "support/input.hpp"
#include "support/options.hpp"
#include "support/progress.hpp"
#include "support/table.hpp"

namespace {

using rollbem::CreepForceGrid, rollbem::CreepForceTable, rollbem::Creepage;

/// The grid and the patches that forces on it come from.
struct Job {
    CreepForceGrid grid;
    std::ptrdiff_t n;
    std::vector<std::array<double, 2>> elements;  ///< of each ellipse: elements of a strip, strips
};

Job make_job(const study::Options& options) {
    const std::vector<double> ends = options.numbers("a-over-b", study::between(1e-3, 1e3));
    if (ends.size() != 2 || !(ends[0] < ends[1])) {
        throw study::BadInput(options.said("a-over-b") + " must be the smallest and the largest, in this order");
    }
    const double nu = options.number("poisson", study::between(0, 0.5));
    const std::ptrdiff_t n = options.integer("n", 2, 100), shapes = options.integer("shapes", 4, 100);
    const auto levels = static_cast<int>(options.integer("levels", 4, 64));
    const Eigen::Index numbers = CreepForceGrid::coefficient_count(levels, shapes);
    if (numbers > CreepForceGrid::most_coefficients) {
        throw study::BadInput(
            options.said("levels") + ", " + options.said("shapes") +
            " give a table of (levels + 3)^2 (2 levels + 3) (shapes + 2) = " + std::to_string(numbers) +
            " coefficients, which must be at most " + std::to_string(CreepForceGrid::most_coefficients));
    }
    std::vector<rollbem::CreepCoefficients<double>> coefficients(static_cast<std::size_t>(shapes));
    std::vector<std::array<double, 2>> elements(coefficients.size());
    rollbem::detail::parallel_for(coefficients.size(), study::job_count(options), [&](std::size_t i) {
        const double a_over_b = CreepForceGrid::a_over_b_of(static_cast<Eigen::Index>(i),
                                                            static_cast<Eigen::Index>(shapes), ends[0], ends[1]);
        rollbem::CreepForceSource source(a_over_b, nu, n);
        const rollbem::Response<double> steady = source.in_adhesion();
        coefficients[i] = creep_coefficients(source.contact(), steady);
        elements[i] = {static_cast<double>(source.mesh().elements_per_strip()),
                       static_cast<double>(source.mesh().strip_count())};
        // with a spin so large that both meshes count
        const rollbem::StepStatus sliding = source.solve({0, 0, 10}, true).step.status;
        if (steady.status == rollbem::Status::ok && sliding == rollbem::StepStatus::ok) return;
        throw study::BadInput(options.said("a-over-b") + ": a/b = " + study::Cell(a_over_b).text(6) +
                              " with --n = " + std::to_string(n) + " must have the status ok, not " +
                              (sliding == rollbem::StepStatus::ok ? name(steady.status) : name(sliding)));
    });
    try {
        return {CreepForceGrid(nu, ends[0], ends[1], levels, std::move(coefficients)), n, std::move(elements)};
    } catch (const std::invalid_argument& error) {
        throw study::BadInput("--n = " + std::to_string(n) + " is too small: " + error.what());
    }
}

// --- rows ----------------------------------------------------------------------------------------------------------

const std::vector<std::string>& columns() {
    static const std::vector<std::string> names = study::cells_of(
        "a_over_b,poisson,n,strips,longitudinal,lateral,spin,longitudinal_force,lateral_force,spin_moment,stick_count,"
        "rounds,complementarity_residual,time_us,status,nodes");
    return names;
}

void emit_slab(const Job& job, const rollbem::CreepForceSlab& slab, study::RowRange range, const study::Emit& emit) {
    const CreepForceGrid& grid = job.grid;
    rollbem::CreepForceSource source(grid.a_over_b(slab.shape), grid.poisson_ratio(), job.n);
    const Eigen::Index first = slab.first + static_cast<Eigen::Index>(range.first),
                       last = slab.first + static_cast<Eigen::Index>(range.last);
    // along a line of growing spin each solution starts from the one before, also where rows begin in the middle
    Eigen::Index begin = first;
    while (!grid.begins_line(begin)) --begin;
    for (Eigen::Index node = begin; node < last; ++node) {
        const Creepage<double> v = grid.creepage(slab.shape, node);
        const rollbem::CreepForceSource::Solution solution = source.solve(v, grid.begins_line(node));
        if (node < first) continue;
        const auto& step = solution.step;
        study::Row row{source.contact().a_over_b(),
                       grid.poisson_ratio(),
                       source.mesh().elements_per_strip(),
                       source.mesh().strip_count(),
                       v.longitudinal,
                       v.lateral,
                       v.spin};
        for (const double value : solution.force) {
            row.emplace_back(step.status == rollbem::StepStatus::ok ? study::Cell(value) : study::Cell());
        }
        row.insert(row.end(), {step.stick_count, step.rounds, step.complementarity_residual, study::Cell(),
                               name(step.status), "chebyshev"});
        emit(std::move(row));
    }
}

/// The forces of rows, which must be all those of the grid. `where` names a row, counted from 0, for messages.
Eigen::Array3Xd read_forces(const Job& job, const std::vector<std::string>& lines,
                            const std::function<std::string(std::size_t)>& where) {
    const CreepForceGrid& grid = job.grid;
    Eigen::Array3Xd forces(3, grid.nodes() * grid.shapes());
    if (static_cast<Eigen::Index>(lines.size()) != forces.cols()) {
        throw study::BadInput(where(lines.size()) + ": number of rows = " + std::to_string(lines.size()) + " must be " +
                              std::to_string(forces.cols()));
    }
    for (std::size_t i = 0; i < lines.size(); ++i) {
        const auto column = static_cast<Eigen::Index>(i);
        const Eigen::Index shape = column / grid.nodes();
        const Creepage<double> v = grid.creepage(shape, column % grid.nodes());
        const std::vector<std::string> cells = study::cells_of(study::detail::trim(lines[i]), ',');
        const auto number = [&](std::size_t k) {
            return cells.size() == columns().size() ? study::number_of(cells[k], ',') : std::nullopt;
        };
        const auto& [elements, strips] = job.elements[static_cast<std::size_t>(shape)];
        const std::array<std::pair<std::size_t, double>, 7> expected{{{0, grid.a_over_b(shape)},
                                                                      {1, grid.poisson_ratio()},
                                                                      {2, elements},
                                                                      {3, strips},
                                                                      {4, v.longitudinal},
                                                                      {5, v.lateral},
                                                                      {6, v.spin}}};
        for (const auto& [k, value] : expected) {
            const auto found = number(k);
            if (!found || std::abs(*found - value) > 1e-9 * std::abs(value)) {
                throw study::BadInput(where(i) + ": " + columns()[k] + " = " + (k < cells.size() ? cells[k] : "") +
                                      " must be " + study::Cell(value).text(12) +
                                      ", as the options of the grid want it");
            }
        }
        for (std::size_t k = 0; k < 3; ++k) {
            const auto force = number(7 + k);
            if (!force) {
                throw study::BadInput(where(i) + ": " + columns()[7 + k] + " must be a number; status = " + cells[14]);
            }
            forces(static_cast<Eigen::Index>(k), column) = *force;
        }
        if (!(std::hypot(forces(0, column), forces(1, column)) <= 1 + 1e-6)) {
            throw study::BadInput(where(i) + ": longitudinal_force, lateral_force = " + cells[7] + ", " + cells[8] +
                                  " must be a force of at most mu N");
        }
        if (cells[14] != "ok") throw study::BadInput(where(i) + ": status = " + cells[14] + " must be ok");
        const double arm = std::sqrt(std::max(grid.a_over_b(shape), 1 / grid.a_over_b(shape)));
        if (!(std::abs(forces(2, column)) <= arm)) {
            throw study::BadInput(where(i) + ": spin_moment = " + cells[9] +
                                  " must be at most the longer semi-axis over c, " + study::Cell(arm).text(4));
        }
    }
    return forces;
}

// --- the table -----------------------------------------------------------------------------------------------------

void write_binary(study::OutputFile& file, const CreepForceTable& table) {
    std::ostringstream bytes;
    table.write(bytes);
    file.write(bytes.str());
    file.commit();
}

/// The largest of the differences of F_x/(mu N), F_y/(mu N) and M_z/(mu N c) of one scene.
struct Difference {
    double value = -1, a_over_b = 0;
    Eigen::Array3d direction{0, 0, 0};  ///< xi C11, eta C22, phi c C23 over mu N/(G a b)
};

/// Prints mean and largest difference between the table and the patches it was made from, in random scenes: log(a/b)
/// uniform, the direction of (xi C11, eta C22, phi c C23) uniform on the sphere, its length log-uniform on 0.02 ... 20.
void check(const study::Options& options, const Job& job, const CreepForceTable& table, std::size_t count) {
    constexpr std::size_t together = 10;  // scenes of one ellipse
    const std::size_t ellipses = (count + together - 1) / together;
    std::mutex mutex;
    std::vector<double> sums(ellipses);
    Difference largest;
    std::size_t done = 0;
    study::Progress progress(options.program() + " --check", count, study::shows_progress(options), "scenes");
    rollbem::detail::parallel_for(ellipses, study::job_count(options), [&](std::size_t ellipse) {
        std::mt19937_64 random(ellipse);
        std::uniform_real_distribution<double> uniform;
        const double low = job.grid.smallest_a_over_b(), high = job.grid.largest_a_over_b();
        const double a_over_b = low * std::pow(high / low, uniform(random));
        rollbem::CreepForceSource source(a_over_b, job.grid.poisson_ratio(), job.n);
        const auto& contact = source.contact();
        const auto c = creep_coefficients(contact, source.in_adhesion());
        const std::size_t scenes = std::min(together, count - ellipse * together);
        for (std::size_t i = 0; i < scenes; ++i) {
            const double height = 2 * uniform(random) - 1, angle = 2 * std::numbers::pi * uniform(random);
            const double level = 0.02 * std::pow(1000, uniform(random)), radius = std::sqrt(1 - height * height);
            const Eigen::Array3d direction =
                level * Eigen::Array3d(radius * std::cos(angle), radius * std::sin(angle), height);
            const Creepage<double> v{direction[0] / c.c11, direction[1] / c.c22, direction[2] / c.c23};
            const rollbem::CreepForceSource::Solution solved = source.solve(v, true);
            const double load = contact.half_width();  // G a b
            const auto found = table.look_up(contact, 1, load, {v.longitudinal, v.lateral, v.spin / contact.c()});
            if (solved.step.status != rollbem::StepStatus::ok || found.status != rollbem::StepStatus::ok) {
                throw std::runtime_error("--check: a scene at a/b = " + study::Cell(a_over_b).text(6) +
                                         " has no forces");
            }
            const Eigen::Array3d force =
                -Eigen::Array3d(found.force.longitudinal, found.force.lateral, found.force.moment / contact.c()) / load;
            const double difference = (force - solved.force).abs().maxCoeff();
            sums[ellipse] += difference;
            const std::lock_guard lock(mutex);
            if (difference > largest.value) largest = {difference, a_over_b, direction};
            progress.update(++done);
        }
    });
    progress.clear();
    double sum = 0;
    for (const double one : sums) sum += one;
    study::OutputFile output = study::OutputFile::standard_output();
    const auto text = [](double value) { return study::Cell(value).text(3); };
    output.write("scenes " + std::to_string(count) + ", mean difference " + text(sum / static_cast<double>(count)) +
                 ", largest " + text(largest.value) + " of mu N, at a/b = " + text(largest.a_over_b) +
                 " and (xi C11, eta C22, phi c C23) G a b/(mu N) = (" + text(largest.direction[0]) + ", " +
                 text(largest.direction[1]) + ", " + text(largest.direction[2]) + ")\n");
    output.commit();
}

/// 4. The file of the table, and its check in `scenes` scenes.
void finish(const study::Options& options, const Job& job, study::OutputFile& file, const CreepForceTable& table,
            std::size_t scenes) {
    write_binary(file, table);
    if (scenes > 0) check(options, job, table, scenes);
}

/// The lines of --rows below its header, and where they stand.
struct Rows {
    std::vector<std::string> lines, places;
};

Rows read_rows(const study::Options& options) {
    const std::string header = study::join(columns(), ",");
    Rows rows;
    study::Lines file(options, "rows");
    while (file.next()) {
        if (!file.is_first()) {
            rows.lines.push_back(file.text());
            rows.places.push_back(file.where());
        } else if (file.text() != header) {
            throw study::BadInput(file.where() + " must be " + header);
        }
    }
    return rows;
}

}  // namespace

int main(int argc, char** argv) {
    // 1. The command line.
    study::Options options("creep_table", "Steady creep forces of contact patches on a grid, as a table for look-up.");
    options.group("Table");
    options.add("a-over-b", "LIST", "the smallest and the largest a/b, a along the rolling direction (dimensionless)",
                "0.1,10");
    options.add("shapes", "N", "number of ellipses, a/b in steps of a constant factor, 4 to 100 (dimensionless)", "13");
    options.add("levels", "N", "number of nodes from no creepage to full sliding, 4 to 64 (dimensionless)", "19");
    options.add_input(
        "rows",
        "take the rows from this file instead of computing them: the parts of --shard, one after the other; "
        "with the same options and version");
    options.add(
        "check", "N",
        "also print the mean and the largest difference between the table and the patches in N random scenes, 1 "
        "to 10000000 (dimensionless)");
    options.set_default("n", "17");
    options.set_help("n",
                     "n^2 elements on each ellipse, as many of them in a strip as its shape wants, 2 to 100 "
                     "(dimensionless)");
    options.refuse_group("Discretisation", "each patch has uniform strips and node differences", {"n"});
    options.refuse("kernel", "the bodies are half-spaces");
    options.refuse("aspect", "a patch is wide and long: --a-over-b");
    options.not_with({"shard"}, "rows");
    options.refuse("plot", "draw friction on patches with patch_study");
    options.footer(R"(Example: the table of steel, by two threads; then the same by 4 machines
  creep_table --output table.csv --jobs 2
  creep_table --shard 1/4 --output part1.csv    # and 2/4, 3/4, 4/4
  cat part?.csv > rows.csv && creep_table --rows rows.csv --output table.csv --check 1000

Writes a row for each node of the grid, with the columns of patch_study: creepages times G a b/(mu N), spin times
G a b c/(mu N), -F_x, -F_y over mu N, -M_z over mu N c, c = sqrt(a b). Beside FILE stands FILE.bin, which
CreepForceTable::read of the library takes (not for a shard, nor on standard output). An interrupt leaves
FILE.part; the same command goes on from there.
Nodes are denser for small creepages, follow saturation and end at full sliding, so no creepage lies outside. Each node
is solved on one mesh. Where the pole of a large spin lies inside or near the edge, forces are a mean of two: the second
has one more element in each strip and one more strip. Columns other than forces, residual and status are of the first.
time_us stays empty, so that rows are the same wherever they are computed.
Extrapolation from two meshes has larger errors where spin is large. --check: log(a/b) uniform, direction of (xi C11,
eta C22, phi c C23) uniform on the sphere, its length 0.02 to 20 mu N/(G a b), log-uniform; the difference of a scene is
the largest of F_x/(mu N), F_y/(mu N), M_z/(mu N c). Ten scenes share an ellipse.
)");

    return study::run_program(options, argc, argv, [](const study::Options& given) {
        // 2. The grid.
        const bool whole = !given.given("shard");
        const auto scenes = given.given("check") ? static_cast<std::size_t>(given.integer("check", 1, 10'000'000)) : 0;
        if (!whole && scenes > 0) given.ignored("check", "with --shard: a part is no table");
        const bool to_file = given.given("output") && given.text("output") != "-";
        if (scenes > 0 && !to_file) given.ignored("check", "without --output FILE");
        std::optional<study::OutputFile> binary;
        if (whole && to_file) binary.emplace(given.text("output") + ".bin", "--output");
        const Job job = make_job(given);

        // 3. Its rows: read, or computed.
        if (given.given("rows")) {
            const Rows rows = read_rows(given);
            if (!to_file) throw study::BadInput("--rows = " + given.text("rows") + " must go with --output FILE");
            const CreepForceTable made(job.grid, read_forces(job, rows.lines, [&](std::size_t i) {
                                           return i < rows.places.size() ? rows.places[i] : given.said("rows");
                                       }));
            study::TableFile file(given, "output", study::join(columns(), ",") + "\n");
            for (const std::string& line : rows.lines) file.rows().write(line + "\n");
            file.commit();
            finish(given, job, *binary, made, scenes);
            return study::exit_ok;
        }
        const std::vector<rollbem::CreepForceSlab> slabs = slabs_of(job.grid);
        std::optional<CreepForceTable> made;
        study::Table table;
        table.columns = columns();
        for (const rollbem::CreepForceSlab& slab : slabs)
            table.rows_of_task.push_back(static_cast<std::size_t>(slab.last - slab.first));
        table.label = [&](std::size_t task) {
            return "a/b = " + study::Cell(job.grid.a_over_b(slabs[task].shape)).text(3);
        };
        table.compute = [&](std::size_t task, study::RowRange range, const study::Emit& emit) {
            emit_slab(job, slabs[task], range, emit);
        };
        table.resumable = to_file;
        if (whole && to_file) {
            table.accept = [&](const std::vector<std::string>& rows) {
                made.emplace(job.grid, read_forces(job, rows, [&](std::size_t i) {
                                 return given.said("output") + ": line " + std::to_string(i + 2);
                             }));
            };
            table.written = [&] { finish(given, job, *binary, *made, scenes); };
        }
        study::write_table(given, table);
        return study::exit_ok;
    });
}
