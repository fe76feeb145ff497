// The response at one frequency, and --method polynomial.
#pragma once

#include <complex>
#include <limits>
#include <optional>
#include <string>
#include <vector>

#include <Eigen/Core>

#include "support/scenes.hpp"

namespace frequency {

using Complex = std::complex<double>;

inline constexpr Complex unknown{std::numeric_limits<double>::quiet_NaN(), std::numeric_limits<double>::quiet_NaN()};

/// The response of the plane model; unknown if that does not decay.
Complex exact_c11(const rollbem::Contact<double>& contact, double omega);

/// The response at one frequency. Where c11 is not finite, it and the error are left out, as is what needs the exact
/// value where the plane model has none.
struct Response {
    double omega;
    Complex c11, exact;
    std::string status;
    std::optional<double> rcond{}, error_estimate{};
    std::optional<Eigen::Index> order{};
    std::string basis{};
};

/// Scenes without elements, one for each order and contact, and their responses: what must be refused shows before
/// anything is written.
struct Polynomials {
    std::vector<study::Scene> scenes;
    std::vector<std::vector<Response>> responses;
};

/// Throws BadInput where monomials have broken down.
Polynomials solve_polynomials(const study::Options& options, const std::vector<double>& omegas);

}  // namespace frequency
