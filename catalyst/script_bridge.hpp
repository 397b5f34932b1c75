#pragma once

#include <filesystem>
#include <string>
#include <utility>
#include <vector>

#include "catalyst/insitu_abi.h"
#include "catalyst/parameter.hpp"
#include "catalyst/ranks.hpp"
#include "catalyst/turn_watch.hpp"

namespace breccia::insitu {

/// A script among the pipelines.
struct BridgedScript {
  std::string name;
  std::filesystem::path file;
  std::filesystem::path folder;  ///< of its files; exists
  Parameters parameters;
};

/// Data exchanged with python/breccia_catalyst2.py, the first script of ParaView's implementation: the script to
/// execute, whether another rank has failed; and in return the exception of the script, its output, and its requests
/// to the solver. Catalyst 2 itself runs all scripts at every execution and does not report their exceptions. The
/// script finds the functions by the address in its argument.
class ScriptBridge {
 public:
  /// One a process at a time. @pre ranks and watch outlive this
  ScriptBridge(const Ranks& ranks, TurnWatch& watch, const BrecciaConfig& config,
               const std::vector<BridgedScript>& scripts);
  ScriptBridge(const ScriptBridge&) = delete;
  ScriptBridge& operator=(const ScriptBridge&) = delete;
  ~ScriptBridge();

  /// The address of the functions, as a decimal number.
  [[nodiscard]] static std::string address();

  /// The script that is to run in the next execution; empty: none.
  void set_turn(const std::filesystem::path& script);

  /// Result of the execution: throws PipelineError with the exception of the script, or when it was not run; Abandoned
  /// when other ranks have not come in time. Adds its requests.
  void take_result(BrecciaRequests& requests);

  /// Notices of the scripts since the last call, see with_name; on this rank.
  [[nodiscard]] std::string take_notices() { return std::exchange(notices_, {}); }

 private:
  struct Functions;
  static ScriptBridge* active;
  static const char* scripts();
  static const char* turn();
  static int agree(const char* text);
  static void done(const char* error);
  static int request(const char* name, double value);
  static void note(const char* script, const char* lines);

  const Ranks& ranks_;
  TurnWatch& watch_;
  std::string scripts_;  ///< JSON
  std::string turn_;
  bool done_ = false;
  std::string error_, abandoned_, notices_;
  BrecciaRequests requests_{};
};

}  // namespace breccia::insitu
