// Eigen's decompositions of double and complex matrices as plain functions, compiled once for all tests.
#pragma once

#include <complex>

#include <Eigen/Core>

namespace dense {

struct Spectrum {
    Eigen::VectorXcd values;
    Eigen::MatrixXcd vectors;  // as columns
};

Spectrum spectrum(const Eigen::MatrixXd& A);

double largest_singular_value(const Eigen::MatrixXd& A);

Eigen::MatrixXd product(const Eigen::MatrixXd& A, const Eigen::MatrixXd& B);

// A^-1 B, by LU.
Eigen::MatrixXd solve(const Eigen::MatrixXd& A, const Eigen::MatrixXd& B);
Eigen::MatrixXcd solve_complex(const Eigen::MatrixXcd& A, const Eigen::MatrixXcd& B);

// C (s I - A)^-1 B + D
Eigen::MatrixXcd transfer(const Eigen::MatrixXd& A, const Eigen::MatrixXd& B, const Eigen::MatrixXd& C,
                          const Eigen::MatrixXd& D, std::complex<double> s);
template <class Space>
Eigen::MatrixXcd transfer(const Space& space, std::complex<double> s) {
    return transfer(space.A, space.B, space.C, space.D, s);
}

}  // namespace dense
