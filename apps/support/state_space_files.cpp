#include "state_space_files.hpp"

#include <cstddef>

#include <Eigen/Core>

#include <rollbem/compiled/stability.hpp>

#include "sidecar.hpp"

namespace study {

namespace {

using Space = rollbem::StateSpace<double>;

/// The space reduced to --states; its singular value and bound for the sidecar.
std::string reduce(const Options& options, Space& space, const std::string& bounded) {
    const Eigen::Index states = options.integer("states", 1, space.A.rows());
    const rollbem::BalancedReduction<double> reduced = rollbem::balanced_reduction(space, states);
    if (reduced.status != rollbem::Status::ok) {
        throw BadInput(options.said("states") + " must go with a scheme that decays in time: the reduction is " +
                       name(reduced.status));
    }
    space = reduced.space;
    const Eigen::Index kept = space.A.rows(), present = reduced.hankel_singular_values.size();
    const double left_out = kept < present ? reduced.hankel_singular_values[kept] : 0;
    return "x = \"of a balanced reduction, whose steady state is exact\"\n"
           "states = " +
           std::to_string(kept) +
           "\n"
           "largest_hankel_singular_value_left_out = " +
           Cell(left_out).text() +
           "\n"
           "error_bound = " +
           Cell(reduced.error_bound).text() + "  # of " + bounded + ", at every frequency\n";
}

/// Plain numbers, comma-separated, one row a line.
void write(OutputFile& file, const Eigen::MatrixXd& matrix) {
    for (Eigen::Index i = 0; i < matrix.rows(); ++i) {
        Row row;
        for (Eigen::Index k = 0; k < matrix.cols(); ++k) row.emplace_back(matrix(i, k));
        file.write(csv_line(row));
    }
    file.flush();
}

}  // namespace

std::vector<std::string> StateSpaceFiles::names() { return {"A.csv", "B.csv", "C.csv", "D.csv", "state_space.toml"}; }

void StateSpaceFiles::add_options(Options& options, const std::string& what) {
    options.add_folder("state-space",
                       "also write " + what +
                           " as linear differential equations: A.csv, B.csv, C.csv, D.csv and state_space.toml in this "
                           "folder, which is made if it does not exist (dimensionless)",
                       names());
    options
        .add("states", "K",
             "reduce to the K states that matter most (balanced reduction, the steady state "
             "exact), 1 to the number there is; an error bound stands in state_space.toml (dimensionless)")
        .only_with({"state-space"});
    options.not_with({"shard"}, "state-space", ": every part would write it");
}

StateSpaceFiles::StateSpaceFiles(const Options& options, Space space, const std::string& conventions,
                                 const std::string& states, const std::string& bounded) {
    const std::string folder = options.text("state-space");
    const std::string meaning = options.given("states") ? reduce(options, space, bounded) : "x = \"" + states + "\"\n";
    make_folder(folder, "--state-space");
    for (const std::string& name : names()) files_.emplace_back(folder + "/" + name, "--state-space");
    std::size_t next = 0;
    for (const Eigen::MatrixXd* matrix : {&space.A, &space.B, &space.C, &space.D}) write(files_[next++], *matrix);
    files_[next].write(sidecar_text(options) + "\n[state_space]\n" + conventions + meaning);
    files_[next].flush();
}

void StateSpaceFiles::commit() {
    for (OutputFile& file : files_) file.commit();
}

}  // namespace study
