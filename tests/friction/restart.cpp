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
#include <type_traits>
#include <utility>

#include <rollbem/compiled/transient.hpp>
#include <rollbem/normal/hertz_load.hpp>

#include "scene.hpp"

namespace {

using namespace friction_tests;

constexpr int steps = 60;

// The 64 bits of a number, as a decimal integer.
void write(std::ostream& file, double x) { file << std::bit_cast<std::uint64_t>(x) << '\n'; }
double read(std::istream& file) {
    std::uint64_t bits = 0;
    if (!(file >> bits)) throw std::runtime_error("restart: the file is cut short");
    return std::bit_cast<double>(bits);
}

// A state with friction, in one direction or in two.
template <class State>
void write_state(std::ostream& file, const State& state) {
    file << state.system << '\n';
    for (const double p : state.traction.reshaped()) write(file, p);
    if constexpr (requires { state.plain_traction; }) {
        for (const double p : state.plain_traction.reshaped()) write(file, p);
    }
    for (const double p : state.normal_pressure) write(file, p);
    write(file, state.half_length);
    for (const auto zone : state.zones) file << static_cast<int>(zone) << '\n';
    if constexpr (requires { state.solver.unchanged_steps; }) {
        file << state.solver.unchanged_steps << '\n';
        write(file, state.solver.unchanged_distance);
    }
}
// Overwrites a state of the same number of elements.
template <class State>
void read_state(std::istream& file, State& state) {
    file >> state.system;
    for (double& p : state.traction.reshaped()) p = read(file);
    if constexpr (requires { state.plain_traction; }) {
        for (double& p : state.plain_traction.reshaped()) p = read(file);
    }
    for (double& p : state.normal_pressure) p = read(file);
    state.half_length = read(file);
    for (auto& zone : state.zones) {
        int value = 9;
        file >> value;
        zone = static_cast<std::remove_reference_t<decltype(zone)>>(value);
    }
    if constexpr (requires { state.solver.unchanged_steps; }) {
        file >> state.solver.unchanged_steps;
        state.solver.unchanged_distance = read(file);
    }
}

// Friction under a varying load, on a breathing or a fixed mesh, in one direction and in two. Some steps take no load
// and keep that of the state.
struct LoadedRide {
    LoadedRide(const Mesh<double>& mesh, bool breathes, Integrator integrator)
        : hertz(breathes ? HertzLoad<double>::breathing(line(), mesh)
                         : HertzLoad<double>::fixed(line(), mesh, 1.3 * line().half_length())),
          load(hertz.at(line().load_per_width())),
          contact({.half_length = load.half_length,
                   .half_width = 100 * load.half_length,
                   .shear_modulus = 1,
                   .poisson_ratio = nu}),
          along(rolling_system(mesh, half, PlaneKernel<double>::longitudinal(contact))),
          one(contact, along, unchecked, {1, load.normal_pressure}, integrator),
          both(contact, {along, rolling_system(mesh, half, PlaneKernel<double>::lateral(contact))}, unchecked,
               {1, load.normal_pressure}, integrator) {}

    static HertzLine<double> line() {
        return HertzLine<double>({.load_per_width = full_force,
                                  .combined_radius = 1 / (4 * peak * (1 - nu * nu)),
                                  .body_1 = {1, nu},
                                  .body_2 = {1, nu}});
    }

    void roll(int first, int last) {
        for (int k = first; k < last; ++k) {
            const double a = load.half_length, dq = (k % 7 == 0 ? 0.4 : 0.1) * a;
            const Creepage<double> xi{creepage(std::sin(0.3 * k)), creepage(0.8 * std::cos(0.2 * k))};
            FrictionState<> next = now;
            FrictionState<2> both_next = both_now;
            if (k % 4 == 2) {
                result = one.advance(now, dq, xi.longitudinal, next, workspace);
                both_result = both.advance(both_now, dq, xi, both_next, both_workspace);
            } else {
                hertz.set(full_force * (1 + 0.5 * std::sin(0.1 * k)), load);
                result = one.advance(now, dq, xi.longitudinal, load, next, workspace);
                both_result = both.advance(both_now, dq, xi, load, both_next, both_workspace);
            }
            std::swap(now, next);
            std::swap(both_now, both_next);
        }
    }
    void save(std::ostream& file) const {
        write_state(file, now);
        write_state(file, both_now);
        write(file, load.half_length);
    }
    void load_from(std::istream& file) {
        read_state(file, now);
        read_state(file, both_now);
        load.half_length = read(file);
    }
    void save_results(std::ostream& file) const {
        for (const double x : {result.force, result.tangent, result.tangent_by_load, result.tangent_by_half_length,
                               result.slip_work, result.complementarity_residual, both_result.force.longitudinal,
                               both_result.force.lateral, both_result.tangent.by_lateral.longitudinal,
                               both_result.tangent_by_load.lateral, both_result.tangent_by_half_length.lateral,
                               both_result.slip_work, both_result.complementarity_residual}) {
            write(file, x);
        }
        file << name(result.status) << '\n' << name(both_result.status) << '\n';
        save(file);
    }
    void require_solved() const {
        for (const StepStatus status : {result.status, both_result.status}) {
            if (status != StepStatus::ok) throw std::runtime_error(name(status));
        }
    }

    HertzLoad<double> hertz;
    NormalLoad<double> load;
    Contact<double> contact;
    ElementSystem<double> along;
    FrictionModel<> one;
    FrictionModel<ConstantFriction<>, 2> both;
    FrictionState<> now = one.at_rest();
    FrictionState<2> both_now = both.at_rest();
    FrictionWorkspace<> workspace = one.workspace();
    FrictionWorkspace<2> both_workspace = both.workspace();
    FrictionStep<> result;
    FrictionStep<2> both_result;
};

// The states of one scene, with friction by both integrators and in full adhesion. An even ride continues at constant
// creepage until no element changes its zone any more.
struct Ride {
    explicit Ride(const Scene& scene, bool even_ = false)
        : even(even_),
          models{scene.transient(Integrator::implicit_euler), scene.transient(Integrator::sdirk2)},
          adhesion(scene.contact, scene.system(), unchecked),
          states{models[0].at_rest(), models[1].at_rest()},
          workspaces{models[0].workspace(), models[1].workspace()},
          sticking(adhesion.at_rest()),
          sticking_workspace(adhesion.workspace()) {}

    // Steps first ... last - 1, in full adhesion and with friction.
    void roll(int first, int last) {
        AdhesionState<> sticking_next = sticking;
        for (int k = first; k < last; ++k) {
            const double dq = even || k % 7 == 0 ? 0.4 : 0.1;
            const RigidMotion<double> motion = even         ? RigidMotion<double>(creepage(0.5))
                                               : k % 5 == 3 ? RigidMotion<double>::shift(peak * 0.3)
                                                            : RigidMotion<double>(creepage(1.2 * std::sin(0.3 * k)));
            for (int i = 0; i < 2; ++i) {
                FrictionState<> next = states[i];
                results[i] = models[i].advance(states[i], dq, motion, next, workspaces[i]);
                std::swap(states[i], next);
            }
            result = adhesion.advance(sticking, dq, motion, sticking_next, sticking_workspace);
            std::swap(sticking, sticking_next);
        }
    }

    void save(std::ostream& file) const {
        for (const FrictionState<>& state : states) write_state(file, state);
        file << sticking.system << '\n';
        write(file, sticking.half_length);
        write(file, sticking.distance);
        for (const double p : sticking.traction) write(file, p);
    }
    void load_from(std::istream& file) {
        for (FrictionState<>& state : states) read_state(file, state);
        file >> sticking.system;
        sticking.half_length = read(file);
        sticking.distance = read(file);
        for (double& p : sticking.traction) p = read(file);
    }
    void save_results(std::ostream& file) const {
        for (const FrictionStep<>& step : results) {
            write(file, step.force);
            write(file, step.tangent);
            write(file, step.slip_work);
            write(file, step.complementarity_residual);
            file << name(step.status) << '\n';
        }
        write(file, result.force);
        write(file, result.tangent);
        file << name(result.status) << '\n';
        save(file);
    }

    void require_solved() const {
        for (const FrictionStep<>& step : results) {
            if (step.status != StepStatus::ok) throw std::runtime_error(name(step.status));
        }
    }

    bool even;
    FrictionModel<> models[2];
    AdhesionModel<> adhesion;
    FrictionState<> states[2];
    FrictionWorkspace<> workspaces[2];
    FrictionStep<> results[2];
    AdhesionState<> sticking;
    AdhesionWorkspace<> sticking_workspace;
    AdhesionStep<> result;
};

template <class Ride>
void save(Ride ride, std::ostream& file) {
    ride.roll(0, steps / 2);
    ride.save(file);
    ride.roll(steps / 2, steps);
    ride.save_results(file);
    file << "end\n";
    ride.require_solved();
}

template <class Ride>
void resume(Ride ride, std::istream& file) {
    ride.load_from(file);
    ride.roll(steps / 2, steps);
    std::stringstream found;
    ride.save_results(found);
    found << "end\n";
    std::string expected, word;
    while (word != "end" && file >> word) expected += word + '\n';
    if (found.str() != expected || word != "end") throw std::runtime_error("restart: another result");
}

}  // namespace

int main(int argc, char** argv) try {
    const std::string what = argc == 3 ? argv[1] : "";
    if (what != "save" && what != "resume") throw std::runtime_error("restart: save FILE or resume FILE");
    const Ride rides[] = {Ride(Scene(cosine_mesh<double>(30), half, 1, 10)),
                          Ride(Scene(cosine_mesh<double>(18), half, 1, 10), true),
                          Ride(Scene(cosine_mesh<double>(21), {.alpha_L = 0, .alpha_T = 0.63}, 1, 10))};
    const LoadedRide loaded[] = {LoadedRide(cosine_mesh<double>(24), true, Integrator::sdirk2),
                                 LoadedRide(uniform_mesh<double>(30), false, Integrator::sdirk2),
                                 LoadedRide(cosine_mesh<double>(24), true, Integrator::implicit_euler)};
    if (what == "save") {
        std::ofstream file(argv[2]);
        for (const Ride& ride : rides) save(ride, file);
        for (const LoadedRide& ride : loaded) save(ride, file);
        return file.flush() ? EXIT_SUCCESS : EXIT_FAILURE;
    }
    std::ifstream file(argv[2]);
    for (const Ride& ride : rides) resume(ride, file);
    for (const LoadedRide& ride : loaded) resume(ride, file);
    return EXIT_SUCCESS;
} catch (const std::exception& error) {
    std::cerr << error.what() << '\n';
    return EXIT_FAILURE;
}
