// Friction on contact patches drawn at random: stick and slip found by the library, checked against equations set up
// here from G and G'.
#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <random>
#include <string>
#include <utility>
#include <vector>

#include <rollbem/compiled/friction.hpp>
#include <rollbem/compiled/patch.hpp>

#include "cases.hpp"
#include "friction_scale.hpp"

namespace extremes {

namespace {

using Creepage = rollbem::Creepage<double>;
using Matrix = rollbem::MatrixX<double>;
using Vector = rollbem::VectorX<double>;
using State = rollbem::FrictionState<2>;
using Step = rollbem::FrictionStep<2>;

constexpr rollbem::NodeDifference chebyshev{rollbem::Nodes::chebyshev};
constexpr int steps = 4;

/// Numbers from a seed, the same with every standard library.
class Draw {
public:
    explicit Draw(std::uint64_t seed) : bits_(seed) {}

    double between(double low, double high) { return low + (high - low) * unit(); }
    double decades(double low, double high) { return low * std::pow(high / low, unit()); }
    int count(int low, int high) { return low + static_cast<int>(unit() * (high - low + 1)); }
    double sign() { return unit() < 0.5 ? -1 : 1; }
    bool one_in(int n) { return count(1, n) == 1; }

private:
    double unit() { return static_cast<double>(bits_() >> 11) * 0x1p-53; }

    std::mt19937_64 bits_;
};

/// mu N = 1, and so are a and G.
struct Scene {
    double a_over_b, nu;
    int n, strips;
    bool cosine;
    Creepage creepage;
    struct Later {
        double dq, load;  ///< of a; over N
        Creepage creepage;
    };
    std::array<Later, steps> later;
    bool euler;

    explicit Scene(std::uint64_t seed) {
        Draw draw(seed);
        a_over_b = draw.decades(0.05, 20);
        nu = std::array{0.0, steel, 0.5}[static_cast<std::size_t>(draw.count(0, 2))];
        strips = draw.count(1, 10);
        n = draw.count(1, std::min(12, 2 * strips));
        cosine = !draw.one_in(4);
        // in full adhesion creepages of this size make a force of about the friction limit
        const double size = 0.2 * a_over_b;
        const auto some = [&](bool none) { return none ? 0 : draw.sign() * size * draw.decades(1e-2, 1e2); };
        const int kind = draw.count(0, 5);  // spin alone, no spin, one creepage with spin, all together
        creepage = {some(kind == 0 || kind == 3), some(kind == 0 || kind == 2), some(kind == 1) * std::sqrt(a_over_b)};
        const bool steady_creepage = draw.one_in(2), steady_load = draw.one_in(2);
        double dq = draw.decades(1e-3, 10);
        for (Later& step : later) {
            if (draw.one_in(3)) dq = draw.decades(1e-3, 10);
            step = {dq, 1, creepage};
            if (!steady_load) step.load = draw.one_in(8) ? 0 : draw.between(0.2, 2);
            if (!steady_creepage) {
                step.creepage = {creepage.longitudinal * draw.between(-2, 2), creepage.lateral * draw.between(-2, 2),
                                 creepage.spin * draw.between(-2, 2)};
            }
        }
        euler = draw.one_in(2);
    }

    std::string name(std::uint64_t seed) const {
        return "scene " + std::to_string(seed) + ": a/b = " + shown(a_over_b) + ", nu = " + shown(nu) + ", " +
               std::to_string(n) + " x " + std::to_string(strips) + ", creepages " + shown(creepage.longitudinal) +
               " " + shown(creepage.lateral) + " " + shown(creepage.spin) + (euler ? ", implicit Euler" : ", sdirk2");
    }
};

/// Largest violation of Coulomb's law: of the tractions over the largest mu p_n, of the slip over `scale`.
double violation(const State& state, const Vector& bound, const Matrix& slip, double scale) {
    const double largest = std::max(bound.maxCoeff(), 1e-300);
    double worst = 0;
    for (Eigen::Index i = 0; i < bound.size(); ++i) {
        const auto p = state.traction.row(i);
        const auto s = slip.row(i);
        worst = std::max(worst, (p.norm() - bound[i]) / largest);
        if (state.zones[static_cast<std::size_t>(i)] == rollbem::Zone::stick) {
            worst = std::max(worst, s.norm() / scale);
        } else {
            // slip opposes traction, but for the angle by which it is turned, at most 60 degrees
            worst = std::max({worst, (bound[i] - p.norm()) / largest,
                              (p.dot(s) / std::max(bound[i], 1e-300) + s.norm() / 2) / scale});
        }
    }
    return worst;
}

/// Steady rolling from rest, then steps in time; the error is the largest violation of the law, of the equations by the
/// slip that the library gives, and of the forces' sum.
Outcome run(const Scene& scene) {
    const auto contact = rollbem::PatchContact<double>::dimensionless(scene.a_over_b, scene.nu);
    const auto across = scene.cosine ? rollbem::cosine_mesh(scene.strips) : rollbem::uniform_mesh(scene.strips);
    const auto mesh = rollbem::patch_mesh(contact, rollbem::cosine_mesh(scene.n), across);
    const auto system = rollbem::rolling_system(mesh, chebyshev, rollbem::HalfSpace<double>(scene.nu));
    const auto whole = system.whole();
    const rollbem::ArrayX<double> pressure = rollbem::hertz_pressures(contact, mesh, 1.0);
    const rollbem::FrictionModel model(contact, system, rollbem::unchecked, {1.0, pressure},
                                       scene.euler ? rollbem::Integrator::implicit_euler : rollbem::Integrator::sdirk2);
    const Eigen::Index count = mesh.size();
    const auto stacked = [&](const State& state) {
        return Vector(Eigen::Map<const Vector>(state.traction.data(), 2 * count));
    };
    const auto rigid = [&](const Creepage& c) {
        return Vector(whole.inputs() * Eigen::Vector3d(c.longitudinal, c.lateral, c.spin));
    };
    auto workspace = model.workspace();
    auto now = model.at_rest(), next = now;
    Outcome outcome{.reference = 0, .error = 0, .residual = 0, .bound = 1e-9};
    // `slip` by the equations, a column each direction; `terms` is the size of what they sum
    const auto check = [&](const Step& step, const Vector& bound, const Vector& slip, double terms) {
        outcome.told = told_by(step.status);
        outcome.residual = std::max(outcome.residual, step.complementarity_residual);
        const Vector sum = whole.outputs().transpose() * stacked(next);
        double error = std::max({std::abs(step.force.longitudinal - sum[0]), std::abs(step.force.lateral - sum[1]),
                                 std::abs(step.force.moment - sum[2])});
        if (slip.size() > 0) {
            const Matrix own = Eigen::Map<const Matrix>(slip.data(), count, 2);
            error = std::max(
                {error, violation(next, bound, own, terms), (own - workspace.slip()).cwiseAbs().maxCoeff() / terms});
        } else {
            error = std::max(error, (next.traction.rowwise().norm() - bound).maxCoeff() / bound.maxCoeff());
        }
        outcome.error = std::max(outcome.error, error);
        outcome.value = -step.force.lateral;
    };
    const auto size = [](const Vector& vector) { return vector.cwiseAbs().maxCoeff(); };

    const Step steady = model.steady(now, scene.creepage, next, workspace);
    const Vector w = rigid(scene.creepage), u_prime = whole.G_prime() * stacked(next);
    check(steady, pressure, w - u_prime, size(w) + size(u_prime));
    for (const Scene::Later& later : scene.later) {
        if (!outcome.told.empty()) break;
        std::swap(now, next);
        const rollbem::NormalLoad<double> load{
            .normal_pressure = later.load * pressure, .half_length = contact.half_length(), .pressure_rate = {}};
        const Step step = model.advance(now, later.dq, later.creepage, load, next, workspace);
        if (later.load == 0 && step.status == rollbem::StepStatus::ok && next.traction.isZero(0)) continue;
        if (!scene.euler) {
            check(step, load.normal_pressure, {}, 1);
            continue;
        }
        const Vector rolled = later.dq * rigid(later.creepage), slope = later.dq * (whole.G_prime() * stacked(next));
        const Vector change = whole.G() * (stacked(next) - stacked(now));
        check(step, load.normal_pressure, rolled - slope + change, size(rolled) + size(slope) + size(change));
    }
    return outcome;
}

}  // namespace

Case patch_scene(std::uint64_t seed) {
    return {Scene(seed).name(seed), "violation of the law of friction", [=] { return run(Scene(seed)); }};
}

}  // namespace extremes
