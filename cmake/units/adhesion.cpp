// Full adhesion: frequency response, eigenvalues, state spaces.
#include <rollbem/adhesion/balanced_reduction.hpp>
#include <rollbem/adhesion/frequency.hpp>
#include <rollbem/adhesion/impl/balanced_reduction.ipp>
#include <rollbem/adhesion/impl/frequency.ipp>
#include <rollbem/adhesion/impl/stability.ipp>
#include <rollbem/adhesion/impl/state_space.ipp>
#include <rollbem/adhesion/stability.hpp>
#include <rollbem/adhesion/transient.hpp>
#include <rollbem/assembly/rolling_system.hpp>
#include <rollbem/discretisation/scheme.hpp>
#include <rollbem/elasticity/line_kernel.hpp>
#include <rollbem/spectral/chebyshev.hpp>
#include <rollbem/steady/steady.hpp>
