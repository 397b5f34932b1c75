#include "simulation/run_control.hpp"

#include <sstream>

namespace breccia {

bool RunControl::asks() {
  if (!file_) return false;
  for (std::string& line : file_->take()) lines_.push_back(std::move(line));
  return !lines_.empty();
}

std::vector<Command> RunControl::receive() {
  std::vector<std::byte> bytes;
  for (const std::string& line : lines_) {
    for (const char c : line + "\n") bytes.push_back(static_cast<std::byte>(c));
  }
  lines_.clear();
  communicator_.broadcast(bytes);
  std::istringstream text(std::string(reinterpret_cast<const char*>(bytes.data()), bytes.size()));
  std::vector<Command> commands;
  for (std::string line; std::getline(text, line);) commands.push_back(parse_command(line));
  return commands;
}

}  // namespace breccia
