#include "support/dense.hpp"

#include <cmath>

#include <Eigen/Eigenvalues>

#include <rollbem/adhesion/balanced_reduction.hpp>
#include <rollbem/adhesion/stability.hpp>
#include <rollbem/assembly/rolling_system.hpp>

namespace dense {

Spectrum spectrum(const Eigen::MatrixXd& A) {
    const Eigen::EigenSolver<Eigen::MatrixXd> solver(A);
    return {solver.eigenvalues(), solver.eigenvectors()};
}

double largest_singular_value(const Eigen::MatrixXd& A) {
    const Eigen::EigenSolver<Eigen::MatrixXd> solver(product(A.transpose(), A), false);
    return std::sqrt(solver.eigenvalues().real().maxCoeff());
}

Eigen::MatrixXd product(const Eigen::MatrixXd& A, const Eigen::MatrixXd& B) { return A * B; }

Eigen::MatrixXd solve(const Eigen::MatrixXd& A, const Eigen::MatrixXd& B) { return A.partialPivLu().solve(B); }

Eigen::MatrixXcd solve_complex(const Eigen::MatrixXcd& A, const Eigen::MatrixXcd& B) {
    return A.partialPivLu().solve(B);
}

Eigen::MatrixXcd transfer(const Eigen::MatrixXd& A, const Eigen::MatrixXd& B, const Eigen::MatrixXd& C,
                          const Eigen::MatrixXd& D, std::complex<double> s) {
    Eigen::MatrixXcd resolvent = -A.cast<std::complex<double>>();
    resolvent.diagonal().array() += s;
    const Eigen::MatrixXcd states = solve_complex(resolvent, B.cast<std::complex<double>>());
    return C.cast<std::complex<double>>() * states + D.cast<std::complex<double>>();
}

}  // namespace dense
