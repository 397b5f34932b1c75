#include "end_to_end/program.hpp"

#include <signal.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <chrono>
#include <cmath>
#include <cstdlib>
#include <fstream>
#include <initializer_list>
#include <sstream>
#include <stdexcept>
#include <thread>

namespace breccia::test {

const std::string kSmallCase = R"(title = "two boxes"
[mesh.raster]
cells = [2, 2, 1]
cell_size = "10 mm"
boxes = [2, 1, 1]
gap = ["1 mm", "0 mm", "0 mm"]
group = "box"
[[material]]
group = "box"
young = "4 MPa"
poisson = 0.3
density = "2340 kg/m3"
joints = "breakable"
[[joint]]
group = "box"
penalty_factor = 10
tensile_strength = "20 kPa"
energy_mode_1 = "1 J/m2"
[[contact]]
between = ["*", "*"]
penalty = "40 MPa"
friction = 0.3
[[initial_velocity]]
group = "box"
random = ["1 m/s", "2 m/s"]
seed = 3
[sphere]
centre = ["20 mm", "10 mm", "5 mm"]
radius = "26 mm"
penalty = "40 MPa"
[[stage]]
name = "fly"
end = "4 ms"
[[stage.constraint]]
group = "box.x0"
velocity = { z = 0 }
[output]
frame_interval = "1 ms"
gauges = ["box"]
)";

Scratch::Scratch() {
  std::string pattern = (std::filesystem::temp_directory_path() / "breccia_test_XXXXXX").string();
  if (mkdtemp(pattern.data()) == nullptr) throw std::runtime_error("no scratch folder");
  root_ = pattern;
}

Scratch::~Scratch() { std::filesystem::remove_all(root_); }

std::string Scratch::write(const std::string& name, const std::string& text) const {
  std::ofstream(path(name)) << text;
  return "'" + path(name).string() + "'";
}

namespace {

/// As root, too, as in a container.
std::string launcher(std::size_t ranks) {
  return "exec env OMPI_ALLOW_RUN_AS_ROOT=1 OMPI_ALLOW_RUN_AS_ROOT_CONFIRM=1 '" BRECCIA_MPIEXEC
         "' --oversubscribe -n " +
         std::to_string(ranks);
}

std::string launch(int ranks, const std::string& arguments, const std::string& environment = "") {
  return launcher(static_cast<std::size_t>(ranks)) + (environment.empty() ? "" : " env " + environment) +
         " '" BRECCIA_PROGRAM "' " + arguments;
}

/// @return  the shell, which `exec` lets become the program itself
pid_t start(const std::string& command) {
  const pid_t process = fork();
  if (process == 0) {
    execl("/bin/sh", "sh", "-c", command.c_str(), nullptr);
    _exit(127);
  }
  return process;
}

}  // namespace

Outcome outcome_of(const std::string& command) {
  const Scratch scratch;
  const std::string out = scratch.path("out").string(), err = scratch.path("err").string();
  const int status = std::system((command + " > '" + out + "' 2> '" + err + "' < /dev/null").c_str());
  return {WIFEXITED(status) ? WEXITSTATUS(status) : -1, read_text(out), read_text(err)};
}

Outcome call(const std::string& arguments, const std::string& environment) {
  return outcome_of(environment + " '" BRECCIA_PROGRAM "' " + arguments);
}

Outcome call_ranks(int ranks, const std::string& arguments, const std::string& environment) {
  return outcome_of(launch(ranks, arguments, environment));
}

Outcome call_each_rank(const std::vector<RankCall>& calls) {
  const Scratch scratch;
  std::ofstream script(scratch.path("ranks.sh"));
  for (std::size_t rank = 0; rank < calls.size(); ++rank) {
    script << "[ $OMPI_COMM_WORLD_RANK = " << rank << " ] && exec env " << calls[rank].environment
           << " '" BRECCIA_PROGRAM "' " << calls[rank].arguments << '\n';
  }
  script.close();
  return outcome_of(launcher(calls.size()) + " sh '" + scratch.path("ranks.sh").string() + "'");
}

pid_t start_ranks(int ranks, const std::string& arguments, const std::string& environment) {
  return start(launch(ranks, arguments, environment) + " > /dev/null 2>&1 < /dev/null");
}

int call_interrupted(const std::string& arguments, int signal, const std::function<bool()>& ready) {
  const pid_t process = start("exec '" BRECCIA_PROGRAM "' " + arguments);
  for (int look = 0; look < 2500 && !ready(); ++look) std::this_thread::sleep_for(std::chrono::milliseconds(20));
  kill(process, signal);
  int status = 0;
  waitpid(process, &status, 0);
  return WIFEXITED(status) ? WEXITSTATUS(status) : -1;
}

std::string changed(const std::string& from, const std::string& to) {
  std::string text = kSmallCase;
  const std::size_t at = text.find(from);
  if (at == std::string::npos) throw std::logic_error("not in the small case: " + from);
  return text.replace(at, from.size(), to);
}

std::string read_text(const std::filesystem::path& file) {
  std::ifstream stream(file);
  std::ostringstream text;
  text << stream.rdbuf();
  return text.str();
}

namespace {

std::vector<std::string> cells_of(const std::string& line) {
  std::vector<std::string> cells;
  std::istringstream text(line);
  for (std::string cell; std::getline(text, cell, ',');) cells.push_back(cell);
  return cells;
}

/// Sum of the columns with these names in a row.
double sum_of(const std::vector<std::string>& header, const std::vector<std::string>& row,
              std::initializer_list<const char*> names) {
  double sum = 0;
  for (const char* name : names) {
    const auto found = std::find(header.begin(), header.end(), std::string(name) + " [J]");
    if (found == header.end()) throw std::runtime_error(std::string("no column ") + name);
    sum += std::stod(row.at(static_cast<std::size_t>(found - header.begin())));
  }
  return sum;
}

}  // namespace

std::string history_without_couples(const std::filesystem::path& file) {
  std::istringstream lines(read_text(file));
  std::string text;
  std::size_t left_out = std::string::npos;
  for (std::string line; std::getline(lines, line);) {
    const std::vector<std::string> cells = cells_of(line);
    for (std::size_t column = 0; column < cells.size(); ++column) {
      if (cells[column] == "couples") left_out = column;
      if (column != left_out) text += cells[column] + ",";
    }
    text += "\n";
  }
  return text;
}

std::vector<double> history_column(const std::filesystem::path& file, const std::string& name) {
  std::istringstream lines(read_text(file));
  std::string line;
  std::getline(lines, line);
  const std::vector<std::string> header = cells_of(line);
  const auto found = std::find(header.begin(), header.end(), name);
  if (found == header.end()) throw std::runtime_error("no column " + name);
  std::vector<double> values;
  while (std::getline(lines, line))
    values.push_back(std::stod(cells_of(line).at(static_cast<std::size_t>(found - header.begin()))));
  return values;
}

std::string energy_fault(const std::filesystem::path& history) {
  // Central differences conserve the energy of a linear system exactly and that of others to second order in the step:
  // this share of the largest energy is above what the small cases of the tests show at the default step.
  constexpr double kSecondOrder = 2e-3;
  std::istringstream lines(read_text(history));
  std::string line;
  std::getline(lines, line);
  const std::vector<std::string> header = cells_of(line);
  constexpr std::array kDissipated{"joint mode 1", "joint mode 2",     "joint friction", "contact dissipated",
                                   "plastic",      "contact friction", "viscous",        "damping"};
  std::array<double, kDissipated.size()> before{};
  double first = 0, largest = 0;
  for (bool is_first = true; std::getline(lines, line); is_first = false) {
    const std::vector<std::string> row = cells_of(line);
    for (std::size_t t = 0; t < kDissipated.size(); ++t) {
      const double now = sum_of(header, row, {kDissipated[t]});
      if (now < before[t]) return std::string(kDissipated[t]) + " falls in step " + row.at(0);
      before[t] = now;
    }
    const double held = sum_of(header, row, {"kinetic", "elastic", "joint elastic", "contact stored"});
    const double put_in = sum_of(header, row, {"external work"});
    if (is_first) first = held - put_in;
    largest = std::max({largest, held, std::abs(put_in)});
    if (held - put_in > first + kSecondOrder * largest) return "energy is created by step " + row.at(0);
  }
  return {};
}

}  // namespace breccia::test
