// A wheel that slips under a load that varies by half, on a mesh that is as long as the contact in every step.
#include <cmath>
#include <iostream>

#include <rollbem/rollbem.hpp>

int main() {
    using namespace rollbem;
    const ElasticBody steel{2.1e11, 0.28};
    const HertzLine line({.load_per_width = 1e6, .combined_radius = 0.46, .body_1 = steel, .body_2 = steel});
    const Contact contact = line.contact(0.5);  // half-width [m]
    const Mesh<double> mesh = cosine_mesh(40);
    const HertzLine::Load hertz = HertzLine::Load::breathing(line, mesh);
    NormalLoad load = hertz.at(1e6);
    const auto system =
        rolling_system(mesh, NodeDifference{Nodes::chebyshev}, PlaneKernel<double>::longitudinal(contact));
    const FrictionModel model(contact, system, judge_stability(system), {0.3, load.normal_pressure});
    Run run(model);
    for (int k = 1; k <= 100; ++k) {
        hertz.set(1e6 * (1 + 0.5 * std::sin(0.1 * k)), load);
        const auto step = run.advance({0.1 * contact.half_length(), Creepage{1e-3}, load});
        if (step.status != Status::ok) return 1;
        std::cout << step.force.longitudinal << '\n';
    }
}
