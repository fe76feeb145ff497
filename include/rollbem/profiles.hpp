// Profiles of wheels and rails, from files or by their equations, and their contacts.
#pragma once

#include "normal/normal_contact.hpp"
#include "normal/profile.hpp"
#include "normal/profile_file.hpp"
#include "normal/surface.hpp"
#include "normal/virtual_penetration.hpp"
#include "normal/wheel_on_rail.hpp"
#include "scene/wheelset.hpp"
#include "status.hpp"
