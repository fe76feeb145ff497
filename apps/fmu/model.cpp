// Functions that all models share.
#include "model.hpp"

#include <algorithm>
#include <cmath>
#include <cstring>
#include <optional>
#include <span>
#include <stdexcept>
#include <string>

namespace fmu {

namespace {

/// The item `none`, then all of rollbem::Status, counted from 0; name() returns not_finite for every value beyond them.
Enumeration enumerate_statuses() {
    using rollbem::Status;
    Enumeration result{"Status", {{"none", "nothing has been computed yet"}}, 0};
    const std::string beyond = name(Status::not_finite);
    for (int i = 0;; ++i) {
        const std::string item = name(static_cast<Status>(i));
        if (item == beyond && i != static_cast<int>(Status::not_finite)) return result;
        result.items.push_back({item});
    }
}

}  // namespace

const Enumeration step_statuses = enumerate_statuses();

std::span<const Unit> known_units() {
    static constexpr Unit units[] = {{"m", 0, 1, 0},  {"m/s", 0, 1, -1}, {"rad", 0, 0, 0, 1}, {"rad/s", 0, 0, -1, 1},
                                     {"N", 1, 1, -2}, {"N.m", 1, 2, -2}, {"Pa", 1, -1, -2},   {"J", 1, 2, -2}};
    return units;
}

Variable& Model::add(Variable variable) {
    const auto same = [&](const Variable& other) { return other.causality == variable.causality; };
    variable.index = std::ranges::count_if(variables_, same);
    const std::size_t place = variables_.size();
    variables_.push_back(variable);
    if (variable.items != nullptr) {
        const bool sets = variable.causality == Causality::parameter;
        const char* meaning = sets ? " as an integer; 0: as that says" : " as an integer";
        variables_.push_back({.name = variable.name + "_code",
                              .value = sets ? &codes_.emplace_back(0) : &variable.integer(),
                              .description = variable.name + meaning,
                              .causality = variable.causality,
                              .is_code = true,
                              .index = variable.index + 1});
    }
    return variables_[place];
}

void Model::check_range(const Variable& variable, double least, double most) {
    const double value = variable.number();
    const std::string within =
        "lie in [" + rollbem::detail::to_text(least) + ", " + rollbem::detail::to_text(most) + "]";
    require(value >= least && value <= most, variable.name.c_str(), value,
            rollbem::detail::is_finite(most) ? within : "not be negative");
}

void Model::check(Causality causality) const {
    for (const Variable& variable : variables_) {
        if (variable.causality != causality) continue;
        const char* const name = variable.name.c_str();
        if (causality == Causality::input) rollbem::detail::require_finite(identity.identifier, name, variable.real());
        if (variable.rule != nullptr) variable.rule(identity.identifier, name, variable.number());
        if (std::isfinite(variable.min)) check_range(variable, variable.min, variable.max);
    }
}

void Model::settle_enumerations() {
    for (std::size_t i = 0; i < variables_.size(); ++i) {
        const Variable& variable = variables_[i];
        if (variable.items == nullptr || variable.causality != Causality::parameter) continue;
        const Variable& code = variables_[i + 1];
        const double most = static_cast<double>(variable.items->items.size());
        check_range(code, 0, most);
        if (code.integer() != 0) variable.integer() = code.integer();
        check_range(variable, 1, most);
    }
}

void Model::begin() {
    settle_enumerations();
    check(Causality::parameter);
    slip_work_ = 0;
    const std::optional<rollbem::Status> first = build();
    status_ = first ? static_cast<int>(*first) + 1 : 0;
}

rollbem::Status Model::step(double duration) {
    const rollbem::Status status = advance(duration);
    status_ = static_cast<int>(status) + 1;
    return status;
}

void Archive::keep(std::string& text) {
    std::size_t size = text.size();
    keep(size);
    if (reads()) {
        if (left() < size) throw std::invalid_argument("the saved state is too short");
        text.resize(size);
    }
    keep(text.data(), size);
}

void Archive::keep(void* data, std::size_t size) {
    if (size == 0) return;
    if (bytes_ != nullptr) {
        const auto* first = static_cast<const std::byte*>(data);
        bytes_->insert(bytes_->end(), first, first + size);
        return;
    }
    if (source_.size() < size) throw std::invalid_argument("the saved state is too short");
    std::memcpy(data, source_.data(), size);
    source_ = source_.subspan(size);
}

}  // namespace fmu
