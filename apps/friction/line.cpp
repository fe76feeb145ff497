#include "line.hpp"

#include <algorithm>
#include <cmath>

#include <rollbem/assembly/rolling_system.hpp>
#include <rollbem/closed_form/carter.hpp>
#include <rollbem/elasticity/line_kernel.hpp>

namespace friction {

namespace {

/// The contact of a mesh of the half-length [a_0].
rollbem::Contact contact_of(const study::Scene& scene, double half_length) {
    return rollbem::Contact({.half_length = half_length,
                             .half_width = scene.contact.half_width(),
                             .shear_modulus = 1,
                             .poisson_ratio = scene.contact.poisson_ratio()});
}

}  // namespace

double largest_half_length(const study::Run& run) { return std::sqrt(run.imposed.largest("load_ratio")); }

rollbem::HertzLine::Load hertz_load(const study::Run& run, const rollbem::Mesh<double>& mesh) {
    const auto line = rollbem::HertzLine::dimensionless();
    return run.breathing ? rollbem::HertzLine::Load::breathing(line, mesh)
                         : rollbem::HertzLine::Load::fixed(line, mesh, largest_half_length(run));
}

System Line::system(const study::Scene& scene, Direction direction, bool in_time, double half_length) const {
    using Kernel = rollbem::AnyKernel<double>;
    const auto make = [&](const auto& kernel) {
        return in_time ? System(rollbem::rolling_system(*scene.mesh, scene.scheme, kernel))
                       : rollbem::steady_system(*scene.mesh, scene.scheme, kernel);
    };
    const auto of = direction == Direction::longitudinal ? Kernel::longitudinal : Kernel::lateral;
    const Kernel kernel = of(scene.kernel.model(), contact_of(scene, half_length));
    return layer == 0 ? make(kernel) : make(rollbem::LayeredKernel(kernel, layer / half_length));
}

std::optional<System> Line::lateral_system(const study::Scene& scene, bool in_time, double half_length) const {
    return both ? std::optional(system(scene, Direction::lateral, in_time, half_length)) : std::nullopt;
}

rollbem::FrictionModel Line::contact(const study::Scene& scene, const System& along,
                                     const std::optional<System>& across, const Eigen::ArrayXd& means,
                                     const rollbem::StabilityVerdict& checks, rollbem::Integrator integrator,
                                     double half_length) const {
    const rollbem::Contact contact = contact_of(scene, half_length);
    rollbem::Friction friction{1, means};
    if (law) friction = {law->law(), means, law->memory};
    if (!across) return {contact, along, checks, friction, integrator};
    return {contact, {along, *across}, checks, friction, integrator};
}

study::Cell relative_error(double value, std::optional<double> exact) {
    return exact && *exact != 0 ? study::Cell(value / *exact - 1) : study::Cell();
}

// --- what pictures share

study::Series carter_curve(double from, double to) {
    study::Series line{"Carter", study::Look::exact};
    from = std::min(from, 0.0);
    to = std::max(to, 0.0);
    for (int i = 0; i <= line_points; ++i) {
        const double ratio = from + (to - from) * i / line_points;
        line.points.emplace_back(ratio, rollbem::carter_force_ratio(ratio));
    }
    return line;
}

study::PlotRange force_range(const study::Plot& plot) {
    bool below = false, above = false;
    for (const study::Series& series : plot.series) {
        for (const auto& [ratio, force] : series.points) {
            below = below || force < 0;
            above = above || force > 0;
        }
    }
    return {below ? -1.05 : 0, above || !below ? 1.05 : 0};
}

std::string coefficient(bool falling) { return falling ? "μ_0" : "μ"; }
std::string creepage_label(bool falling, const std::string& ratio) {
    return "creepage ratio " + ratio + " G / (2 (1 - ν) " + coefficient(falling) + " p_0)";
}
std::string force_label(bool falling, const std::string& force, const std::string& load) {
    return force + " / (" + coefficient(falling) + " " + load + ")";
}

}  // namespace friction
