// What all models share.
#include "model.hpp"

#include <array>
#include <cstring>
#include <stdexcept>

namespace fmu {

std::span<const Unit> known_units() {
    static constexpr std::array<Unit, 6> units{
        {{"m", 0, 1, 0}, {"m/s", 0, 1, -1}, {"N", 1, 1, -2}, {"N/s", 1, 1, -3}, {"Pa", 1, -1, -2}, {"J", 1, 2, -2}}};
    return units;
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
