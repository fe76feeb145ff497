// Sections 3 and 4: the sign of the creepage in the equations, one Gauss point, and the difference of Eq. (29).
#include <algorithm>
#include <cmath>

#include <Eigen/Core>

#include <rollbem/adhesion/transient.hpp>
#include <rollbem/closed_form/carter.hpp>
#include <rollbem/discretisation/scheme.hpp>
#include <rollbem/rolling/run.hpp>
#include <rollbem/spectral/chebyshev.hpp>
#include <rollbem/steady/steady.hpp>

#include "paper/claims.hpp"

namespace paper {

namespace {

/// Results of Eqs. (8), (12), (15) and (16) as printed over results of Eqs. (2), (23) and (30), by the recommended
/// scheme with xi = a = G = V = 1.
struct AsPrinted {
    double sides;     ///< left side of Eq. (8) over the right one with Carter's traction, mean over |x| < a/2
    double in_time;   ///< c11 by Eqs. (12) and (30) after rolling 200 a from rest
    double steady;    ///< c11 by Eqs. (15) and (30)
    double harmonic;  ///< c11 by Eqs. (16) and (30) at omega a/V = 1, real part of the ratio
};

AsPrinted as_printed() {
    const rollbem::ElementSystem<double> system = system_of({});
    const double exact = rollbem::steady_c11(poisson_ratio);
    const Eigen::VectorXd left = system.G_prime() * tractions({}).carter_mean.matrix();
    const double sides = -left.segment(left.size() / 4, left.size() / 2).mean();

    const rollbem::RollingSystem<double> printed(system.G(), system.G_prime(), -system.inputs(), system.outputs());
    const rollbem::AdhesionModel<> model(scene_of({}).contact, printed, rollbem::unchecked,
                                         rollbem::Integrator::implicit_euler);
    rollbem::Run run(model);
    for (int k = 1; k < 400; ++k) run.advance({0.5, 1.0});
    return {sides, -run.advance({0.5, 1.0}).force_per_width / exact, rollbem::solve_steady(printed).c11() / exact,
            (rollbem::solve_response<double>(printed, {0, 1}).c11() / polynomial_c11(1)).real()};
}

/// Largest relative difference between the matrices G and G' of Galerkin's method with one Gauss point and of
/// collocation.
double one_point_difference() {
    double largest = 0;
    for (const std::string derivative : {":fd", ":analytic"}) {
        for (const std::string alphas : {"0/0.63", "0.5/0.5", "1/1"}) {
            const auto collocation = system_of({"geometric-2:collocation:" + alphas + derivative});
            const auto galerkin = system_of({"geometric-2:galerkin:" + alphas + derivative + ":q1"});
            largest = std::max({largest, relative_difference(galerkin.G(), collocation.G()),
                                relative_difference(galerkin.G_prime(), collocation.G_prime())});
        }
    }
    return largest;
}

}  // namespace

Claims equations(const Results&) {
    const AsPrinted found = as_printed();
    const std::string sign =
        "the sign of xi is opposite to that of Eqs. (2), (23) and (30), which agree with one another";
    const auto near_one = [](double ratio, const std::string& text) {
        return judged(std::abs(ratio - 1) < 0.01, text, ratio);
    };
    return {
        {"Eq. 8", "can be expressed through the following matrix form",
         "Eq. (8) as printed holds for Carter's traction, whose force is that of Eq. (30)", sign + "; so in Eq. (11)",
         near_one(found.sides, "its left side is {4} of the right one (0/0.63, n = 40, mean over |x| < a/2)"), false},
        {"Eq. 12", "transformed in an ordinary differential equation system",
         "Eq. (12) as printed tends to the force of Eq. (30) at constant creepage", sign,
         near_one(found.in_time, "{4} of it after rolling 200 a from rest"), false},
        {"Eq. 15", "the solution for the steady state case is obtained",
         "Eq. (15) as printed gives the force of Eq. (30)", sign, near_one(found.steady, "c11* is {5} c11"), false},
        {"Eq. 16", "The complex response for the harmonic creepage variation",
         "Eq. (16) as printed gives the c11 of Eqs. (25) to (27)", sign,
         near_one(found.harmonic, "{5} of it at omega a/V = 1"), false},
        {"Sec. 3", "produces the same result if one single Gauss point is adopted",
         "Galerkin with one Gauss point is collocation",
         "geometric mesh of 40 elements; 0/0.63, 0.5/0.5 and 1/1, either derivative",
         below(1e-14, one_point_difference(), "largest difference of G and G' {1} of the largest entry")},
        {"Eq. 29", "Finite differences, by means of the expression",
         "With the difference as printed, forward from the point, alpha_L = 0 errs least at alpha_T = 0.63",
         say("the interval of the difference lies about the point: then the error of 0/0.63 is {%} at n = 40, and "
             "alpha = 0.5 is Kalker's scheme",
             c11_ratio({}) - 1),
         errs_least_at(0.63, paper_alphas(),
                       [](Eigen::Index n, double x) {
                           return ratio_at({"uniform:collocation:0.5/0.5", n}, Vary::alpha_T, 0.5 + x);
                       }),
         false},
    };
}

}  // namespace paper
