// Headers from outside this project that most tests include. Each test still includes what it needs.
#pragma once

#include <algorithm>
#include <cmath>
#include <complex>
#include <functional>
#include <limits>
#include <numbers>
#include <string>
#include <vector>

#include <Eigen/Core>
#include <Eigen/LU>

#include "support/catch.hpp"
