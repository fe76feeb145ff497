// What most tests include that is not of this project. Each test includes what it needs all the same.
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
