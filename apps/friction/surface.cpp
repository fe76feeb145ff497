#include "surface.hpp"

#include <cmath>
#include <variant>

#include <rollbem/elasticity/layered_kernel.hpp>

#include "support/errors.hpp"

namespace friction {

namespace {

/// function(mesh, scheme, kernel) with the kernel of a direction, under a layer where there is one.
template <class Function>
auto visit(const Surface& surface, Direction direction, const Function& function) {
    const rollbem::Contact<double> contact = surface.contact();
    return surface.scene.visit([&](const auto& mesh, const auto& scheme, const auto& any) {
        using Kernel = std::remove_cvref_t<decltype(any)>;
        const Kernel kernel =
            direction == Direction::longitudinal ? Kernel::longitudinal(contact) : Kernel::lateral(contact);
        if (surface.layer == 0) return function(mesh, scheme, kernel);
        return function(mesh, scheme, rollbem::LayeredKernel(kernel, surface.layer / surface.half_length));
    });
}

}  // namespace

rollbem::Contact<double> Surface::contact() const {
    return rollbem::Contact<double>({.half_length = half_length,
                                     .half_width = scene.contact.half_width(),
                                     .shear_modulus = 1,
                                     .poisson_ratio = scene.contact.poisson_ratio()});
}

rollbem::ElementSystem<double> Surface::system(Direction direction) const {
    return visit(*this, direction, [](const auto& mesh, const auto& scheme, const auto& kernel) {
        return rollbem::rolling_system(mesh, scheme, kernel);
    });
}

std::pair<Eigen::MatrixXd, Eigen::ArrayXd> Surface::gradient(Direction direction) const {
    return visit(*this, direction, [](const auto& mesh, const auto& scheme, const auto& kernel) {
        return std::pair<Eigen::MatrixXd, Eigen::ArrayXd>(rollbem::assemble_G_prime(mesh, scheme, kernel),
                                                          rollbem::unknown_widths(mesh, scheme));
    });
}

double read_layer(const study::Options& options) {
    const double layer = options.number(
        "layer", {[](double value) { return std::isfinite(value) && value >= 0; }, "be finite and not negative"});
    if (layer == 0) return 0;
    const bool quadrature = options.text("method") == "galerkin" && options.text("quadrature") != "exact";
    const bool analytic = options.given("derivative") && options.text("derivative") == "analytic";
    if (analytic && (quadrature || options.text("method") != "galerkin")) {
        throw study::BadInput(options.said("derivative") +
                              " must be fd with --layer: the layer's displacement jumps with the traction, and only "
                              "differences of it exist");
    }
    return layer;
}

}  // namespace friction
