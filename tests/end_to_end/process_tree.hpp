#pragma once

#include <sys/types.h>

#include <functional>
#include <string>
#include <vector>

namespace breccia::test {

/// Starts a command of the shell, its output thrown away. Returns the shell, which `exec` lets become the program.
pid_t start_process(const std::string& command);
/// What is started from now on has neither this machine's settings of Open MPI's networks nor this user's.
void forget_network_settings();
/// A process and all below it.
[[nodiscard]] std::vector<pid_t> tree_below(pid_t process);
/// Name of its program; empty: it has ended.
[[nodiscard]] std::string name_of(pid_t process);
/// Where a process listens that other machines can reach: "0.0.0.0:1234 ..."; empty: nowhere.
[[nodiscard]] std::string open_listeners(pid_t process);
/// Kills a process with all below it and waits for it.
void end_tree(pid_t process);
/// Waits for it, a minute at most. Returns whether it has come.
bool wait_until(const std::function<bool()>& condition);

}  // namespace breccia::test
