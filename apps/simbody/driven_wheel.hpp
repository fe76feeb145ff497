// A driven wheel under a vehicle, in Simbody, whose rail force comes from a contact with memory.
// C++17, an interface between both: Simbody 3.7's headers do not compile as C++20, which rollbem needs.
#pragma once

#include <string>
#include <vector>

namespace driven_wheel {

/// The contact as the force element sees it. Its memory is a plain value, kept by the force element.
class Contact {
public:
    using Tractions = std::vector<double>;  ///< [Pa], trailing to leading

    Contact() = default;
    Contact(const Contact&) = delete;
    Contact& operator=(const Contact&) = delete;
    virtual ~Contact() = default;

    /// Force on the wheel [N].
    virtual double force(const Tractions& tractions) const = 0;
    /// Rolls on by dq > 0 [m] while the creepage [-] goes from `start` to `end`. Throws if that is not possible.
    virtual Tractions advance(const Tractions& from, double dq, double start, double end) const = 0;
};

/// The rail force F on the wheel drives the vehicle: m dV/dt = F - D, J d(omega)/dt = T - R F.
struct Wheel {
    double mass = 6000;        ///< m, the wheel's share of the vehicle, itself included [kg]
    double inertia = 80;       ///< J [kg m^2]
    double radius = 0.46;      ///< R [m]
    double torque = 920;       ///< T [N m]
    double resistance = 2000;  ///< D [N]; T = R D keeps the speed
};

struct Start {
    double speed;     ///< V [m/s]
    double rotation;  ///< omega [rad/s]
    Contact::Tractions tractions;
};

struct Integration {
    std::string integrator;  ///< one of integrators()
    double accuracy;         ///< relative, of Simbody's integrator [-]
    double largest_step;     ///< [s]
    double sample_interval;  ///< [s]
    int samples;
};

struct Response {
    std::vector<double> sliding{};  ///< V - R omega after each sample interval [m/s]
    int steps = 0;                  ///< accepted by the integrator
    int rejected = 0;               ///< steps tried and not accepted
    int trials = 0;                 ///< evaluations of the contact's force, several in each step
};

/// Names of the Simbody integrators that can be chosen.
std::vector<std::string> integrators();

/// Throws std::runtime_error if Simbody fails.
Response roll(const Wheel& wheel, const Contact& contact, const Start& start, const Integration& integration);

}  // namespace driven_wheel
