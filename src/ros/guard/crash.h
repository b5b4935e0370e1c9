// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

namespace palpate::node {

/// A thread that crashes, by a bad address, an endless recursion or an exception that nobody
/// catches, ends the program; but the others take the force back first. It stays where it crashed,
/// the program ends as Ending has it, in a second at most, and then dies as it would have at once,
/// with its core. Where another thread crashes after it, or one that is needed to take the force
/// back, it dies at once.
class Crash {
 public:
  /// From now on, of all threads but this one, once Ending watches.
  static void catchAll();
  /// The others cannot do without this thread.
  static void isFatalHere();
  /// This one, too, if it is a thread of ROS, which block all signals; and with a stack of its own
  /// for crashes: one by recursion has none left. Ending::guard does so for our threads.
  static void catchHere();

  /// The signal that a thread crashed by; 0: none.
  static int signal();
  /// Ends the program by that signal, as if nobody had caught it.
  [[noreturn]] static void end();
};

}  // namespace palpate::node
