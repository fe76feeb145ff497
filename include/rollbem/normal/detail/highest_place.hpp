// The highest point of a rail's profile.
#pragma once

#include <algorithm>

#include "../profile.hpp"

namespace rollbem {

namespace detail {

/// s of a profile's highest point, where z' = 0, between the neighbours of its highest given point.
inline double highest_place(const Profile& profile) {
    Eigen::Index top = 0;
    profile.z().minCoeff(&top);
    double low = profile.s()[(std::max)(top - 1, Eigen::Index(0))],
           high = profile.s()[(std::min)(top + 1, profile.size() - 1)];
    for (int k = 0; k < 60; ++k) {
        const double middle = (low + high) / 2;
        (profile.at(middle).slope[1] < 0 ? low : high) = middle;
    }
    return low;
}

}  // namespace detail

}  // namespace rollbem
