// The C interface: what the library has, behind plain numbers, handles and codes. No exception leaves it.
#include <cmath>
#include <cstddef>
#include <filesystem>
#include <initializer_list>
#include <memory>
#include <stdexcept>
#include <string>

#include <Eigen/Core>
#include <rollbem.h>

#include <rollbem/compiled/creep_force_table.hpp>
#include <rollbem/compiled/friction.hpp>
#include <rollbem/compiled/patch.hpp>
#include <rollbem/compiled/stability.hpp>
#include <rollbem/compiled/wheelset.hpp>
#include <rollbem/detail/require.hpp>
#include <rollbem/friction/model.hpp>
#include <rollbem/normal/hertz_ellipse.hpp>
#include <rollbem/normal/load.hpp>
#include <rollbem/normal/profile.hpp>
#include <rollbem/rolling/run.hpp>

using namespace rollbem;

namespace {

thread_local std::string last_error;

int failed(const std::string& message, int code = ROLLBEM_FAILED) {
    last_error = message;
    return code;
}

/// Calls what returns a code, and turns exceptions into one.
template <class Call>
int guarded(const Call& call) noexcept {
    try {
        return static_cast<int>(call());
    } catch (const std::invalid_argument& error) {
        return failed(error.what(), ROLLBEM_INVALID);
    } catch (const std::exception& error) {
        return failed(error.what());
    }
}

/// An argument that may not be NULL.
struct Given {
    const char* name;
    const void* pointer;
};

/// Throws std::invalid_argument, naming the first that is NULL.
void require_given(const char* who, std::initializer_list<Given> arguments) {
    for (const Given& argument : arguments) {
        detail::require(argument.pointer != nullptr, who, argument.name, "NULL", "not be NULL");
    }
}

/// Makes a handle; null if that throws.
template <class Make>
auto made(const Make& make) noexcept -> decltype(make().release()) {
    decltype(make().release()) handle = nullptr;
    guarded([&] {
        handle = make().release();
        return ROLLBEM_OK;
    });
    return handle;
}

/// Writes numbers in a row, and returns the place behind them.
double* put(double* to, std::initializer_list<double> values) { return std::copy(values.begin(), values.end(), to); }
double* put(double* to, const TangentialForce<double>& of) { return put(to, {of.longitudinal, of.lateral, of.moment}); }
double* put(double* to, const CreepageTangent<double>& of) {
    return put(put(put(to, of.by_longitudinal), of.by_lateral), of.by_spin);
}

Creepage<double> creepage_from(const double* numbers) { return {numbers[0], numbers[1], numbers[2]}; }

}  // namespace

struct rollbem_table {
    CreepForceTable table;
};

struct rollbem_patch {
    using Model = FrictionModel<ConstantFriction<double>, 2>;

    rollbem_patch(const PatchContact<double>& contact, double mu, double load, const PatchMesh<double>& mesh)
        : load_(load),
          a_(contact.half_length()),
          b_(contact.half_width()),
          pressure_(hertz_pressures(contact, mesh, load)),
          model_(contact, breathing_system(contact, mesh, scheme, HalfSpace<double>(contact.poisson_ratio())),
                 judge_stability(patch_parts(mesh, scheme, HalfSpace<double>(contact.poisson_ratio()))),
                 Friction<>{mu, pressure_}),
          run_(model_),
          under_{pressure_, a_, pressure_ / (3 * load), b_} {}

    /// Solves by try_solve(under) with the load set, and writes the results.
    template <class Solve>
    int solve(const char* who, double load, const Solve& try_solve, double* force, double* tangent, double* work) {
        // a and b grow like N^(1/3), and so do pressures
        const double scale = std::cbrt(load / load_);
        under_.normal_pressure = scale * pressure_;
        under_.half_length = scale * a_;
        under_.half_width = scale * b_;
        under_.pressure_rate = scale / (3 * load) * pressure_;
        const FrictionStep<2> step = try_solve(under_);
        put(force, step.force);
        if (work != nullptr) *work = step.slip_work;
        if (tangent != nullptr) {
            // b follows a
            put(put(tangent, step.tangent),
                step.tangent_by_load + under_.half_length / (3 * load) * step.tangent_by_half_length);
        }
        return step.status == StepStatus::ok ? ROLLBEM_OK
                                             : failed(std::string(who) + ": status is " + name(step.status));
    }

    /// Calls visit(number) for all numbers of a state in turn.
    template <class State, class Visit>
    static void for_state(State& state, const Visit& visit) {
        for (auto* vectors : {&state.traction, &state.plain_traction}) {
            for (Eigen::Index i = 0; i < vectors->size(); ++i) visit(vectors->data()[i]);
        }
        for (Eigen::Index i = 0; i < state.normal_pressure.size(); ++i) visit(state.normal_pressure[i]);
        visit(state.half_length);
        visit(state.half_width);
    }

    static constexpr NodeDifference scheme{Nodes::chebyshev};

    double load_, a_, b_;
    Eigen::ArrayXd pressure_;
    Model model_;
    Run<Model> run_;
    NormalLoad<double> under_;
};

struct rollbem_wheel {
    WheelOnRail wheel;
    WheelOnRail::Workspace workspace{};
};

const char* rollbem_last_error(void) { return last_error.c_str(); }
const char* rollbem_version(void) { return ROLLBEM_VERSION; }

// --- creep forces by look-up -----------------------------------------------------------------------------------------

rollbem_table* rollbem_table_open(const char* path) {
    return made([&] {
        require_given("rollbem_table_open", {{"path", path}});
        const std::u8string text(path, path + std::char_traits<char>::length(path));
        return std::make_unique<rollbem_table>(rollbem_table{CreepForceTable::read(std::filesystem::path(text))});
    });
}

void rollbem_table_close(rollbem_table* table) { delete table; }

int rollbem_table_forces(const rollbem_table* table, size_t count, const double* contacts, double* forces,
                         double* tangents) {
    const char* const who = "rollbem_table_forces";
    int code = guarded([&] {
        require_given(who, {{"table", table}});
        if (count > 0) require_given(who, {{"contacts", contacts}, {"forces", forces}});
        return ROLLBEM_OK;
    });
    if (code != ROLLBEM_OK) return code;
    const auto severity = [](int of) { return of == ROLLBEM_OK ? 0 : of == ROLLBEM_OFF_TABLE ? 1 : 2; };
    std::string message;  // of the first contact that is worst
    for (size_t i = 0; i < count; ++i, contacts += 9) {
        TabulatedForce found;
        const int own = guarded([&] {
            found = table->table.look_up(PatchContact<double>({contacts[0], contacts[1], contacts[2], contacts[3]}),
                                         contacts[4], contacts[5], creepage_from(contacts + 6));
            if (found.status != StepStatus::ok) return failed(std::string(who) + ": status is " + name(found.status));
            if (found.a_over_b_on_table || code != ROLLBEM_OK) return static_cast<int>(ROLLBEM_OK);
            const CreepForceGrid& grid = table->table.grid();
            return failed(std::string(who) + ": a/b = " + detail::to_text(contacts[0] / contacts[1]) +
                              " lies beyond the table, " + detail::to_text(grid.smallest_a_over_b()) + " to " +
                              detail::to_text(grid.largest_a_over_b()) + ": forces are those of its border",
                          ROLLBEM_OFF_TABLE);
        });
        forces = put(forces, found.force);
        if (tangents != nullptr) {
            tangents = put(tangents, found.tangent);
            for (const auto& by : {found.tangent_by_load, found.tangent_by_friction_coefficient,
                                   found.tangent_by_half_length, found.tangent_by_half_width}) {
                tangents = put(tangents, by);
            }
        }
        if (severity(own) <= severity(code)) continue;
        code = own;
        message = last_error + " (contact " + std::to_string(i) + ")";
    }
    return code == ROLLBEM_OK ? code : failed(message, code);
}

// --- Hertz and Kalker ------------------------------------------------------------------------------------------------

int rollbem_hertz(double load, const double radii[4], double angle, const double bodies[4], double result[5]) {
    return guarded([&] {
        require_given("rollbem_hertz", {{"radii", radii}, {"bodies", bodies}, {"result", result}});
        const HertzEllipse<double> ellipse({.load = load,
                                            .radii_1 = {radii[0], radii[1]},
                                            .radii_2 = {radii[2], radii[3]},
                                            .angle = angle,
                                            .body_1 = {bodies[0], bodies[1]},
                                            .body_2 = {bodies[2], bodies[3]}});
        put(result,
            {ellipse.half_length(), ellipse.half_width(), ellipse.approach(), ellipse.peak_pressure(), ellipse.turn()});
        return ROLLBEM_OK;
    });
}

int rollbem_kalker(double a_over_b, double poisson_ratio, int n, double coefficients[5]) {
    return guarded([&] {
        require_given("rollbem_kalker", {{"coefficients", coefficients}});
        const PatchContact<double> contact({a_over_b, 1, 1, poisson_ratio});
        const auto steady = solve_steady(contact, patch_mesh(contact, n, n), rollbem_patch::scheme);
        const CreepCoefficients<double> c = creep_coefficients(contact, steady);
        put(coefficients, {c.c11, c.c22, c.c23, c.c32, c.c33});
        return steady.status == Status::ok ? ROLLBEM_OK
                                           : failed(std::string("rollbem_kalker: status is ") + name(steady.status));
    });
}

// --- a patch in the time domain --------------------------------------------------------------------------------------

rollbem_patch* rollbem_patch_new(double half_length, double half_width, double shear_modulus, double poisson_ratio,
                                 double friction_coefficient, double load, int elements, int strips) {
    return made([&] {
        const PatchContact<double> contact({half_length, half_width, shear_modulus, poisson_ratio});
        return std::make_unique<rollbem_patch>(contact, friction_coefficient, load,
                                               patch_mesh(contact, elements, strips));
    });
}

void rollbem_patch_free(rollbem_patch* patch) { delete patch; }

int rollbem_patch_step(rollbem_patch* patch, double distance, const double creepage[3], double load, double force[3],
                       double tangent[12], double* slip_work) {
    return guarded([&] {
        require_given("rollbem_patch_step", {{"patch", patch}, {"creepage", creepage}, {"force", force}});
        const auto solve = [&](const auto& under) {
            return patch->run_.try_advance(distance, creepage_from(creepage), under);
        };
        return patch->solve("rollbem_patch_step", load, solve, force, tangent, slip_work);
    });
}

int rollbem_patch_steady(rollbem_patch* patch, const double creepage[3], double load, double force[3],
                         double tangent[12], double* slip_work) {
    return guarded([&] {
        require_given("rollbem_patch_steady", {{"patch", patch}, {"creepage", creepage}, {"force", force}});
        // lengths and pressures grow like N^(1/3): F = N f(xi/N^(1/3), eta/N^(1/3), phi), and M_z has another N^(1/3)
        const auto solve = [&](const auto& under) {
            FrictionStep<2> step = patch->run_.try_steady(creepage_from(creepage), under);
            const TangentialForce<double>& f = step.force;
            step.tangent_by_load = 1 / load * TangentialForce<double>{f.longitudinal, f.lateral, 4 * f.moment / 3} +
                                   -creepage[0] / (3 * load) * step.tangent.by_longitudinal +
                                   -creepage[1] / (3 * load) * step.tangent.by_lateral;
            step.tangent_by_half_length = {0, 0, 0};
            return step;
        };
        return patch->solve("rollbem_patch_steady", load, solve, force, tangent, slip_work);
    });
}

void rollbem_patch_accept(rollbem_patch* patch) {
    guarded([&] {
        require_given("rollbem_patch_accept", {{"patch", patch}});
        patch->run_.accept();
        return ROLLBEM_OK;
    });
}

size_t rollbem_patch_state_size(const rollbem_patch* patch) {
    size_t size = 0;
    guarded([&] {
        require_given("rollbem_patch_state_size", {{"patch", patch}});
        size = patch->run_.now().zones.size();
        rollbem_patch::for_state(patch->run_.now(), [&](double) { ++size; });
        return ROLLBEM_OK;
    });
    return size;
}

void rollbem_patch_get_state(const rollbem_patch* patch, double* state) {
    guarded([&] {
        require_given("rollbem_patch_get_state", {{"patch", patch}, {"state", state}});
        const auto& now = patch->run_.now();
        rollbem_patch::for_state(now, [&](double value) { *state++ = value; });
        for (const Zone zone : now.zones) *state++ = static_cast<double>(zone);
        return ROLLBEM_OK;
    });
}

int rollbem_patch_set_state(rollbem_patch* patch, const double* state) {
    return guarded([&] {
        require_given("rollbem_patch_set_state", {{"patch", patch}, {"state", state}});
        auto& now = patch->run_.now();
        rollbem_patch::for_state(now, [&](double& value) { value = *state++; });
        for (Zone& zone : now.zones) zone = *state++ != 0 ? Zone::slip : Zone::stick;
        return ROLLBEM_OK;
    });
}

// --- a wheel on a rail, by their profiles ----------------------------------------------------------------------------

rollbem_wheel* rollbem_wheel_new(const double* wheel, size_t wheel_points, const double* rail, size_t rail_points,
                                 const double dimensions[7]) {
    return made([&] {
        const auto profile = [](const char* quantity, const double* points, size_t count, const auto& standard) {
            if (points == nullptr) {
                detail::require(count == 0, "rollbem_wheel_new", quantity, count, "be 0 where its points are NULL");
                return standard();
            }
            const Eigen::Map<const Eigen::Array2Xd> of(points, 2, static_cast<Eigen::Index>(count));
            return Profile(of.row(0), of.row(1));
        };
        TrackDimensions track;
        if (dimensions != nullptr) {
            const double* const d = dimensions;
            track = {d[0], d[1], d[2], d[3], d[4], d[5], d[6]};
        }
        return std::make_unique<rollbem_wheel>(
            rollbem_wheel{WheelOnRail(profile("wheel_points", wheel, wheel_points, [] { return s1002(); }),
                                      profile("rail_points", rail, rail_points, [] { return rail_60e1(); }), track)});
    });
}

void rollbem_wheel_free(rollbem_wheel* wheel) { delete wheel; }

int rollbem_wheel_carry(rollbem_wheel* wheel, double lateral, double roll, double yaw, double load, size_t most,
                        double* patches, size_t* count) {
    return guarded([&]() -> int {
        require_given("rollbem_wheel_carry", {{"wheel", wheel}, {"count", count}});
        if (most > 0) require_given("rollbem_wheel_carry", {{"patches", patches}});
        *count = 0;
        const auto found = wheel->wheel.solve_for_load({.lateral = lateral, .roll = roll, .yaw = yaw}, load, wheel->workspace);
        if (!has_numbers(found.status)) {
            return failed(std::string("rollbem_wheel_carry: status is ") + name(found.status));
        }
        for (const RailPatch& patch : found.patches) {
            if ((*count)++ >= most) continue;
            patches =
                put(patches, {patch.x, patch.y, patch.z, patch.angle, patch.rolling_radius, patch.load, patch.approach,
                              patch.peak_pressure, patch.area, patch.half_length, patch.half_width, found.height});
        }
        return ROLLBEM_OK;
    });
}
