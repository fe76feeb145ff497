// coarse_table FILE: writes the table of steady creep forces that is packed with rollbem_patch.fmu.
#include <cstdio>
#include <exception>
#include <fstream>
#include <stdexcept>
#include <string>
#include <vector>

#include <rollbem/vehicle/creep_force_table.hpp>

#include "../creep/source.hpp"

namespace {

using rollbem::CreepForceGrid;

constexpr double poisson_ratio = 0.28, smallest = 0.1, largest = 10;  // nu and a/b
constexpr Eigen::Index shapes = 12;
constexpr int levels = 10, elements = 10;

rollbem::CreepForceTable make_table() {
    std::vector<creep::Source> sources;
    std::vector<rollbem::CreepCoefficients<double>> coefficients;
    for (Eigen::Index shape = 0; shape < shapes; ++shape) {
        sources.emplace_back(CreepForceGrid::a_over_b_of(shape, shapes, smallest, largest), poisson_ratio, elements);
        coefficients.push_back(sources.back().coefficients());
    }
    const CreepForceGrid grid(poisson_ratio, smallest, largest, levels, coefficients);
    Eigen::Array3Xd forces(3, grid.nodes() * shapes);
    for (Eigen::Index i = 0; i < forces.cols(); ++i) {
        const Eigen::Index shape = i / grid.nodes(), node = i % grid.nodes();
        const auto solution =
            sources[static_cast<std::size_t>(shape)].solve(grid.creepage(shape, node), grid.begins_line(node));
        if (solution.step.status != rollbem::StepStatus::ok) {
            throw std::runtime_error("no forces at row " + std::to_string(i) + ": " + name(solution.step.status));
        }
        forces.col(i) = solution.force;
    }
    return rollbem::CreepForceTable(grid, forces);
}

}  // namespace

int main(int count, char** arguments) {
    if (count != 2) return 2;
    try {
        const rollbem::CreepForceTable table = make_table();
        std::ofstream file(arguments[1], std::ios::binary);
        table.write(file);
        if (!file.flush()) throw std::runtime_error(std::string("cannot write ") + arguments[1]);
    } catch (const std::exception& error) {
        std::fprintf(stderr, "coarse_table: %s\n", error.what());
        return 1;
    }
}
