// rollbem in a multibody code: a driven wheel in Simbody whose rail force is that of the contact, disturbed from steady
// rolling. Its oscillation is compared with the closed loop of the exact creep coefficient c11(s):
//
//     ./simbody_wheel --n 10,20,40 --integrator merson --output wheel.csv
#include <algorithm>
#include <atomic>
#include <cmath>
#include <complex>
#include <cstddef>
#include <numbers>
#include <stdexcept>
#include <string>
#include <vector>

#include <Eigen/LU>

#include <rollbem/compiled/adhesion.hpp>
#include <rollbem/reference/bessel.hpp>
#include <rollbem/reference/step_response.hpp>

#include "simbody/driven_wheel.hpp"
#include "support/options.hpp"
#include "support/table.hpp"

namespace {

using Complex = std::complex<double>;
using Model = rollbem::AdhesionModel<>;

constexpr double speed = 20;   // V [m/s]
constexpr double kick = 1e-4;  // fraction of the rotation that is removed; small, so that the loop is linear
constexpr int samples = 20;    // in a period
constexpr double periods = 2.5;

/// The contact for Simbody's force element.
class RolledContact final : public driven_wheel::Contact {
public:
    explicit RolledContact(const Model& model)
        : model_(model), half_length_(model.at_rest().half_length), workspace_(model.workspace()) {}

    Tractions steady(double creepage) const { return values(model_.steady(creepage)); }

    double force(const Tractions& tractions) const override { return model_.force(state(tractions)); }

    Tractions advance(const Tractions& from, double dq, double start, double end) const override {
        Model::State to = model_.at_rest();
        const auto motion = rollbem::RigidMotion<double>::linear(start, end);
        const Model::Step step = model_.advance(state(from), dq, motion, to, workspace_);
        if (step.status != rollbem::StepStatus::ok) {
            throw std::runtime_error(std::string("the contact refuses the step: ") + name(step.status));
        }
        return values(to);
    }

private:
    Model::State state(const Tractions& tractions) const {
        return {Eigen::VectorXd::Map(tractions.data(), static_cast<Eigen::Index>(tractions.size())),
                model_.fingerprint(), half_length_};
    }
    static Tractions values(const Model::State& state) { return {state.traction.begin(), state.traction.end()}; }

    const Model& model_;
    double half_length_;  // a [m]
    mutable Model::Workspace workspace_;
};

/// The sliding speed V - R omega = w under the contact's force: s w - w_0 = -kappa c11(s) w, in V/a.
struct ClosedLoop {
    double poisson_ratio, aspect;
    double kappa;  // 2 a^2 b G (1/m + R^2/J) / V^2

    Complex characteristic(Complex s) const {
        return s + kappa * rollbem::reference::plane_c11(s, poisson_ratio, aspect);
    }

    /// Its root, by the secant method, started at that of c11 = C/(1 + (Lambda - 1/2) s).
    Complex root() const {
        const double lag = rollbem::plane_lambda(poisson_ratio, aspect) - 0.5;
        const double steady = kappa * rollbem::steady_c11(poisson_ratio);
        Complex old = (-1.0 + std::sqrt(Complex(1 - 4 * lag * steady))) / (2 * lag), s = old * 1.01;
        for (int k = 0; k < 50 && std::abs(s - old) > 1e-13; ++k) {
            const Complex slope = (characteristic(s) - characteristic(old)) / (s - old);
            old = s;
            s -= characteristic(s) / slope;
        }
        return s;
    }

    /// w/w_0 at q/a > 0 after a kick w_0.
    double response(double q_over_a) const {
        using Long = std::complex<long double>;
        return rollbem::reference::invert_laplace([&](Long s) { return Long(1) / Long(characteristic(Complex(s))); },
                                                  q_over_a);
    }
};

/// s of e^{s t} in equidistant samples: x_{k+2h} = t x_{k+h} - d x_k by least squares, e^{2 Re(s) h dt} = d.
Complex fit(const Eigen::VectorXd& x, double dt) {
    const Eigen::Index h = samples / 10, first = 3 * samples / 4, count = x.size() - first - 2 * h;
    Eigen::MatrixX2d matrix(count, 2);
    matrix << x.segment(first + h, count), -x.segment(first, count);
    const Eigen::Vector2d td =
        (matrix.transpose() * matrix).inverse() * (matrix.transpose() * x.segment(first + 2 * h, count));
    return std::log(td[0] / 2 + std::sqrt(Complex(td[0] * td[0] / 4 - td[1]))) / (static_cast<double>(h) * dt);
}

}  // namespace

int main(int argc, char** argv) {
    // 1. The command line.
    study::Options options("simbody_wheel",
                           "Oscillation of a driven wheel in Simbody with the contact as its rail force, against the "
                           "exact closed loop.");
    for (const char* group : {"Discretisation", "Contact"}) {
        options.refuse_group(group, "the contact is given; see --help", {"n"});
    }
    options.set_default("n", "10,20,40");
    options.add("integrator", "NAME", "Simbody's: merson, rk3, verlet or cpodes", "merson");
    options.add("accuracy", "X", "the integrator's relative accuracy, 1e-14 to 0.1 (dimensionless)", "1e-10");
    options.add("steps", "N", "largest step: this part of a period of the oscillation, 20 to 10000 (dimensionless)",
                "200");
    options.add("tolerance", "X", "largest error that is allowed, above 0 (dimensionless)", "0.01");
    options.footer(R"(Example: a fine contact with a multistep integrator
  simbody_wheel --n 80 --steps 1000 --integrator cpodes

One row per n. frequency_error and decay_error are relative; response_error is the largest distance of the
sliding speed from the exact one over 2.5 periods, in units of the kick. steps are those Simbody accepted,
rejected those it tried and rejected, trials the evaluations of the contact in all of them. If one of the
errors exceeds --tolerance, status is above_tolerance instead of ok, and the exit code is 1.
The contact: a = 6 mm, b = 12 mm, nu = 0.28, plane kernel, cosine mesh, alpha 0.5; the wheel: 20 m/s, R = 0.46 m,
J = 80 kg m^2, 6000 kg.
)");

    return study::run_program(options, argc, argv, [](const study::Options& given) {
        const driven_wheel::Wheel wheel;
        const std::string integrator = given.choice("integrator", driven_wheel::integrators());
        const double accuracy = given.number("accuracy", study::between(1e-14, 0.1));
        const double steps = given.number("steps", study::between(samples, 1e4));
        const double tolerance = given.number("tolerance", study::positive());
        const std::vector<std::ptrdiff_t> sizes = given.integers("n", 1, 1000);

        // 2. The contact, and what the exact one does with the wheel.
        const rollbem::Contact<double> contact(
            {.half_length = 6e-3, .half_width = 12e-3, .shear_modulus = 8e10, .poisson_ratio = 0.28});
        const double a = contact.half_length();
        const double mobility = 1 / wheel.mass + wheel.radius * wheel.radius / wheel.inertia;
        const ClosedLoop loop{
            .poisson_ratio = contact.poisson_ratio(),
            .aspect = contact.aspect(),
            .kappa = 2 * a * a * contact.half_width() * contact.shear_modulus() * mobility / (speed * speed)};
        const Complex exact = loop.root() * speed / a;  // [1/s]
        const double period = 2 * std::numbers::pi / std::abs(exact.imag());
        const double interval = period / samples;

        std::atomic<bool> within_tolerance = true;
        study::Table table;
        table.columns = {"integrator",      "n",           "frequency_hz",      "exact_frequency_hz",
                         "frequency_error", "decay_per_s", "exact_decay_per_s", "decay_error",
                         "response_error",  "steps",       "rejected",          "trials",
                         "status"};
        table.rows_of_task.assign(sizes.size(), 1);
        table.compute = [&](std::size_t task, study::RowRange, const study::Emit& emit) {
            // 3. Steady rolling, where the rail carries the resistance, and a kick to the rotation.
            const Model model(contact,
                              rollbem::rolling_system(rollbem::cosine_mesh(sizes[task]),
                                                      rollbem::Collocation{.alpha_L = 0.5, .alpha_T = 0.5},
                                                      rollbem::PlaneKernel<double>::longitudinal(contact)),
                              rollbem::unchecked);
            const RolledContact rolled(model);
            const double creepage = wheel.resistance / model.force(model.steady(1.0));
            const double rotation = speed * (1 - creepage) / wheel.radius;
            const driven_wheel::Response response =
                driven_wheel::roll(wheel, rolled, {speed, rotation * (1 - kick), rolled.steady(creepage)},
                                   {integrator, accuracy, period / steps, interval, int(periods * samples)});

            // 4. The sliding speed that follows.
            const double scale = kick * rotation * wheel.radius;
            Eigen::VectorXd sliding = Eigen::VectorXd::Map(response.sliding.data(), std::ssize(response.sliding));
            sliding = (sliding.array() - creepage * speed) / scale;
            double response_error = 0;
            for (Eigen::Index k = 0; k < sliding.size(); ++k) {
                const double q_over_a = speed * interval * static_cast<double>(k + 1) / a;
                response_error = std::max(response_error, std::abs(sliding[k] - loop.response(q_over_a)));
            }
            const Complex measured = fit(sliding, interval);
            const double frequency_error = std::abs(measured.imag() / exact.imag()) - 1;
            const double decay_error = measured.real() / exact.real() - 1;
            bool passes = true;
            for (const double error : {frequency_error, decay_error, response_error}) {
                passes = passes && std::abs(error) < tolerance;
            }
            if (!passes) within_tolerance = false;
            const double turn = 2 * std::numbers::pi;
            emit({integrator, sizes[task], std::abs(measured.imag()) / turn, std::abs(exact.imag()) / turn,
                  frequency_error, -measured.real(), -exact.real(), decay_error, response_error, response.steps,
                  response.rejected, response.trials, passes ? "ok" : "above_tolerance"});
        };

        // 5. --plot: the errors over n.
        table.plot = [&](const std::vector<study::Row>& rows) {
            study::Plot plot{.title = "Driven wheel in Simbody, against the exact closed loop",
                             .x_label = "number of elements n",
                             .y_label = "relative error",
                             .log_x = true,
                             .log_y = true};
            if (rows.empty()) return plot;  // of a shard
            for (const std::string name : {"frequency", "decay", "response"}) {
                study::add_series(plot, table.columns, rows,
                                  {.by = {}, .x = "n", .y = name + "_error", .absolute = true});
                plot.series.back().label = name;
            }
            return plot;
        };
        study::write_table(given, table);
        return within_tolerance ? study::exit_ok : study::exit_failed;
    });
}
