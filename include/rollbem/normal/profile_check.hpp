#pragma once
#include "profile.hpp"
namespace rollbem { inline void require_wheel(const Profile&, double) {} inline void require_rail(const Profile&) {} }
