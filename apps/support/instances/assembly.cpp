// What most programs need compiled for double: matrices, the steady and the harmonic solution, time steps.
#include <rollbem/problem/frequency.hpp>
#include <rollbem/problem/steady.hpp>
#include <rollbem/problem/transient.hpp>

namespace rollbem {

template MatrixX<double> detail::influence_matrix<double>(const Mesh<double>&, const detail::Sampling<double>&,
                                                          Eigen::Index, Eigen::Index, const detail::KernelView<double>&,
                                                          detail::Quantity);
template VectorX<double> detail::influence_product<double>(const Mesh<double>&, const detail::Sampling<double>&,
                                                           Eigen::Index, const detail::KernelView<double>&,
                                                           detail::Quantity, const VectorX<double>&);
template UnitSteadySolution<double> detail::solve_steady_in_place<double>(
    Eigen::Ref<MatrixX<double>>, const ArrayX<double>&, const std::function<VectorX<double>(const VectorX<double>&)>&);
template HarmonicSolution<double> solve_exponential<double>(const InfluenceMatrices<double>&, const ArrayX<double>&,
                                                            std::complex<double>);
template class FrequencySweep<double>;
template class TransientModel<double>;

}  // namespace rollbem
