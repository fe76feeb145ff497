// Steps in time: integrators, the input of a step, and Run, a model with the data of one contact in a time loop.
#pragma once

#include <utility>

#include "../scene/rigid_motion.hpp"
#include "../status.hpp"
#include "detail/given_load.hpp"

namespace rollbem {

/// The time integration of a step. With w = dq G^-1 G', each method replaces e^w by a rational function r(w) with one
/// real pole that tends to 0 for w -> -inf (L-stable): stiff modes, which a nearly singular G has, decay instead of
/// ringing.
enum class Integrator {
    implicit_euler,      ///< first order
    sdirk2,              ///< second order, two stages, gamma = 1 - 1/sqrt(2) (Alexander 1977); the default
    matrix_exponential,  ///< e^w to rounding: exact in dq for constant (zero-order hold) or linear creepage
                         ///< (first-order hold); in full adhesion only
};

constexpr const char* name(Integrator integrator) {
    switch (integrator) {
        case Integrator::implicit_euler: return "implicit_euler";
        case Integrator::sdirk2: return "sdirk2";
        case Integrator::matrix_exponential: break;
    }
    return "matrix_exponential";
}

/// One step: the distance rolled, the motion of the bodies meanwhile, and the load at its end. The load varies linearly
/// from the state's load; without one the state's load remains. A model's `Load` is a NormalLoad with friction, the
/// half-length or the semi-axes in full adhesion. Written in braces:
///
///     model.advance(now, {dq, creepage}, next, workspace);
///     model.advance(now, {{dq, duration}, Motion::linear(start, end), load}, next, workspace);
///     model.advance(now, {0, Motion::shift(shift)}, next, workspace);  // without rolling
///
/// Steady rolling takes the motion at the end of such a step, its load, and its speed if friction depends on slip:
///
///     model.steady(now, {.motion = creepage}, next, workspace);
///     model.steady(now, {Travel::at_speed(V), creepage, load}, next, workspace);
template <class Motion_, class Load_>
struct RollingStep {
    using Motion = Motion_;
    using Load = Load_;

    Travel travel{};
    Motion motion;
    Load load{};
};

/// One contact in a time loop, by any of the models. A step becomes the present state if its status is ok; otherwise
/// the present state stays as it is. try_advance() and try_steady() leave the result in next(), until accept() makes it
/// the present state: a loop that rejects steps calls accept() when it is sure. Steps neither throw nor allocate. A Run
/// keeps a reference to the model, which several runs, and threads, may share.
///
/// \code
/// #include <rollbem/patch.hpp>
///
/// int main() {
///     using namespace rollbem;
///     const PatchContact contact({6e-3, 4e-3, 8.2e10, 0.28});  // a, b [m], G [Pa], nu
///     const PatchMesh<double> mesh = patch_mesh(contact, 8, 8);
///     const auto system = rolling_system(mesh, NodeDifference{Nodes::chebyshev}, HalfSpace<double>(0.28));
///     const FrictionModel model(contact, system, unchecked, {0.3, hertz_pressures(contact, mesh, 80e3)});
///     Run run(model);
///     for (int k = 0; k < 10; ++k) {
///         const FrictionStep step = run.advance({1e-3, {1e-3, 5e-4, 0.1}});  // rolls by 1 mm; spin 0.1 1/m
///         if (step.status != Status::ok || !(step.force.longitudinal < 0)) return 1;
///     }
/// }
/// \endcode
template <class Model_>
class Run {
public:
    using Model = Model_;
    using State = typename Model::State;
    using Step = typename Model::Step;
    using Workspace = typename Model::Workspace;
    using RollingStep = typename Model::RollingStep;

    /// Starts from rest, or from a state of the model.
    explicit Run(const Model& model) : Run(model, model.at_rest()) {}
    Run(const Model& model, State from)
        : model_(&model), now_(std::move(from)), next_(model.at_rest()), workspace_(model.workspace()) {}
    explicit Run(Model&&) = delete;
    Run(Model&&, State) = delete;

    const Model& model() const { return *model_; }
    const State& now() const { return now_; }
    State& now() { return now_; }  ///< to restore a state
    const State& next() const { return next_; }
    const Workspace& workspace() const { return workspace_; }

    Step advance(const RollingStep& step) noexcept { return commit(try_advance(step)); }
    Step try_advance(const RollingStep& step) noexcept { return model_->advance(now_, step, next_, workspace_); }
    Step steady(const RollingStep& step) noexcept { return commit(try_steady(step)); }
    Step try_steady(const RollingStep& step) noexcept { return model_->steady(now_, step, next_, workspace_); }

    void accept() noexcept { std::swap(now_, next_); }

private:
    Step commit(const Step& step) noexcept {
        if (step.status == Status::ok) accept();
        return step;
    }

    const Model* model_;
    State now_, next_;
    Workspace workspace_;
};

}  // namespace rollbem
