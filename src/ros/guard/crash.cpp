// SPDX-License-Identifier: GPL-3.0-or-later
#include "crash.h"

#include <unistd.h>

#include <atomic>
#include <csignal>
#include <memory>

#include "ending.h"

namespace palpate::node {
namespace {

constexpr int kSignals[] = {SIGSEGV, SIGBUS, SIGFPE, SIGILL, SIGABRT};
constexpr std::size_t kStack = 1 << 16;  // [bytes]
constexpr double kLongest = 1.0;         // [s] the others have

std::atomic<int> crashed_by{0};
thread_local bool fatal_here = false;

void crashed(int signal) {
  int none = 0;
  if (fatal_here || !crashed_by.compare_exchange_strong(none, signal)) {
    std::signal(signal, SIG_DFL);
    std::raise(signal);
    return;
  }
  Ending::limit(kLongest, 1);
  Ending::note();
  for (;;) ::pause();  // the others go on
}

void unblock() {
  sigset_t signals;
  sigemptyset(&signals);
  for (const int signal : kSignals) sigaddset(&signals, signal);
  pthread_sigmask(SIG_UNBLOCK, &signals, nullptr);
}

}  // namespace

void Crash::catchAll() {
  isFatalHere();
  struct sigaction action {};
  action.sa_handler = crashed;
  action.sa_flags = SA_ONSTACK | SA_NODEFER;
  sigemptyset(&action.sa_mask);
  for (const int signal : kSignals) sigaction(signal, &action, nullptr);
}

void Crash::isFatalHere() { fatal_here = true; }

void Crash::catchHere() {
  thread_local const std::unique_ptr<char[]> memory(new char[kStack]);
  stack_t stack{};
  stack.ss_sp = memory.get();
  stack.ss_size = kStack;
  sigaltstack(&stack, nullptr);
  unblock();
}

int Crash::signal() { return crashed_by; }

void Crash::end() {
  std::signal(crashed_by, SIG_DFL);
  unblock();
  std::raise(crashed_by);
  ::_exit(1);
}

}  // namespace palpate::node
