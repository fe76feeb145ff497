#include "surface.hpp"

#include <cmath>
#include <stdexcept>

#include <rollbem/elasticity/layered_kernel.hpp>

#include "support/errors.hpp"

namespace friction {

namespace {

/// function(mesh, scheme, kernel) with the kernel of the direction, under a layer if there is one.
template <class Function>
auto visit(const Surface& surface, Direction direction, const Function& function) {
    using Kernel = rollbem::AnyKernel<double>;
    const study::Scene& scene = surface.scene;
    const auto of = direction == Direction::longitudinal ? Kernel::longitudinal : Kernel::lateral;
    const Kernel kernel = of(scene.kernel.model(), surface.contact());
    if (surface.layer == 0) return function(*scene.mesh, scene.scheme, kernel);
    return function(*scene.mesh, scene.scheme, rollbem::LayeredKernel(kernel, surface.layer / surface.half_length));
}

}  // namespace

rollbem::Contact<double> Surface::contact() const {
    return rollbem::Contact<double>({.half_length = half_length,
                                     .half_width = scene.contact.half_width(),
                                     .shear_modulus = 1,
                                     .poisson_ratio = scene.contact.poisson_ratio()});
}

rollbem::ElementSystem<double> Surface::system(Direction direction) const {
    try {
        return visit(*this, direction, [](const auto& mesh, const auto& scheme, const auto& kernel) {
            return rollbem::rolling_system(mesh, scheme, kernel);
        });
    } catch (const std::invalid_argument&) {
        if (gradient(direction).allFinite()) throw;
        throw study::BadInput("--aspect = " + study::aspect_cell(scene.contact).text() +
                              " and --layer = " + study::Cell(layer).text() + " must be such that G and G' are finite");
    }
}

Eigen::MatrixXd Surface::gradient(Direction direction) const {
    return visit(*this, direction, [](const auto& mesh, const auto& scheme, const auto& kernel) -> Eigen::MatrixXd {
        return rollbem::assemble_G_prime(mesh, scheme, kernel);
    });
}

template <int directions, class Law>
rollbem::FrictionModel<Law, directions> Surface::steady_model(const rollbem::Friction<Law>& friction) const {
    using Model = rollbem::FrictionModel<Law, directions>;
    const auto system = [&](Direction direction) {
        return visit(*this, direction, [](const auto& mesh, const auto& scheme, const auto& kernel) {
            return rollbem::steady_system(mesh, scheme, kernel);
        });
    };
    if constexpr (directions == 1) {
        return Model(contact(), system(Direction::longitudinal), friction);
    } else {
        return Model(contact(), {system(Direction::longitudinal), system(Direction::lateral)}, friction);
    }
}
using Coulomb = rollbem::Friction<>;
using Falling = rollbem::Friction<rollbem::ExponentialFall<>>;
template rollbem::FrictionModel<> Surface::steady_model<1>(const Coulomb&) const;
template rollbem::FrictionModel<rollbem::ConstantFriction<>, 2> Surface::steady_model<2>(const Coulomb&) const;
template rollbem::FrictionModel<rollbem::ExponentialFall<>> Surface::steady_model<1>(const Falling&) const;
template rollbem::FrictionModel<rollbem::ExponentialFall<>, 2> Surface::steady_model<2>(const Falling&) const;

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
