// States written to a file by one process go on in another, to the last bit.
//     restart save FILE      rolls on, writes the states half-way to FILE, and the results at the end
//     restart resume FILE    goes on from there, and compares
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

#include <rollbem/adhesion/transient.hpp>

#include "scene.hpp"

namespace {

using namespace friction_tests;

constexpr int steps = 60;

// Numbers as 64 bits each, decimal.
void write(std::ostream& file, double x) { file << std::bit_cast<std::uint64_t>(x) << '\n'; }
double read(std::istream& file) {
    std::uint64_t bits = 0;
    if (!(file >> bits)) throw std::runtime_error("restart: the file is cut short");
    return std::bit_cast<double>(bits);
}

// The states of one scene: with friction by both integrators, and in full adhesion.
struct Ride {
    explicit Ride(const Scene& scene)
        : models{scene.transient(Integrator::implicit_euler), scene.transient(Integrator::sdirk2)},
          adhesion(scene.contact, scene.system(), unchecked),
          states{models[0].at_rest(), models[1].at_rest()},
          workspaces{models[0].workspace(), models[1].workspace()},
          sticking(adhesion.at_rest()) {}

    // Steps first ... last - 1; the force of the last in full adhesion and with friction.
    void roll(int first, int last) {
        TransientState<double> sticking_next = sticking;
        for (int k = first; k < last; ++k) {
            const double dq = k % 7 == 0 ? 0.4 : 0.1;
            const RigidMotion<double> motion = k % 5 == 3 ? RigidMotion<double>::shift(peak * 0.3)
                                                          : RigidMotion<double>(creepage(1.2 * std::sin(0.3 * k)));
            for (int i = 0; i < 2; ++i) {
                FrictionState<double> next = states[i];
                results[i] = models[i].advance(states[i], dq, motion, next, workspaces[i]);
                std::swap(states[i], next);
            }
            result = adhesion.advance(sticking, dq, motion, sticking_next);
            std::swap(sticking, sticking_next);
        }
    }

    void save(std::ostream& file) const {
        for (const FrictionState<double>& state : states) {
            file << state.system << '\n';
            for (const double p : state.traction) write(file, p);
            for (const double p : state.normal_pressure) write(file, p);
            write(file, state.half_length);
            for (const Zone zone : state.zones) file << static_cast<int>(zone) << '\n';
        }
        file << sticking.system << '\n';
        for (const double p : sticking.traction) write(file, p);
    }
    void load(std::istream& file) {
        for (FrictionState<double>& state : states) {
            file >> state.system;
            for (double& p : state.traction) p = read(file);
            for (double& p : state.normal_pressure) p = read(file);
            state.half_length = read(file);
            for (Zone& zone : state.zones) {
                int value = 9;
                file >> value;
                zone = static_cast<Zone>(value);
            }
        }
        file >> sticking.system;
        for (double& p : sticking.traction) p = read(file);
    }
    void save_results(std::ostream& file) const {
        for (const FrictionStep<double>& step : results) {
            write(file, step.force);
            write(file, step.tangent);
            write(file, step.slip_work_per_width);
            write(file, step.complementarity_residual);
            file << name(step.status) << '\n';
        }
        write(file, result.force);
        write(file, result.tangent);
        file << name(result.status) << '\n';
        save(file);
    }

    FrictionModel<double> models[2];
    TransientModel<double> adhesion;
    FrictionState<double> states[2];
    FrictionWorkspace<double> workspaces[2];
    FrictionStep<double> results[2];
    TransientState<double> sticking;
    TransientStep<double> result;
};

}  // namespace

int main(int argc, char** argv) try {
    const std::string what = argc == 3 ? argv[1] : "";
    if (what != "save" && what != "resume") throw std::runtime_error("restart: save FILE or resume FILE");
    Ride rides[] = {Ride(Scene(cosine_mesh<double>(30), half, 1, 10)),
                    Ride(Scene(cosine_mesh<double>(21), {.alpha_L = 0, .alpha_T = 0.63}, 1, 10))};
    if (what == "save") {
        std::ofstream file(argv[2]);
        for (Ride& ride : rides) {
            ride.roll(0, steps / 2);
            ride.save(file);
            ride.roll(steps / 2, steps);
            ride.save_results(file);
            file << "end\n";
            for (const FrictionStep<double>& step : ride.results) {
                if (step.status != StepStatus::ok) throw std::runtime_error(name(step.status));
            }
        }
        return file.flush() ? EXIT_SUCCESS : EXIT_FAILURE;
    }
    std::ifstream file(argv[2]);
    for (Ride& ride : rides) {
        ride.load(file);
        ride.roll(steps / 2, steps);
        std::stringstream found;
        ride.save_results(found);
        found << "end\n";
        std::string expected, line, word;
        while (word != "end" && file >> word) expected += word + '\n';
        if (found.str() != expected || word != "end") throw std::runtime_error("restart: another result");
    }
    return EXIT_SUCCESS;
} catch (const std::exception& error) {
    std::cerr << error.what() << '\n';
    return EXIT_FAILURE;
}
