#include "rolling.hpp"

#include <rollbem/rolling/run.hpp>

namespace friction {

namespace {

using rollbem::StepStatus;
using Creepage = rollbem::Creepage<double>;

/// -F.s of a relative motion s.
double work(const rollbem::FrictionStep<2>& step, const Creepage& motion) {
    const auto& [F_x, F_y, M_z] = step.force;
    return 0 - F_x * motion.longitudinal - F_y * motion.lateral - (motion.spin == 0 ? 0 : M_z * motion.spin);
}

std::string word(const Rolling& rolling, const Moment& moment) {
    if (!moment.computed) return study::after_failure;
    if (moment.step.status != StepStatus::ok) return name(moment.step.status);
    return !moment.valid ? study::unresolved : rolling.checked ? study::ok : study::unchecked;
}

}  // namespace

std::string roll(const Rolling& rolling, study::RowRange range, const std::function<void(const Moment&)>& emit) {
    const rollbem::FrictionContact& contact = rolling.contact;
    rollbem::Run run(contact);
    Moment now;
    now.step.force = {0, 0, 0};
    now.step.status = StepStatus::ok;
    std::string ended;
    std::size_t row = 0;

    const auto emit_row = [&] {
        if (row++ < range.first) return;
        now.elastic_energy = contact.elastic_energy(run.now());
        now.valid = now.step.status == StepStatus::ok && (!rolling.resolved || rolling.resolved(now.q));
        now.status = word(rolling, now);
        emit(now);
    };
    // the state before a failed step is not that of a later instant: the run is over
    const auto keep = [&](const rollbem::FrictionStep<2>& step, double creep_work) {
        now.step = step;
        now.rounds += step.rounds;
        if (step.status != StepStatus::ok) return;
        now.slip_work += step.slip_work;
        now.jump_work += step.jump_work;
        now.creep_work += creep_work;
    };
    if (rolling.load_at) {
        const rollbem::NormalLoad<double> first = rolling.load_at(0);
        run.now().normal_pressure = first.normal_pressure.head(contact.size());
        run.now().half_length = first.half_length;
        if (first.half_width > 0) run.now().half_width = first.half_width;
    }
    if (rolling.shift) {
        const auto step =
            run.advance({{0, rolling.run.steps.dq}, rollbem::FrictionContact::Motion::shift(*rolling.shift)});
        keep(step, work(step, *rolling.shift) / 2);  // the mean force, from none
        now.shifted = true;
        if (step.status != StepStatus::ok) ended = study::why_ended(0, step.status);
        emit_row();
        now.shifted = false;
    }
    if (rolling.run.from_steady) {
        now.step = run.steady({rollbem::Travel<>::at_speed(1.0), rolling.creepage(0)});
        if (now.step.status != StepStatus::ok) ended = study::why_ended(0, now.step.status);
    }
    rollbem::FrictionStep<2> failed;
    const auto step = [&](double from, double to) {
        const Creepage start = rolling.creepage(from), end = rolling.creepage(to);
        const double distance = rolling.a_0 * (to - from), before = work(now.step, start);
        const rollbem::Travel<double> travel{distance, distance};
        const auto motion = rollbem::FrictionContact::Motion::linear(start, end);
        rollbem::NormalLoad<double> load;
        if (rolling.load_at) load = rolling.load_at(to);
        const auto next = rolling.load_at ? run.advance({travel, motion, load}) : run.advance({travel, motion});
        if (next.status != StepStatus::ok) {
            failed = next;
            return next.status;
        }
        const double after = work(next, end);  // implicit Euler knows no other
        keep(next, distance * (study::named(rolling.run.integrator).order > 1 ? (before + after) / 2 : after));
        return next.status;
    };
    for (std::size_t k = 0; row < range.last; ++k) {
        now.q = double(k + 1) * rolling.run.steps.dq;
        now.computed = ended.empty();
        now.rounds = 0;
        if (now.computed) {
            const auto failed_at = study::roll(double(k) * rolling.run.steps.dq, now.q, rolling.knots, step);
            if (failed_at) {
                keep(failed, 0);
                ended = study::why_ended(*failed_at, failed.status);
            }
        }
        emit_row();
    }
    return ended;
}

}  // namespace friction
