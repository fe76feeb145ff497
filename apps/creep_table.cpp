// Steady creep forces of ellipses with friction and spin on a grid, for look-up in the time loop of a vehicle: rows as
// CSV, the CreepForceTable that interpolates them, and how far it is from the patches that it was made from:
//
//     ./creep_table --output table.csv --jobs 2
//     ./creep_table --n 6 --levels 5 --shapes 6 --output coarse.csv --check 1000
#include <algorithm>
#include <cmath>
#include <filesystem>
#include <numbers>
#include <optional>
#include <random>
#include <sstream>
#include <stdexcept>
#include <string>
#include <system_error>
#include <utility>
#include <vector>

#include <rollbem/steady/creep_coefficients.hpp>
#include <rollbem/vehicle/creep_force_table.hpp>
#include <rollbem/vehicle/make_creep_force_table.hpp>

#include "support/csv.hpp"
#include "support/input.hpp"
#include "support/joined_rows.hpp"
#include "support/options.hpp"
#include "support/output.hpp"
#include "support/progress.hpp"
#include "support/table.hpp"

namespace {

using rollbem::CreepForceTable, rollbem::Creepage;

/// What is asked for: the grid, from how many elements forces on it come, and in how many scenes they are checked.
struct Job {
    std::ptrdiff_t n;
    CreepForceTable::Grid grid;
    study::Threads threads;
    study::OutputFile* binary;  ///< the file of the table; none where rows alone are wanted
    std::size_t scenes;

    CreepForceTable::Source source(Eigen::Index shape) const { return {grid.a_over_b(shape), grid.poisson_ratio(), n}; }
    Eigen::Index nodes() const { return grid.nodes() * grid.shapes(); }
};

/// The file of the table is opened before the grid is made, which takes seconds.
Job read_job(const study::Options& options, study::OutputFiles& files) {
    const std::vector<double> ends = options.numbers("a-over-b", study::between(1e-3, 1e3));
    options.require(ends.size() == 2 && ends[0] < ends[1], "a-over-b",
                    "be the smallest and the largest, in this order");
    const CreepForceTable::Grid::Range range{.poisson_ratio = options.number("poisson", study::between(0, 0.5)),
                                             .smallest_a_over_b = ends[0],
                                             .largest_a_over_b = ends[1],
                                             .shapes = options.integer("shapes", 4, 100),
                                             .levels = static_cast<int>(options.integer("levels", 4, 64)),
                                             .n = options.integer("n", 2, 100)};
    const Eigen::Index numbers = CreepForceTable::Grid::coefficient_count(range.levels, range.shapes);
    if (numbers > CreepForceTable::Grid::most_coefficients) {
        throw study::BadInput(
            options.said("levels") + ", " + options.said("shapes") +
            " give a table of (levels + 3)^2 (2 levels + 3) (shapes + 2) = " + std::to_string(numbers) +
            " coefficients, which must be at most " + std::to_string(CreepForceTable::Grid::most_coefficients));
    }
    std::error_code unknown;
    const std::string output = options.text("output");
    const bool to_file = options.given("output") && output != "-" && !std::filesystem::is_other(output, unknown);
    const bool whole = !options.given("shard");
    if (!whole) options.ignored("check", "with --shard: a part is no table");
    if (!to_file) options.ignored("check", "without --output FILE");
    options.require(to_file || !options.given("rows"), "rows", "go with --output FILE");
    const auto scenes = options.given("check") ? static_cast<std::size_t>(options.integer("check", 1, 10'000'000)) : 0;
    study::OutputFile* const binary = whole && to_file ? &files.open(output + ".bin", "--output") : nullptr;
    const study::Threads threads = study::read_threads(options);
    const study::Progress progress(threads.program, 1, threads.shows, "grids");
    return {range.n,
            study::blame(options.said("a-over-b") + " and " + options.said("n"),
                         [&] { return rollbem::make_creep_force_grid(range, threads.jobs); }),
            threads, binary, scenes};
}

// --- rows ----------------------------------------------------------------------------------------------------------

const std::vector<std::string> columns = study::cells_of(
    "a_over_b,poisson,n,strips,longitudinal,lateral,spin,longitudinal_force,lateral_force,spin_moment,stick_count,"
    "rounds,complementarity_residual,time_us,status,nodes");

/// The first columns, which say what node it is.
study::Row node_cells(const CreepForceTable::Source& source, const Creepage& v) {
    return {source.contact().a_over_b(),
            source.contact().poisson_ratio(),
            source.mesh().elements_per_strip(),
            source.mesh().strip_count(),
            v.longitudinal,
            v.lateral,
            v.spin};
}

/// Rows of a slab; their forces go into the columns of `forces`.
void emit_slab(const Job& job, const CreepForceTable::Grid::Slab& slab, study::RowRange range, const study::Emit& emit,
               Eigen::Array3Xd& forces) {
    const CreepForceTable::Grid& grid = job.grid;
    CreepForceTable::Source source = job.source(slab.shape);
    const Eigen::Index first = slab.first + static_cast<Eigen::Index>(range.first),
                       last = slab.first + static_cast<Eigen::Index>(range.last);
    // along a line of growing spin each solution starts from the one before, also where rows begin in the middle
    Eigen::Index node = first;
    while (!grid.begins_line(node)) --node;
    for (; node < last; ++node) {
        const Creepage v = grid.creepage(slab.shape, node);
        const CreepForceTable::Source::Solution solution = source.solve(v, grid.begins_line(node));
        if (node < first) continue;
        const auto& step = solution.step;
        auto force = forces.col(slab.shape * grid.nodes() + node);
        if (step.status == rollbem::Status::ok) force = solution.force + 0.0;  // without -0, as in the row
        study::Row row = node_cells(source, v);
        for (const double value : force) row.emplace_back(value);
        emit(study::joined(std::move(row), {step.stick_count, step.rounds, step.complementarity_residual, study::Cell(),
                                            name(step.status), "chebyshev"}));
    }
}

/// A row for each node. The table refers to the job, and fills `forces`.
study::Table table_of(const Job& job, Eigen::Array3Xd& forces) {
    study::Table table;
    table.columns = columns;
    const std::vector<CreepForceTable::Grid::Slab> slabs = job.grid.slabs();
    for (const auto& slab : slabs) table.rows_of_task.push_back(static_cast<std::size_t>(slab.last - slab.first));
    table.label = [&job, slabs](std::size_t task) {
        return "a/b = " + study::Cell(job.grid.a_over_b(slabs[task].shape)).text(3);
    };
    table.compute = [&job, &forces, slabs](std::size_t task, study::RowRange range, const study::Emit& emit) {
        emit_slab(job, slabs[task], range, emit, forces);
    };
    return table;
}

/// The forces of rows, which must cover the whole grid.
Eigen::Array3Xd read_forces(const Job& job, const study::JoinedRows& rows) {
    const CreepForceTable::Grid& grid = job.grid;
    Eigen::Array3Xd forces(3, job.nodes());
    std::optional<CreepForceTable::Source> source;
    for (Eigen::Index column = 0; column < forces.cols(); ++column) {
        const auto i = static_cast<std::size_t>(column);
        const Eigen::Index shape = column / grid.nodes(), node = column % grid.nodes();
        if (node == 0) source.emplace(grid.a_over_b(shape), grid.poisson_ratio(), job.n);
        const study::Row expected = node_cells(*source, grid.creepage(shape, node));
        const std::vector<std::string> cells = rows.cells(i, expected);
        const std::string& status = cells[14 - expected.size()];
        for (std::size_t k = 0; k < 3; ++k) {
            const auto force = study::number_of(cells[k]);
            rows.require(force && std::isfinite(*force), i,
                         columns[expected.size() + k] + " must be a number; status = " + status);
            forces(static_cast<Eigen::Index>(k), column) = *force;
        }
        rows.require(status == "ok", i, "status = " + status + " must be ok");
    }
    return forces;
}

// --- the table -----------------------------------------------------------------------------------------------------

/// The largest of the differences of F_x/(mu N), F_y/(mu N) and M_z/(mu N c) of one scene, and the sum over scenes.
struct Difference {
    double value = -1, a_over_b = 0;
    Eigen::Array3d direction{0, 0, 0};  ///< xi C11, eta C22, phi c C23 over mu N/(G a b)
    double sum = 0;
};

/// The difference in `scenes` random scenes of a random ellipse: log(a/b) uniform, the direction of (xi C11, eta C22,
/// phi c C23) uniform on the sphere, its length log-uniform on 0.02 ... 20.
Difference compare(const Job& job, const CreepForceTable& table, std::size_t seed, std::size_t scenes) {
    std::mt19937_64 random(seed);
    std::uniform_real_distribution<double> uniform;
    const double low = job.grid.smallest_a_over_b(), high = job.grid.largest_a_over_b();
    const double a_over_b = low * std::pow(high / low, uniform(random));
    CreepForceTable::Source source(a_over_b, job.grid.poisson_ratio(), job.n);
    const auto& contact = source.contact();
    const auto c = creep_coefficients(contact, source.in_adhesion());
    Difference largest;
    for (std::size_t i = 0; i < scenes; ++i) {
        const double height = 2 * uniform(random) - 1, angle = 2 * std::numbers::pi * uniform(random);
        const double level = 0.02 * std::pow(1000, uniform(random)), radius = std::sqrt(1 - height * height);
        const Eigen::Array3d direction =
            level * Eigen::Array3d(radius * std::cos(angle), radius * std::sin(angle), height);
        const Creepage v{direction[0] / c.c11, direction[1] / c.c22, direction[2] / c.c23};
        const CreepForceTable::Source::Solution solved = source.solve(v, true);
        const double load = contact.half_width();  // G a b
        const auto found = table.look_up(contact, 1, load, {v.longitudinal, v.lateral, v.spin / contact.c()});
        if (solved.step.status != rollbem::Status::ok || found.status != rollbem::Status::ok) {
            throw std::runtime_error("--check: a case at a/b = " + study::Cell(a_over_b).text(6) + " has no forces");
        }
        const Eigen::Array3d force =
            -Eigen::Array3d(found.force.longitudinal, found.force.lateral, found.force.moment / contact.c()) / load;
        const double difference = (force - solved.force).abs().maxCoeff();
        largest.sum += difference;
        if (difference > largest.value) largest = {difference, a_over_b, direction, largest.sum};
    }
    return largest;
}

/// Prints mean and largest difference between the table and the patches it was made from, in random scenes.
void check(const Job& job, const CreepForceTable& table) {
    constexpr std::size_t together = 10;  // scenes of one ellipse
    const std::size_t count = job.scenes;
    std::vector<Difference> differences((count + together - 1) / together);
    in_parallel(job.threads, differences.size(), "ellipses", [&](std::size_t k) {
        differences[k] = compare(job, table, k, std::min(together, count - k * together));
    });
    Difference largest;
    for (const Difference& one : differences) {
        const double sum = largest.sum + one.sum;
        if (one.value > largest.value) largest = one;
        largest.sum = sum;
    }
    study::OutputFile output = study::OutputFile::standard_output();
    const auto text = [](double value) { return study::Cell(value).text(3); };
    output.write("scenes " + std::to_string(count) + ", mean difference " +
                 text(largest.sum / static_cast<double>(count)) + ", largest " + text(largest.value) +
                 " of mu N, at a/b = " + text(largest.a_over_b) + " and (xi C11, eta C22, phi c C23) G a b/(mu N) = (" +
                 text(largest.direction[0]) + ", " + text(largest.direction[1]) + ", " + text(largest.direction[2]) +
                 ")\n");
    output.commit();
}

/// Throws if a node has no forces.
CreepForceTable make_table(const Job& job, const Eigen::Array3Xd& forces) {
    for (Eigen::Index i = 0; i < forces.cols(); ++i) {
        if (forces.col(i).allFinite()) continue;
        throw std::runtime_error("row " + std::to_string(i + 1) +
                                 " has no forces, so there is no table; its status is in the rows of --shard 1/1");
    }
    return {job.grid, forces};
}

constexpr const char* help =
    R"(Example: the table of steel, by two threads; then the same by 4 machines
  creep_table --output table.csv --jobs 2
  creep_table --shard 1/4 --output part1.csv    # and 2/4, 3/4, 4/4
  cat part?.csv > rows.csv && creep_table --rows rows.csv --output table.csv --check 1000

One row for each node of the grid, with columns as in patch_study:
  a_over_b, poisson, n, strips
                    ellipse, Poisson's ratio, elements in each strip and strips
  longitudinal, lateral, spin
                    creepages times G a b/(mu N), spin times G a b c/(mu N), c = sqrt(a b)
  longitudinal_force, lateral_force, spin_moment
                    -F_x/(mu N), -F_y/(mu N), -M_z/(mu N c)
  stick_count, rounds, complementarity_residual, time_us, status, nodes
                    as in patch_study
Next to FILE stands FILE.bin, for CreepForceTable::read of the library (not for a shard, nor on standard output).
Nodes are denser for small creepages, follow saturation and end at full sliding, so no creepage lies outside. Each node
is solved on one mesh. Where the pole of a large spin lies inside or near the edge, forces are a mean of two: the second
has one more element in each strip and one more strip. Columns other than forces, residual and status are of the first.
time_us stays empty, so that rows are the same wherever they are computed.
Extrapolation from two meshes has larger errors where spin is large. --check: log(a/b) uniform, direction of (xi C11,
eta C22, phi c C23) uniform on the sphere, its length 0.02 to 20 mu N/(G a b), log-uniform; the difference of a case is
the largest of F_x/(mu N), F_y/(mu N), M_z/(mu N c). Ten cases share an ellipse.
)";

void add_options(study::Options& options) {
    options.group("Table");
    options.add(
        "a-over-b", "LIST",
        "smallest and largest ratio of semi-axes a/b [dimensionless], a along the rolling direction, 1e-3 to 1e3",
        "0.1,10");
    options.add("shapes", "N",
                "number of ellipses [dimensionless], 4 to 100, whose a/b are in steps of a constant factor", "13");
    options.add("levels", "N", "number of nodes from no creepage to full sliding [dimensionless], 4 to 64", "19");
    options.add_input("rows",
                      "CSV file of the rows, the parts of --shard one after the other, made with the same options and "
                      "version, in place of a computation");
    options.add("check", "N",
                "number of random cases [dimensionless], 1 to 10000000, in which the table is compared with its "
                "patches: mean and largest difference are printed; no comparison without it");
    options.set_default("n", "17");
    options.set_help("n",
                     "size of the mesh of each ellipse [dimensionless], 2 to 100: n^2 elements, as many of them in a "
                     "strip as its shape wants");
    options.refuse_group("Discretisation", "each patch has uniform strips and node differences", {"n"});
    options.refuse("kernel", "the bodies are half-spaces");
    options.refuse("aspect", "a patch is wide and long: --a-over-b");
    options.not_with({"shard"}, "rows");
    options.refuse("no-timing", "rows have no times");
    options.refuse("plot", "draw friction on patches with patch_study");
    options.footer(help);
}

}  // namespace

int main(int argc, char** argv) {
    // 1. The command line.
    study::Options options("creep_table", "Steady creep forces of contact patches on a grid, as a table for look-up.");
    add_options(options);

    return study::run_program(options, argc, argv, [](const study::Options& given) {
        // 2. The grid.
        study::OutputFiles files;
        const Job job = read_job(given, files);

        // 3. Its rows, read or computed, and the table.
        std::optional<CreepForceTable> made;
        const auto finish = [&](const Eigen::Array3Xd& forces) {
            if (job.binary == nullptr) return;
            made = make_table(job, forces);
            std::ostringstream bytes;
            made->write(bytes);
            job.binary->write(bytes.str());
        };
        if (given.given("rows")) {
            const study::JoinedRows rows(given, columns, static_cast<std::size_t>(job.nodes()));
            finish(read_forces(job, rows));
            study::OutputFile& file =
                files.open_table(given, "output", study::csv_line({columns.begin(), columns.end()}));
            for (const std::string& line : rows.lines()) file.write(line + "\n");
            files.commit();
        } else {
            Eigen::Array3Xd forces = Eigen::Array3Xd::Constant(3, job.nodes(), std::nan(""));
            study::Table table = table_of(job, forces);
            table.finish = [&] { finish(forces); };
            study::write_table(given, table, files);
        }
        if (made && job.scenes > 0) check(job, *made);
        return study::exit_ok;
    });
}
