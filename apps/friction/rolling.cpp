#include "rolling.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include <rollbem/rolling/run.hpp>

namespace friction {

namespace {

using rollbem::Status;
using Creepage = rollbem::Creepage;
using Step = rollbem::FrictionStep;
using Motion = rollbem::FrictionModel::Motion;

/// -F.s of a relative motion s.
double work(const Step& step, const Creepage& motion) {
    const auto& [F_x, F_y, M_z] = step.force;
    return 0 - F_x * motion.longitudinal - F_y * motion.lateral - (motion.spin == 0 ? 0 : M_z * motion.spin);
}

Creepage sum(const Creepage& one, const Creepage& other, double factor = 1) {
    return {one.longitudinal + factor * other.longitudinal, one.lateral + factor * other.lateral,
            one.spin + factor * other.spin};
}

std::string word(const Rolling& rolling, const Moment& moment) {
    if (!moment.computed) return study::after_failure;
    if (moment.step.status != Status::ok) return name(moment.step.status);
    return !moment.valid ? study::unresolved : rolling.run.checked ? study::ok : study::unchecked;
}

/// One run, step by step.
class Driver {
public:
    explicit Driver(const Rolling& rolling) : rolling_(rolling), run_(rolling.contact) {
        now_.step.force = {0, 0, 0};
        now_.step.status = Status::ok;
        if (rolling.load_at) run_.now() = rolling.contact.at_rest(rolling.load_at(0));
    }

    std::string roll(study::RowRange range, const std::function<void(const Moment&)>& emit) {
        std::size_t row = 0;
        const auto emit_row = [&] {
            if (row++ < range.first) return;
            now_.elastic_energy = rolling_.contact.elastic_energy(run_.now());
            const bool resolved =
                rolling_.run.imposed.resolved(rolling_.run.steps.dq) && (!rolling_.fits || rolling_.fits(now_.q));
            now_.valid = now_.step.status == Status::ok && resolved;
            now_.status = word(rolling_, now_);
            emit(now_);
        };
        if (rolling_.run.begins_with_shift()) {
            now_.shifted = true;
            const Status status = jump(0);
            if (status != Status::ok) end(0, failed_);
            emit_row();
            now_.shifted = false;
        }
        if (rolling_.run.from_steady) begin_steadily();
        for (std::size_t k = 0; row < range.last; ++k) {
            roll_row(k);
            emit_row();
        }
        return ended_;
    }

private:
    void roll_row(std::size_t k) {
        const double dq = rolling_.run.steps.dq;
        now_.q = double(k + 1) * dq;
        now_.computed = ended_.empty();
        now_.rounds = 0;
        now_.shift = {0, 0, 0};
        if (!now_.computed) return;
        const auto failed_at =
            study::roll(double(k) * dq, now_.q, rolling_.run.imposed.places(), [this](double from, double to) {
                const Status status = jump(from);
                return status == Status::ok ? step(from, to) : status;
            });
        if (failed_at) end(*failed_at, failed_);
    }

    void begin_steadily() {
        Creepage creepage = rolling_.creepage(0, true);
        const auto at = [&](double longitudinal) {
            creepage.longitudinal = longitudinal;
            return run_.try_steady({rollbem::Travel::at_speed(rolling_.speed(0, true)), creepage});
        };
        now_.step = rolling_.run.by_force() ? found(0, true, 0, at) : at(creepage.longitudinal);
        now_.creepage = creepage;
        jumped_at_ = 0;
        if (now_.step.status != Status::ok) return end(0, now_.step);
        run_.accept();
    }

    /// Displaces without rolling, once, where what is imposed jumps.
    Status jump(double q) {
        if (jumped_at_ == q) return Status::ok;
        const std::optional<Creepage> given = rolling_.jump(q);
        if (!given) return Status::ok;
        Creepage shift = *given;
        const auto by = [&](double longitudinal) {
            shift.longitudinal = longitudinal;
            return run_.try_advance({{0, rolling_.run.steps.dq}, Motion::shift(shift)});
        };
        const Step next = rolling_.run.by_force() ? found(q, true, given->longitudinal, by) : by(shift.longitudinal);
        if (next.status != Status::ok) return refuse(next);
        keep(next, (work(now_.step, shift) + work(next, shift)) / 2);
        now_.shift = sum(now_.shift, shift);
        jumped_at_ = q;
        return next.status;
    }

    Status step(double from, double to) {
        const double distance = rolling_.a_0 * (to - from);
        const Creepage shift = sum(rolling_.shift(to, false), rolling_.shift(from, true), -1);
        Creepage start = sum(rolling_.creepage(from, true), shift, 1 / distance);
        Creepage end = sum(rolling_.creepage(to, false), shift, 1 / distance);
        rollbem::NormalLoad load;
        if (rolling_.load_at) load = rolling_.load_at(to);
        const auto advance = [&] {
            const rollbem::Travel travel{distance, rolling_.duration(from, to)};
            const Motion motion = Motion::linear(start, end);
            return rolling_.load_at ? run_.try_advance({travel, motion, load}) : run_.try_advance({travel, motion});
        };
        const auto at = [&](double longitudinal) {
            start.longitudinal = end.longitudinal = longitudinal;
            return advance();
        };
        const Step next = rolling_.run.by_force() ? found(to, false, now_.creepage.longitudinal, at) : advance();
        if (next.status != Status::ok) return refuse(next);
        const double before = work(now_.step, start), after = work(next, end);  // implicit Euler knows no other
        keep(next, distance * (study::named(rolling_.run.integrator).order > 1 ? (before + after) / 2 : after));
        now_.creepage = end;
        now_.shift = sum(now_.shift, shift);
        return next.status;
    }

    /// The last trial of a motion for the force at q.
    Step found(double q, bool behind, double guess, const std::function<Step(double)>& trial) const {
        return find_for_force(rolling_.run.imposed.at("force", q, behind), rolling_.full, guess, trial);
    }

    /// The trial of the run becomes its present state.
    void keep(const Step& step, double creep_work) {
        run_.accept();
        now_.step = step;
        now_.rounds += step.rounds;
        now_.slip_work += step.slip_work;
        now_.jump_work += step.jump_work;
        now_.creep_work += creep_work;
    }

    Status refuse(const Step& step) {
        failed_ = step;
        return step.status;
    }

    // the state before a failed step belongs to no later instant: the run is over
    void end(double q, const Step& failed) {
        now_.step = failed;
        now_.rounds += failed.rounds;
        ended_ = study::why_ended(q, failed.status);
    }

    const Rolling& rolling_;
    rollbem::Run<rollbem::FrictionModel> run_;
    Moment now_;
    Step failed_;
    std::string ended_;
    double jumped_at_ = std::numeric_limits<double>::quiet_NaN();
};

}  // namespace

Creepage Rolling::creepage(double q, bool behind) const {
    const auto value = [&](std::size_t k) { return run.imposed.at(run.columns.creepage[k], q, behind); };
    return {creepage_unit * value(0), creepage_unit * value(1), spin_unit * value(2)};
}

Creepage Rolling::shift(double q, bool behind) const {
    return {a_0 * run.imposed.at(run.columns.shift[0], q, behind),
            a_0 * run.imposed.at(run.columns.shift[1], q, behind), 0};
}

double Rolling::speed(double q, bool behind) const {
    return run.imposed.has("speed") ? run.imposed.at("speed", q, behind) : 1;
}

double Rolling::duration(double from, double to) const {
    const double distance = a_0 * (to - from), first = speed(from, true), last = speed(to, false);
    const double change = last / first - 1;
    return distance / first * (change == 0 ? 1 : std::log1p(change) / change);
}

std::optional<Creepage> Rolling::jump(double q) const {
    const Creepage by = sum(shift(q, true), shift(q, false), -1);
    const bool moves = by.longitudinal != 0 || by.lateral != 0;
    const bool pulls = run.imposed.at("force", q, true) != run.imposed.at("force", q, false);
    return moves || pulls ? std::optional(by) : std::nullopt;
}

Step find_for_force(double force, double full, double guess, const std::function<Step(double)>& trial) {
    constexpr double precision = 1e-13;  // of the force
    Step last;
    const auto miss = [&](double motion) {
        last = trial(motion);
        return last.status == Status::ok ? -last.force.longitudinal / full - force
                                         : std::numeric_limits<double>::quiet_NaN();
    };
    const auto is_done = [](double miss_) { return !(std::abs(miss_) > precision); };
    double a = guess, at_a = miss(a), stride = at_a < 0 ? 0.05 : -0.05;
    if (is_done(at_a)) return last;
    double b = a, at_b = at_a;
    for (int k = 0; at_a * at_b > 0 && k < 40; ++k, stride *= 2) {
        a = b;
        at_a = at_b;
        b += stride;
        at_b = miss(b);
        if (is_done(at_b)) return last;
    }
    if (at_a * at_b > 0) {
        last.status = Status::no_solution;
        return last;
    }
    for (int k = 0; k < 200; ++k) {  // regula falsi, by Illinois
        const double middle = (at_a * b - at_b * a) / (at_a - at_b), at_middle = miss(middle);
        if (is_done(at_middle) || std::abs(b - a) <= 1e-15 * std::max(std::abs(a), std::abs(b))) return last;
        if (at_middle * at_b < 0) {
            a = b;
            at_a = at_b;
        } else {
            at_a /= 2;
        }
        b = middle;
        at_b = at_middle;
    }
    last.status = Status::no_solution;
    return last;
}

std::string roll(const Rolling& rolling, study::RowRange range, const std::function<void(const Moment&)>& emit) {
    return Driver(rolling).roll(range, emit);
}

}  // namespace friction
