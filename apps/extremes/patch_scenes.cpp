// Friction on contact patches drawn at random, whose size and shape may vary: stick and slip found by the library,
// checked against equations set up here from G, G' and du/dy.
#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <optional>
#include <string>
#include <utility>

#include <rollbem/assembly/patch_system.hpp>
#include <rollbem/assembly/rolling_system.hpp>
#include <rollbem/elasticity/patch_kernel.hpp>
#include <rollbem/friction/model.hpp>
#include <rollbem/normal/hertz.hpp>
#include <rollbem/normal/load.hpp>
#include <rollbem/rolling/run.hpp>

#include "cases.hpp"
#include "drawn.hpp"

namespace extremes {

namespace {

using Axes = rollbem::SemiAxes;
using Creepage = rollbem::Creepage;
using Eigen::MatrixXd, Eigen::VectorXd;
using State = rollbem::FrictionState;

constexpr int steps = 4;

/// mu N = 1, and so are the contact's a and G.
struct PatchScene {
    double a_over_b, nu;
    int n, strips;
    bool cosine;
    Creepage creepage;
    struct Later {
        double dq, load;  ///< of a; over N
        Creepage creepage;
        double growth = 0, narrowing = 1;  ///< da over the smaller of dq and a/2; factor on a/b
    };
    std::array<Later, steps> later;
    bool euler;
    bool varies, reshapes;              ///< the size; and the shape
    double half_length, narrowing = 1;  ///< a at the beginning; a/b then over a/b of the contact

    explicit PatchScene(std::uint64_t seed) {
        drawn::Draw draw(seed);
        a_over_b = draw.logarithmic(0.05, 20);
        nu = std::array{0.0, steel, 0.5}[static_cast<std::size_t>(draw.integer(0, 2))];
        strips = draw.integer(1, 10);
        n = draw.integer(1, std::min(12, 2 * strips));
        cosine = !draw.one_in(4);
        // in full adhesion creepages of this size make a force of about the friction limit
        const double size = 0.2 * a_over_b;
        const auto some = [&](bool none) { return none ? 0 : draw.sign() * size * draw.logarithmic(1e-2, 1e2); };
        const int kind = draw.integer(0, 5);  // spin alone, no spin, one creepage with spin, all together
        creepage = {some(kind == 0 || kind == 3), some(kind == 0 || kind == 2), some(kind == 1) * std::sqrt(a_over_b)};
        const bool steady_creepage = draw.one_in(2), steady_load = draw.one_in(2);
        double dq = draw.logarithmic(1e-3, 10);
        for (Later& step : later) {
            if (draw.one_in(3)) dq = draw.logarithmic(1e-3, 10);
            step = {dq, 1, creepage};
            if (!steady_load) step.load = draw.one_in(8) ? 0 : draw.uniform(0.2, 2);
            if (!steady_creepage) {
                step.creepage = {creepage.longitudinal * draw.uniform(-2, 2), creepage.lateral * draw.uniform(-2, 2),
                                 creepage.spin * draw.uniform(-2, 2)};
            }
        }
        euler = draw.one_in(2);
        varies = draw.one_in(2);
        reshapes = varies && draw.one_in(2);
        half_length = varies ? draw.logarithmic(0.5, 2) : 1;
        if (reshapes) narrowing = draw.logarithmic(1 / 1.4, 2);
        for (Later& step : later) {
            if (varies) step.growth = draw.uniform(-1.02, 1.02);
            if (reshapes) step.narrowing = draw.logarithmic(0.75, 1 / 0.75);
        }
    }

    std::string name(std::uint64_t seed) const {
        return "scene " + std::to_string(seed) + ": a/b = " + shown(a_over_b) + ", nu = " + shown(nu) + ", " +
               std::to_string(n) + " x " + std::to_string(strips) + ", creepages " + shown(creepage.longitudinal) +
               " " + shown(creepage.lateral) + " " + shown(creepage.spin) + (euler ? ", implicit Euler" : ", sdirk2") +
               (reshapes ? ", a and b vary"
                : varies ? ", a varies"
                         : "");
    }
};

double size(const VectorXd& vector) { return vector.cwiseAbs().maxCoeff(); }

/// A scene's contact, and the equations of its present ellipse, set up anew.
class RollingPatch {
public:
    explicit RollingPatch(const PatchScene& scene)
        : scene_(scene),
          contact_(rollbem::PatchContact::dimensionless(scene.a_over_b, scene.nu)),
          mesh_(rollbem::patch_mesh(contact_, rollbem::cosine_mesh(scene.n), across())),
          shapes_(make_shapes()),
          system_(make_system()),
          pressure_(rollbem::hertz_pressures(contact_, mesh_, 1.0)),
          model_(contact_, system_, rollbem::unchecked, {1.0, pressure_},
                 scene.euler ? rollbem::Integrator::implicit_euler : rollbem::Integrator::sdirk2),
          axes_{scene.half_length, scene.half_length / scene.narrowing * contact_.half_width()},
          whole_(equations_at(axes_)),
          run_(model_) {}

    /// Steady rolling from rest, then steps in the time domain; the error is the largest violation of the law, of the
    /// equations by the slip that the library gives, and of the forces' sum.
    Outcome operator()() {
        const auto first = load_of(1, axes_);
        const auto steady = run_.try_steady({.motion = scene_.creepage, .load = first});
        const VectorXd w = rigid(scene_.creepage), u_prime = whole_.G_prime() * stacked(run_.next());
        check(steady, first.normal_pressure, w - u_prime, size(w) + size(u_prime));
        run_.accept();
        for (const PatchScene::Later& later : scene_.later) {
            if (outcome_.told.empty() && step(later)) run_.accept();
        }
        return outcome_;
    }

private:
    rollbem::Mesh<double> across() const {
        return scene_.cosine ? rollbem::cosine_mesh(scene_.strips) : rollbem::uniform_mesh(scene_.strips);
    }
    rollbem::HalfSpace<double> kernel() const { return rollbem::HalfSpace<double>(scene_.nu); }

    std::optional<rollbem::PatchShapes<double>> make_shapes() const {
        if (!scene_.reshapes) return std::nullopt;
        const double ratio = scene_.a_over_b;
        return std::optional<rollbem::PatchShapes<double>>(
            std::in_place, rollbem::cosine_mesh(scene_.n), across(), chebyshev, kernel(),
            rollbem::PatchShapes<double>::Range{ratio / 1.5, ratio * 2.25, 1.5});
    }

    rollbem::ElementSystem<double, 2> make_system() const {
        if (shapes_) return shapes_->system(scene_.a_over_b);
        if (scene_.varies) return rollbem::breathing_system(contact_, mesh_, chebyshev, kernel());
        return rollbem::rolling_system(mesh_, chebyshev, kernel());
    }

    /// All equations of an ellipse.
    rollbem::RollingSystem<double> equations_at(const Axes& axes) const {
        const double a = axes.half_length;
        const auto unit = (shapes_ ? shapes_->system(a / axes.half_width) : system_).joined();
        return rollbem::RollingSystem<double>(a * unit.G(), unit.G_prime(),
                                              unit.inputs() * Eigen::Vector3d(1, 1, a).asDiagonal(),
                                              unit.outputs() * Eigen::Vector3d(a * a, a * a, a * a * a).asDiagonal());
    }

    rollbem::NormalLoad load_of(double load, const Axes& axes) const {
        const double area = axes.half_length * axes.half_width / contact_.half_width();
        return rollbem::NormalLoad{load / area * pressure_, axes.half_length, {}, axes.half_width};
    }

    VectorXd stacked(const State& state) const {
        return VectorXd(Eigen::Map<const VectorXd>(state.traction.data(), 2 * mesh_.size()));
    }
    VectorXd rigid(const Creepage& c) const {
        return VectorXd(whole_.inputs() * Eigen::Vector3d(c.longitudinal, c.lateral, c.spin));
    }

    /// y/b du/dy.
    VectorXd stretched(const VectorXd& p) const {
        const Eigen::Index count = mesh_.size();
        VectorXd result = VectorXd::Zero(2 * count);
        if (!system_.shapes()) return result;
        const auto weights = system_.shapes()->weights(axes_.half_length / axes_.half_width);
        for (std::size_t k = 0; k < weights.count; ++k) {
            const auto& G_y = system_.shapes()->nodes[weights.first + k].G_y;
            result.head(count) += weights.values[k] * (G_y.xx * p.head(count) + G_y.xy * p.tail(count));
            result.tail(count) += weights.values[k] * (G_y.xy * p.head(count) + G_y.yy * p.tail(count));
        }
        result.array() *= system_.elements().y.replicate(2, 1) * scene_.a_over_b;
        return result;
    }

    /// `slip` by the equations, a column each direction; `terms` is the size of what they sum.
    void check(const rollbem::FrictionStep& step, const VectorXd& bound, const VectorXd& slip, double terms) {
        outcome_.told = told_by(step.status);
        outcome_.residual = std::max(outcome_.residual, step.complementarity_residual);
        const State& next = run_.next();
        const VectorXd sum = whole_.outputs().transpose() * stacked(next);
        double error = std::max({std::abs(step.force.longitudinal - sum[0]), std::abs(step.force.lateral - sum[1]),
                                 std::abs(step.force.moment - sum[2])});
        if (slip.size() > 0) {
            const MatrixXd own = Eigen::Map<const MatrixXd>(slip.data(), mesh_.size(), 2);
            const auto law = drawn::violation(next.traction, own, bound, next.zones, true);
            error = std::max({error, law.bound / std::max(bound.maxCoeff(), 1e-300), law.stick / terms,
                              law.direction / terms, (own - run_.workspace().slip()).cwiseAbs().maxCoeff() / terms});
        } else {
            error = std::max(error, (next.traction.rowwise().norm() - bound).maxCoeff() / bound.maxCoeff());
        }
        outcome_.error = std::max(outcome_.error, error);
        outcome_.value = -step.force.lateral;
    }

    /// Whether the mesh could follow.
    bool step(const PatchScene::Later& later) {
        const double a = axes_.half_length, da = std::min(later.dq, a / 2) * later.growth;
        const Axes ended{a + da, axes_.half_width * ((a + da) / a) / later.narrowing};
        const auto load = load_of(later.load, ended);
        const auto step = run_.try_advance({later.dq, later.creepage, load});
        const bool covered = !system_.shapes() || system_.shapes()->covers(ended.half_length / ended.half_width);
        if (!covered || std::abs(da) >= later.dq) {
            if (step.status != rollbem::Status::needs_fixed_mesh) outcome_.told = "not refused";
            return false;
        }
        const VectorXd before = whole_.G() * stacked(run_.now());
        const double db = ended.half_width - axes_.half_width;
        axes_ = ended;
        whole_ = equations_at(axes_);
        if (later.load == 0 && step.status == rollbem::Status::ok && run_.next().traction.isZero(0)) return true;
        const VectorXd p = stacked(run_.next()), rolled = later.dq * rigid(later.creepage),
                       change = whole_.G() * p - before;
        const VectorXd travelled =
            (later.dq + da * system_.elements().x.replicate(2, 1)) * (whole_.G_prime() * p).array();
        const VectorXd slope = travelled + db * stretched(p);
        const VectorXd slip = scene_.euler ? VectorXd(rolled - slope + change) : VectorXd();
        check(step, load.normal_pressure, slip, size(rolled) + size(slope) + size(change));
        return true;
    }

    using Model = rollbem::FrictionModel;

    const PatchScene& scene_;
    rollbem::PatchContact contact_;
    rollbem::PatchMesh<double> mesh_;
    std::optional<rollbem::PatchShapes<double>> shapes_;
    rollbem::ElementSystem<double, 2> system_;
    rollbem::ArrayX<double> pressure_;
    Model model_;
    Axes axes_;
    rollbem::RollingSystem<double> whole_;
    rollbem::Run<Model> run_;
    Outcome outcome_{.reference = 0, .error = 0, .residual = 0, .bound = 1e-9};
};

}  // namespace

Case patch_scene(std::uint64_t seed) {
    return {PatchScene(seed).name(seed), "violation of the law of friction", [=] {
                const PatchScene scene(seed);
                return RollingPatch(scene)();
            }};
}

}  // namespace extremes
