// The plain implementation of the matrices, a baseline for the fast ones: a double loop over elements, with four
// antiderivatives for every entry of a finite-difference G' and two for every entry of G.
#pragma once

#include <cmath>
#include <numbers>

#include <rollbem/discretisation/scheme.hpp>

namespace naive {

/// Antiderivative of the strip's kernel, half-width b in units of a.
inline double strip_H(double x, double b, double nu) {
    if (x == 0) return 0;
    return 2 / std::numbers::pi * ((1 - nu) * x * std::asinh(b / std::abs(x)) + b * std::asinh(x / b));
}

/// The same in the plane limit.
inline double plane_H(double x, double b, double nu) {
    if (x == 0) return 0;
    return x / std::numbers::pi * ((1 - nu) * (std::log(4 * b * b / (x * x)) + 2) + 2 * nu);
}

template <class Entry>
rollbem::MatrixX<double> matrix(const rollbem::Mesh<double>& mesh, const rollbem::Collocation& scheme,
                                const Entry& entry) {
    const rollbem::ArrayX<double> alpha = rollbem::interpolate_alpha(mesh, scheme.alpha_L, scheme.alpha_T);
    const Eigen::Index n = mesh.size();
    rollbem::MatrixX<double> result(n, n);
    for (Eigen::Index l = 0; l < n; ++l) {
        const double width = mesh.widths()[l];
        for (Eigen::Index m = 0; m < n; ++m) {
            const double d = mesh.centres()[l] + alpha[l] * width - mesh.centres()[m];
            result(l, m) = entry(d, mesh.widths()[m] / 2, width);
        }
    }
    return result;
}

template <class Antiderivative>
rollbem::MatrixX<double> G_prime(const rollbem::Mesh<double>& mesh, const rollbem::Collocation& scheme,
                                 const Antiderivative& H) {
    return matrix(mesh, scheme, [&](double d, double h, double width) {
        const auto u = [&](double x) { return H(x + h) - H(x - h); };
        return (u(d + width / 2) - u(d - width / 2)) / width;
    });
}

template <class Antiderivative>
rollbem::MatrixX<double> G(const rollbem::Mesh<double>& mesh, const rollbem::Collocation& scheme,
                           const Antiderivative& H) {
    return matrix(mesh, scheme, [&](double d, double h, double) { return H(d + h) - H(d - h); });
}

}  // namespace naive
