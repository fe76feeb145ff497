// The least that shows that the headers, Eigen and the language are found.
#include <rollbem/discretisation/mesh.hpp>

int main() { return rollbem::uniform_mesh(4).size() == 4 ? 0 : 1; }
