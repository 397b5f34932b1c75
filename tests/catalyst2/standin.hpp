#pragma once

#include <cstdint>
#include <functional>
#include <string>
#include <vector>

namespace breccia::test {

/// A leaf of a tree of nodes that our libcatalyst was given.
struct StandinLeaf {
  enum Kind { text, integer, real, view_f64, view_i32, view_i64 };
  std::string path;  ///< from the root, "catalyst/state/time"; elements of lists are called 0, 1, ...
  Kind kind;
  std::string words;           ///< of a text
  std::int64_t number = 0;     ///< of an integer
  double value = 0;            ///< of a real
  const void* data = nullptr;  ///< of a view, and so on
  std::int64_t count = 0, offset = 0, stride = 0;
};
using StandinTree = std::vector<StandinLeaf>;

/// A libcatalyst of our own, without an implementation: keeps what it was given, and checks that meshes are such of the
/// Conduit Mesh Blueprint, and that nodes live as long as an implementation may use them.
/// Environment, for programs: STANDIN_FAIL_INITIALIZE, STANDIN_FAIL_EXECUTE: status to return, or "throw", "abort" or
/// "hang";
/// STANDIN_RANK: on that rank of Open MPI alone; STANDIN_ABOUT: name of the implementation that about tells;
/// STANDIN_DUMP: folder in which a file a rank gets a line a cell: channel, step, and the bits of all values.
struct Standin {
  StandinTree initialized;
  std::vector<StandinTree> executed;
  int finalized = 0;
  std::int64_t live_nodes = 0;                    ///< roots that have been created and not destroyed
  std::vector<std::string> problems;              ///< what was wrong with what it was given
  std::function<void()> on_execute, on_finalize;  ///< act as an implementation
  int initialize_status = 0, execute_status = 0;
  bool execute_throws = false;
  std::string about = "standin";
};

/// Of the library in this process, taken by name: the function is `standin`.
using StandinEntry = Standin* (*)();

}  // namespace breccia::test
