// What most programs need compiled for double: matrices, the steady and the harmonic solution, time steps.
#include <rollbem/problem/frequency.hpp>
#include <rollbem/problem/steady.hpp>
#include <rollbem/problem/transient.hpp>

namespace rollbem {

template MatrixX<double> detail::influence_matrix<double>(const Mesh<double>&, const detail::Sampling<double>&,
                                                          Eigen::Index, Eigen::Index, const detail::KernelView<double>&,
                                                          detail::Quantity);
template UnitSteadySolution<double> solve_steady<double>(MatrixX<double>, const ArrayX<double>&);
template HarmonicSolution<double> solve_exponential<double>(const InfluenceMatrices<double>&, const ArrayX<double>&,
                                                            std::complex<double>);
template class FrequencySweep<double>;
template class TransientModel<double>;

}  // namespace rollbem
