// Steady rolling with Coulomb friction under longitudinal and lateral creepage: s/V = xi - G' p in both directions, |p|
// <= mu p_n and slip against traction as vectors. One model for all creepages; each point starts from the one before.
#pragma once

#include "../detail/language.hpp"

#include <array>
#include <cstdint>
#include <optional>
#include <string>
#include <utility>

#include "../assembly/influence.hpp"
#include "../assembly/rolling_system.hpp"
#include "../detail/finite.hpp"
#include "../discretisation/mesh.hpp"
#include "../discretisation/scheme.hpp"
#include "../elasticity/line_kernel.hpp"
#include "../scene/contact.hpp"
#include "../scene/creepage.hpp"
#include "combined_state.hpp"
#include "combined_workspace.hpp"
#include "detail/combined_core.hpp"
#include "law.hpp"

namespace rollbem {

/// Steady rolling of one contact, mesh, scheme and law of friction at any creepage vector. Const and free of caches:
/// threads may share it. Positive creepages give negative forces. In full sliding the force opposes the creepage
/// exactly, otherwise only approximately, because the bodies are more compliant across the rolling direction.
///
/// The scheme must converge, which nothing here checks; see SteadyFrictionModel, which is for one direction of creepage
/// and costs less.
///
///     const SteadyCombinedModel<double> model(contact, mesh, scheme, StripKernel<double>::longitudinal(contact),
///                                             StripKernel<double>::lateral(contact), friction);
///     CombinedFrictionWorkspace<double> workspace = model.workspace();
///     CombinedFrictionState<double> now = model.at_rest(), next = now;
///     for (const Creepage<double>& creepage : curve) {
///         const CombinedFrictionStep<double> point = model.solve(now, creepage, next, workspace);
///         std::swap(now, next);
///     }
template <class Scalar_ = double>
class SteadyCombinedModel {
public:
    using Scalar = Scalar_;
    using State = CombinedFrictionState<Scalar>;
    using Step = CombinedFrictionStep<Scalar>;
    using Workspace = CombinedFrictionWorkspace<Scalar>;

    /// The kernels of both directions. Throws std::invalid_argument as assemble_G_prime does, if the law is out of the
    /// range that CoulombFriction states, and if the half-width of a kernel differs from the contact's.
    template <RollingScheme<Scalar> Scheme, LineKernel Kernel>
    SteadyCombinedModel(const Contact<Scalar>& contact, const Mesh<Scalar>& mesh, const Scheme& scheme,
                        const Kernel& longitudinal, const Kernel& lateral, const CoulombFriction<Scalar>& friction)
        : SteadyCombinedModel(Checked{}, contact,
                              {assemble_G_prime(mesh, scheme, longitudinal), assemble_G_prime(mesh, scheme, lateral)},
                              unknown_widths(mesh, scheme), detail::equation_points(mesh, scheme),
                              detail::checked_friction("SteadyCombinedModel", friction, mesh.size(),
                                                       unknown_count(scheme, mesh))) {
        detail::require_same_aspect("SteadyCombinedModel", contact, detail::aspect_of<Scalar>(longitudinal));
        detail::require_same_aspect("SteadyCombinedModel", contact, detail::aspect_of<Scalar>(lateral));
    }

    /// From ready G' of both directions (in units of 1/G) and the widths of the elements (in units of a); the law has
    /// as many pressures. Throws std::invalid_argument as above, and if sizes differ, an entry is not finite or a width
    /// is not positive.
    SteadyCombinedModel(const Contact<Scalar>& contact, MatrixX<Scalar> longitudinal_G_prime,
                        MatrixX<Scalar> lateral_G_prime, const ArrayX<Scalar>& widths,
                        const CoulombFriction<Scalar>& friction)
        : SteadyCombinedModel(Checked{}, contact, {std::move(longitudinal_G_prime), std::move(lateral_G_prime)}, widths,
                              std::nullopt,
                              detail::checked_friction("SteadyCombinedModel", friction, widths.size(), widths.size())) {
    }

    Eigen::Index size() const { return core_.size(); }                 ///< number of unknown elements
    std::uint64_t fingerprint() const { return core_.fingerprint(); }  ///< of the G', widths, contact and pressures

    /// No traction anywhere, everything sticks: the start of a first solution.
    State at_rest() const { return core_.at_rest(); }
    Workspace workspace() const { return Workspace(size()); }

    /// The solution at a creepage, sought from the zones and tractions of `from` and under its pressures; its
    /// half-length must be the contact's. `to` must be another state of as many elements; it is left unchanged if the
    /// status is wrong_state, invalid_load or needs_fixed_mesh or the creepage is not finite. No allocation.
    Step solve(const State& from, const Creepage<Scalar>& creepage, State& to, Workspace& workspace) const noexcept {
        const StepStatus possible = check(from, to, workspace);
        if (possible != StepStatus::ok) return Core::failed(possible);
        detail::ConstantCombinedStages<Scalar> stages;
        return solve(stages, from, creepage, to, workspace);
    }

private:
    using Core = detail::CombinedCore<Scalar>;
    template <class, class>
    friend class SteadyCombinedFallingModel;

    StepStatus check(const State& from, const State& to, const Workspace& workspace) const noexcept {
        const StepStatus possible = core_.check(from, to, workspace);
        if (possible != StepStatus::ok) return possible;
        return from.half_length == core_.half_length() ? StepStatus::ok : StepStatus::needs_fixed_mesh;
    }

    template <class Stages>
    Step solve(Stages& stages, const State& from, const Creepage<Scalar>& creepage, State& to,
               Workspace& workspace) const noexcept {
        return core_.solve_steady(stages, from, creepage, G_prime_[0], G_prime_[1],
                                  {from.normal_pressure, from.half_length}, to, workspace);
    }

    struct Checked {};  // distinguishes the constructor from the one whose law may be given in braces

    SteadyCombinedModel(Checked, const Contact<Scalar>& contact, std::array<MatrixX<Scalar>, 2> G_prime,
                        const ArrayX<Scalar>& widths, const std::optional<ArrayX<Scalar>>& points,
                        CoulombFriction<Scalar> friction)
        : core_(contact, widths, points, std::move(friction), fingerprint_of(G_prime, widths)),
          G_prime_(std::move(G_prime)) {
        const Eigen::Index n = size();
        require_entries("longitudinal G_prime", G_prime_[0], n);
        require_entries("lateral G_prime", G_prime_[1], n);
        for (Eigen::Index i = 0; i < n; ++i) {
            detail::require(detail::is_finite(widths[i]) && widths[i] > 0, "SteadyCombinedModel", "width", widths[i],
                            "be positive and finite");
        }
    }

    static void require_entries(const char* name, const MatrixX<Scalar>& matrix, Eigen::Index n) {
        const std::string of = std::string(" of ") + name;
        detail::require(matrix.rows() == n, "SteadyCombinedModel", ("number of rows" + of).c_str(), matrix.rows(),
                        "equal the number of widths");
        detail::require(matrix.cols() == n, "SteadyCombinedModel", ("number of columns" + of).c_str(), matrix.cols(),
                        "equal the number of widths");
        detail::require_finite("SteadyCombinedModel", name, matrix);
    }

    static std::uint64_t fingerprint_of(const std::array<MatrixX<Scalar>, 2>& G_prime, const ArrayX<Scalar>& widths) {
        detail::Fingerprint fingerprint;
        for (const MatrixX<Scalar>& matrix : G_prime) fingerprint.add(matrix);
        fingerprint.add(widths);
        return fingerprint.value();
    }

    Core core_;
    std::array<MatrixX<Scalar>, 2> G_prime_;
};

}  // namespace rollbem
