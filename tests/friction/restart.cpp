// States that one process writes to a file continue bit for bit in another.
//     restart save FILE      rolls, and writes the states half-way and the final results to FILE
//     restart resume FILE    continues from those states, and compares the results
#include <bit>
#include <cmath>
#include <cstdint>
#include <cstdlib>
#include <exception>
#include <fstream>
#include <iostream>
#include <sstream>
#include <stdexcept>
#include <string>
#include <utility>

#include <rollbem/line.hpp>

#include "friction/any_model.hpp"

namespace {

using namespace any_model;

constexpr int steps = 60;

// The 64 bits of a number, as a decimal integer; sizes do not change.
void put(std::ostream& file, double x) { file << std::bit_cast<std::uint64_t>(x) << '\n'; }
void take(std::istream& file, double& x) {
    std::uint64_t bits = 0;
    if (!(file >> bits)) throw std::runtime_error("restart: the file is cut short");
    x = std::bit_cast<double>(bits);
}

// Calls `each` with every number of a state.
template <class State, class Each>
void for_numbers(State& state, const Each& each) {
    for (auto& p : state.traction.reshaped()) each(p);
    each(state.half_length);
    each(state.half_width);
    if constexpr (requires { state.zones; }) {
        for (auto& p : state.unrotated_traction.reshaped()) each(p);
        for (auto& p : state.normal_pressure) each(p);
        for (auto& mu : state.friction_coefficient) each(mu);
        for (auto& mu : state.solver.stage_coefficient) each(mu);
    } else {
        each(state.distance);
    }
}
template <class State>
void write_state(std::ostream& file, const State& state) {
    for_numbers(state, [&](double x) { put(file, x); });
    file << state.system << '\n';
    if constexpr (requires { state.zones; }) {
        for (const Zone zone : state.zones) file << static_cast<int>(zone) << '\n';
    }
}
template <class State>
void read_state(std::istream& file, State& state) {
    for_numbers(state, [&](double& x) { take(file, x); });
    file >> state.system;
    if constexpr (requires { state.zones; }) {
        for (Zone& zone : state.zones) {
            int value = 9;
            file >> value;
            zone = static_cast<Zone>(value);
        }
    }
}

// Step k, whose results are written if there is a file: in full adhesion, and with friction under a load that varies or
// the state's own; `even` means a constant creepage, until nothing changes any more.
void step(Run<AdhesionModel<>>& run, int k, bool even, std::ostream* file) {
    const double value = 1e-3 * std::sin(0.3 * k), dq = even || k % 7 == 0 ? 0.4 : 0.1;
    const auto step = k % 5 == 3 ? run.advance({dq * a, RigidMotion<double>::shift(a * value)})
                                 : run.advance({dq * a, RigidMotion<double>(even ? 1e-3 : value)});
    if (file == nullptr) return;
    put(*file, step.force);
    put(*file, step.tangent);
    *file << name(step.status) << '\n';
}
void step(Run<FrictionModel>& run, int k, bool even, std::ostream* file) {
    const double ratio = even ? 0.5 : 1.2 * std::sin(0.3 * k), dq = even || k % 7 == 0 ? 0.4 : 0.1;
    const Travel travel = Ride::travel(dq);
    const double longer = 1 + 0.02 * std::sin(0.1 * k);
    const State& now = run.now();
    const Load load{longer * now.normal_pressure, longer * now.half_length, now.normal_pressure};
    const Motion motion = k % 5 == 3 && !even ? shift(0.3, 40) : Motion(creepage(ratio, 5.0 * k));
    const Step step = k % 4 == 2 || even ? run.advance({travel, motion}) : run.advance({travel, motion, load});
    if (file == nullptr) return;
    for (const double x : {step.force.longitudinal, step.force.lateral, step.tangent.by_lateral.longitudinal,
                           step.tangent_by_load.lateral, step.tangent_by_half_length.longitudinal, step.slip_work,
                           step.jump_work, step.complementarity_residual}) {
        put(*file, x);
    }
    *file << name(step.status) << '\n';
    if (step.status != Status::ok) throw std::runtime_error(name(step.status));
}

// Every model half of the way; then either its state is written or read, and the results of the other half are written.
void roll(std::ostream* states, std::istream* from, std::ostream& results) {
    const auto both = [&](const auto& model, bool even) {
        Run run(model);
        if (from == nullptr) {
            for (int k = 0; k < steps / 2; ++k) step(run, k, even, nullptr);
            write_state(*states, std::as_const(run).now());
        } else {
            read_state(*from, run.now());
        }
        for (int k = steps / 2; k < steps; ++k) step(run, k, even, &results);
        write_state(results, std::as_const(run).now());
    };
    for (const Setup& setup : every_setup_in_time()) {
        for (const bool even : {false, true}) both(make(setup), even);
    }
    const Setup setup;
    const AdhesionModel<> adhesion(setup.contact(), setup.system(false), unchecked);
    for (const bool even : {false, true}) both(adhesion, even);
}

}  // namespace

int main(int argc, char** argv) try {
    const std::string what = argc == 3 ? argv[1] : "";
    std::ostringstream results;
    if (what == "save") {
        std::ofstream file(argv[2]);
        roll(&file, nullptr, results);
        file << results.str();
        return file.flush() ? EXIT_SUCCESS : EXIT_FAILURE;
    }
    if (what != "resume") throw std::runtime_error("restart: save FILE or resume FILE");
    std::ifstream file(argv[2]);
    roll(nullptr, &file, results);
    std::ostringstream expected;
    expected << (file >> std::ws).rdbuf();
    if (expected.str() != results.str()) throw std::runtime_error("restart: another result");
    return EXIT_SUCCESS;
} catch (const std::exception& error) {
    std::cerr << error.what() << '\n';
    return EXIT_FAILURE;
}
