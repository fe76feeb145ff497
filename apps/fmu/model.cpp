// Functions that all models share.
#include "model.hpp"

#include <cstring>
#include <stdexcept>

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

Outcome outcome_of(rollbem::Status status) {
    if (status == rollbem::Status::ok) return Outcome::ok;
    return status == rollbem::Status::not_finite ? Outcome::not_a_number : Outcome::refused;
}

std::span<const Unit> known_units() {
    static constexpr Unit units[] = {{"m", 0, 1, 0},  {"m/s", 0, 1, -1}, {"rad", 0, 0, 0, 1}, {"rad/s", 0, 0, -1, 1},
                                     {"N", 1, 1, -2}, {"N.m", 1, 2, -2}, {"Pa", 1, -1, -2},   {"J", 1, 2, -2}};
    return units;
}

Variable& Model::add(Variable variable) {
    const std::size_t place = variables_.size();
    variables_.push_back(variable);
    if (variable.items != nullptr) {
        const bool sets = variable.causality == Causality::parameter;
        const char* meaning = sets ? " as an integer; 0: as that says" : " as an integer";
        variables_.push_back({.name = variable.name + "_code",
                              .value = sets ? &codes_.emplace_back(0) : &variable.integer(),
                              .description = variable.name + meaning,
                              .causality = variable.causality,
                              .is_code = true});
    }
    return variables_[place];
}

void Model::require_finite_inputs() const {
    for (const Variable& variable : variables_) {
        if (variable.causality != Causality::input) continue;
        require(rollbem::detail::is_finite(variable.real()), variable.name.c_str(), variable.real(), "be finite");
    }
}

void Model::settle_enumerations() {
    for (std::size_t i = 0; i < variables_.size(); ++i) {
        const Variable& variable = variables_[i];
        if (variable.items == nullptr || variable.causality != Causality::parameter) continue;
        const int most = static_cast<int>(variable.items->items.size());
        const auto check = [most](const Variable& one, int least) {
            const std::string rule = "lie in [" + std::to_string(least) + ", " + std::to_string(most) + "]";
            require(one.integer() >= least && one.integer() <= most, one.name.c_str(), one.integer(), rule.c_str());
        };
        const Variable& code = variables_[i + 1];
        check(code, 0);
        if (code.integer() != 0) variable.integer() = code.integer();
        check(variable, 1);
    }
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
