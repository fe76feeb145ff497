#include "surface.hpp"

#include <cmath>
#include <stdexcept>

#include <rollbem/elasticity/layered_kernel.hpp>

#include "support/errors.hpp"

namespace friction {

namespace {

/// function(mesh, scheme, kernels...) with the kernels of the directions, under a layer if there is one.
template <class Function, class... Directions>
auto visit(const Surface& surface, const Function& function, Directions... directions) {
    using Kernel = rollbem::AnyKernel<double>;
    const study::Scene& scene = surface.scene;
    const rollbem::Contact<double> contact = surface.contact();
    const auto kernel = [&](Direction direction) {
        const auto of = direction == Direction::longitudinal ? Kernel::longitudinal : Kernel::lateral;
        return of(scene.kernel.model(), contact);
    };
    if (surface.layer == 0) return function(*scene.mesh, scene.scheme, kernel(directions)...);
    return function(*scene.mesh, scene.scheme,
                    rollbem::LayeredKernel(kernel(directions), surface.layer / surface.half_length)...);
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
        return visit(
            *this,
            [](const auto& mesh, const auto& scheme, const auto& kernel) {
                return rollbem::rolling_system(mesh, scheme, kernel);
            },
            direction);
    } catch (const std::invalid_argument&) {
        if (gradient(direction).allFinite()) throw;
        throw study::BadInput("--aspect = " + study::aspect_cell(scene.contact).text() +
                              " and --layer = " + study::Cell(layer).text() + " must be such that G and G' are finite");
    }
}

Eigen::MatrixXd Surface::gradient(Direction direction) const {
    return visit(
        *this,
        [](const auto& mesh, const auto& scheme, const auto& kernel) -> Eigen::MatrixXd {
            return rollbem::assemble_G_prime(mesh, scheme, kernel);
        },
        direction);
}

template <int directions, class Law>
rollbem::SteadyFrictionModel<Law, directions> Surface::steady_model(const rollbem::Friction<Law>& friction) const {
    using Model = rollbem::SteadyFrictionModel<Law, directions>;
    const auto make = [&](const auto&... parts) { return Model(contact(), parts..., friction); };
    if constexpr (directions == 1) {
        return visit(*this, make, Direction::longitudinal);
    } else {
        return visit(*this, make, Direction::longitudinal, Direction::lateral);
    }
}
using Coulomb = rollbem::Friction<>;
using Falling = rollbem::Friction<rollbem::ExponentialFall<>>;
template rollbem::SteadyFrictionModel<> Surface::steady_model<1>(const Coulomb&) const;
template rollbem::SteadyFrictionModel<rollbem::ConstantFriction<>, 2> Surface::steady_model<2>(const Coulomb&) const;
template rollbem::SteadyFrictionModel<rollbem::ExponentialFall<>> Surface::steady_model<1>(const Falling&) const;
template rollbem::SteadyFrictionModel<rollbem::ExponentialFall<>, 2> Surface::steady_model<2>(const Falling&) const;

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
