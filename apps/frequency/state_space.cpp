#include "state_space.hpp"

#include <cstddef>
#include <stdexcept>

#include <Eigen/Core>

#include <rollbem/compiled/balanced_reduction.hpp>

#include "support/errors.hpp"
#include "support/non_steady.hpp"

namespace frequency {

namespace {

using Space = rollbem::StateSpace<double>;

constexpr const char* conventions =
    "\n[state_space]\n"
    "equations = \"d x/d(q/a) = A x + B xi, -F/(a G) = C x + D xi; q = V t, F per unit width\"\n"
    "response = \"c11(s) = C (s I - A)^-1 B + D, s in V/a\"\n";

constexpr const char* all_states =
    "x = \"by elements: their tractions p/G, trailing to leading; chebyshev: coefficients of T_0, T_1, ... in u/a\"\n";

Space state_space_of(const study::Options& options, const std::vector<study::Scene>& scenes) {
    const std::string said = options.said("state-space");
    const study::Scene& scene = scenes.front();
    if (scenes.size() != 1) {
        throw study::BadInput(said +
                              " must go with one scheme; the values of --n, --alpha-L, --alpha-T and --lambda make " +
                              std::to_string(scenes.size()));
    }
    const auto require_no_flaw = [&](const rollbem::RollingSystem<double>& system) {
        const std::string flaw = study::flaw_in_steady_rolling(scene, system);
        if (flaw.empty()) return;
        throw study::BadInput(said + " must go with another scheme: that of n = " + std::to_string(scene.n()) + " " +
                              flaw);
    };
    const auto of_elements = [&](const auto& mesh, const auto& scheme, const auto& kernel) {
        const rollbem::ElementSystem<double> system = rollbem::rolling_system(mesh, scheme, kernel);
        require_no_flaw(system);
        try {
            return rollbem::state_space<double>(system);
        } catch (const std::invalid_argument& singular) {
            throw study::BadInput(said + " must go with a scheme that has one: " + singular.what());
        }
    };
    const auto of_states = [&](const auto& method, const auto& kernel) {
        const rollbem::ChebyshevSystem<double> system = rolling_system(method, kernel);
        require_no_flaw(system);
        return rollbem::state_space(system);
    };
    return scene.visit(of_elements, of_states);
}

/// The space reduced to --states; its singular value and bound for the sidecar.
std::string reduce(const study::Options& options, Space& space) {
    const Eigen::Index states = options.integer("states", 1, space.A.rows());
    const rollbem::BalancedReduction<double> reduced = rollbem::balanced_reduction(space, states);
    if (reduced.status != rollbem::Status::ok) {
        throw study::BadInput(options.said("states") + " must go with a scheme that decays in time: the reduction is " +
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
           study::Cell(left_out).text() +
           "\n"
           "error_bound = " +
           study::Cell(reduced.error_bound).text() + "  # of c11, at every frequency\n";
}

/// Plain numbers, comma-separated, one row a line.
void write(study::OutputFile& file, const Eigen::MatrixXd& matrix) {
    for (Eigen::Index i = 0; i < matrix.rows(); ++i) {
        study::Row row;
        for (Eigen::Index k = 0; k < matrix.cols(); ++k) row.emplace_back(matrix(i, k));
        file.write(study::csv_line(row));
    }
    file.close();
}

}  // namespace

std::vector<std::string> StateSpaceFiles::names() { return {"A.csv", "B.csv", "C.csv", "D.csv", "state_space.toml"}; }

StateSpaceFiles::StateSpaceFiles(const study::Options& options, const std::vector<study::Scene>& scenes)
    : StateSpaceFiles(options, contents(options, scenes)) {}

StateSpaceFiles::Contents StateSpaceFiles::contents(const study::Options& options,
                                                    const std::vector<study::Scene>& scenes) {
    Contents result{state_space_of(options, scenes), conventions};
    result.conventions += options.given("states") ? reduce(options, result.space) : all_states;
    return result;
}

StateSpaceFiles::StateSpaceFiles(const study::Options& options, const Contents& contents)
    : folder_(options.text("state-space"), "--state-space") {
    for (const std::string& name : names()) files_.emplace_back(folder_.file(name), "--state-space");
    std::size_t next = 0;
    const Space& space = contents.space;
    for (const Eigen::MatrixXd* matrix : {&space.A, &space.B, &space.C, &space.D}) write(files_[next++], *matrix);
    files_[next].write(study::sidecar_text(options) + contents.conventions);
    files_[next].close();
}

void StateSpaceFiles::commit() {
    for (study::OutputFile& file : files_) file.commit();
    folder_.keep();
}

}  // namespace frequency
