#include <rollbem/rollbem.hpp>
