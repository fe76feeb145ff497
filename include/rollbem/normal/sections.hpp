#pragma once
#include <array>
#include <cstddef>
namespace rollbem { class Sections { public: struct Point { double y, z; std::array<double,2> by_s, by_u; };
 std::size_t parts() const {return 0;} bool covers(std::size_t,double) const {return false;} double length(std::size_t) const {return 0;} Point at(std::size_t,double,double) const noexcept {return {};} }; }
