#include "support/dense.hpp"

#include <cmath>

#include <Eigen/QR>

#include <rollbem/compiled/decompositions.hpp>

namespace dense {

Spectrum spectrum(const Eigen::MatrixXd& A) {
    const Eigen::EigenSolver<Eigen::MatrixXd> solver(A);
    return {solver.eigenvalues(), solver.eigenvectors()};
}

Eigen::MatrixXd orthogonal_factor(const Eigen::MatrixXd& A) {
    return Eigen::HouseholderQR<Eigen::MatrixXd>(A).householderQ();
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

}  // namespace dense
