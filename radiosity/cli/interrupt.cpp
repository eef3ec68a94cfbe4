#include "radiosity/cli/interrupt.h"

#include <csignal>

namespace hemicube::radiosity::cli {
namespace {

volatile std::sig_atomic_t asked_to_stop = 0;

extern "C" void ask_to_stop(int) {
  asked_to_stop = 1;
}

} // namespace

void catch_interrupts() {
  std::signal(SIGXFSZ, SIG_IGN);
  for (const int signal : {SIGINT, SIGTERM}) {
    struct sigaction action = {};
    action.sa_handler = ask_to_stop;
    // The second signal finds the default action. System calls go on: a write must not break off.
    action.sa_flags = static_cast<int>(static_cast<unsigned>(SA_RESETHAND) | SA_RESTART);
    sigemptyset(&action.sa_mask);
    // Whoever starts us may have chosen to ignore the signal, as nohup and `&` in scripts do.
    struct sigaction before = {};
    if (sigaction(signal, nullptr, &before) == 0 && before.sa_handler != SIG_IGN)
      sigaction(signal, &action, nullptr);
  }
}

bool interrupted() noexcept {
  return asked_to_stop != 0;
}

Status check_interrupt() {
  return interrupted() ? Status::error(StatusCode::kCancelled, "interrupted") : Status();
}

} // namespace hemicube::radiosity::cli
