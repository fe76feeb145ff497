#include "transient.hpp"

#include <algorithm>
#include <cstddef>
#include <memory>
#include <optional>
#include <stdexcept>
#include <string>
#include <utility>

#include <rollbem/adhesion/stability.hpp>
#include <rollbem/assembly/patch_shapes.hpp>
#include <rollbem/compiled/friction.hpp>
#include <rollbem/compiled/patch.hpp>
#include <rollbem/compiled/stability.hpp>
#include <rollbem/friction/model.hpp>
#include <rollbem/normal/hertz_patch_load.hpp>

#include "friction.hpp"
#include "load.hpp"
#include "plots.hpp"
#include "pressure.hpp"
#include "support/errors.hpp"
#include "support/non_steady.hpp"
#include "support/progress.hpp"
#include "support/runs.hpp"
#include "support/table.hpp"

namespace patch {

namespace {

using Contact = rollbem::PatchContact<double>;
using Model = rollbem::FrictionModel<rollbem::ConstantFriction<double>, 2>;
using rollbem::Integrator;
using rollbem::StepStatus;

const std::vector<std::string> transient_columns = study::joined(
    columns(), {"q_over_a", "load_ratio", "a_ratio", "b_ratio", "longitudinal_force", "lateral_force", "spin_moment",
                "stick_count", "slip_work", "creep_work", "status", "longitudinal", "lateral", "spin", "elastic_energy",
                "rounds", "complementarity_residual", "integrator", "nodes"});

/// A patch on the mesh of a whole run. Units as elsewhere: G = 1, mu N_0 = G a_0 b_0.
class Rolling {
public:
    /// Throws BadInput if modes of the patch grow.
    Rolling(const Patch& patch, const Pressure& pressure, const std::optional<Load>& load, Integrator integrator)
        : patch_(patch),
          load_(load),
          covered_(covered(patch, load)),
          mesh_(rollbem::patch_mesh(covered_, patch.mesh.along(), patch.across)),
          elements_(rollbem::rectangles(mesh_, covered_.half_length())),
          pressures_(load ? rollbem::hertz_pressures(covered_, mesh_, mu_N()) : pressure.on(patch)) {
        const rollbem::HalfSpace<double> kernel(patch.contact.poisson_ratio());
        const auto make = [&](rollbem::ElementSystem<double, 2> system, const rollbem::StabilityVerdict& verdict) {
            if (!verdict.stable()) {
                throw std::invalid_argument("modes must decay, whatever rounding does; take another --n or --strips");
            }
            model_.emplace(covered_, std::move(system), verdict, rollbem::Friction<>{1, pressures_}, integrator);
        };
        try {
            const auto [least, largest] = load ? load->shapes() : std::pair(1.0, 1.0);
            if (breathes() && largest > least * (1 + 1e-9)) {
                const double a_over_b = patch.contact.a_over_b(), margin = 1 + 1e-6;
                const rollbem::PatchShapes<double> shapes(
                    mesh_.along(), patch.across, patch.scheme, kernel,
                    {.least = a_over_b * least / margin, .largest = a_over_b * largest * margin});
                make(shapes.system(a_over_b), rollbem::judge_stability(shapes));
                return;
            }
            make(breathes() ? rollbem::breathing_system(covered_, mesh_, patch.scheme, kernel)
                            : rollbem::rolling_system(mesh_, patch.scheme, kernel),
                 rollbem::judge_stability(rollbem::patch_parts(mesh_, patch.scheme, kernel)));
        } catch (const std::invalid_argument& error) {
            throw study::BadInput(patch.label() + " cannot be stepped: " + error.what());
        }
    }

    bool breathes() const { return load_ && load_->breathing; }
    /// Whether the elements are small enough for the contact after a distance [a_0].
    bool resolves(double q) const {
        if (!load_ || breathes() || load_->at(q) == 0) return true;
        const rollbem::SemiAxes<double> least = rollbem::least_resolved(covered_, mesh_);
        const Contact contact = stretched(patch_.contact, load_->axes(q));
        return contact.half_length() >= least.half_length && contact.half_width() >= least.half_width;
    }

    const Patch& patch() const { return patch_; }
    const Model& model() const { return *model_; }
    double mu_N() const { return patch_.contact.half_length() * patch_.contact.half_width(); }
    /// Of works and energies.
    double work_unit() const { return mu_N() * mu_N() / patch_.contact.c(); }

    /// The normal load after a distance [a_0].
    rollbem::NormalLoad<double> load_at(double q) const {
        rollbem::NormalLoad<double> normal{pressures_, covered_.half_length(), {}, covered_.half_width()};
        if (!load_) return normal;
        const double ratio = load_->at(q);
        const AxisRatios axes = load_->axes(q);
        if (breathes()) {
            normal.normal_pressure *= ratio / (axes.a * axes.b);
            normal.half_length *= axes.a;
            normal.half_width *= axes.b;
        } else if (ratio > 0) {
            normal.normal_pressure =
                rollbem::hertz_pressures(stretched(patch_.contact, axes), elements_, ratio * mu_N());
        } else {
            normal.normal_pressure.setZero();
        }
        return normal;
    }

private:
    static Contact stretched(const Contact& contact, const AxisRatios& axes) {
        return Contact({.half_length = axes.a * contact.half_length(),
                        .half_width = axes.b * contact.half_width(),
                        .shear_modulus = contact.shear_modulus(),
                        .poisson_ratio = contact.poisson_ratio()});
    }
    static Contact covered(const Patch& patch, const std::optional<Load>& load) {
        return load && !load->breathing ? stretched(patch.contact, load->largest_axes()) : patch.contact;
    }

    const Patch& patch_;
    const std::optional<Load>& load_;
    Contact covered_;
    rollbem::PatchMesh<double> mesh_;
    std::vector<rollbem::Rectangle<double>> elements_;
    Eigen::ArrayXd pressures_;
    std::optional<Model> model_;
};

/// What all runs share.
struct Scene {
    CreepPoint point;
    std::optional<Load> load;
    bool from_steady;
    Integrator integrator;
    double dq;

    bool resolved() const { return !load || load->resolved(dq); }
};

/// One run, from rest or steady rolling under the first load.
class Run {
public:
    Run(const Scene& scene, const Rolling& rolling)
        : scene_(scene),
          rolling_(rolling),
          model_(rolling.model()),
          a_(rolling.patch().contact.half_length()),
          c_(rolling.patch().contact.c()),
          creepage_{scene.point.longitudinal, scene.point.lateral, scene.point.spin / c_},
          workspace_(model_.workspace()),
          now_(model_.at_rest()),
          next_(now_) {
        last_.force = {0, 0, 0};
        last_.status = StepStatus::ok;
        const rollbem::NormalLoad<double> first = rolling.load_at(0);
        now_.normal_pressure = first.normal_pressure;
        now_.half_length = first.half_length;
        now_.half_width = first.half_width;
        if (!scene.from_steady) return;
        last_ = model_.steady(now_, creepage_, next_, workspace_);
        if (last_.status == StepStatus::ok) {
            std::swap(now_, next_);
        } else {
            ended_ = study::why_ended(0, last_.status);
        }
    }

    /// Emits the rows of `range`, but steps from the start, as the state requires. Returns why the run ended before
    /// these rows did; nothing if it did not.
    std::string rows(study::RowRange range, const study::Emit& emit) {
        for (std::size_t k = 0; k < range.last; ++k) {
            const double end = double(k + 1) * scene_.dq;
            const bool over = !ended_.empty();
            rounds_ = 0;
            const auto failed = over ? std::nullopt
                                     : study::roll(double(k) * scene_.dq, end, scene_.load ? &*scene_.load : nullptr,
                                                   [this](double low, double high) { return step(low, high); });
            if (failed) ended_ = study::why_ended(*failed, last_.status);
            if (k >= range.first) emit(row(end, over));
        }
        return ended_;
    }

private:
    double power() const {
        const auto& [F_x, F_y, M_z] = last_.force;
        return -(F_x * creepage_.longitudinal + F_y * creepage_.lateral + M_z * creepage_.spin);
    }

    StepStatus step(double from, double to) {
        const double before = power();
        last_ = model_.advance(now_, a_ * (to - from), creepage_, rolling_.load_at(to), next_, workspace_);
        if (last_.status != StepStatus::ok) return last_.status;
        std::swap(now_, next_);
        rounds_ += last_.rounds;
        slip_work_ += last_.slip_work;
        // the mean of both ends; implicit Euler knows the end alone
        const double after = power();
        creep_work_ += a_ * (to - from) * (scene_.integrator == Integrator::sdirk2 ? (before + after) / 2 : after);
        return last_.status;
    }

    std::string status(bool over, bool resolved) const {
        if (over) return study::after_failure;
        if (!ended_.empty()) return name(last_.status);
        return resolved ? study::ok : study::unresolved;
    }

    /// `over`: the run ended before this row.
    study::Row row(double end, bool over) const {
        const bool resolved = scene_.resolved() && rolling_.resolves(end), valid = ended_.empty() && resolved;
        const auto if_valid = [&](auto value) { return valid ? study::Cell(value) : study::Cell(); };
        const AxisRatios axes = scene_.load ? scene_.load->axes(end) : AxisRatios{1, 1};
        const auto& [F_x, F_y, M_z] = last_.force;
        const double mu_N = rolling_.mu_N(), work = rolling_.work_unit();
        return study::row_of(
            {cells(rolling_.patch()),
             {end, scene_.load ? scene_.load->at(end) : 1, axes.a, axes.b},
             {if_valid(0 - F_x / mu_N), if_valid(0 - F_y / mu_N), if_valid(0 - M_z / c_ / mu_N)},
             {if_valid(last_.stick_count), if_valid(slip_work_ / work), if_valid(creep_work_ / work),
              status(over, resolved)},
             {scene_.point.longitudinal, scene_.point.lateral, scene_.point.spin},
             {if_valid(model_.elastic_energy(now_) / work), over ? study::Cell() : study::Cell(rounds_)},
             {over ? study::Cell() : study::Cell(last_.complementarity_residual), study::word(scene_.integrator),
              nodes_name(rolling_.patch())}});
    }

    const Scene& scene_;
    const Rolling& rolling_;
    const Model& model_;
    double a_, c_;
    rollbem::Creepage<double> creepage_;
    Model::Workspace workspace_;
    Model::State now_, next_;
    rollbem::FrictionStep<2> last_;  // also if it failed
    double slip_work_ = 0, creep_work_ = 0;
    int rounds_ = 0;     // of the steps of a row
    std::string ended_;  // why, if it did
};

}  // namespace

void add_transient_options(study::Options& options) {
    options.add_flag("transient",
                     "with one value of each creepage: roll in time, one row for each step; lengths over a, N, a and b "
                     "at load_ratio 1");
    study::add_run_options(
        options,
        " and, if known, a_ratio,b_ratio: N/N_0, a/a_0 and b/b_0 over the distance rolled in a_0, linear between its "
        "rows, which must cover the run (dimensionless); without them both are the cube root of load_ratio",
        "the mesh follows the ellipse, as it does by default where --load has a_ratio,b_ratio and the load never "
        "vanishes; --breathing=false: it covers the largest one");
}

void run_transient(const study::Options& options, const std::vector<Patch>& patches) {
    const Pressure pressure(options);
    const study::Steps steps = study::read_steps(options);
    const std::vector<CreepPoint> points = read_points(options, patches);
    if (points.size() != 1) {
        throw study::BadInput("--longitudinal, --lateral and --spin must have one value each with --transient");
    }
    const Scene scene{points.front(), read_load(options, double(steps.count) * steps.dq),
                      options.choice("from", {"rest", "steady"}) == "steady",
                      study::read_integrator(options, {Integrator::sdirk2, Integrator::implicit_euler}), steps.dq};
    std::vector<std::unique_ptr<Rolling>> runs;
    study::Progress checking(options.program(), patches.size(), study::shows_progress(options), "patches checked");
    for (const Patch& patch : patches) {
        checking.doing(patch.label());
        runs.push_back(std::make_unique<Rolling>(patch, pressure, scene.load, scene.integrator));
        checking.update(runs.size());
    }
    checking.clear();
    std::vector<std::string> ended(patches.size());
    study::Table table = study::table_of(transient_columns, patches, steps.count);
    table.compute = [&](std::size_t task, study::RowRange range, const study::Emit& emit) {
        ended[task] = Run(scene, *runs[task]).rows(range, emit);
    };
    table.plot = [&](const std::vector<study::Row>& drawn) {
        return draw_in_time(transient_columns, drawn, scene.load.has_value());
    };
    table.resumable = !options.given("plot");
    study::write_runs(options, table, ended);
}

}  // namespace patch
