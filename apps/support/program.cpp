#include "program.hpp"

#include <cstdio>
#include <exception>
#include <new>
#include <optional>
#include <stdexcept>
#include <string>

#include <gsl/gsl_errno.h>

#include "csv.hpp"
#include "errors.hpp"
#include "files.hpp"

namespace study {

namespace {

int report(const Options& options, const std::string& message, ExitCode code) {
    std::fprintf(stderr, "%s: %s\n", options.program().c_str(), printable(message).c_str());
    return code;
}

}  // namespace

int run_program(Options& options, int argc, const char* const* argv, const std::function<int(const Options&)>& body) {
    gsl_set_error_handler_off();  // the default handler aborts the program
    ignore_write_signals();
    try {
        if (const std::optional<std::string> text = options.parse(argc, argv)) {
            OutputFile standard_output = OutputFile::standard_output();
            standard_output.write(*text);
            standard_output.commit();
            return exit_ok;
        }
        return body(options);
    } catch (const std::invalid_argument& error) {
        return report(options, error.what(), exit_bad_input);
    } catch (const std::bad_alloc&) {
        return report(options, "not enough memory; --n must be smaller", exit_bad_input);
    } catch (const PlotError& error) {
        return report(options, error.what(), exit_no_plot);
    } catch (const WriteError& error) {
        return report(options, error.what(), exit_write_error);
    } catch (const std::exception& error) {
        return report(options, error.what(), exit_failed);
    }
}

}  // namespace study
