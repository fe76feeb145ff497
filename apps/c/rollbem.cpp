// The C interface: the library behind plain numbers, handles and codes. No exception leaves it.
#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <filesystem>
#include <initializer_list>
#include <limits>
#include <memory>
#include <stdexcept>
#include <string>
#include <utility>

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
#include <rollbem/normal/surface_file.hpp>
#include <rollbem/rolling/run.hpp>

using namespace rollbem;

namespace {

thread_local std::string last_error;

int failed(const std::string& message, int code = ROLLBEM_FAILED) {
    last_error = message;
    return code;
}

/// Returns the code of call(), or the code of its exception.
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

/// Throws std::invalid_argument, naming the first argument that is NULL.
void require_given(const char* who, std::initializer_list<Given> arguments) {
    for (const Given& argument : arguments) {
        detail::require(argument.pointer != nullptr, who, argument.name, "NULL", "not be NULL");
    }
}

/// The handle from make(); null if make() throws.
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

std::filesystem::path path_of(const char* utf8) {
    return std::u8string(utf8, utf8 + std::char_traits<char>::length(utf8));
}

Creepage<double> creepage_from(const double* numbers) { return {numbers[0], numbers[1], numbers[2]}; }

}  // namespace

struct rollbem_table {
    CreepForceTable table;
};

struct rollbem_contact_table {
    ContactTable table;
    std::array<WheelFriction, 2> friction{};  // left and right
};

struct rollbem_patch {
    using Model = FrictionModel<ConstantFriction<double>, 2>;

    rollbem_patch(const PatchContact<double>& contact, double mu, double load, const PatchMesh<double>& mesh)
        : load_(load),
          a_(contact.half_length()),
          b_(contact.half_width()),
          pressure_(hertz_pressures(contact, mesh, load)),
          model_(contact, breathing_system(contact, mesh, scheme, HalfSpace<double>(contact.poisson_ratio())),
                 judge_stability(patch_subsystems(mesh, scheme, HalfSpace<double>(contact.poisson_ratio()))),
                 Friction<>{mu, pressure_}),
          run_(model_),
          under_{pressure_, a_, pressure_ / (3 * load), b_} {}

    /// Sets the load, solves by try_solve(under) and writes the results.
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
            // the rate of b is contained in tangent_by_half_length, as b follows a
            put(put(tangent, step.tangent),
                step.tangent_by_load + under_.half_length / (3 * load) * step.tangent_by_half_length);
        }
        return step.status == Status::ok ? ROLLBEM_OK : failed(std::string(who) + ": status is " + name(step.status));
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
    WheelOnRail::Options options{};
    std::string notes{};
    WheelOnRail::Workspace workspace{};

    /// Writes the patches of solve(), or the reason why there are none to last_error.
    template <class Solve>
    static int write(const char* who, size_t most, double* patches, size_t* count, const Solve& solve) {
        require_given(who, {{"count", count}});
        if (most > 0) require_given(who, {{"patches", patches}});
        *count = 0;
        const WheelOnRail::Contact found = solve();
        if (!has_numbers(found.status)) return failed(std::string(who) + ": status is " + name(found.status));
        for (const RailPatch& patch : found.patches) {
            if ((*count)++ >= most) continue;
            patches =
                put(patches, {patch.x, patch.y, patch.z, patch.angle, patch.rolling_radius, patch.load, patch.approach,
                              patch.peak_pressure, patch.area, patch.half_length, patch.half_width, found.height});
        }
        return ROLLBEM_OK;
    }
};

const char* rollbem_last_error(void) { return last_error.c_str(); }
const char* rollbem_version(void) { return ROLLBEM_VERSION; }

// --- creep forces by look-up -----------------------------------------------------------------------------------------

rollbem_table* rollbem_table_open(const char* path) {
    return made([&] {
        require_given("rollbem_table_open", {{"path", path}});
        return std::make_unique<rollbem_table>(rollbem_table{CreepForceTable::read(path_of(path))});
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
    std::string message;  // about the first of the worst contacts
    for (size_t i = 0; i < count; ++i, contacts += 9) {
        TabulatedForce found;
        const int own = guarded([&] {
            found = table->table.look_up(PatchContact<double>({contacts[0], contacts[1], contacts[2], contacts[3]}),
                                         contacts[4], contacts[5], creepage_from(contacts + 6));
            if (found.status != Status::ok) return failed(std::string(who) + ": status is " + name(found.status));
            if (found.a_over_b_on_table || code != ROLLBEM_OK) return static_cast<int>(ROLLBEM_OK);
            const CreepForceGrid& grid = table->table.grid();
            return failed(std::string(who) + ": a/b = " + detail::to_text(contacts[0] / contacts[1]) +
                              " lies beyond the table, " + detail::to_text(grid.smallest_a_over_b()) + " to " +
                              detail::to_text(grid.largest_a_over_b()) + ": its border gives the forces",
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

// --- wheelsets by look-up --------------------------------------------------------------------------------------------

rollbem_contact_table* rollbem_contact_table_open(const char* path) {
    return made([&] {
        require_given("rollbem_contact_table_open", {{"path", path}});
        return std::make_unique<rollbem_contact_table>(rollbem_contact_table{ContactTable::read(path_of(path))});
    });
}

void rollbem_contact_table_close(rollbem_contact_table* table) { delete table; }

/// The rule that an input of a look-up breaks; empty if each input alone is valid.
static std::string reason_of(const ContactTable& table, const double inputs[11]) {
    constexpr std::array names{
        "lateral position", "yaw",       "forward speed", "pitch rate", "lateral speed",
        "vertical speed",   "roll rate", "yaw rate",      "load",       "coefficient of friction"};
    const auto says = [&](std::size_t k, const std::string& rule) {
        return ": " + std::string(names[k]) + " = " + detail::to_text(inputs[k]) + " must " + rule;
    };
    for (std::size_t k = 0; k < names.size(); ++k) {
        if (!detail::is_finite(inputs[k])) return says(k, "be finite");
    }
    if (!table.covers(inputs[0], 0)) return says(0, "lie within +-" + detail::to_text(table.largest_shift()));
    if (!table.covers(0, inputs[1])) return says(1, "lie within +-" + detail::to_text(table.largest_yaw()));
    for (const std::size_t k : {std::size_t(WheelForces::load), std::size_t(WheelForces::mu)}) {
        if (inputs[k] < 0) return says(k, "not be negative");
    }
    return "";
}

int rollbem_contact_table_look_up(const rollbem_contact_table* table, const rollbem_table* creep, int side,
                                  const double inputs[11], double force[6], double tangent[66], double points[40],
                                  double* heat) {
    return guarded([&] {
        constexpr const char* who = "rollbem_contact_table_look_up";
        require_given(who, {{"table", table}, {"creep", creep}, {"inputs", inputs}, {"force", force}});
        detail::require(side == ROLLBEM_LEFT || side == ROLLBEM_RIGHT, who, "side", side, "be 0 (left) or 1 (right)");
        WheelLoad load(inputs[WheelForces::load]);
        if (!std::isnan(inputs[WheelForces::roll])) load.roll = inputs[WheelForces::roll];
        const WheelsetPosition at{.lateral = inputs[WheelForces::lateral], .yaw = inputs[WheelForces::yaw]};
        const WheelsetSpeeds speeds{inputs[WheelForces::forward],       inputs[WheelForces::pitch_rate],
                                    inputs[WheelForces::lateral_speed], inputs[WheelForces::vertical_speed],
                                    inputs[WheelForces::roll_rate],     inputs[WheelForces::yaw_rate]};
        const WheelsetSide of = side == ROLLBEM_LEFT ? WheelsetSide::left : WheelsetSide::right;
        WheelFriction friction = table->friction[std::size_t(side)];
        friction.coefficient = inputs[WheelForces::mu];
        const WheelForces now = tangent == nullptr ? table->table.forces(creep->table, of, at, speeds, load, friction)
                                                   : table->table.look_up(creep->table, of, at, speeds, load, friction);
        std::copy(now.force.begin(), now.force.end(), force);
        if (tangent != nullptr) std::copy_n(now.tangent.data(), now.tangent.size(), tangent);
        const bool known = detail::is_finite(now.force[0]);
        if (heat != nullptr) *heat = known ? now.heat : now.force[0];
        if (tangent != nullptr && !known) std::fill_n(tangent, now.tangent.size(), now.force[0]);
        for (double* to = points; const WheelForces::Point& point : now.points) {
            if (points == nullptr) break;
            to = put(to, {point.load_share, point.arm[0], point.arm[1], point.arm[2], point.angle, point.rolling_radius,
                          point.normal_load, point.peak_pressure, point.rail_y, point.wheel_y});
        }
        if (now.status != Status::ok) {
            return failed(std::string(who) + ": status is " + name(now.status) + reason_of(table->table, inputs));
        }
        if (now.load_on_table || load.vertical == 0) return static_cast<int>(ROLLBEM_OK);
        const auto& loads = table->table.grid().loads;
        return failed(std::string(who) + ": load = " + detail::to_text(load.vertical) + " lies beyond the table, " +
                          detail::to_text(loads.front()) + " to " + detail::to_text(loads.back()) +
                          ": its border gives the contacts",
                      ROLLBEM_OFF_TABLE);
    });
}

int rollbem_contact_table_set_friction(rollbem_contact_table* table, int side, const double factors[4]) {
    return guarded([&] {
        constexpr const char* who = "rollbem_contact_table_set_friction";
        require_given(who, {{"table", table}, {"factors", factors}});
        detail::require(side == ROLLBEM_LEFT || side == ROLLBEM_RIGHT, who, "side", side, "be 0 (left) or 1 (right)");
        for (std::size_t zone = 0; zone < ContactZones::most; ++zone) {
            detail::require(detail::is_finite(factors[zone]) && factors[zone] >= 0, who, "factor", factors[zone],
                            "be finite and not negative");
        }
        std::copy_n(factors, ContactZones::most, table->friction[std::size_t(side)].factor.begin());
        return ROLLBEM_OK;
    });
}

int rollbem_contact_table_support(const rollbem_contact_table* table, int side, double lateral, double yaw,
                                  double height, double load[4]) {
    return guarded([&] {
        constexpr const char* who = "rollbem_contact_table_support";
        require_given(who, {{"table", table}, {"load", load}});
        std::fill_n(load, 4, std::numeric_limits<double>::quiet_NaN());
        detail::require(side == ROLLBEM_LEFT || side == ROLLBEM_RIGHT, who, "side", side,
                        "be ROLLBEM_LEFT or ROLLBEM_RIGHT");
        detail::require_finite(who, "height", height);
        detail::require(table->table.covers(lateral, 0), who, "lateral position", lateral, "lie on the table");
        detail::require(table->table.covers(0, yaw), who, "yaw", yaw, "lie on the table");
        const auto now =
            table->table.support(side == ROLLBEM_LEFT ? WheelsetSide::left : WheelsetSide::right, lateral, yaw, height);
        if (now.status != Status::ok) return failed(std::string(who) + ": status is " + name(now.status));
        put(load, {now.load, now.by_height, now.by_lateral, now.by_yaw});
        return static_cast<int>(ROLLBEM_OK);
    });
}

int rollbem_contact_table_range(const rollbem_contact_table* table, double range[4]) {
    return guarded([&] {
        require_given("rollbem_contact_table_range", {{"table", table}, {"range", range}});
        const auto& loads = table->table.grid().loads;
        put(range, {table->table.largest_shift(), table->table.largest_yaw(), loads.front(), loads.back()});
        return ROLLBEM_OK;
    });
}

int rollbem_contact_table_on_rails(const rollbem_contact_table* table, double lateral, double yaw,
                                   const double loads[2], double height[5], double roll[5]) {
    return guarded([&] {
        constexpr const char* who = "rollbem_contact_table_on_rails";
        require_given(who, {{"table", table}, {"loads", loads}, {"height", height}, {"roll", roll}});
        std::fill_n(height, 5, std::numeric_limits<double>::quiet_NaN());
        std::fill_n(roll, 5, std::numeric_limits<double>::quiet_NaN());
        detail::require(table->table.covers(lateral, 0), who, "lateral position", lateral, "lie on the table");
        detail::require(table->table.covers(0, yaw), who, "yaw", yaw, "lie on the table");
        for (const double load : {loads[0], loads[1]}) detail::require_positive(who, "load", load);
        const auto at = table->table.on_rails(lateral, yaw, {loads[0], loads[1]});
        put(height, {at.height, at.height_by_lateral, at.height_by_yaw, at.height_by_load[0], at.height_by_load[1]});
        put(roll, {at.roll, at.roll_by_lateral, at.roll_by_yaw, at.roll_by_load[0], at.roll_by_load[1]});
        return ROLLBEM_OK;
    });
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
        const auto confirmed = [&](Eigen::Index i, Eigen::Index j, double value) {
            return is_confirmed(steady, i, j) ? value : std::numeric_limits<double>::quiet_NaN();
        };
        put(coefficients, {confirmed(0, 0, c.c11), confirmed(1, 1, c.c22), confirmed(1, 2, c.c23),
                           confirmed(2, 1, c.c32), confirmed(2, 2, c.c33)});
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
            return patch->run_.try_advance({distance, creepage_from(creepage), under});
        };
        return patch->solve("rollbem_patch_step", load, solve, force, tangent, slip_work);
    });
}

int rollbem_patch_steady(rollbem_patch* patch, const double creepage[3], double load, double force[3],
                         double tangent[12], double* slip_work) {
    return guarded([&] {
        require_given("rollbem_patch_steady", {{"patch", patch}, {"creepage", creepage}, {"force", force}});
        // lengths and pressures grow like N^(1/3): F = N f(xi/N^(1/3), eta/N^(1/3), phi); M_z has a further N^(1/3)
        const auto solve = [&](const auto& under) {
            FrictionStep<2> step = patch->run_.try_steady({.motion = creepage_from(creepage), .load = under});
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

namespace {

rollbem_wheel_options default_options() {
    const TrackDimensions d;
    return {.size = sizeof(rollbem_wheel_options),
            .wheel_mirror = 0,
            .rail_mirror = 0,
            .any_shape = 0,
            .by_origin = 0,
            .interaction = 1,
            .per_metre = 1,
            .smooth = 0,
            .cant = RailPlacing{}.cant,
            .gauge = d.gauge,
            .gauge_depth = d.gauge_depth,
            .flange_back = d.flange_back,
            .tape_offset = d.tape_offset,
            .radius = d.radius,
            .rail_origin = {0, 0},
            .roller_radius = 0,
            .shear_modulus = d.shear_modulus,
            .poisson_ratio = d.poisson_ratio};
}

/// The options of a program, checked, or the defaults.
rollbem_wheel_options options_from(const rollbem_wheel_options* given) {
    constexpr const char* who = "rollbem_wheel_open";
    rollbem_wheel_options options = default_options();
    if (given == nullptr) return options;
    detail::require(given->size == sizeof options, who, "options.size", given->size,
                    "be the size that rollbem_wheel_defaults() sets");
    options = *given;
    const auto flag = [&](const char* quantity, int value) {
        detail::require(value == 0 || value == 1, who, quantity, value, "be 0 or 1");
    };
    flag("options.any_shape", options.any_shape);
    flag("options.by_origin", options.by_origin);
    flag("options.interaction", options.interaction);
    for (const int mirror : {options.wheel_mirror, options.rail_mirror}) {
        detail::require(mirror >= 0 && mirror <= (ROLLBEM_MIRROR_Y | ROLLBEM_MIRROR_Z), who, "mirror in options",
                        mirror, "be a sum of ROLLBEM_MIRROR_Y and ROLLBEM_MIRROR_Z");
    }
    return options;
}

ProfileFileOptions file_options(const rollbem_wheel_options& o, int mirror) {
    return {.per_metre = o.per_metre,
            .mirror_y = (mirror & ROLLBEM_MIRROR_Y) != 0,
            .mirror_z = (mirror & ROLLBEM_MIRROR_Z) != 0,
            .smooth = o.smooth,
            .tape_offset = o.tape_offset};
}

WheelsetPosition position_from(const double* p) { return {p[0], p[1], p[2], p[3], p[4], p[5]}; }

}  // namespace

int rollbem_wheel_defaults(rollbem_wheel_options* options, size_t size) {
    return guarded([&] {
        constexpr const char* who = "rollbem_wheel_defaults";
        require_given(who, {{"options", options}});
        detail::require(size == sizeof *options, who, "size", size,
                        "be the size of rollbem_wheel_options in this version");
        *options = default_options();
        return ROLLBEM_OK;
    });
}

rollbem_wheel* rollbem_wheel_open(const char* wheel_path, const char* rail_path, const rollbem_wheel_options* options) {
    return made([&] {
        const rollbem_wheel_options o = options_from(options);
        const bool any_shape = o.any_shape != 0, by_origin = o.by_origin != 0;
        TrackDimensions track{o.gauge,  o.gauge_depth,   o.flange_back,  o.tape_offset,
                              o.radius, o.shear_modulus, o.poisson_ratio};
        if (by_origin) track.rail_origin = TrackDimensions::Origin{o.rail_origin[0], o.rail_origin[1]};
        const auto changes = [&](const std::filesystem::path& name, Profile::Use use, int mirror) {
            ProfileFileOptions how = file_options(o, mirror);
            if (is_standard_profile(name, use)) how.smooth = 0;  // smoothing applies to the profile from a file
            return how;
        };
        const auto wheel_name = path_of(wheel_path != nullptr ? wheel_path : "s1002"),
                   rail_name = path_of(rail_path != nullptr ? rail_path : "60e1");
        const WheelFile wheel =
            open_wheel(wheel_name, changes(wheel_name, Profile::Use::wheel, o.wheel_mirror), any_shape);
        const RailFile rail = open_rail(rail_name, changes(rail_name, Profile::Use::rail, o.rail_mirror),
                                        {o.cant, o.roller_radius, by_origin}, any_shape);
        std::string notes;
        for (const std::string& note : wheel.notes) notes += "wheel: " + note + "\n";
        for (const std::string& note : rail.notes) notes += "rail: " + note + "\n";
        return std::make_unique<rollbem_wheel>(rollbem_wheel{
            WheelOnRail(wheel.surface, rail.surface, track), {.interaction = o.interaction != 0}, std::move(notes)});
    });
}

const char* rollbem_wheel_notes(const rollbem_wheel* wheel) { return wheel != nullptr ? wheel->notes.c_str() : ""; }

int rollbem_wheel_carry(rollbem_wheel* wheel, double lateral, double roll, double yaw, double load, size_t most,
                        double* patches, size_t* count) {
    return guarded([&] {
        constexpr const char* who = "rollbem_wheel_carry";
        require_given(who, {{"wheel", wheel}});
        return rollbem_wheel::write(who, most, patches, count, [&] {
            detail::require_finite(who, "lateral", lateral);
            detail::require_finite(who, "roll", roll);
            detail::require_finite(who, "yaw", yaw);
            detail::require_positive(who, "load", load);
            return wheel->wheel.solve_for_load({.lateral = lateral, .roll = roll, .yaw = yaw}, load, wheel->workspace,
                                               wheel->options);
        });
    });
}

int rollbem_wheel_solve_for_load(rollbem_wheel* wheel, const double position[6], double load, size_t most,
                                 double* patches, size_t* count) {
    return guarded([&] {
        constexpr const char* who = "rollbem_wheel_solve_for_load";
        require_given(who, {{"wheel", wheel}, {"position", position}});
        return rollbem_wheel::write(who, most, patches, count, [&] {
            detail::require_positive(who, "load", load);
            return wheel->wheel.solve_for_load(position_from(position), load, wheel->workspace, wheel->options);
        });
    });
}

int rollbem_wheel_solve_at_height(rollbem_wheel* wheel, const double position[6], size_t most, double* patches,
                                  size_t* count) {
    return guarded([&] {
        constexpr const char* who = "rollbem_wheel_solve_at_height";
        require_given(who, {{"wheel", wheel}, {"position", position}});
        return rollbem_wheel::write(who, most, patches, count, [&] {
            return wheel->wheel.solve_at_height(position_from(position), wheel->workspace, wheel->options);
        });
    });
}
