#include "state_space_files.hpp"

#include <string>

#include <Eigen/Core>

#include <rollbem/adhesion/balanced_reduction.hpp>

#include "csv.hpp"
#include "progress.hpp"
#include "sidecar.hpp"
#include "table.hpp"

namespace study {

namespace {

using Space = rollbem::StateSpace;

/// The space reduced to --states; its singular value and bound for the sidecar.
std::string reduce(const Options& options, Space& space, const std::string& bounded) {
    const Eigen::Index states = options.integer("states", 1, space.A.rows());
    const rollbem::BalancedReduction reduced = rollbem::balanced_reduction(space, states);
    options.require(reduced.status == rollbem::Status::ok, "states",
                    std::string("go with a scheme that decays in time: the reduction is ") + name(reduced.status));
    space = reduced.space;
    const Eigen::Index kept = space.A.rows(), present = reduced.hankel_singular_values.size();
    const double left_out = kept < present ? reduced.hankel_singular_values[kept] : 0;
    return "# x = of a balanced reduction, whose steady state is exact\n# states = " + std::to_string(kept) +
           "\n# largest_hankel_singular_value_left_out = " + Cell(left_out).text() +
           "\n# error_bound = " + Cell(reduced.error_bound).text() + " of " + bounded + ", at every frequency\n";
}

/// Plain numbers, comma-separated, one row a line.
std::string text_of(const Eigen::MatrixXd& matrix) {
    std::string text;
    for (Eigen::Index i = 0; i < matrix.rows(); ++i) {
        Row row;
        for (Eigen::Index k = 0; k < matrix.cols(); ++k) row.emplace_back(matrix(i, k));
        text += csv_line(row);
    }
    return text;
}

}  // namespace

void add_state_space_options(Options& options, const std::string& what) {
    options.add_folder("state-space",
                       "folder, made if it does not exist, for the linear differential equations of " + what +
                           ": A.csv, B.csv, C.csv, D.csv [dimensionless] and state_space.toml; none without it");
    options
        .add("states", "K",
             "number of states [dimensionless] to which a balanced reduction, exact in the steady state, brings the "
             "equations, 1 to their own number; its error bound stands in state_space.toml; all states without it")
        .only_with({"state-space"});
    options.not_with({"shard"}, "state-space", ": every part would write it");
}

void write_state_space(const Options& options, OutputFiles& files, std::size_t count,
                       const std::function<Space()>& make, const StateSpaceWords& words) {
    if (!options.given("state-space")) return;
    const std::string said = options.said("state-space"), folder = options.text("state-space");
    if (count != 1) {
        throw BadInput(said + " must go with one " + words.one + "; the values of " + words.lists + " make " +
                       std::to_string(count));
    }
    Progress progress(options.program(), 1, shows_progress(options), "state spaces");
    Space space = blame(said + " must go with a " + words.one + " that has one", make);
    const std::string meaning =
        options.given("states") ? reduce(options, space, words.bounded) : "# x = " + words.states + "\n";
    progress.clear();
    files.make_folder(folder, "--state-space");
    const auto add = [&](const char* file, const std::string& text) {
        files.add(folder + "/" + file, "--state-space", text);
    };
    add("A.csv", text_of(space.A));
    add("B.csv", text_of(space.B));
    add("C.csv", text_of(space.C));
    add("D.csv", text_of(space.D));
    add("state_space.toml", sidecar_text(options) + "# state space\n" + words.conventions + meaning);
}

}  // namespace study
