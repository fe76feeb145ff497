// Force elements of tests/laws: steps and steady rolling in full adhesion and with friction, on lines and patches.
#pragma once

#include <cmath>
#include <cstddef>
#include <functional>
#include <initializer_list>
#include <memory>
#include <string>
#include <utility>
#include <vector>

#include <rollbem/line.hpp>
#include <rollbem/patch.hpp>

#include "friction/same_bits.hpp"
#include "laws/force_element.hpp"

namespace laws {

namespace steps_detail {

constexpr double a_0 = 5e-3, G = 8e10, nu = 0.28, mu = 0.3, V = 20, peak = 1e9;
constexpr double slides = 2 * (1 - nu) * mu * peak / G;  // the creepage of full sliding on a line
constexpr NodeDifference chebyshev{Nodes::chebyshev};
using Motion = RigidMotion<Creepage>;

inline Eigen::Vector3d vector(const TangentialForce& force) {
    return {force.longitudinal, force.lateral, force.moment};
}
inline double vector(double force) { return force; }
inline Eigen::Matrix3d matrix(const TangentialForce::ByCreepage& tangent) {
    Eigen::Matrix3d columns;
    columns << vector(tangent.by_longitudinal), vector(tangent.by_lateral), vector(tangent.by_spin);
    return columns;
}

/// A creepage of about `size` in a random direction.
inline Creepage drawn_creepage(Draw& draw, double size, double c) {
    const double x = draw.normal(), y = draw.normal(), z = draw.normal(),
                 unit = size / std::sqrt(x * x + y * y + z * z);
    return {unit * x, unit * y, unit * z / c};
}
/// Motion of one of three kinds in a step of `dq`.
template <class Value>
RigidMotion<Value> motion_of(int kind, const Value& start, const Value& end, const Value& rolled) {
    if (kind == 2) return RigidMotion<Value>::shift(rolled);
    return kind == 1 ? RigidMotion<Value>::linear(start, end) : RigidMotion<Value>(end);
}
inline double times(double dq, double of) { return dq * of; }
inline Creepage times(double dq, const Creepage& of) { return {dq * of.longitudinal, dq * of.lateral, dq * of.spin}; }

/// Asks for a step of each kind of motion.
template <class Scene, class Step>
void ask_each_kind(Scene& scene, const Numbers& x, const Step& step) {
    for (int k = 0; k < 3; ++k) {
        step(scene, x);
        scene.kind = (scene.kind + 1) % 3;
    }
}

inline const PatchShapes<double>& shapes() {
    static const PatchShapes<double> made(4, 3, chebyshev, HalfSpace<double>(nu),
                                          {.least = 0.4, .largest = 2.5, .factor = 1.25});
    return made;
}

}  // namespace steps_detail

/// What can be stepped in full adhesion.
enum class Stuck { elements, states, strip, patch };

/// The state, memory and kind of motion of an adhesion model in one scene.
template <int directions>
struct StuckScene {
    using Model = AdhesionModel<directions>;
    Model model;
    typename Model::State from = model.at_rest(), to = from, mark = from;
    typename Model::Workspace workspace = model.workspace();
    int kind = 0;
    typename Model::Value start{};  ///< the creepage at the start of the step
    typename Model::State* target = &to;
};

namespace steps_detail {

inline AdhesionModel<1> stuck_line(Stuck what, Integrator integrator, double a, double modulus) {
    const Contact contact({.half_length = a, .half_width = 10 * a, .shear_modulus = modulus, .poisson_ratio = nu});
    const auto plane = PlaneKernel<double>::longitudinal(contact);
    if (what == Stuck::states) return {contact, rolling_system(Chebyshev{6}, plane), unchecked, integrator};
    if (what == Stuck::elements)
        return {contact, rolling_system(cosine_mesh(9), chebyshev, plane), unchecked, integrator};
    return {contact, rolling_system(cosine_mesh(9), chebyshev, StripKernel<double>::longitudinal(contact)), unchecked,
            integrator};
}
inline AdhesionModel<2> stuck_patch(Integrator integrator, double a, double modulus) {
    const PatchContact contact(
        {.half_length = a, .half_width = a / 1.3, .shear_modulus = modulus, .poisson_ratio = nu});
    return {contact, shapes().system(1.3), unchecked, integrator};
}

}  // namespace steps_detail

/// Creepages, semi-axes at the end of the step (of models that can breathe), the distance dq, a and G of the model.
template <int directions>
ForceElement adhesion_step(Stuck what, Integrator integrator) {
    using namespace steps_detail;
    using Scene = StuckScene<directions>;
    constexpr Eigen::Index forces = directions == 1 ? 1 : 3;
    const auto made = [what, integrator](double a, double modulus) {
        if constexpr (directions == 1) return Scene{stuck_line(what, integrator, a, modulus)};
        if constexpr (directions == 2) return Scene{stuck_patch(integrator, a, modulus)};
    };
    const auto scene = std::make_shared<Scene>(made(a_0, G));
    const bool breathes = scene->model.can_breathe();
    const Eigen::Index n = scene->model.size(), axes = breathes ? directions : 0, own = forces + axes;
    ForceElement result;
    result.name = std::string("adhesion by ") + name(integrator) + ", " + std::to_string(n) + " unknowns";
    result.inputs = {{1e-3}, {1e-3}, {1e-3 / a_0, -1}};
    result.inputs.resize(std::size_t(forces));
    for (Eigen::Index k = 0; k < axes; ++k) result.inputs.push_back({a_0, 1});
    for (const Quantity& of : {Quantity{a_0, 1}, Quantity{a_0, 1}, Quantity{G, 0, 1}}) result.inputs.push_back(of);
    const double force = 1e-3 * G * a_0 * a_0 * (directions == 1 ? 40 : 4);
    result.values = {{force, 2, 1}, {force, 2, 1}, {force * a_0, 3, 1}};
    result.values.resize(std::size_t(forces));
    for (Eigen::Index i = 0; i < n; ++i) result.values.push_back({1e-3 * G, 0, 1});

    const auto creepage = [](const Numbers& x) {
        if constexpr (directions == 1) return x[0];
        if constexpr (directions == 2) return Creepage{x[0], x[1], x[2]};
    };
    // a step of one scene, with all lengths and stresses in its own units
    const auto step = [=](Scene& on, const Numbers& x) {
        const double dq = x[own];
        const auto end = creepage(x);
        typename Scene::Model::RollingStep rolled{{dq}, motion_of(on.kind, on.start, end, times(dq, end))};
        if (breathes) {
            if constexpr (directions == 1) rolled.load = x[forces];
            if constexpr (directions == 2) rolled.load = SemiAxes{x[forces], x[forces + 1]};
        }
        on.to = on.mark;
        const auto found = on.model.advance(on.from, rolled, *on.target, on.workspace);
        Answer answer{Numbers(forces + n), Tangent(forces, own), found.status};
        answer.values.setConstant(nan);
        answer.values.head(forces) << vector(found.force);
        const double per = on.kind == 2 ? dq : 1;
        if constexpr (directions == 1) answer.tangent(0, 0) = per * found.tangent;
        if constexpr (directions == 2) answer.tangent.leftCols(3) = per * matrix(found.tangent);
        if (axes > 0) answer.tangent.col(forces) << vector(found.tangent_by_half_length);
        if (axes > 1) answer.tangent.col(forces + 1) << vector(found.tangent_by_half_width);
        if (found.status == Status::ok) {
            answer.values.tail(n) = on.target->traction;
        } else {
            answer.keeps_target = on.target != &on.to || on.to.traction == on.mark.traction;
        }
        return answer;
    };
    result.draw = [=](Draw& draw) {
        const auto any = [&] {
            Numbers x(own + 3);
            const Creepage of = drawn_creepage(draw, 1e-3, a_0);
            const double dq = a_0 * (draw.one_in(2) ? 0.25 : draw.decades(-1, 0.3));
            x.head(forces) = Eigen::Vector3d(of.longitudinal, of.lateral, of.spin).head(forces);
            for (Eigen::Index k = 0; k < axes; ++k) {
                const double now = k == 0 ? scene->from.half_length : scene->from.half_width;
                x[forces + k] = now + draw.uniform(-0.2, 0.2) * dq * (k == 0 ? 1 : 0.1);
            }
            x.tail(3) << dq, a_0, G;
            return x;
        };
        scene->mark.traction.setConstant(7);
        scene->target = &scene->to;
        scene->from = scene->model.at_rest();
        scene->workspace = scene->model.workspace();
        for (int k = draw.integer(4); k >= 0; --k) {
            scene->kind = draw.integer(3);
            const Numbers x = any();
            if (step(*scene, x).status == Status::ok) std::swap(scene->from, scene->to);
            scene->start = creepage(x);
        }
        return any();
    };
    result.answer = [=](const Numbers& x) {
        const double length = x[own + 1], modulus = x[own + 2];
        const bool numbers = !detail::is_nan(length) && !detail::is_nan(modulus);  // NaN equals all with -ffast-math
        if (numbers && length == a_0 && modulus == G) return step(*scene, x);
        Scene other = made(length, modulus);  // the same scene in other units
        other.target = &other.to;
        other.kind = scene->kind;
        other.start = scene->start;
        if constexpr (directions == 2) other.start.spin *= a_0 / length;
        other.from.traction = modulus / G * scene->from.traction;
        other.from.half_length = length / a_0 * scene->from.half_length;
        other.from.half_width = length / a_0 * scene->from.half_width;
        other.from.distance = length / a_0 * scene->from.distance;
        return step(other, x);
    };
    result.forget = [scene] { scene->workspace = scene->model.workspace(); };
    result.distract = [=](const Numbers& x) { ask_each_kind(*scene, x, step); };
    result.refusals = {{std::size_t(own), {-1, nan, infinite, -infinite}, Status::invalid_step}};
    for (Eigen::Index j = 0; j < forces; ++j) {
        result.refusals.push_back({std::size_t(j), {nan, infinite, -infinite}, Status::not_finite});
    }
    for (Eigen::Index k = 0; k < axes; ++k) {
        result.refusals.push_back({std::size_t(forces + k), {0, -1, nan, infinite}, Status::invalid_load});
    }
    if (axes > 0) result.refusals.push_back({std::size_t(forces), {20 * a_0, 1e-9 * a_0}, Status::needs_fixed_mesh});
    auto& from = scene->from;
    const auto spoilt = [&](const char* words, const std::function<void()>& spoil) {
        result.spoilt.push_back({words, spoil, Status::wrong_state});
    };
    spoilt("no state", [&from] { from = {}; });
    spoilt("another system", [&from] { from.system += 1; });
    spoilt("too few tractions", [&from] { from.traction.conservativeResize(from.traction.size() - 1); });
    spoilt("the state that is written", [scene] { scene->target = &scene->from; });
    spoilt("a target that is too small",
           [scene] { scene->mark.traction.conservativeResize(scene->to.traction.size() - 1); });
    spoilt("memory of another size",
           [scene] { scene->workspace = typename AdhesionModel<directions>::Workspace(scene->model.size() + 1); });
    for (const double bad : {0.0, -1.0, nan, infinite}) {
        spoilt("a half-length that is none", [&from, bad] { from.half_length = bad; });
        if (directions == 2) spoilt("a half-width that is none", [&from, bad] { from.half_width = bad; });
    }
    return result;
}

/// What rolls with friction, and how: `alone` is steady rolling of a system without G.
enum class Rolling { one, both, patch };
enum class By { alone, steady, implicit_euler, sdirk2 };
enum class Law { constant, falling, remembering };

/// The model, state and memory of friction in one scene.
struct SlippingScene {
    FrictionModel model;
    FrictionState from = model.at_rest(), to = from, mark = from;
    FrictionModel::Workspace workspace = model.workspace();
    NormalLoad load{}, under{};  ///< whose pressures are factored, and of the step
    ElementVectors rows{};       ///< rigid slip of each element, if any
    Creepage start{};
    int kind = 0;
    FrictionState* target = &to;
};

namespace steps_detail {

/// The contact of a kind of friction: what makes forces and creepages dimensionless, and models of it.
struct Body {
    Rolling what;
    double a_over_b = 1;

    bool is_patch() const { return what == Rolling::patch; }
    double half_width() const { return is_patch() ? a_0 / a_over_b : 10 * a_0; }
    double c() const { return is_patch() ? std::sqrt(a_0 * half_width()) : a_0; }
    double load() const { return is_patch() ? 8e4 / a_over_b : peak * a_0 * 20 * a_0 * 1.57; }
    double creepage() const { return is_patch() ? mu * load() / (4 * G * c() * c()) : slides; }

    FrictionModel model(By by, Law law, bool hole, double factor = 1) const {
        const ExponentialFall falling{mu, law == Law::remembering ? 0.02 : 0.2, V * creepage()};
        const Friction::Memory memory{law == Law::remembering ? a_0 * creepage() : 0, 0.01 * V * creepage()};
        const auto friction = [&](ArrayX<double> pressure) {
            if (hole) pressure[1] = 0;
            return law == Law::constant ? Friction{mu, factor * pressure}
                                        : Friction{falling, factor * pressure, memory};
        };
        const Integrator integrator = by == By::implicit_euler ? Integrator::implicit_euler : Integrator::sdirk2;
        if (is_patch()) {
            const PatchContact contact(
                {.half_length = a_0, .half_width = half_width(), .shear_modulus = G, .poisson_ratio = nu});
            const Friction of = friction(hertz_pressures(contact, patch_mesh(contact, 4, 3), load()));
            if (by != By::alone) return {contact, shapes().system(a_over_b), unchecked, of, integrator};
            return {contact, steady_system(patch_mesh(contact, 4, 3), chebyshev, HalfSpace<double>(nu)), of};
        }
        const Contact contact({.half_length = a_0, .half_width = 10 * a_0, .shear_modulus = G, .poisson_ratio = nu});
        const Mesh<double> mesh = cosine_mesh(8);
        const Friction of = friction(peak * mean_hertz_pressure(mesh));
        const auto system = [&](const PlaneKernel<double>& kernel) {
            return by == By::alone ? steady_system(mesh, chebyshev, kernel) : rolling_system(mesh, chebyshev, kernel);
        };
        const auto along = system(PlaneKernel<double>::longitudinal(contact));
        if (what == Rolling::one) return {contact, along, unchecked, of, integrator};
        const ElementSystem both(along, system(PlaneKernel<double>::lateral(contact)));
        return {contact, both, unchecked, of, integrator};
    }
};

/// The table of what no step or solution starts from.
inline void add_spoilt_states(const std::shared_ptr<SlippingScene>& scene, bool falls, bool in_time, ForceElement& to) {
    const auto from = [scene]() -> FrictionState& { return scene->from; };
    const auto add = [&](Status status, const char* what, const std::function<void()>& spoil) {
        to.spoilt.push_back({what, spoil, status});
    };
    using enum Status;
    add(wrong_state, "no state", [=] { from() = FrictionState{}; });
    add(wrong_state, "another system", [=] { from().system += 1; });
    add(wrong_state, "a zone less", [=] { from().zones.pop_back(); });
    add(wrong_state, "a traction less", [=] { from().traction.conservativeResize(from().traction.rows() - 1, 2); });
    add(wrong_state, "a pressure less", [=] { from().normal_pressure.conservativeResize(scene->model.size() - 1); });
    add(wrong_state, "too many coefficients", [=] { from().friction_coefficient.setConstant(99, 0.3); });
    add(wrong_state, "too few coefficients of a stage", [=] { from().solver.stage_coefficient.setConstant(2, 0.3); });
    add(wrong_state, "the state that is written", [=] { scene->target = &scene->from; });
    add(wrong_state, "a target without zones", [=] { scene->mark.zones.pop_back(); });
    add(wrong_state, "memory of another law", [=] {
        scene->workspace =
            Body{Rolling::one}.model(By::sdirk2, falls ? Law::constant : Law::falling, false).workspace();
    });
    if (scene->model.directions() == 2) {
        add(wrong_state, "too few unrotated tractions", [=] { from().unrotated_traction.setConstant(2, 2, 1); });
    }
    for (const double bad : {-0.1, nan, infinite}) {
        if (!falls) break;
        add(wrong_state, "a coefficient that is none", [=] { from().friction_coefficient[1] = bad; });
        add(wrong_state, "a coefficient of a stage that is none",
            [=] { from().solver.stage_coefficient.setConstant(scene->model.size(), bad); });
    }
    for (const double bad : {-1e-300, nan, infinite}) {
        add(invalid_load, "a pressure that is none", [=] { from().normal_pressure[1] = bad; });
        add(invalid_load, "a half-length that is none", [=] { from().half_length = bad; });
        if (!in_time) continue;
        add(invalid_load, "a given pressure that is none", [=] { scene->load.normal_pressure[1] = bad; });
    }
    if (!in_time) return;
    add(invalid_load, "a given pressure less",
        [=] { scene->load.normal_pressure.conservativeResize(scene->model.size() - 1); });
    add(invalid_load, "a rate less", [=] { scene->under.pressure_rate.conservativeResize(scene->model.size() - 1); });
    add(invalid_load, "a rate that is none", [=] { scene->under.pressure_rate[1] = nan; });
}

}  // namespace steps_detail

/// Creepages; for steps a factor of the pressures, the semi-axes and the distance dq; the duration where it matters.
/// Values are the forces, and tractions and coefficients of the state. A `plain` element has neither holes in the
/// pressures nor rigid slip of its own, and starts from rest.
inline ForceElement friction(Rolling what, By by, Law law, bool plain = false) {
    using namespace steps_detail;
    const bool in_time = by == By::implicit_euler || by == By::sdirk2, falls = law != Law::constant;
    const Eigen::Index forces = what == Rolling::one ? 1 : 3, axes = what == Rolling::patch ? 2 : 1,
                       own = forces + (in_time ? 1 + axes : 0),
                       travel = falls     ? 2
                                : in_time ? 1
                                          : 0;
    const auto body = std::make_shared<Body>(Body{what});
    const auto scene = std::make_shared<SlippingScene>(SlippingScene{body->model(by, law, false)});
    const Eigen::Index n = scene->model.size(), columns = forces == 1 ? 1 : 2;
    const double force = mu * body->load(), c = body->c();
    ForceElement result;
    result.name = std::string(what == Rolling::patch ? "a patch" : "a line") + ", directions " +
                  std::to_string(scene->model.directions()) + ", law " + std::to_string(int(law)) + ", by " +
                  std::to_string(int(by));
    const auto add = [](std::vector<Quantity>& to, std::initializer_list<double> of, Eigen::Index count) {
        for (Eigen::Index k = 0; k < count; ++k) to.push_back({of.begin()[k]});
    };
    add(result.inputs, {body->creepage(), body->creepage(), body->creepage() / c}, forces);
    if (in_time) add(result.inputs, {1, a_0, body->half_width()}, 1 + axes);
    add(result.inputs, {a_0, a_0 / V}, travel);
    add(result.values, {force, force, force * c}, forces);
    for (Eigen::Index i = 0; i < (columns + 1) * n; ++i) result.values.push_back({i < columns * n ? mu * peak : mu});
    result.motions = std::size_t(forces);

    const auto step = [=](SlippingScene& on, const Numbers& x) {
        const Creepage end = forces == 1 ? Creepage{x[0]} : Creepage{x[0], x[1], x[2]};
        const double dq = travel > 0 ? x[own] : 1;
        auto motion = motion_of(on.kind, on.start, end, times(dq, end));
        if (on.rows.size() > 0) motion = motion.with_rows(on.rows);
        FrictionModel::RollingStep rolled{{dq, falls ? x[own + 1] : nan}, motion};
        if (in_time) {
            on.under.normal_pressure = x[forces] * on.load.normal_pressure;
            on.under.half_length = x[forces + 1];
            if (axes == 2) on.under.half_width = x[forces + 2];
            rolled.load = on.under;
        }
        on.to = on.mark;
        const double worked = on.workspace.slip_work().sum();
        const FrictionStep found = in_time ? on.model.advance(on.from, rolled, *on.target, on.workspace)
                                           : on.model.steady(on.from, rolled, *on.target, on.workspace);
        Answer answer{Numbers(forces + (columns + 1) * n), Tangent(forces, own), found.status};
        answer.values.setConstant(nan);
        answer.values.head(forces) = vector(found.force).head(forces);
        answer.tangent.leftCols(forces) = (on.kind == 2 ? dq : 1) * matrix(found.tangent).topLeftCorner(forces, forces);
        Eigen::Matrix3d by_load;
        by_load << vector(found.tangent_by_load), vector(found.tangent_by_half_length),
            vector(found.tangent_by_half_width);
        answer.tangent.rightCols(own - forces) = by_load.topLeftCorner(forces, own - forces);
        if (found.status != Status::ok) {
            answer.keeps_target =
                on.target != &on.to || (same_bits::same(on.to, on.mark) && on.workspace.slip_work().sum() == worked);
            return answer;
        }
        for (const Zone zone : on.target->zones) answer.branch = 3 * answer.branch + std::size_t(int(zone) + 1);
        answer.values.segment(forces, columns * n) = on.target->traction.leftCols(columns).reshaped();
        answer.values.tail(n).setConstant(mu);
        if (falls) answer.values.tail(n) = on.target->friction_coefficient.matrix();
        return answer;
    };
    result.answer = [=](const Numbers& x) { return step(*scene, x); };
    result.draw = [=](Draw& draw) {
        SlippingScene& on = *scene;
        if (what == Rolling::patch && by != By::alone) body->a_over_b = draw.decades(-0.3, 0.3);
        on = SlippingScene{body->model(by, law, !plain && draw.one_in(3))};
        const ArrayX<double> pressure = on.from.normal_pressure;
        on.load = on.under = {pressure, a_0, pressure, on.from.half_width};
        on.target = &on.to;
        const double unit = body->creepage();
        if (!plain && draw.one_in(2)) {
            on.rows = 0.3 * unit * Eigen::MatrixX2d::NullaryExpr(n, 2, [&] { return draw.normal(); });
        }
        const auto any = [&] {
            Numbers x(own + travel);
            const Creepage of = drawn_creepage(draw, unit * draw.decades(-1, 0.6), body->c());
            const double dq = a_0 * draw.decades(-1.5, 0);
            x.head(forces) = Eigen::Vector3d(of.longitudinal, of.lateral, of.spin).head(forces);
            if (in_time) {
                const double a = a_0 + draw.uniform(-0.05, 0.05) * dq,
                             b = body->half_width() * draw.uniform(0.95, 1.05);
                x.segment(forces, 1 + axes) = Eigen::Vector3d(draw.uniform(0.8, 1.2), a, b).head(1 + axes);
            }
            x.tail(travel) = Eigen::Vector2d(dq, dq / V).head(travel);
            return x;
        };
        on.kind = 1;
        for (int k = in_time && !plain ? draw.integer(4) : -1; k >= 0; --k) {
            if (step(on, any()).status == Status::ok) std::swap(on.from, on.to);
        }
        on.kind = in_time ? draw.integer(3) : 0;
        on.start = in_time ? drawn_creepage(draw, unit, body->c()) : Creepage{};
        return any();
    };
    result.forget = [scene] { scene->workspace = scene->model.workspace(); };
    if (in_time) result.distract = [=](const Numbers& x) { ask_each_kind(*scene, x, step); };
    if (forces == 3) result.symmetries = {{"across the track", "+--", "+--"}, {"backward motion", "---", "---"}};
    for (Symmetry& symmetry : result.symmetries) {
        symmetry.inputs += std::string(std::size_t(own + travel - forces), '+');
    }

    const auto refuse = [&](Eigen::Index input, const std::vector<double>& bad, Status status) {
        result.refusals.push_back({std::size_t(input), bad, status});
    };
    for (Eigen::Index j = 0; j < forces; ++j) refuse(j, {nan, infinite, -infinite}, Status::not_finite);
    if (in_time) {
        refuse(forces, {-1, nan, infinite}, Status::invalid_load);
        refuse(forces + 1, {0, -1e-300, nan, infinite}, Status::invalid_load);
        refuse(forces + 1, {20 * a_0, 1e-9 * a_0}, Status::needs_fixed_mesh);
        if (axes == 2) refuse(forces + 2, {-1, nan, infinite}, Status::invalid_load);
    }
    if (travel > 0) refuse(own, {-1, nan, infinite}, Status::invalid_step);
    if (travel > 1) refuse(own + 1, {0, -1, nan, infinite}, Status::invalid_step);
    add_spoilt_states(scene, falls, in_time, result);
    return result;
}

}  // namespace laws
