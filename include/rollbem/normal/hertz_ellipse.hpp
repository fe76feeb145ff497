// HertzEllipse by the path of its own; the face is normal/hertz.hpp.
#pragma once

#include "hertz.hpp"
