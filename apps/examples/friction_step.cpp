// A wheel that slips, step by step: its force, the heat of friction and the energy of the elastic half-spaces.
#include <iostream>

#include <rollbem/adhesion/stability.hpp>
#include <rollbem/line.hpp>

using namespace rollbem;

int main() {
    // a steel wheel of radius 0.46 m with 60 kN on a contact 24 mm wide: half-length and pressure by Hertz
    const ElasticBody steel{.young_modulus = 2.1e11, .poisson_ratio = 0.28};
    const HertzLine line({.load_per_width = 2.5e6, .combined_radius = 0.46, .body_1 = steel, .body_2 = steel});
    const Contact contact = line.contact(12e-3);
    const Mesh<double> mesh = cosine_mesh(40);
    const NodeDifference scheme{Nodes::chebyshev};
    const auto system = rolling_system(mesh, scheme, PlaneKernel<double>::longitudinal(contact));
    const FrictionModel model(contact, system, judge_stability(system), {0.3, line.mean_pressure(mesh)});
    Run run(model);
    double heat = 0;  // by slip [J]
    for (int k = 0; k < 200; ++k) {
        const auto step = run.advance({0.2e-3, Creepage{2e-3}});  // rolls on by 0.2 mm
        if (step.status != Status::ok) return 1;
        heat += step.slip_work;
    }
    std::cout << "F = " << model.force(run.now()).longitudinal << " N, heat " << heat << " J, elastic energy "
              << model.elastic_energy(run.now()) << " J\n";
}
