#include "line.hpp"

#include <algorithm>
#include <cmath>
#include <stdexcept>

#include <rollbem/closed_form/friction.hpp>
#include <rollbem/elasticity/layered_kernel.hpp>
#include <rollbem/normal/pressure_table.hpp>

#include "support/input.hpp"

namespace friction {

namespace {

double read_layer(const study::Options& options) {
    const double layer = options.number("layer", study::not_negative());
    const bool analytic = options.given("derivative") && options.text("derivative") == "analytic";
    const bool closed = options.text("method") == "galerkin" && options.text("quadrature") == "exact";
    options.require(
        layer == 0 || !analytic || closed, "derivative",
        "be fd with --layer: the layer's displacement jumps with the traction, and only differences of it exist");
    return layer;
}

/// Of a mesh of that half-length [a_0].
rollbem::Contact<double> contact_of(const study::Scene& scene, double half_length) {
    return rollbem::Contact<double>({.half_length = half_length,
                                     .half_width = scene.contact.half_width(),
                                     .shear_modulus = 1,
                                     .poisson_ratio = scene.contact.poisson_ratio()});
}

/// Line::title.
std::string scene_in_title(const study::Options& options) {
    std::string title;
    const auto say = [&](const char* name, const std::string& before, const std::string& between = "",
                         const std::string& after = "") {
        if (!options.given(name)) return;
        const std::string value = options.text(name);
        const std::size_t comma = value.find(',');
        title += ", " + before + value.substr(0, comma);
        if (comma != std::string::npos) title += between + value.substr(comma + 1) + after;
    };
    if (options.given("pressure")) title += ", pressure of a table";
    if (options.flag("transient")) {
        const std::string delta = options.given("lateral-ratio") ? "δ_x = " : "δ = ";
        say("creepage-ratio", delta);
        say("sine", delta, " sin(", " q/a)");
        say("lateral-ratio", "δ_y = ");
        say("spin-ratio", "δ_φ = ");
        say("shift", "shift ");
        say("load-sine", "N/N_0 = 1 + ", " sin(2π q/", ")");
        if (options.given("load")) title += ", load of a table";
    }
    for (const NamedLaw& known : laws()) say(known.option.c_str(), known.before, known.between);
    say("memory", "memory ", " and ");
    say("layer", "layer ");
    return title;
}

}  // namespace

Pressure make_pressure(const study::Options& options) {
    if (!options.given("pressure")) {
        const rollbem::HertzPressure<double> hertz;
        return {hertz, hertz, true};
    }
    const study::Rule within = study::between(-1, 1);
    const std::vector<study::Numbers> points = study::read_columns(
        options, "pressure", "x_over_a,pressure", "", [&](const auto& read, const std::string& where) {
            if (!within.holds(read[0].back())) throw study::BadInput(where + ": x_over_a must " + within.text);
            study::require_order(read[0], "x_over_a", where);
        });
    options.require(!points[0].empty(), "pressure", "have at least one row below its header");
    const auto table = study::blame(options.said("pressure"), [&] {
        return rollbem::PressureTable<double>(study::array(points[0]), study::array(points[1]));
    });
    const double scale = mu_N / table.integral();
    return {[=](double x_over_a) { return scale * table(x_over_a); },
            [=](const rollbem::Mesh<double>& mesh) { return Eigen::ArrayXd(scale * table(mesh)); }, false};
}

double largest_half_length(const study::History& imposed) { return std::sqrt(imposed.largest("load_ratio")); }

rollbem::HertzLoad<double> hertz_load(const study::History& imposed, bool breathing,
                                      const rollbem::Mesh<double>& mesh) {
    const auto line = rollbem::HertzLine<double>::dimensionless();
    return breathing ? rollbem::HertzLoad<double>::breathing(line, mesh)
                     : rollbem::HertzLoad<double>::fixed(line, mesh, largest_half_length(imposed));
}

Line::Line(const study::Options& options)
    : both(options.given("lateral-ratio")),
      pressure(make_pressure(options)),
      layer(read_layer(options)),
      law(read_law(options)),
      title(scene_in_title(options)) {}

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

rollbem::FrictionContact Line::contact(const study::Scene& scene, const System& along,
                                       const std::optional<System>& across, const Eigen::ArrayXd& means,
                                       const rollbem::StabilityVerdict& checks, rollbem::Integrator integrator,
                                       double half_length) const {
    const auto under = [&](const auto& friction) -> rollbem::FrictionContact {
        const rollbem::Contact<double> contact = contact_of(scene, half_length);
        if (!across) return rollbem::FrictionModel(contact, along, checks, friction, integrator);
        return rollbem::FrictionModel(contact, rollbem::ElementSystem(along, *across), checks, friction, integrator);
    };
    if (!law) return under(rollbem::Friction<>{1, means});
    return under(rollbem::Friction<std::function<double(double)>>{law->mu(), means, law->memory});
}

study::Cell relative_error(double value, std::optional<double> exact) {
    return exact && *exact != 0 ? study::Cell(value / *exact - 1) : study::Cell();
}

// --- what pictures share

study::Series carter_curve(double from, double to) {
    study::Series line{.label = "Carter", .markers = false, .reference = true};
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
