// describe: prints the modelDescription.xml of the FMU that it is linked with; describe --table: the table of its
// variables for the documentation.
#include <cstdio>
#include <string_view>

#include "description.hpp"

int main(int count, char** arguments) {
    const bool table = count > 1 && std::string_view(arguments[1]) == "--table";
    const std::string text = table ? fmu::table_of_variables() : fmu::model_description();
    return std::fputs(text.c_str(), stdout) < 0 || std::fflush(stdout) != 0;
}
