#include "radiosity/cli/commands.h"
#include "radiosity/cli/console.h"
#include "radiosity/cli/interrupt.h"

#include <cstdlib>
#include <exception>
#include <new>

namespace {

using namespace hemicube;
using namespace hemicube::radiosity::cli;

enum ExitStatus { kDone = 0, kFailed = 1, kUsage = 2, kBadScene = 3, kInterrupted = 130 };

ExitStatus exit_status(StatusCode code) {
  switch (code) {
  case StatusCode::kOk:
    return kDone;
  case StatusCode::kInvalidArgument:
    return kUsage;
  case StatusCode::kBadScene:
    return kBadScene;
  case StatusCode::kCancelled:
    return kInterrupted;
  default:
    return kFailed;
  }
}

Status run_command(const CommandLine& line) {
  switch (line.command) {
  case Command::kSolve:
    return run_solve(line);
  case Command::kFormFactors:
    return run_formfactors(line);
  case Command::kRender:
    return run_render(line);
  case Command::kInfo:
    return run_info(line);
  case Command::kLook:
    return run_look(line);
  case Command::kProbe:
    return run_probe(line);
  case Command::kVerify:
    return run_verify(line);
  }
  return {};
}

int run(int argc, char** argv) {
  CommandLine line;
  switch (parse_command_line(argc, argv, &line)) {
  case ParseOutcome::kUsageError:
    return kUsage;
  case ParseOutcome::kDone:
    break;
  case ParseOutcome::kRun:
    catch_interrupts();
    if (const Status status = run_command(line); !status.ok()) {
      flush_output();
      print_message(status.message());
      return exit_status(status.code());
    }
  }
  if (!flush_output()) {
    print_message("stdout cannot be written");
    return kFailed;
  }
  return kDone;
}

/// Says what was thrown; for handlers.
void print_exception() noexcept {
  try {
    throw;
  } catch (const std::bad_alloc&) {
    print_message("out of memory");
  } catch (const std::exception& exception) {
    print_message(exception.what());
  }
}

/// Ends the program where an exception cannot be caught: libraries have destructors that take
/// memory, as nlohmann::json's do.
[[noreturn]] void end_at_once() noexcept {
  if (std::current_exception() == nullptr)
    std::abort();
  print_exception();
  std::_Exit(kFailed);
}

} // namespace

int main(int argc, char** argv) {
  std::set_terminate(end_at_once);
  try {
    return run(argc, argv);
  } catch (const std::exception&) {
    print_exception();
  }
  return kFailed;
}
